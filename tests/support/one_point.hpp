// One point under a pulse, from its four coordinates, and the end of its forced stage in doubles
// and in 50 digits.
#pragma once

#include "overturn/integrate/more_digits.hpp"

namespace overturn {

template <class S>
struct PulsePoint {
    S slenderness; ///< [rad]
    S restitution; ///< r [1]
    S frequency;   ///< Omega [1]
    S amplitude;   ///< a [1]

    Block<S> block() const { return {slenderness, restitution}; }
};

template <Theory theory, class S>
PulseExcitation<S> excitation_of(PulseKind pulse, const PulsePoint<S>& point,
                                 const PulseShape& shape = {})
{
    return pulse_excitation<theory>(pulse_motion<S>(pulse, shape), point.block(), point.amplitude,
                                    point.frequency);
}

/// The motion as if it ended at an earlier phase [rad].
template <class S>
PulseMotion<S> cut_at(const S& phase, PulseMotion<S> motion)
{
    motion.end = phase;
    motion.kink = motion.kink < phase ? motion.kink : motion.begin;
    return motion;
}

inline PulsePoint<Digits50> in_digits(const PulsePoint<double>& point)
{
    return {point.slenderness, point.restitution, point.frequency, point.amplitude};
}

/// run_forced_stage(), for each of EveryMethod; with_error: with a bound on the error. Compiled
/// once, in one_point.cpp.
template <class Method, Theory theory, bool with_error = false>
ForcedEnd<double> run_in_doubles(const Block<double>& block,
                                 const PulseExcitation<double>& excitation, double tolerance);

template <Theory theory, class Method = RungeKutta, bool with_error = false>
ForcedEnd<double> forced_end(PulseKind pulse, const PulsePoint<double>& point, double tolerance,
                             const PulseShape& shape = {})
{
    return run_in_doubles<Method, theory, with_error>(
        point.block(), excitation_of<theory>(pulse, point, shape), tolerance);
}

template <Theory theory>
ForcedEnd<Digits50> forced_end(PulseKind pulse, const PulsePoint<Digits50>& point, double tolerance)
{
    return run_in_more_digits<Digits50, theory>(point.block(), excitation_of<theory>(pulse, point),
                                                nullptr, tolerance);
}

/// Calls visit.template operator()<theory>(pulse) for every pulse and theory.
template <class Visitor>
void for_every_scene(const Visitor& visit)
{
    for (std::size_t pulse = 0; pulse < pulses.size(); ++pulse) {
        visit.template operator()<Theory::nonlinear>(PulseKind(pulse));
        visit.template operator()<Theory::linear>(PulseKind(pulse));
    }
}

template <Theory theory, class S>
S margin_of(const ForcedEnd<S>& end, const PulsePoint<S>& point)
{
    return margin_of<theory>(end, point.block());
}

/// The number between `low` and `high` at which the verdict flips, by halving.
template <class IsUnsafe>
double flip_of(const IsUnsafe& is_unsafe_at, double low, double high)
{
    const bool below = is_unsafe_at(low);
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (is_unsafe_at(middle) == below ? low : high) = middle;
    }
    return (low + high) / 2;
}

/// The amplitude between `low` and `high` at which the verdict flips.
template <Theory theory, class Method = RungeKutta>
double flip(PulseKind pulse, PulsePoint<double> point, double low, double high, double tolerance,
            const PulseShape& shape = {})
{
    const auto is_unsafe_at = [&](double amplitude) {
        point.amplitude = amplitude;
        return margin_of<theory>(forced_end<theory, Method>(pulse, point, tolerance, shape),
                                 point) < 0;
    };
    return flip_of(is_unsafe_at, low, high);
}

/// The block of the paper: b = 1 m, h = 5.67 m.
inline double papers_slenderness()
{
    return std::atan2(1.0, 5.67);
}

} // namespace overturn
