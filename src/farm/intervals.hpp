// How often the ranks of a farm do something besides computing tiles.
#pragma once

#include <chrono>

namespace overturn {

using Clock = std::chrono::steady_clock;

/// While a rank computes a tile, it attends to its other duties at this interval.
inline constexpr std::chrono::microseconds attention_interval{100};

/// Rank 0 looks for messages at this interval, which takes a hundredth of it at most.
inline constexpr std::chrono::milliseconds message_interval{1};

/// Limits how often something is done in a loop.
struct IntervalTimer {
    Clock::duration interval;
    Clock::time_point last = Clock::now();

    /// True at most once per interval.
    bool is_due()
    {
        const auto now = Clock::now();
        const bool due = now - last >= interval;
        last = due ? now : last;
        return due;
    }
};

} // namespace overturn
