// The error bound of the margin of a run, to first order: the local errors of its steps, propagated
// by the linearised motion over steps and impacts, and their effect on the margin (Eqs. 11-20).
#pragma once

#include "overturn/integrate/observers/observer.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"

namespace overturn {

template <Theory theory, Number T>
class MarginError : public Observer {
    using S = scalar_t<T>;
    using E = estimate_t<T>;
    using Mask = mask_t<T>;

public:
    /// Whether it is uncertain that an event has happened, so that the error is unknown.
    const Mask& is_doubtful() const { return doubtful_; }

    /// Earlier errors do not affect a block at rest.
    void pass_event(EventKind kind, const Rocking<T>&, const Mask& lanes)
    {
        if (kind == EventKind::rest && any<T>(lanes)) {
            growth_.forget(lanes);
        }
    }

    /// Propagates the errors over a step and adds its local errors.
    void pass_step(const Block<T>& block, const auto& excitation, const Rocking<T>& now,
                   const auto& step, const Mask& lanes)
    {
        const E rounding = E(scalar_t<E>(std::numeric_limits<S>::epsilon()));
        const E end_rate = estimate_of(step.rate);
        const E rate = abs(estimate_of(now.rate)) + abs(end_rate);
        const E acceleration = estimate_of(excitation.largest_acceleration() + block.slenderness);
        // A constant rounding error, e.g. that of the peak of the pulse, adds up; those of the
        // phase and the state are random.
        const E frequency = estimate_of(excitation.frequency);
        const E duration = estimate_of(step.phase - now.phase) / frequency;
        const E late = abs(estimate_of(step.phase)) / frequency;
        growth_.pass(step.errors.variation, lanes);
        growth_.add(fma(rounding * duration, rate, step.errors.tilt),
                    fma(rounding * duration, acceleration + acceleration, step.errors.rate), lanes);
        growth_.add_round_off({rounding * estimate_of(step.tilt), rounding * rate, rounding * late},
                              end_rate, step.errors.acceleration, lanes);

        // A block that turned closer to the ground, or to pi/2, than its error may have reached it.
        const T turn = step.errors.turning_tilt;
        const T lower = lesser<T>(now.tilt, step.tilt);
        const Mask dips = now.rate * step.rate > 0 && lower > 0 && !(turn >= lower);
        const Mask inward = lanes && ((now.rate < 0 && step.rate > 0) || dips);
        const Mask outward = lanes && now.rate > 0 && step.rate < 0;
        if (any<T>(inward || outward)) {
            const T radius = bound(1, 0);
            const Mask met =
                (inward && !(turn > radius)) || (outward && !(T(pi<S>() / 2) - turn > radius));
            doubtful_ = doubtful_ || met;
        }
    }

    /// The first-order error is trusted if the relative error of the squared speed is below 1/4, or
    /// below 1/64 where a series of bounces dies out. A block that stood on its edge for a long
    /// time before it came back may also have overturned: its distance from the top has grown since
    /// then, as has its error, which must still be small compared with alpha.
    /// block: as seen from the side of `now`, before the impact of these lanes. rests: those of
    /// them that come to rest.
    void pass_impact(const Block<T>& block, const auto& excitation, const Rocking<T>& now,
                     const Mask& lanes, const Mask& rests)
    {
        const auto push = now.side * excitation.ground(now.phase);
        const T before = Equations<theory>::acceleration(block, T(0), push);
        const T after = Equations<theory>::acceleration(block.other, T(0), T(-1) * push);
        const T speed = select<T>(lanes && now.rate < 0, -now.rate, 1);
        const T square_error = bound(before + before, speed + speed);
        const T share = select<T>(rests, 64, 4);
        const T radius = bound(1, 0);
        const Mask known = share * square_error < speed * speed && 4 * radius < block.slenderness;
        doubtful_ = doubtful_ || (lanes && !(known && now.rate < 0));
        growth_.forget(doubtful_); // it would only grow until it overflows
        const T ratio = block.other.frequency_parameter / block.frequency_parameter;
        growth_.pass(variation_over_impact<E>(estimate_of(block.rate_ratio()), estimate_of(ratio),
                                              estimate_of(speed), estimate_of(before),
                                              estimate_of(after)),
                     lanes);
    }

