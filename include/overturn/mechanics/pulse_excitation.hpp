// The excitation of one block, dimensionless: a ground motion with an amplitude, a frequency and
// the phases at which it lifts the block from rest.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/pulse_motion.hpp"

namespace overturn {

template <Number T>
struct PulseExcitation {
    PulseMotion<scalar_t<T>> motion;
    T acceleration;     ///< a_p / g [1]; negative: the mirrored pulse
    T frequency;        ///< Omega = omega_p / p [1]
    PerLobe<T> uplifts; ///< see uplift_phases() [rad]

    /// Ground acceleration over g at these phases [1].
    template <std::size_t count>
    std::array<T, count> ground(const std::array<T, count>& phases) const
    {
        std::array<T, count> ground = motion.values(phases);
        for (T& value : ground) {
            value = acceleration * value;
        }
        return ground;
    }
    T ground(const T& phase) const { return ground(std::array{phase})[0]; }

    /// The Taylor coefficients of the push from the phase on, see PulseMotion::series().
    template <int count>
    Coefficients<count, T> series(const T& towards, const T& phase, const T& rate) const
    {
        return motion.template series<count>(towards, phase, rate);
    }

    /// An upper bound of |ground acceleration| over g [1].
    T largest_acceleration() const
    {
        using std::abs;
        return abs(acceleration);
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

/// The excitation of a block of this slenderness [rad]. amplitude: a = a_p / (g tan alpha), linear
/// theory a_p / (g alpha) [1]; frequency: Omega [1].
template <Theory theory, class S>
PulseExcitation<S> pulse_excitation(const PulseMotion<S>& motion, const S& slenderness,
                                    const S& amplitude, const S& frequency)
{
    return {.motion = motion,
            .acceleration = amplitude * uplift_acceleration<theory>(slenderness),
            .frequency = frequency,
            .uplifts = uplift_phases(motion, amplitude)};
}

} // namespace overturn
