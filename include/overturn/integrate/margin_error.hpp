// The error bound of the margin of a run, to first order: the local errors of its steps, propagated
// by the linearised motion over steps and impacts, and their effect on the margin (Eqs. 11-20).
#pragma once

#include "overturn/integrate/forced_end.hpp"
#include "overturn/integrate/rocking_step.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"

namespace overturn {

template <Theory theory, Number T>
class MarginError {
    using S = scalar_t<T>;
    using Mask = mask_t<T>;

public:
    /// Whether it is uncertain that an event has happened, so that the error is unknown.
    const Mask& is_doubtful() const { return doubtful_; }

    /// Resets the errors of lanes at rest, which earlier errors do not affect.
    void forget(const Mask& lanes) { growth_.forget(lanes); }

    /// Propagates the errors over a step and adds its local errors.
    void pass_step(const Block<T>& block, const auto& excitation, const Rocking<T>& now,
                   const StepEndWithErrors<T>& step, const Mask& lanes)
    {
        using arithmetic::fma;
        using std::abs;
        const T rounding(std::numeric_limits<S>::epsilon());
        const T rate = abs(now.rate) + abs(step.rate);
        const T acceleration = excitation.largest_acceleration() + block.slenderness;
        // A constant rounding error, e.g. that of the peak of the pulse, adds up; those of the
        // phase and the state are random.
        const T duration = (step.phase - now.phase) / excitation.frequency;
        const T late = abs(step.phase) / excitation.frequency;
        growth_.pass(step.errors.variation, lanes);
        growth_.add(fma(rounding * duration, rate, step.errors.tilt),
                    fma(rounding * duration, acceleration + acceleration, step.errors.rate), lanes);
        growth_.add_round_off({rounding * step.tilt, rounding * rate, rounding * late}, step.rate,
                              step.errors.acceleration, lanes);

        // A block that turned closer to the ground, or to pi/2, than its error may have reached it.
        const T turn = step.errors.turning_tilt;
        const T lower = lesser<T>(now.tilt, step.tilt);
        const Mask dips = now.rate * step.rate > zero_ && lower > zero_ && !(turn >= lower);
        const Mask inward = lanes && ((now.rate < zero_ && step.rate > zero_) || dips);
        const Mask outward = lanes && now.rate > zero_ && step.rate < zero_;
        if (any<T>(inward || outward)) {
            const T radius = growth_.bound(T(S(1)), zero_);
            const Mask met =
                (inward && !(turn > radius)) || (outward && !(T(pi<S>() / 2) - turn > radius));
            doubtful_ = doubtful_ || met;
        }
    }

    /// The first-order error is trusted if the relative error of the squared speed is below 1/4, or
    /// below 1/64 where a series of bounces dies out. A block that stood on its edge for a long
    /// time before it came back may also have overturned: its distance from the top has grown since
    /// then, as has its error, which must still be small compared with alpha.
    void pass_impact(const Block<T>& block, const auto& excitation, const Rocking<T>& now,
                     const Mask& lanes, const Mask& rests)
    {
        using std::sqrt;
        const auto push = now.side * excitation.ground(now.phase);
        const T before = rocking_acceleration<theory>(zero_, block.slenderness, push);
        const T after = rocking_acceleration<theory>(zero_, block.slenderness, mirrored(push));
        const T speed = select<T>(lanes && now.rate < zero_, -now.rate, T(S(1)));
        const T square_error = growth_.bound(T(before + before), T(speed + speed));
        const T share = select<T>(rests, T(S(64)), T(S(4)));
        const T radius = growth_.bound(T(S(1)), zero_);
        const Mask known =
            share * square_error < speed * speed && T(S(4)) * radius < block.slenderness;
        doubtful_ = doubtful_ || (lanes && !(known && now.rate < zero_));
        growth_.forget(doubtful_); // it would only grow until it overflows
        growth_.pass(variation_over_impact<T>(sqrt(block.restitution), speed, before, after),
                     lanes);
    }

