#include "overturn/sweep/in_threads.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace overturn {

int threads_of_processor()
{
    return int(std::max(1U, std::thread::hardware_concurrency()));
}

std::function<bool()> is_this_thread()
{
    return [caller = std::this_thread::get_id()] { return std::this_thread::get_id() == caller; };
}

void in_threads(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                const std::function<void(std::size_t done)>& progress)
{
    std::atomic<std::size_t> next = 0;
    std::atomic<std::size_t> done = 0;
    std::exception_ptr failure;
    std::mutex mutex;
    const auto take = [&](bool is_caller) {
        for (std::size_t i = next++; i < count; i = next++) {
            try {
                work(i);
            } catch (...) {
                const std::scoped_lock lock(mutex);
                failure = failure ? failure : std::current_exception();
                next = count;
            }
            ++done;
            if (is_caller && progress) {
                progress(done);
            }
        }
    };
    {
        std::vector<std::future<void>> others; // not std::jthread, which libc++ 19 does not have
        for (int i = 1; i < threads; ++i) {
            others.push_back(std::async(std::launch::async, take, false));
        }
        take(true);
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

} // namespace overturn
