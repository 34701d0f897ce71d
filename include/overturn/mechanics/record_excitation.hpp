// The excitation of one block by a ground motion that is given by samples, dimensionless. The phase
// of a record is the time in samples; the shape of a pulse has phases of its own [rad]. Each
// interval between two samples is a smooth piece.
#pragma once

#include "overturn/mechanics/accelerogram.hpp"
#include "overturn/mechanics/theory/theories.hpp"

#include <limits>

namespace overturn {

/// A phase in the interval between two samples.
template <Number T>
struct RecordPiece {
    T sample; ///< the number of the first one
    T since;  ///< the phase after the first one
    T end;    ///< the phase of the second one
};

/// A record over its phase. The record must outlive it. S: the type of one lane. may_be_pulse:
/// whether it may be the shape of a pulse, with phases of its own; kernels of records are faster
/// without.
template <class S, bool may_be_pulse = false>
struct RecordMotion {
    const Accelerogram* record;
    const double* phases; ///< of the samples [rad]; null: their numbers
    S begin;              ///< phases at which the ground motion begins and ends
    S end;
    S intervals; ///< the number of smooth pieces

    operator RecordMotion<S, true>() const // for functions of any motion
        requires(!may_be_pulse)
    {
        return {record, phases, begin, end, intervals};
    }

    S pieces() const { return intervals; }
    bool has_own_phases() const { return may_be_pulse && phases != nullptr; }

    /// The interval that contains or begins at the phase, the first or last one if none does. No
    /// step may cross its end.
    template <Number T>
    RecordPiece<T> piece_at(const T& phase) const
    {
        const T last(end - S(1));
        const T before = lesser<T>(greater<T>(T(floor(phase)), T(begin)), last);
        RecordPiece<T> piece{before, phase - before, before + T(1)};
        if (has_own_phases()) {
            // With more digits, a phase that is below that of a sample by less than a double
            // resolves is in the interval that begins there; what follows from that is far below
            // any error bound.
            piece.sample =
                number_of<T>(phase, [&](double at) { return record->sample_before(at); });
            const auto [first, next] = gathered_pair<T>(phases, piece.sample);
            piece.since = phase - first;
            piece.end = next;
        }
        return piece;
    }

    template <Number T>
    T end_of_piece(const T& phase) const
    {
        return piece_at(phase).end;
    }

    /// The number of the first sample at the phase or later.
    template <Number T>
    T sample_after(const T& phase) const
    {
        return has_own_phases()
                   ? number_of<T>(phase, [&](double at) { return record->sample_after(at); })
                   : T(ceil(phase));
    }

    /// The phase at a share of the interval that begins at a sample.
    template <Number T>
    T phase_after(const T& sample, const T& share) const
    {
        if (!has_own_phases()) {
            return sample + share;
        }
        const auto [first, last] = gathered_pair<T>(phases, sample);
        return lesser<T>(first + share * (last - first), last);
    }

    /// Per lane: whether the accelerations have no extremum between these phases.
    template <Number T>
    mask_t<T> is_monotone(const T& first, const T& last) const
    {
        return last <= end_of_piece(first);
    }

private:
    /// Lane by lane.
    template <Number T, class NumberAt>
    static T number_of(const T& phase, const NumberAt& number_at)
    {
        auto lanes = lanes_of(phase);
        for (auto& lane : lanes) {
            lane = scalar_t<T>(number_at(double(lane)));
        }
        return load<T>(lanes.data());
    }
};

/// Always inlined: kernels must not define functions that the rest of the program may use.
template <class S>
[[gnu::always_inline]] inline RecordMotion<S> record_motion(const Accelerogram& record)
{
    const std::vector<double>& phases = record.phases();
    const auto intervals = S(record.samples() - 1);
    return {.record = &record,
            .phases = phases.empty() ? nullptr : phases.data(),
            .begin = S(0),
            .end = phases.empty() ? intervals : S(phases.back()),
            .intervals = intervals};
}

/// The directions in which the ground may move. `both` is for any motion, also for the shape of a
/// pulse. Of records, `horizontal` is faster without a vertical motion, `both_recorded` with it.
enum class Directions { horizontal, both, both_recorded };

template <Number T, Directions directions>
struct RecordExcitation {
    using S = scalar_t<T>;
    static constexpr bool is_recorded = true; // or a pulse that is integrated like a record
    static constexpr bool has_vertical = directions != Directions::horizontal;
    using Push = std::conditional_t<has_vertical, Ground<Ramp<T>>, Ramp<T>>;

    RecordMotion<S, directions == Directions::both> motion;
    T acceleration; ///< the factor on the samples [1]; negative: mirrored. Named as that of a pulse
    T frequency; ///< of a record samples per time unit 1/p: 1 / (p time_step); see PulseExcitation
    T to_plus;   ///< uplift_acceleration() of the sides of the block [1]
    T to_minus;

