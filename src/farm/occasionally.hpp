// Limits how often something is done in a loop.
#pragma once

#include <chrono>

namespace overturn {

class Occasionally {
    using Clock = std::chrono::steady_clock;

public:
    explicit Occasionally(Clock::duration interval) : interval_(interval) {}

    /// True at most once per interval.
    bool is_due()
    {
        const auto now = Clock::now();
        const bool due = now - last_ >= interval_;
        last_ = due ? now : last_;
        return due;
    }

private:
    Clock::duration interval_;
    Clock::time_point last_ = Clock::now();
};

} // namespace overturn
