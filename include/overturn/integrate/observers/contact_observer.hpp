// What the contact must bear during the ground motion: the forces at the ends of every step, and
// extremes within those steps in which a bound allows a larger friction or a smaller normal force.
#pragma once

#include "overturn/integrate/stepper_types.hpp"
#include "overturn/mechanics/free_contact.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"

namespace overturn {

/// A block under a pulse. on: a phase of the smooth piece.
template <Number T>
MovingBlock<T, T> moving_block(const PulseExcitation<T>& excitation, const Rocking<T>& block,
                               const T& on)
{
    const auto push = excitation.motion.template series<2>(block.side * excitation.acceleration,
                                                           block.phase, excitation.frequency, on);
    return {block.tilt, block.rate, push[0], push[1]};
}

/// The tilt and the rate at both ends of a step [rad].
template <Number T>
struct StepEnds {
    T tilt;
    T rate;
    T end_tilt;
    T end_rate;
};

/// A step for the contact. The functions return MovingBlock: at its beginning, at its end
/// and at a share of it; the tilt at a share of it.
template <Number T, class Begin, class End, class At, class TiltAt>
struct ObservedStep {
    T duration;     ///< with respect to tau
    T push_slope;   ///< bound of the derivative of the push, if it is piecewise linear
    bool is_joined; ///< the force at its beginning is that at the end of the step before it
    Begin begin;
    End end;
    At at;
    TiltAt tilt_at;
};

/// A function at a place, with the derivative or its sign.
template <Number T>
struct FunctionSample {
    T place;
    T value;
    T slope;
};

/// Follows the contact. A block beyond alpha that does not come back has overturned, so that what
/// its contact bears there counts only once it comes back.
template <Number T>
class ContactObserver {
    using S = scalar_t<T>;
    using Mask = mask_t<T>;
    using Force = ContactForce<T>;

public:
    explicit ContactObserver(const ContactSides<T>& sides)
        : sides_(sides), inertia_(greater<T>(sides.plus.inertia, sides.minus.inertia))
    {
        kept_ = demand_of(force_at_rest(sides.plus, T(0), T(0))); // before the motion
    }

    /// The side of the block has changed. ground: see fourth_derivative_of_force().
    void set_side(const T& side, const T& slenderness, const std::array<T, 5>& ground)
    {
        side_ = sides_.seen_from(side);
        slenderness_ = slenderness;
        ground_ = ground;
        fastest_ = T(0);
        is_joined_ = false;
    }

    /// The rate has changed since the last step, or the side of a symmetric block.
    void turn(const T& side)
    {
        side_ = sides_.seen_from(side);
        is_joined_ = false;
    }

    /// A trial of a step in the active lanes, which was taken in `lanes`. halvings: of a step that
    /// may have an extreme, before that is searched for.
    template <int halvings>
    void pass_step(const StepEnds<T>& ends, const Mask& active, const Mask& lanes, const auto& step)
    {
        const bool is_joined = is_joined_ && step.is_joined;
        const Force first = is_joined ? last_ : force_of(step.begin());
        const Force last = force_of(step.end());
        last_ = chosen(lanes, last, first);
        is_joined_ = true;
        const Mask begins_beyond = ends.tilt > slenderness_;
        const Mask ends_beyond = ends.end_tilt > slenderness_;
        if (!is_joined) {
            include(demand_of(first), active, begins_beyond);
        }
        const Mask passes = lanes && begins_beyond != ends_beyond;
        const Part whole{first, last, T(0), T(1), step.duration, margin_of(ends, lanes, step)};
        if (any<T>(passes)) {
            pass_alpha<halvings>(whole, lanes, passes, begins_beyond, step);
        } else {
            include(demand_of(last), lanes, begins_beyond);
            include_part<halvings>(whole, lanes, begins_beyond, step);
        }
    }

    /// The block rests at times when it must bear this.
    void pass_rest(const ContactDemand<T>& demand, const Mask& lanes)
    {
        kept_.include(demand, lanes);
    }

    /// The block strikes the corner of a side, which makes a difference only if its sides differ: a
    /// symmetric block needs more friction to lift than to strike.
    void pass_impact(const T& side, const T& slenderness, const Mask& lanes)
    {
        kept_.include_impact(friction_of_plastic_impact(sides_.seen_from(side), slenderness),
                             lanes);
    }

    const ContactSides<T>& sides() const { return sides_; }

    /// What the contact had to bear so far and bears later. gone: the lanes that do not come back
    /// from beyond alpha.
    ContactDemand<T> demand(const Mask& gone, const ContactDemand<T>& later) const
    {
        ContactDemand<T> demand = kept_;
        demand.include(beyond_, !gone);
        demand.include(later, gone || !gone);
        const T infinite(std::numeric_limits<S>::infinity());
        return {select<T>(demand.normal > 0, demand.friction, infinite),
                demand.normal / sides_.plus.cosine};
    }

