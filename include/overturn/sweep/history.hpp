// The history of one point in full: the forced stage, as finely as doubles allow, and after it the
// free stage in closed form, until the block lies, rests, or nobody looks any more.
#pragma once

#include "overturn/integrate/event.hpp"
#include "overturn/mechanics/region.hpp"
#include "overturn/sweep/plane.hpp"

#include <limits>
#include <vector>

namespace overturn {

/// What to look at.
struct HistoryView {
    /// The last time that is shown, since the pulse began [1/p]; not a number: until the block
    /// rests or lies, but no longer than free_time_shown after the pulse.
    double until = std::numeric_limits<double>::quiet_NaN();
    int samples = 2000; ///< evenly spread, beside those at events
};

/// How much of the free stage is shown of a block that does not come to rest [1/p].
inline constexpr double free_time_shown = 60;

/// Impacts that are followed, at most.
inline constexpr int most_impacts_shown = 100'000;

/// The block at one time. An event has two of them, before and after.
struct HistorySample {
    double time;         ///< since the pulse began [1/p]
    double angle;        ///< theta [rad]
    double velocity;     ///< theta' = d theta / d tau [rad]
    double acceleration; ///< theta'' [rad]
    double q;            ///< 4 sin^2((alpha - |theta|)/2) - theta'^2 (Eq. 12) [rad^2]
    double ground;       ///< acceleration of the ground over g [1]
};

struct HistoryEvent {
    EventKind kind; ///< not a step
    HistorySample before;
    HistorySample after;
};

struct History {
    std::vector<HistorySample> samples; ///< in order of time
    std::vector<HistoryEvent> events;   ///< those up to the last sample
    double end_of_pulse;                ///< [1/p]
    double time_of_rest; ///< after which it is not lifted any more [1/p]; or infinite
    double time_of_fall; ///< [1/p]; infinite if it never lies; not a number if undecided
    Region region;
    double margin;
    double error;   ///< of the margin, at most
    bool shortened; ///< there is more than can be followed
};

/// The history of a point. The forced stage does not depend on a job's method and tolerance.
History history_of(const Scene& scene, const PlanePoint& point, const HistoryView& view = {});

} // namespace overturn