    /// What the ground does at this phase: T, or Ground<T> with a vertical motion.
    auto ground(const T& phase) const { return series<1>(acceleration, phase, T(1)).at(T(0)); }

    /// The push on the interval that contains or begins at the phase: the horizontal acceleration
    /// times `towards`, the factor on the samples with the sign of the side, over time from the
    /// phase on; rate [phase per unit of time].
    template <int>
    Push series(const T& towards, const T& phase, const T& rate) const
    {
        return push_on(motion.piece_at(phase), towards, rate);
    }

    /// The same with the interval at the phase.
    Push push_on(const RecordPiece<T>& piece, const T& towards, const T& rate) const
    {
        const auto ramp_of = [&](const std::vector<double>& samples, const T& factor) -> Ramp<T> {
            const auto [here, next] = gathered_pair<T>(samples.data(), piece.sample);
            T slope = next - here; // over the phase
            if (motion.has_own_phases()) {
                const auto [first, last] = gathered_pair<T>(motion.phases, piece.sample);
                slope = slope / (last - first);
            }
            return {factor * Ramp<T>{here, slope}.at(piece.since), factor * slope * rate};
        };
        const Ramp<T> horizontal = ramp_of(motion.record->horizontal(), towards);
        if constexpr (has_vertical) {
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
    /// uplift `latest`; infinite if there is none. Between two samples, the ground must not be
    /// lifting the block at `phase`.
    T next_uplift(const mask_t<T>& lanes, const T& phase, const T& latest) const
    {
        const T scale = abs(acceleration);
        const auto resting = lanes_of(select<T>(lanes, 1, 0));
        const auto first = lanes_of(motion.sample_after(phase));
        const auto factors = lanes_of(acceleration);
        const auto plus = lanes_of(to_plus);
        const auto minus = lanes_of(to_minus);
        std::array<S, lanes_v<T>> lifting;
        for (std::size_t i = 0; i < lifting.size(); ++i) {
            lifting[i] = motion.intervals + S(1);
            if (resting[i] != 0) {
                lifting[i] =
                    S(motion.record->first_lifting(std::int64_t(first[i]), double(factors[i]),
                                                   {double(plus[i]), double(minus[i])}));
            }
        }
        const T sample = load<T>(lifting.data());
        const mask_t<T> lifts = lanes && sample <= T(motion.intervals);
        // The excess over the threshold, which is linear on the interval before the sample.
        const T there = select<T>(lifts, sample, 1);
        const T before = greater<T>(there - 1, 0);
        const T peak = gathered<T>(motion.record->horizontal().data(), there);
        const T towards = select<T>(peak < 0, -scale, scale);
        // A positive acceleration of the ground pushes the block towards minus.
        const T threshold = select<T>(peak * acceleration < 0, to_plus, to_minus);
        const auto excess = [&](const T& number) -> T {
            T needed = threshold;
            if constexpr (has_vertical) {
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
        const T reached =
            select<T>(sample == 0, 0, motion.phase_after(before, lesser<T>(share, 1)));
        const T earliest = greater<T>(reached, phase);
        // Rounding must not lift the block at the same phase again.
        const T previous = greater<T>(latest, -1);
        const T after_latest =
            previous + T(std::numeric_limits<S>::epsilon()) * (1 + abs(previous));
        const T uplift = select<T>(earliest > latest, earliest, after_latest);
        return select<T>(lifts, uplift, T(std::numeric_limits<S>::infinity()));
    }
};

/// The excitation of blocks, as seen from their side plus. strength: the factor on a record; of the
/// shape of a pulse, the amplitude, see scaled_pulse() [1]. frequency: samples per time unit, that
/// of Block::frequency_parameter [1], or that of a pulse. Always inlined, see record_motion().
template <Theory theory, Directions directions, Number T>
[[gnu::always_inline]] inline RecordExcitation<T, directions>
record_excitation(const Accelerogram& record, const Block<T>& blocks, const T& strength,
                  const T& frequency)
{
    RecordExcitation<T, directions> excitation{
        .motion = record_motion<scalar_t<T>>(record),
        .acceleration = strength,
        .frequency = frequency,
        .to_plus = Equations<theory>::uplift_acceleration(blocks),
        .to_minus = Equations<theory>::uplift_acceleration(blocks.other)};
    if (excitation.motion.has_own_phases()) {
        excitation.acceleration = strength * lesser<T>(excitation.to_plus, excitation.to_minus);
    }
    return excitation;
}

/// The same for any scalar, and motions in both directions.
template <Theory theory, class S>
RecordExcitation<S, Directions::both> record_excitation(const Accelerogram& record,
                                                        const Block<S>& block, const S& strength,
                                                        const S& frequency)
{
    return record_excitation<theory, Directions::both>(record, block, strength, frequency);
}

} // namespace overturn