    /// The friction coefficient from which on the block slips nowhere, impacts included, until the
    /// motion ends, however far it has tilted, and later until it last passes alpha.
    T slip_demand(const ContactDemand<T>& later) const
    {
        ContactDemand<T> demand = kept_;
        const Mask all = kept_.normal == kept_.normal;
        demand.include(beyond_, all);
        demand.include(later, all);
        const T infinite(std::numeric_limits<S>::infinity());
        const T impact = greater<T>(kept_.impact, later.impact);
        return select<T>(demand.normal > 0, greater<T>(demand.friction, impact), infinite);
    }

private:
    /// A part of a step, from the share `from` on.
    struct Part {
        Force first;
        Force last;
        T from;
        T width; ///< [steps]
        T duration;
        T margin; ///< see margin_of()
    };

    Force force_of(const auto& block) const
    {
        return force_while_rocking(side_, slenderness_, block);
    }

    static Force chosen(const Mask& mask, const Force& yes, const Force& no)
    {
        return {select<T>(mask, yes.along, no.along), select<T>(mask, yes.normal, no.normal),
                select<T>(mask, yes.along_slope, no.along_slope),
                select<T>(mask, yes.normal_slope, no.normal_slope)};
    }

    void include(const ContactDemand<T>& demand, const Mask& lanes, const Mask& beyond)
    {
        kept_.include(demand, lanes && !beyond);
        if (any<T>(beyond)) {
            beyond_.include(demand, lanes && beyond);
        }
    }

    /// A force over a step of length h is the cubic through its values and slopes at both ends plus
    /// at most
    ///
    ///     M t^2 (h - t)^2 / 24 <= M h^4 / 288 (b1 + b2)
    ///
    /// with M the bound of its fourth derivative, and b1, b2 the inner Bernstein polynomials: those
    /// of the cubic in Bernstein form, raised by M h^4 / 288, bound the force.
    T margin_of(const StepEnds<T>& ends, const Mask& lanes, const auto& step)
    {
        const T speed = greater<T>(abs(ends.rate), abs(ends.end_rate));
        const T fastest = fma(0.5 * step.duration, ground_[0], speed); // |omega'| <= |c|
        const Mask grows = lanes && (fastest > fastest_ || step.push_slope > ground_[1]);
        if (any<T>(grows)) {
            fastest_ = select<T>(grows, greater<T>(1.5 * fastest, fastest_), fastest_);
            ground_[1] = select<T>(grows, greater<T>(2 * step.push_slope, ground_[1]), ground_[1]);
            roughness_ = fourth_derivative_of_force(inertia_, fastest_, ground_);
        }
        const T square = step.duration * step.duration;
        return roughness_ * T(S(1) / 288) * (square * square);
    }

    /// A step within which the block passes alpha in the lanes `passes`.
    template <int halvings>
    [[gnu::noinline]] void pass_alpha(const Part& whole, const Mask& lanes, const Mask& passes,
                                      const Mask& begins_beyond, const auto& step)
    {
        const auto height_at = [&](const T& share) -> T {
            return step.tilt_at(share) - slenderness_;
        };
        const T pass = select<T>(passes, root_between<T>(T(0), T(1), passes, height_at), T(1));
        const Force there = chosen(passes, force_of(step.at(pass)), whole.last);
        const T rest = 1 - pass;
        const auto part = [&](const Force& first, const Force& last, const T& from,
                              const T& width) -> Part {
            const T square = width * width;
            return {
                first, last, from, width, whole.duration * width, whole.margin * (square * square)};
        };
        include(demand_of(there), lanes, begins_beyond);
        include_part<halvings>(part(whole.first, there, T(0), pass), lanes, begins_beyond, step);
        // A block that comes back had to bear what it bore beyond alpha.
        kept_.include(beyond_, passes && begins_beyond);
        beyond_.forget(passes);
        const Mask beyond_now = passes && !begins_beyond;
        include(demand_of(there), passes, beyond_now);
        include(demand_of(whole.last), passes, beyond_now);
        include_part<halvings>(part(there, whole.last, pass, rest), passes, beyond_now, step);
    }

    template <int halvings>
    [[gnu::always_inline]] void include_part(const Part& part, const Mask& lanes,
                                             const Mask& beyond, const auto& step)
    {
        const T most = greater<T>(kept_.friction, beyond_.friction);
        const T least = lesser<T>(kept_.normal, beyond_.normal);
        const T third = part.duration * T(S(1) / 3);
        const T normal_1 = fma(third, part.first.normal_slope, part.first.normal) - part.margin;
        const T normal_2 = fma(-third, part.last.normal_slope, part.last.normal) - part.margin;
        const T along_1 = abs(fma(third, part.first.along_slope, part.first.along)) + part.margin;
        const T along_2 = abs(fma(-third, part.last.along_slope, part.last.along)) + part.margin;
        const T infinite(std::numeric_limits<S>::infinity());
        const Mask slips =
            lanes && most < infinite && (along_1 > most * normal_1 || along_2 > most * normal_2);
        const Mask lifts = lanes && (normal_1 < least || normal_2 < least);
        if (any<T>(slips || lifts)) {
            if constexpr (halvings > 0) {
                halve<halvings>(part, slips || lifts, beyond, step);
            } else {
                search(part, slips, lifts, beyond, step);
            }
        }
    }

