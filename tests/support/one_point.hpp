// One point of a plane in any number type, from its four coordinates.
#pragma once

#include "overturn/integrate/forced_stage.hpp"
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

template <class Pulse, Theory theory, class Method = RungeKutta, class S>
ForcedEnd<S> forced_end(const Point<S>& point, double tolerance, double window = 1)
{
    return run_forced_stage<Method, Pulse, theory>(Block<S>{point.slenderness, point.restitution},
                                                   excitation_of<Pulse, theory>(point, window),
                                                   S(tolerance));
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
