// Instead of sweep/in_threads.cpp: the page has workers, each with a module of its own.
#include "overturn/sweep/in_threads.hpp"

namespace overturn {

int threads_of_processor()
{
    return 1;
}

std::function<bool()> is_this_thread()
{
    return [] { return true; };
}

void in_threads(std::size_t count, int /*threads*/, const std::function<void(std::size_t)>& work,
                const std::function<void(std::size_t done)>& progress)
{
    for (std::size_t i = 0; i < count; ++i) {
        work(i);
        if (progress) {
            progress(i + 1);
        }
    }
}

} // namespace overturn
