// One point of a plane, from its four coordinates, and the end of its forced stage in doubles and
// in 50 digits.
#pragma once

#include "overturn/integrate/more_digits.hpp"
#include "overturn/mechanics/region.hpp"

namespace overturn {

template <class S>
struct Point {
    S slenderness; ///< [rad]
    S restitution; ///< r [1]
    S frequency;   ///< Omega [1]
    S amplitude;   ///< a [1]
};

template <class Pulse, Theory theory, class S>
Excitation<Pulse, S> excitation_of(const Point<S>& point, double window = 1)
{
    return {.acceleration = point.amplitude * uplift_acceleration<theory>(point.slenderness),
            .frequency = point.frequency,
            .uplifts = uplift_phases<Pulse>(point.amplitude, S(window)),
            .begin = Pulse::begin(S(window)),
            .end = Pulse::end(S(window))};
}

inline Point<Digits50> in_digits(const Point<double>& point)
{
    return {point.slenderness, point.restitution, point.frequency, point.amplitude};
}

/// run_forced_stage(), for each of EveryMethod; watched: with a bound of the error. Compiled once
/// per pulse, in one_point.cpp.
template <class Method, class Pulse, Theory theory, bool watched = false>
ForcedEnd<double> run_in_doubles(const Block<double>& block,
                                 const Excitation<Pulse, double>& excitation, double tolerance);

template <class Pulse, Theory theory, class Method = RungeKutta, bool watched = false>
ForcedEnd<double> forced_end(const Point<double>& point, double tolerance)
{
    return run_in_doubles<Method, Pulse, theory, watched>(
        {point.slenderness, point.restitution}, excitation_of<Pulse, theory>(point), tolerance);
}

template <class Pulse, Theory theory>
ForcedEnd<Digits50> forced_end(const Point<Digits50>& point, double tolerance)
{
    return run_in_more_digits<Digits50, Pulse, theory>(
        {point.slenderness, point.restitution}, excitation_of<Pulse, theory>(point), tolerance);
}

/// Calls visit.template operator()<Pulse, theory>() for every pulse and theory.
template <class Visitor>
void for_every_scene(const Visitor& visit)
{
    const auto both_theories = [&]<class Pulse>() {
        visit.template operator()<Pulse, Theory::nonlinear>();
        visit.template operator()<Pulse, Theory::linear>();
    };
    both_theories.template operator()<OneSine>();
    both_theories.template operator()<OneCosine>();
    both_theories.template operator()<SymmetricRicker>();
    both_theories.template operator()<AntisymmetricRicker>();
    both_theories.template operator()<HalfSine>();
    both_theories.template operator()<Rectangular>();
}

template <Theory theory, class S>
S margin_of(const ForcedEnd<S>& end, const Point<S>& point)
{
    const Block<S> block{point.slenderness, point.restitution};
    return end.fell ? margin_of_fall<theory>(end.state.rate, block)
                    : margin_after_pulse<theory>(end.state, block);
}

/// The amplitude between `low` and `high` at which the verdict flips, by halving.
template <class Pulse, Theory theory, class Method = RungeKutta>
double flip(Point<double> point, double low, double high, double tolerance)
{
    const auto is_unsafe_at = [&](double amplitude) {
        point.amplitude = amplitude;
        return margin_of<theory>(forced_end<Pulse, theory, Method>(point, tolerance), point) < 0;
    };
    const bool below = is_unsafe_at(low);
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (is_unsafe_at(middle) == below ? low : high) = middle;
    }
    return (low + high) / 2;
}

/// The block of the paper: b = 1 m, h = 5.67 m.
inline double papers_slenderness()
{
    return std::atan2(1.0, 5.67);
}

} // namespace overturn
