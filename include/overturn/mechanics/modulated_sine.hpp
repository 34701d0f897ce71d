// A sine whose amplitude may vary slowly. Without variation it is a sine or cosine of several
// cycles; with it, the derivative of the velocity pulse of Mavroeidis & Papageorgiou, Bull. Seism.
// Soc. Am. 93 (2003) 1099, |phase| <= gamma pi:
//
//     velocity = (1 + cos(phase / gamma)) cos(phase + nu) / 2
#pragma once

#include "overturn/mechanics/pulse_series.hpp"

#include <vector>

namespace overturn {

/// Two extrema that are closer are not found; the values of f between them differ by 1e-8.
inline constexpr double shortest_distance = 0x1p-8; // [rad]

/// With q = 1 / gamma:
///
///     f = scale ((1 + cos(q phase)) sin(phase + nu) + q sin(q phase) cos(phase + nu))
///       = scale (sin(phase + nu) + (1 + q)/2 sin((1 + q) phase + nu)
///                                + (1 - q)/2 sin((1 - q) phase + nu))
template <class S>
struct ModulatedSine {
    S scale;        ///< [1]
    S q;            ///< [1]; 0: f = 2 scale sin(phase + nu)
    S sine_of_nu;   ///< [1]
    S cosine_of_nu; ///< [1]

    template <Number T>
    T value(const T& phase) const
    {
        const SineAndCosine<T> fast = oscillation(phase);
        const SineAndCosine<T> slow = sine_and_cosine_of_cycles(T(phase * T(q)));
        return T(scale) * fma(T(1) + slow.cosine, fast.sine, T(q) * slow.sine * fast.cosine);
    }

    /// The first `count` Taylor coefficients in t of factor f(phase + rate t).
    template <int count, Number T>
    Coefficients<count, T> series(const T& factor, const T& phase, const T& rate) const
    {
        const SineAndCosine<T> fast = oscillation(phase);
        const SineAndCosine<T> slow = sine_and_cosine_of_cycles(T(phase * T(q)));
        const auto harmonic = [&](const S& weight, const S& speed, const T& sine, const T& cosine) {
            const T peak = factor * T(S(scale * weight));
            const T there = rate * T(speed);
            return harmonic_series<count>({peak * sine, peak * there * cosine}, there);
        };
        const auto middle = harmonic(S(1), S(1), fast.sine, fast.cosine);
        const T sine_cosine = fast.sine * slow.cosine;
        const T cosine_cosine = fast.cosine * slow.cosine;
        const auto upper =
            harmonic(S((1 + q) / 2), S(1 + q), fma(fast.cosine, slow.sine, sine_cosine),
                     fma(-fast.sine, slow.sine, cosine_cosine));
        const auto lower =
            harmonic(S((1 - q) / 2), S(1 - q), fma(-fast.cosine, slow.sine, sine_cosine),
                     fma(fast.sine, slow.sine, cosine_cosine));
        Coefficients<count, T> f;
        unrolled<count>([&]<int k>() { f[k] = middle[k] + (upper[k] + lower[k]); });
        return f;
    }

    /// |f''| is at most this [1].
    S largest_curvature() const { return abs(scale) * (2 + 3 * q * q); }

    /// |f^(order)| is at most this [1].
    S largest_derivative(int order) const
    {
        const auto of_harmonic = [&](const S& speed) -> S {
            S power = speed;
            for (int i = 0; i < order; ++i) {
                power *= speed;
            }
            return abs(power) / 2;
        };
        return abs(scale) * (1 + of_harmonic(1 + q) + of_harmonic(1 - q));
    }

    /// The phase at which amplitude |f| reaches 1 between two phases without an extremum between
    /// them.
    S phase_at(const Flank<S>& flank, const S& amplitude) const
    {
        const S towards_peak = value(flank.peak) < 0 ? S(-amplitude) : amplitude;
        const auto excess = [&](const S& phase) -> S { return towards_peak * value(phase) - 1; };
        return where_it_reaches_zero(excess, flank.foot, flank.peak);
    }

    /// The extremum close to this phase, by Newton's method [rad].
    S extremum_near(S phase) const
    {
        for (int i = 0; i < 4; ++i) {
            const auto f = series<3>(S(1), phase, S(1));
            const S curvature = 2 * f[2];
            const S limit = S(shortest_distance);
            const S newton = curvature == 0 ? S(0) : S(f[1] / curvature);
            phase -= newton > limit ? limit : newton < -limit ? S(-limit) : newton;
        }
        return phase;
    }

private:
    /// sin and cos of phase + nu.
    template <Number T>
    SineAndCosine<T> oscillation(const T& phase) const
    {
        const auto [sine, cosine] = sine_and_cosine_of_cycles(phase);
        const T s(sine_of_nu);
        const T c(cosine_of_nu);
        return {fma(sine, c, cosine * s), fma(cosine, c, -(sine * s))};
    }
};

/// Appends the phases of the extrema between two phases [rad].
inline void append_extrema(const ModulatedSine<double>& f, double first, double last,
                           std::vector<double>& found)
{
    const auto slope = [&](double phase) { return f.series<2>(1.0, phase, 1.0)[1]; };
    const double half = (last - first) / 2;
    const double middle = first + half;
    if (std::abs(slope(middle)) > f.largest_curvature() * half) {
        return;
    }
    if (half > shortest_distance) {
        append_extrema(f, first, middle, found);
        append_extrema(f, middle, last, found);
    } else if ((slope(first) > 0) != (slope(last) > 0)) {
        found.push_back(f.extremum_near(middle));
    }
}

} // namespace overturn
