// What a run yields beside its end is computed by observers, one header each. ForcedStage calls
// their hooks; observers.hpp lists them.
#pragma once

#include "overturn/integrate/event_kind.hpp"
#include "overturn/integrate/forced_end.hpp"
#include "overturn/integrate/stepper_types.hpp"

namespace overturn {

/// The hooks, of which each observer defines some. lanes: those in which something happened,
/// without those in which only the contact follows a series of bounces to its end. block: as seen
/// from the side on which it rocks.
struct Observer {
    /// A step of the stepper, which begins at `now`.
    static void pass_step(const auto& /*block*/, const auto& /*excitation*/, const auto& /*now*/,
                          const auto& /*step*/, const auto& /*lanes*/)
    {}

    /// An impact, just before it. rests: the lanes that come to rest by it.
    static void pass_impact(const auto& /*block*/, const auto& /*excitation*/, const auto& /*now*/,
                            const auto& /*lanes*/, const auto& /*rests*/)
    {}

    /// Just after an event or a step.
    static void pass_event(EventKind, const auto& /*now*/, const auto& /*lanes*/) {}

    /// Blocks are seen from their other sides, with alpha larger by this factor.
    static void change_sides(const auto& /*factor*/) {}

    /// Completes the end of the run, which is at `now`. from_plus: the block as seen from its side
    /// plus.
    static void complete(auto& /*end*/, const auto& /*block*/, const auto& /*from_plus*/,
                         const auto& /*excitation*/, const auto& /*now*/)
    {}
};

} // namespace overturn
