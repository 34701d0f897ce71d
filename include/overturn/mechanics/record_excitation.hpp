// The excitation of one block by a recorded ground motion, dimensionless. The phase is the time in
// samples of the record; each interval between two samples is a smooth piece.
#pragma once

#include "overturn/mechanics/accelerogram.hpp"
#include "overturn/mechanics/theory/theories.hpp"

#include <limits>

namespace overturn {

/// A record over its phase. The record must outlive it. S: the type of one lane.
template <class S>
struct RecordMotion {
    const Accelerogram* record;
    S begin; ///< phases at which the ground motion begins and ends [samples]
    S end;

    /// The number of smooth pieces.
    S pieces() const { return end; }

    /// The number of the sample at or before the phase; never the last one. 0 for NaN.
    template <Number T>
    T sample_before(const T& phase) const
    {
        const T last(end - S(1));
        return lesser<T>(greater<T>(T(floor(phase)), T(begin)), last);
    }

    /// The end of the interval that contains the phase [samples]. No step may cross it.
    template <Number T>
    T end_of_piece(const T& phase) const
    {
        return sample_before(phase) + T(1);
    }

    /// Per lane: whether the accelerations have no extremum between these phases.
    template <Number T>
    mask_t<T> is_monotone(const T& first, const T& last) const
    {
        return last <= end_of_piece(first);
    }
};

/// Always inlined: kernels must not define functions that the rest of the program may use.
template <class S>
[[gnu::always_inline]] inline RecordMotion<S> record_motion(const Accelerogram& record)
{
    return {.record = &record, .begin = S(0), .end = S(record.samples() - 1)};
}

/// The directions in which the ground may move. Without a vertical motion, `horizontal` is faster.
enum class Directions { horizontal, both };

template <Number T, Directions directions>
struct RecordExcitation {
    using S = scalar_t<T>;
    using Push = std::conditional_t<directions == Directions::both, Ground<Ramp<T>>, Ramp<T>>;

    RecordMotion<S> motion;
    T acceleration; ///< the factor on the record [1]; negative: mirrored. Named as that of a pulse
    T frequency;    ///< samples per time unit 1/p: 1 / (p time_step) [1]
    T to_plus;      ///< uplift_acceleration() of the sides of the block [1]
    T to_minus;

    /// What the ground does at this phase: T, or Ground<T> with a vertical motion.
    auto ground(const T& phase) const { return series<1>(acceleration, phase, T(1)).at(T(0)); }

    /// The push on the interval that contains or begins at the phase: the horizontal acceleration
    /// times `towards`, the factor on the record with the sign of the side, over time from the
    /// phase on; rate [samples per unit of time].
    template <int>
    Push series(const T& towards, const T& phase, const T& rate) const
    {
        const T before = motion.sample_before(phase);
        const T since = phase - before;
        const auto ramp_of = [&](const std::vector<double>& samples, const T& factor) -> Ramp<T> {
            const auto [here, next] = gathered_pair<T>(samples.data(), before);
            const T rise = next - here;
            return {factor * Ramp<T>{here, rise}.at(since), factor * rise * rate};
        };
        const Ramp<T> horizontal = ramp_of(motion.record->horizontal(), towards);
        if constexpr (directions == Directions::both) {
            if (motion.record->upwards().empty()) { // outside the kernels, compiled only for both
                return {horizontal, {T(1), T(0)}};
            }
            Ramp<T> gravity = ramp_of(motion.record->upwards(), T(abs(acceleration)));
            gravity.start = 1 + gravity.start;
            return {horizontal, gravity};
        } else {
            return horizontal;
        }
    }

    /// An upper bound of the acceleration of the ground over g, in both directions [1].
    T largest_acceleration() const
    {
        return abs(acceleration) * T(S(motion.record->peak()) + S(motion.record->upwards_peak()));
    }

    /// See fourth_derivative_of_force(); the slope is that of each piece.
    std::array<T, 5> ground_bounds() const
    {
        const T size = 1 + largest_acceleration();
        return {size, T(0), T(0), T(0), T(0)};
    }

    /// An upper bound of the gravity over g [1].
    T strongest_gravity() const
    {
        return 1 + abs(acceleration) * T(S(motion.record->upwards_peak()));
    }

    /// In these lanes, the first uplift of a block at rest, at `phase` or later and after the
    /// uplift `latest` [samples]; infinite if there is none. Between two samples, the ground must
    /// not be lifting the block at `phase`.
    T next_uplift(const mask_t<T>& lanes, const T& phase, const T& latest) const
    {
        const T scale = abs(acceleration);
        const auto resting = lanes_of(select<T>(lanes, 1, 0));
        const auto first = lanes_of(T(ceil(phase)));
        const auto factors = lanes_of(acceleration);
        const auto plus = lanes_of(to_plus);
        const auto minus = lanes_of(to_minus);
        std::array<S, lanes_v<T>> lifting;
        for (std::size_t i = 0; i < lifting.size(); ++i) {
            lifting[i] = motion.end + S(1);
            if (resting[i] != 0) {
                lifting[i] =
                    S(motion.record->first_lifting(std::int64_t(first[i]), double(factors[i]),
                                                   {double(plus[i]), double(minus[i])}));
            }
        }
        const T sample = load<T>(lifting.data());
        const mask_t<T> lifts = lanes && sample <= T(motion.end);
        // The excess over the threshold, which is linear on the interval before the sample.
        const T there = select<T>(lifts, sample, 1);
        const T before = greater<T>(there - 1, 0);
        const T peak = gathered<T>(motion.record->horizontal().data(), there);
        const T towards = select<T>(peak < 0, -scale, scale);
        // A positive acceleration of the ground pushes the block towards minus.
        const T threshold = select<T>(peak * acceleration < 0, to_plus, to_minus);
        const auto excess = [&](const T& number) -> T {
            T needed = threshold;
            if constexpr (directions == Directions::both) {
                if (!motion.record->upwards().empty()) {
                    const T v = gathered<T>(motion.record->upwards().data(), number);
                    needed = threshold * (1 + scale * v);
                }
            }
            return towards * gathered<T>(motion.record->horizontal().data(), number) - needed;
        };
        const T low = excess(before);
        const T high = excess(there);
        const mask_t<T> crosses = low < 0 && high > low;
        const T share = select<T>(crosses, -low, 0) / select<T>(crosses, high - low, 1);
        const T reached = select<T>(sample == 0, 0, before + lesser<T>(share, 1));
        const T earliest = greater<T>(reached, phase);
        // Rounding must not lift the block at the same phase again.
        const T previous = greater<T>(latest, -1);
        const T after_latest =
            previous + T(std::numeric_limits<S>::epsilon()) * (1 + abs(previous));
        const T uplift = select<T>(earliest > latest, earliest, after_latest);
        return select<T>(lifts, uplift, T(std::numeric_limits<S>::infinity()));
    }
};

/// The excitation of a block, as seen from its side plus, by a record, for any scalar. scale: the
/// factor on the record [1]; frequency: samples per time unit, that of Block::frequency_parameter
/// [1].
template <Theory theory, class S>
RecordExcitation<S, Directions::both> record_excitation(const Accelerogram& record,
                                                        const Block<S>& block, const S& scale,
                                                        const S& frequency)
{
    return {.motion = record_motion<S>(record),
            .acceleration = scale,
            .frequency = frequency,
            .to_plus = Equations<theory>::uplift_acceleration(block),
            .to_minus = Equations<theory>::uplift_acceleration(block.other)};
}

} // namespace overturn
