// The excitation of one block, dimensionless: a ground motion with an amplitude, a frequency and
// the phases at which it lifts the block from rest.
#pragma once

#include "overturn/mechanics/pulse_motion.hpp"
#include "overturn/mechanics/theory/theories.hpp"

namespace overturn {

template <Number T>
struct PulseExcitation {
    static constexpr bool is_recorded = false;

    PulseMotion<scalar_t<T>> motion;
    T acceleration;     ///< a_p / g [1]; negative: the mirrored pulse
    T frequency;        ///< omega_p over the p of the side, which is 1 for a symmetric block: then
                        ///< Omega = omega_p / p [1]
    PerLobe<T> uplifts; ///< see uplift_phases() [rad]

    /// Ground acceleration over g at these phases [1].
    template <std::size_t count>
    std::array<T, count> ground(const std::array<T, count>& phases) const
    {
        return motion.with_formula([&](const auto& formula) {
            std::array<T, count> ground;
            unrolled<count>([&]<int i>() { ground[i] = acceleration * formula.value(phases[i]); });
            return ground;
        });
    }
    T ground(const T& phase) const { return ground(std::array{phase})[0]; }

    /// The Taylor coefficients of the push from the phase on, see PulseMotion::series().
    template <int count>
    Coefficients<count, T> series(const T& towards, const T& phase, const T& rate) const
    {
        return motion.template series<count>(towards, phase, rate);
    }

    /// An upper bound of |ground acceleration| over g [1].
    T largest_acceleration() const { return abs(acceleration); }

    /// See fourth_derivative_of_force(); with respect to tau = p t, p: the unit of `frequency`.
    std::array<T, 5> ground_bounds() const
    {
        const T size = abs(acceleration);
        std::array<T, 5> bounds{sqrt(1 + size * size)};
        T power = size;
        for (int order = 1; order < 5; ++order) {
            power = power * frequency;
            bounds[std::size_t(order)] = T(motion.largest_derivative(order)) * power;
        }
        return bounds;
    }

    /// In these lanes, the first uplift of a block at rest, at `phase` or later and after the
    /// uplift `latest` [rad]; infinite if there is none.
    T next_uplift(const mask_t<T>&, const T& phase, const T& latest) const
    {
        T next(std::numeric_limits<scalar_t<T>>::infinity());
        for (const T& uplift : uplifts) {
            next = select<T>(uplift >= phase && uplift > latest && uplift < next, uplift, next);
        }
        return next;
    }
};

/// A pulse at one amplitude, as it excites blocks with the same slenderness on each side.
template <class S>
struct ScaledPulse {
    S acceleration;     ///< a_p / g [1]; negative: the mirrored pulse
    PerLobe<S> uplifts; ///< [rad]
};

/// block: as seen from its side plus. amplitude: a = a_p / (g tan alpha), linear theory
/// a_p / (g alpha) [1], with the smaller alpha; negative: the mirrored pulse.
template <Theory theory, class S>
ScaledPulse<S> scaled_pulse(const PulseMotion<S>& motion, const PerLobe<FlankInPulse<S>>& flanks,
                            const Block<S>& block, const S& amplitude)
{
    const bool plus_is_lower = block.slenderness < block.other.slenderness;
    const S acceleration = amplitude * Equations<theory>::uplift_acceleration(
                                           plus_is_lower ? side_of(block) : block.other);
    const auto over_uplift = [&](const BlockSide<S>& side, const BlockSide<S>& other) -> S {
        return side.slenderness > other.slenderness
                   ? S(abs(acceleration) / Equations<theory>::uplift_acceleration(side))
                   : S(abs(amplitude));
    };
    // A positive ground acceleration pushes the block towards its side minus.
    LobeAmplitudes<S> lobes{over_uplift(block.other, block), over_uplift(block, block.other)};
    if (amplitude < 0) {
        std::swap(lobes.positive, lobes.negative);
    }
    return {acceleration, uplift_phases(motion, flanks, lobes)};
}

/// The excitation of a block, as seen from its side plus. amplitude: see scaled_pulse(); frequency:
/// see PulseExcitation.
template <Theory theory, class S>
PulseExcitation<S> pulse_excitation(const PulseMotion<S>& motion, const Block<S>& block,
                                    const S& amplitude, const S& frequency)
{
    const ScaledPulse<S> scaled = scaled_pulse<theory>(motion, flanks_of(motion), block, amplitude);
    return {motion, scaled.acceleration, frequency, scaled.uplifts};
}

} // namespace overturn
