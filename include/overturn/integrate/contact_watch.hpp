// What the contact of a block must bear during the forced stage.
#pragma once

#include "overturn/integrate/rocking_step.hpp"
#include "overturn/mechanics/contact.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"

namespace overturn {

/// The block at a share of a step under a pulse, which begins at `now`.
template <Number T>
MovingBlock<T, T> moving_block(const PulseExcitation<T>& excitation, const Rocking<T>& now,
                               const T& phase_step, const T& share, const StepMotion<T>& motion)
{
    const T& frequency = excitation.frequency;
    const auto push = excitation.motion.template series<2>(
        now.side * excitation.acceleration, now.phase + share * phase_step, frequency, now.phase);
    const T steps_per_time = frequency / select<T>(phase_step > 0, phase_step, 1);
    return {motion.position, motion.rate * steps_per_time, push[0], push[1]};
}

/// Follows the contact. A block beyond alpha that does not come back has overturned, so that what
/// its contact bears there counts only once it comes back.
template <Number T>
class ContactWatch {
    using Mask = mask_t<T>;

public:
    explicit ContactWatch(const ContactSides<T>& sides) : sides_(sides)
    {
        kept_ = demand_of(force_at_rest(sides.plus, T(0), T(0))); // before the motion
    }

    /// The trial of a step on a side. start: the tilt at its beginning [rad]; motion_at(share)
    /// returns the MovingBlock at a share of the step. Not inlined: it would change what the
    /// compiler does with other scenes.
    [[gnu::noinline]] void see_step(const T& side, const T& slenderness, const T& start, int parts,
                                    const auto& motion_at)
    {
        const ContactSide<T> seen = sides_.seen_from(side);
        const auto force_at = [&](const T& share) {
            return force_while_rocking(seen, slenderness, motion_at(share));
        };
        const auto height_at = [&](const T& share) -> T {
            return motion_at(share).tilt - slenderness;
        };
        begins_beyond_ = start > slenderness;
        ends_beyond_ = height_at(T(1)) > 0;
        const Mask passes = begins_beyond_ != ends_beyond_;
        T pass(1);
        if (any<T>(passes)) {
            pass = select<T>(passes, root_between<T>(0, 1, passes, height_at), 1);
            after_pass_ = demand_between<T>(pass, 1, parts, force_at);
        }
        before_pass_ = demand_between<T>(0, pass, parts, force_at);
    }

    /// The step was taken in these lanes.
    void take_step(const Mask& lanes)
    {
        const Mask out = lanes && ends_beyond_ && !begins_beyond_;
        const Mask in = lanes && begins_beyond_ && !ends_beyond_;
        beyond_.include(before_pass_, lanes && begins_beyond_);
        kept_.include(before_pass_, lanes && !begins_beyond_);
        kept_.include(beyond_, in);
        kept_.include(after_pass_, in);
        beyond_.forget(in || out);
        beyond_.include(after_pass_, out);
    }

    /// The block rests at times when it must bear this.
    void see_rest(const ContactDemand<T>& demand, const Mask& lanes)
    {
        kept_.include(demand, lanes);
    }

    const ContactSides<T>& sides() const { return sides_; }

    /// What the contact had to bear so far. gone: the lanes that do not come back from beyond
    /// alpha.
    ContactDemand<T> demand(const Mask& gone) const
    {
        ContactDemand<T> demand = kept_;
        demand.include(beyond_, !gone);
        demand.normal = demand.normal / sides_.plus.cosine;
        return demand;
    }

private:
    ContactSides<T> sides_;
    ContactDemand<T> kept_;
    ContactDemand<T> beyond_;      // since the block passed alpha
    ContactDemand<T> before_pass_; // in the latest step, until it passes alpha
    ContactDemand<T> after_pass_;
    Mask begins_beyond_;
    Mask ends_beyond_;
};

} // namespace overturn
