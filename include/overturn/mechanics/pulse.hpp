// The ground pulses f(phase) with peak 1; phase = omega_p t [rad]. One-sine: Eq. 48, one-cosine:
// Eq. 51, Ricker wavelets: Eqs. 53, 54. Each formula defines its lobes for uplift_phases().
// To add a pulse, add its row in pulse_kind.hpp, its formula, its case in with_pulse(), and its
// series in pulse_series.hpp.
#pragma once

#include "overturn/mechanics/pulse_kind.hpp"
#include "overturn/number/elementary.hpp"
#include "overturn/number/number.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace overturn {

/// The rising flank of a lobe: |f| grows from `foot` to `peak` [rad].
template <class S>
struct Flank {
    S foot;
    S peak;
};

/// Type A, Eq. 48: one period of a sine. Its first half is the half-sine pulse.
struct OneSine {
    template <Number T>
    static T value(const T& phase)
    {
        return sine_and_cosine_of_period(phase).sine;
    }
    template <class S>
    static std::array<Flank<S>, 2> flanks()
    {
        return {{{S(0), pi<S>() / 2}, {pi<S>(), 3 * pi<S>() / 2}}};
    }
    /// The phase at which amplitude |f| reaches 1 on the flank.
    template <class S>
    static S phase_at(const Flank<S>& flank, const S& amplitude)
    {
        return flank.foot + asin(S(1 / amplitude));
    }
};

/// Type B, Eq. 51: one period of a cosine.
struct OneCosine {
    template <Number T>
    static T value(const T& phase)
    {
        return sine_and_cosine_of_period(phase).cosine;
    }
    template <class S>
    static std::array<Flank<S>, 3> flanks()
    {
        return {{{-pi<S>() / 2, S(0)}, {pi<S>() / 2, pi<S>()}, {3 * pi<S>() / 2, 2 * pi<S>()}}};
    }
    template <class S>
    static S phase_at(const Flank<S>& flank, const S& amplitude)
    {
        return flank.peak - acos(S(1 / amplitude));
    }
};

/// A constant acceleration.
struct Rectangular {
    template <Number T>
    static T value(const T&)
    {
        return T(1);
    }
    template <class S>
    static std::array<Flank<S>, 1> flanks()
    {
        return {{{S(0), S(0)}}};
    }
    template <class S>
    static S phase_at(const Flank<S>& flank, const S&)
    {
        return flank.foot;
    }
};

/// A triangle: f rises linearly from 0 to 1 at pi/2, and falls to 0 at pi.
struct Triangular {
    template <Number T>
    static T value(const T& phase)
    {
        using S = scalar_t<T>;
        const T x = phase * T(2 / pi<S>());
        return lesser<T>(x, 2 - x);
    }
    template <class S>
    static std::array<Flank<S>, 1> flanks()
    {
        return {{{S(0), pi<S>() / 2}}};
    }
    template <class S>
    static S phase_at(const Flank<S>& flank, const S& amplitude)
    {
        return flank.foot + 1 / amplitude * (flank.peak - flank.foot);
    }
};

/// The phase between `low` and `high` at which an increasing function reaches 0.
template <class S, class Function>
S where_it_reaches_zero(const Function& increasing, const S& low, const S& high)
{
    std::uintmax_t iterations = 200; // bisection needs one per bit of S
    const auto bracket = boost::math::tools::toms748_solve(
        increasing, low, high,
        boost::math::tools::eps_tolerance<S>(std::numeric_limits<S>::digits - 2), iterations);
    return bracket.second; // the upper end, where the function is not below 0
}

/// A wavelet, with one formula for all of its lobes.
template <class Wavelet>
struct RickerWavelet {
    /// Searches between the ends of the flank, which must enclose the phase.
    template <class S>
    static S phase_at(const Flank<S>& flank, const S& amplitude)
    {
        const S level = 1 / amplitude;
        const auto excess = [&](const S& phase) -> S { return abs(Wavelet::value(phase)) - level; };
        return where_it_reaches_zero(excess, flank.foot, flank.peak);
    }
};

/// Eq. 53: f = (1 - 2 x^2) exp(-x^2), x = phase / 2.
struct SymmetricRicker : RickerWavelet<SymmetricRicker> {
    template <Number T>
    static T value(const T& phase)
    {
        const T square = phase * phase * T(0.25);
        return (1 - (square + square)) * exponential_decay(square);
    }
    template <class S>
    static std::array<Flank<S>, 3> flanks()
    {
        const S zero = sqrt(S(2));   // x^2 = 1/2
        const S trough = sqrt(S(6)); // x^2 = 3/2
        return {{{-std::numeric_limits<S>::max(), -trough}, {-zero, S(0)}, {zero, trough}}};
    }
};

/// Eq. 54: f = z (z^2 - 3) exp(-z^2/2) / 1.38, z = phase / sqrt(3). With the paper's 1.38, the peak
/// is 1.000086.
struct AntisymmetricRicker : RickerWavelet<AntisymmetricRicker> {
    template <Number T>
    static T value(const T& phase)
    {
        using S = scalar_t<T>;
        const T z = phase * T(sqrt(S(3)) / 3);
        const T square = z * z;
        const S scale = S(50) / 69; // 1 / 1.38
        return T(scale) * z * (square - 3) * exponential_decay(T(square * T(0.5)));
    }
    template <class S>
    static std::array<Flank<S>, 4> flanks()
    {
        const S inner = sqrt(9 - 3 * sqrt(S(6))); // z^2 = 3 - sqrt 6
        const S outer = sqrt(9 + 3 * sqrt(S(6)));
        return {{{-std::numeric_limits<S>::max(), -outer},
                 {S(-3), -inner},
                 {S(0), inner},
                 {S(3), outer}}};
    }
};

/// Calls `visit.template operator()<Pulse>()` for the formula of this kind of pulse, or
/// visit_modulated() if it is a ModulatedSine.
template <class Visitor, class ModulatedVisitor>
auto with_pulse(PulseKind kind, const Visitor& visit, const ModulatedVisitor& visit_modulated)
{
    switch (kind) {
    case PulseKind::one_cosine: return visit.template operator()<OneCosine>();
    case PulseKind::symmetric_ricker: return visit.template operator()<SymmetricRicker>();
    case PulseKind::antisymmetric_ricker: return visit.template operator()<AntisymmetricRicker>();
    case PulseKind::rectangular: return visit.template operator()<Rectangular>();
    case PulseKind::triangular: return visit.template operator()<Triangular>();
    case PulseKind::sine:
    case PulseKind::cosine:
    case PulseKind::mavroeidis_papageorgiou: return visit_modulated();
    case PulseKind::one_sine:
    case PulseKind::half_sine: break;
    }
    return visit.template operator()<OneSine>();
}

} // namespace overturn