    template <int halvings>
    [[gnu::noinline]] void halve(const Part& part, const Mask& lanes, const Mask& beyond,
                                 const auto& step)
    {
        const T half = 0.5 * part.width;
        const T middle = part.from + half;
        const Force there = force_of(step.at(middle));
        include(demand_of(there), lanes, beyond);
        const T duration = 0.5 * part.duration;
        const T margin = part.margin * T(S(1) / 16);
        include_part<halvings - 1>({part.first, there, part.from, half, duration, margin}, lanes,
                                   beyond, step);
        include_part<halvings - 1>({there, part.last, middle, half, duration, margin}, lanes,
                                   beyond, step);
    }

    /// Finds the largest friction and the smallest normal force within a part.
    [[gnu::noinline]] void search(const Part& part, const Mask& slips, const Mask& lifts,
                                  const Mask& beyond, const auto& step)
    {
        const Mask outward = part.first.along + part.last.along > 0;
        const auto friction_of = [&](const Force& force) -> FunctionSample<T> {
            const T ratio = force.along / force.normal;
            const T slope = (force.along_slope - ratio * force.normal_slope) / force.normal;
            return {T(0), select<T>(outward, ratio, -ratio), select<T>(outward, slope, -slope)};
        };
        const auto relief_of = [](const Force& force) -> FunctionSample<T> {
            return {T(0), -force.normal, -force.normal_slope};
        };
        find_maximum(part, slips, beyond, step, friction_of);
        find_maximum(part, lifts, beyond, step, relief_of);
    }

    /// Where the cubic through the values and slopes at two places has its maximum.
    static T maximum_of_cubic(const FunctionSample<T>& low, const FunctionSample<T>& high,
                              const T& duration)
    {
        const T width = high.place - low.place;
        const T time = width * duration;
        const T rise = 3 * (high.value - low.value);
        const T at_low = time * low.slope;
        const T at_high = time * high.slope;
        const T bend = rise - (at_low + at_low) - at_high;
        const T twist = 3 * (at_low + at_high) - (rise + rise);
        const T square = fma(bend, bend, -(twist * at_low));
        const T divisor = sqrt(greater<T>(square, 0)) - bend;
        const T share = at_low / select<T>(divisor > 0, divisor, T(1));
        return fma(width, select<T>(divisor > 0, share, T(0.5)), low.place);
    }

    /// Includes the demand at the maximum of a function within a part, if the function increases at
    /// its beginning and decreases at its end: where the cubic through both ends has its maximum,
    /// once more for the part that still contains it, and then by the secant method.
    void find_maximum(const Part& part, const Mask& lanes, const Mask& beyond, const auto& step,
                      const auto& function_of)
    {
        FunctionSample<T> low = function_of(part.first);
        FunctionSample<T> high = function_of(part.last);
        low.place = part.from;
        high.place = part.from + part.width;
        FunctionSample<T> there = low;
        FunctionSample<T> before = low;
        Mask open = lanes && low.slope > 0 && high.slope < 0;
        const T enough = T(S(1e-10)) / select<T>(open, step.duration, T(1));
        constexpr int most_passes = 20;
        for (int pass = 0; pass < most_passes && any<T>(open); ++pass) {
            T place;
            if (pass < 2) {
                place = maximum_of_cubic(low, high, step.duration);
            } else {
                const T change = before.slope - there.slope;
                const T secant = (there.place - before.place) * there.slope;
                place = there.place + secant / select<T>(change != 0, change, 1);
            }
            const Mask inside = place > low.place && place < high.place;
            place = select<T>(inside, place, 0.5 * (low.place + high.place));
            before = there;
            const Force force = force_of(step.at(place));
            include(demand_of(force), open, beyond);
            there = function_of(force);
            there.place = place;
            // The rest of the rise, that of a parabola, is slope^2 / (2 curvature), with the
            // smaller of the mean curvatures on both sides.
            const T square_slope = there.slope * there.slope;
            const Mask far =
                square_slope * (place - low.place) > enough * (low.slope - there.slope) ||
                square_slope * (high.place - place) > enough * (there.slope - high.slope);
            const Mask rises = there.slope > 0;
            const auto replace = [&](FunctionSample<T>& end, const Mask& by) {
                end = {select<T>(by, there.place, end.place), select<T>(by, there.value, end.value),
                       select<T>(by, there.slope, end.slope)};
            };
            replace(low, rises);
            replace(high, !rises);
            open = open && far;
        }
    }

    ContactSides<T> sides_;
    T inertia_; // the larger one
    ContactSide<T> side_ = sides_.plus;
    T slenderness_ = T(0);
    std::array<T, 5> ground_{}; // see fourth_derivative_of_force()
    T fastest_ = T(0);          // the rate for which the next one is valid
    T roughness_ = T(0);        // a bound of the fourth derivative of the force
    ContactDemand<T> kept_;
    ContactDemand<T> beyond_; // since the block passed alpha
    Force last_{T(0), T(1)};  // at the end of the latest step
    bool is_joined_ = false;  // the next step begins there
};

} // namespace overturn
