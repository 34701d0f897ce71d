// The full history of one point: the forced stage, as accurate as doubles allow, followed by the
// free stage in closed form until the block lies flat, comes to rest, or the history ends.
#pragma once

#include "overturn/integrate/event_kind.hpp"
#include "overturn/integrate/sliding_mode.hpp"
#include "overturn/mechanics/region.hpp"
#include "overturn/problem/fields.hpp"
#include "overturn/problem/point.hpp"
#include "overturn/problem/scene.hpp"

#include <vector>

namespace overturn {

/// The extent of a history.
struct HistoryView {
    /// The last time shown, since the beginning of the pulse [1/p]; NaN: until the block rests or
    /// lies flat, but at most free_time_shown after the pulse.
    double until = unknown_value;
    int samples = 2000; ///< evenly spaced, in addition to those at events
};

/// Duration of the free stage that is shown for a block that does not come to rest [1/p].
inline constexpr double free_time_shown = 60;

/// The largest number of impacts that is computed.
inline constexpr int most_impacts_shown = 100'000;

/// The state of the block at one time. An event has two samples, one before and one after it.
struct HistorySample {
    double time;            ///< since the pulse began [1/p]
    double angle;           ///< theta [rad]
    double velocity;        ///< theta' = d theta / d tau [rad]
    double acceleration;    ///< theta'' [rad]
    double q;               ///< 4 sin^2((alpha - |theta|)/2) - theta'^2 (Eq. 12) [rad^2]
    double ground;          ///< acceleration of the ground over g [1]
    double friction_demand; ///< coefficient that the contact needs [1]; NaN in the linear theory

    // Of a block with a friction coefficient.
    SlidingMode mode = SlidingMode::rest;
    double slide = 0;          ///< position of the base over R of the side plus [1]
    double slide_velocity = 0; ///< d slide / d tau [1]
    double force_along = 0;    ///< of the base on the block, over the weight, towards plus [1]
    double force_normal = 0;   ///< [1]
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
    double time_of_rest; ///< after which the block does not move [1/p]; may be infinite
    double time_of_fall; ///< [1/p]; infinite if the block never lies flat
    /// Settled with more digits if the error of the margin exceeds it.
    Region region;
    double margin;         ///< of the curve
    double error;          ///< error bound of the margin
    bool is_curve_certain; ///< otherwise the true motion may differ, and the margin and the times
                           ///< of rest and fall are NaN
    bool shortened;        ///< the history could not be computed to its end
    bool slips;            ///< somewhere; then the whole motion is integrated
};

/// The history of a point under a pulse, or under the first record of the scene. The forced stage
/// does not depend on the method and tolerance of a job.
History history_of(const Scene& scene, const Point& point, const HistoryView& view = {});

} // namespace overturn