    /// The end of the lanes, at `now`, with its error and whether its verdict is in doubt.
    ForcedEnd<T> at_end(const Block<T>& block, const auto& excitation, const Rocking<T>& now,
                        ForcedEnd<T> end) const
    {
        const Mask& fell = end.fell;
        using std::abs;
        using std::sqrt;
        const T one(S(1));
        const T radius = growth_.bound(one, zero_);
        const T largest = separatrix_rate<theory>(zero_, block.slenderness);
        const Distance standing = distance_to_separatrix(block, now, radius, largest);
        // An impact changes the margin by the factor sqrt r.
        const T jump = abs(standing.margin) * (one / sqrt(block.restitution) - one);
        const T near_impact = select<T>(now.tilt < radius, jump, zero_);

        // For a fall at the speed v with the acceleration a, v^2 changes by
        // 2 v d(rate) - 2 a d(tilt).
        const auto push = now.side * excitation.ground(now.phase);
        const T pull = -rocking_acceleration<theory>(now.tilt, block.slenderness, push);
        const T lying = (growth_.bound(T(pull + pull), T(now.rate + now.rate)) +
                         roundings() * now.rate * now.rate) /
                        (largest * largest);
        // Whether it is uncertain that the block falls before the pulse ends.
        const T left = (excitation.motion.end - now.phase) / excitation.frequency;
        const Mask either =
            (fell && left * now.rate < radius) || (!fell && T(pi<S>() / 2) - now.tilt < radius);
        // It is also uncertain whether the block falls at all, unless it falls with some energy.
        // That energy is bounded away from zero; the distance from the separatrix is not. That
        // distance has grown in proportion to its error, which must be a small share of it.
        const Mask barely = fell && !(T(S(4)) * standing.error < abs(standing.margin) &&
                                      lying * largest * largest < now.rate * now.rate);
        const T error = select<T>(fell, lying, standing.error + near_impact);
        const Mask known = growth_.bound(one, one) < T(unknown_error<S> * S(0x1p-100));
        const Mask unknown =
            doubtful_ || end.is_stopped() || either || barely || !known || !(error == error);
        end.error = select<T>(unknown, T(std::numeric_limits<S>::infinity()), error);
        end.in_doubt = !(end.error < abs(margin_of<theory>(end, block)));
        return end;
    }

private:
    static T roundings() { return T(8 * std::numeric_limits<S>::epsilon()); }

    struct Distance {
        T margin;
        T error;
    };

    /// The margin is the smaller of two distances, and either may be overestimated. The lower one
    /// is convex in c, so its gradient is largest at one end of the range of c.
    Distance distance_to_separatrix(const Block<T>& block, const Rocking<T>& now, const T& radius,
                                    const T& largest) const
    {
        using arithmetic::fma;
        using std::abs;
        using std::sqrt;
        const T one(S(1));
        const SafeRates<T> safe = safe_rates<theory>(now.tilt, block);
        const T slope = separatrix_slope<theory>(now.tilt, block.slenderness);
        const auto round_off = [&](const T& limit) -> T {
            return roundings() * (abs(now.rate) + abs(limit)) / largest;
        };
        const auto below_gradient = [&](const T& c) -> T {
            const T inward = sqrt(fma(c, c, safe.minus_q_min));
            return c / select<T>(inward > zero_, inward, largest);
        };
        const T above = (safe.outward - now.rate) / largest;
        const T below = (now.rate + safe.inward) / largest;
        const T above_error = growth_.bound(slope, -one) / largest + round_off(safe.outward);
        const T below_error =
            greater<T>(growth_.bound(T(slope * below_gradient(safe.outward - radius)), one),
                       growth_.bound(T(slope * below_gradient(safe.outward + radius)), one)) /
                largest +
            round_off(safe.inward);
        const T margin = lesser<T>(above, below);
        return {margin, greater<T>(below_error - (below - margin), above_error - (above - margin))};
    }

    T zero_ = T(S(0));
    ErrorGrowth<T> growth_;
    Mask doubtful_ = !(zero_ == zero_); // see is_doubtful()
};

} // namespace overturn