    void complete(ForcedEnd<T>& end, const Block<T>& block, const Block<T>&, const auto& excitation,
                  const Rocking<T>& now) const
    {
        const Mask& fell = end.fell;
        const T radius = bound(1, 0);
        const T largest = Equations<theory>::separatrix_rate(block, T(0));
        const Distance standing = distance_to_separatrix(block, now, radius, largest);
        // An impact on this side i changes the margin by the factor sqrt(r W_i / W_j), one on the
        // other side by sqrt(r W_j / W_i).
        const T ratio =
            any<T>(!block.is_symmetric()) ? barrier_ratio<theory>(largest, block) : T(1);
        const T before_impact = 1 / sqrt(block.restitution * ratio) - 1;
        const T after_impact = 1 - sqrt(block.restitution / ratio);
        const T jump = abs(standing.margin) * greater<T>(abs(before_impact), abs(after_impact));
        const T near_impact = select<T>(now.tilt < radius, jump, 0);

        // For a fall at the speed v with the acceleration a, v^2 changes by
        // 2 v d(rate) - 2 a d(tilt).
        const auto push = now.side * excitation.ground(now.phase);
        const T pull = -Equations<theory>::acceleration(block, now.tilt, push);
        const T lying =
            (bound(pull + pull, now.rate + now.rate) + roundings() * now.rate * now.rate) /
            (largest * largest);
        // Whether it is uncertain that the block falls before the pulse ends.
        const T left = (excitation.motion.end - now.phase) / excitation.frequency;
        const Mask either =
            (fell && left * now.rate < radius) || (!fell && T(pi<S>() / 2) - now.tilt < radius);
        // It is also uncertain whether the block falls at all, unless it falls with some energy.
        // That energy is bounded away from zero; the distance from the separatrix is not. That
        // distance has grown in proportion to its error, which must be a small share of it.
        const Mask barely = fell && !(4 * standing.error < abs(standing.margin) &&
                                      lying * largest * largest < now.rate * now.rate);
        const T error = select<T>(fell, lying, standing.error + near_impact);
        const Mask known = bound(1, 1) < T(unknown_error<S> * 0x1p-100);
        const Mask unknown =
            doubtful_ || end.is_stopped() || either || barely || !known || !(error == error);
        end.error = select<T>(unknown, T(std::numeric_limits<S>::infinity()), error);
        end.in_doubt = !(end.error < abs(margin_of<theory>(end, block)));
    }

private:
    T bound(const T& by_tilt, const T& by_rate) const
    {
        return T(growth_.bound(estimate_of(by_tilt), estimate_of(by_rate)));
    }

    static T roundings() { return T(8 * std::numeric_limits<S>::epsilon()); }

    struct Distance {
        T margin;
        T error;
    };

    /// The margin is the smaller of two distances, and either may be overestimated.
    Distance distance_to_separatrix(const Block<T>& block, const Rocking<T>& now, const T& radius,
                                    const T& largest) const
    {
        const SafeRates<T> safe = safe_rates<theory>(now.tilt, block);
        const ImpactLimit<T> inward = safe.inward();
        const T slope = Equations<theory>::separatrix_slope(block, now.tilt);
        const auto round_off = [&](const T& limit) -> T {
            return roundings() * (abs(now.rate) + abs(limit)) / largest;
        };
        const T above = (safe.outward - now.rate) / largest;
        const T below = inward.distance(now.rate) / largest;
        const T above_error = bound(slope, -1) / largest + round_off(safe.outward);
        const T below_error =
            error_of_limit(inward, {safe.outward, slope, radius, largest}, now.rate) / largest +
            round_off(inward.limit);
        const T margin = lesser<T>(above, below);
        return {margin, greater<T>(below_error - (below - margin), above_error - (above - margin))};
    }

    /// Where the separatrix is, for error_of_limit().
    struct SeparatrixAt {
        T c;
        T slope;   ///< d c / d tilt
        T radius;  ///< error of the tilt, and of c
        T largest; ///< sqrt(q_max)
    };

    /// The error of ImpactLimit::distance(). If q_min <= 0, the limit is convex in c, so that its
    /// gradient c / limit is largest at one end of the range of c.
    T error_of_limit(const ImpactLimit<T>& inward, const SeparatrixAt& at, const T& rate) const
    {
        const auto with_gradient = [&](const T& c) -> T {
            const T limit = inward.limit_at(c);
            const T gradient = c / select<T>(limit > 0, limit, at.largest);
            return bound(at.slope * gradient, 1);
        };
        const T error =
            greater<T>(with_gradient(at.c - at.radius), with_gradient(at.c + at.radius));
        const Mask inside = inward.minus_q_min < 0;
        return any<T>(inside) ? select<T>(inside, error_inside(inward, at, rate), error) : error;
    }

    /// The same if q_min > 0. The gradient |c| / |limit| grows towards c = sqrt(q_min), where it is
    /// infinite. Across that, the change of the limit is its error. Where c^2 and q_min cancel,
    /// their round-off matters.
    [[gnu::noinline]] T error_inside(const ImpactLimit<T>& inward, const SeparatrixAt& at,
                                     const T& rate) const
    {
        const T lost = roundings() * at.largest * at.largest;
        const T low = inward.signed_root(inward.square_at(at.c - at.radius) - lost);
        const T high = inward.signed_root(inward.square_at(at.c + at.radius) + lost);
        const auto with_gradient = [&](const T& c, const T& limit) -> T {
            const T divisor = select<T>(limit == 0, at.largest, abs(limit));
            const T gradient = abs(c) / divisor;
            const T inwards = bound(at.slope * gradient, 1);
            const T outwards = bound(at.slope * gradient, -1);
            const T of_rate = bound(0, 1);
            return lost / divisor +
                   select<T>(rate > of_rate, outwards,
                             select<T>(rate < -of_rate, inwards, greater<T>(inwards, outwards)));
        };
        const T regular =
            greater<T>(with_gradient(at.c - at.radius, low), with_gradient(at.c + at.radius, high));
        const Mask is_regular = (low > 0 && high > 0) || (low < 0 && high < 0);
        return select<T>(is_regular, regular, (high - low) + bound(0, 1));
    }

    ErrorGrowth<E> growth_;
    Mask doubtful_ = T(0) != T(0); // see is_doubtful()
};

} // namespace overturn
