// How ranks notice that others are suspended, or that their hosts are unreachable.
#pragma once

#include "intervals.hpp"

#include "overturn/text/error.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// Detects ranks that are silent for too long. If this rank itself was suspended, or its disk hung,
/// the time starts again for all: the same may have happened to them.
class SilenceCheck {
public:
    SilenceCheck(std::chrono::seconds patience, std::size_t ranks)
        : patience_(patience), interval_{std::chrono::milliseconds(patience) / 20}, ranks_(ranks)
    {}

    /// True at intervals: look for silent ranks.
    bool is_due() { return interval_.is_due(); }

    /// Called at each interval. signs(i): changes while rank i is alive. Returns the first rank for
    /// which it has not changed for too long.
    template <class Signs>
    std::optional<std::size_t> silent_rank(const Signs& signs)
    {
        const auto now = Clock::now();
        const bool was_suspended = now - last_check_ > std::chrono::milliseconds(patience_) / 2;
        last_check_ = now;
        std::optional<std::size_t> silent;
        for (std::size_t i = 0; i < ranks_.size(); ++i) {
            const std::int64_t sign = signs(i);
            if (was_suspended || sign != ranks_[i].sign) {
                ranks_[i] = {sign, now};
            } else if (!silent && now - ranks_[i].since > patience_) {
                silent = i;
            }
        }
        return silent;
    }

private:
    struct LastSign {
        std::int64_t sign = -1;
        Clock::time_point since = Clock::now();
    };

    std::chrono::seconds patience_;
    IntervalTimer interval_;
    Clock::time_point last_check_ = Clock::now();
    std::vector<LastSign> ranks_;
};

/// on_host: " on HOST"; empty if this rank does not know the host.
inline Error timeout_error(int rank, const std::string& on_host, std::chrono::seconds patience)
{
    return Error(exit_code::stopped,
                 "rank {}{} has not responded for {} s: it is suspended, its disk hangs, or its "
                 "host is unreachable. Finished tiles are kept. Run the same command again to "
                 "resume.",
                 rank, on_host, patience.count());
}

} // namespace overturn
