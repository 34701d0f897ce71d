// The samples and events of a history, in order of time.
#pragma once

#include "overturn/sweep/history.hpp"

#include <algorithm>

namespace overturn {

/// Records the state of a block up to the last time shown: at evenly spaced times, and before and
/// after each event.
class Timeline {
public:
    /// until: the last time shown.
    Timeline(History& history, double until, int samples)
        : history_(history), until_(until), samples_(samples)
    {}

    bool is_over(double time) const { return time > until_; }

    /// The time between two samples.
    double spacing() const { return until_ / samples_; }

    /// Records the motion until `end`; at(time) returns a sample.
    template <class At>
    void follow(double end, const At& at)
    {
        for (; next_ < samples_; ++next_) {
            const double time = until_ * next_ / std::max(1, samples_ - 1);
            if (time >= end) {
                break;
            }
            history_.samples.push_back(at(time));
        }
        if (end < infinity) {
            last_ = at(end);
        }
    }

    /// The sample at the last time passed to follow().
    const HistorySample& last() const { return last_; }

    /// Records an event at that time.
    void record_event(EventKind event, const HistorySample& after)
    {
        if (!is_over(last_.time)) {
            history_.samples.push_back(last_);
            history_.samples.push_back(after);
            history_.events.push_back({event, last_, after});
        }
    }

    /// Records the last sample of a motion that cannot be computed to its end.
    void record_last()
    {
        if (!is_over(last_.time)) {
            history_.samples.push_back(last_);
        }
    }

private:
    History& history_;
    double until_;
    int samples_;
    int next_ = 0; // sample
    HistorySample last_{};
};

/// The last time that is worth showing of a history whose times are known, if it ends at `end` at
/// the earliest.
inline double time_worth_showing(const History& history, double end)
{
    return std::isnan(history.time_of_rest)
               ? end
               : std::min({history.time_of_fall, std::max(history.time_of_rest, end),
                           end + free_time_shown});
}

} // namespace overturn
