// Independent pieces of work, such as objects or tiles, in several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace overturn {

/// The number of threads that this computer runs at once, at least 1.
int threads_of_processor();

/// A function that says whether it is called in the thread that called this one.
std::function<bool()> is_this_thread();

/// Calls work(i) for 0 <= i < count in several threads, and `progress` in this one. The first
/// exception of a thread ends all, and is thrown again.
void in_threads(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                const std::function<void(std::size_t done)>& progress = nullptr);

} // namespace overturn
