// The six ground pulses f(phase) with peak 1; phase = omega_p t [rad]. Each says where it begins
// and ends, and where its lobes lie; uplift_phases() does the rest.
// One-sine Eq. 48, one-cosine Eq. 51, Ricker wavelets Eqs. 53, 54.
#pragma once

#include "overturn/number/elementary.hpp"
#include "overturn/number/number.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace overturn {

/// The rising flank of a lobe: |f| grows from `foot` to `peak` [rad].
template <class S>
struct Flank {
    S foot;
    S peak;
};

/// A pulse from phase 0 over a number of half turns.
template <int half_turns>
struct Lasting {
    template <class S>
    static S begin(const S&)
    {
        return S(0);
    }
    template <class S>
    static S end(const S&)
    {
        return half_turns * pi<S>();
    }
};

/// A wavelet about phase 0 without an end of its own: from -2 pi window to 2 pi window.
struct CutByWindow {
    template <class S>
    static S begin(const S& window)
    {
        return -end(window);
    }
    template <class S>
    static S end(const S& window)
    {
        return 2 * pi<S>() * window;
    }
};

/// Type A, Eq. 48: one period of a sine.
struct OneSine : Lasting<2> {
    static constexpr int lobes = 2;

    template <Number T>
    static T value(const T& phase)
    {
        return sine_and_cosine_of_period(phase).sine;
    }
    template <class S>
    static std::array<Flank<S>, lobes> flanks()
    {
        return {{{S(0), pi<S>() / 2}, {pi<S>(), 3 * pi<S>() / 2}}};
    }
    /// Where |f| reaches `level` on the flank.
    template <class S>
    static S phase_at(const Flank<S>& flank, const S& level)
    {
        using std::asin;
        return flank.foot + asin(level);
    }
};

/// Half a period of a sine.
struct HalfSine : Lasting<1> {
    static constexpr int lobes = 1;

    template <Number T>
    static T value(const T& phase)
    {
        return OneSine::value(phase);
    }
    template <class S>
    static std::array<Flank<S>, lobes> flanks()
    {
        return {{{S(0), pi<S>() / 2}}};
    }
    template <class S>
    static S phase_at(const Flank<S>& flank, const S& level)
    {
        return OneSine::phase_at(flank, level);
    }
};

/// Type B, Eq. 51: one period of a cosine.
struct OneCosine : Lasting<2> {
    static constexpr int lobes = 3;

    template <Number T>
    static T value(const T& phase)
    {
        return sine_and_cosine_of_period(phase).cosine;
    }
    template <class S>
    static std::array<Flank<S>, lobes> flanks()
    {
        return {{{-pi<S>() / 2, S(0)}, {pi<S>() / 2, pi<S>()}, {3 * pi<S>() / 2, 2 * pi<S>()}}};
    }
    template <class S>
    static S phase_at(const Flank<S>& flank, const S& level)
    {
        using std::acos;
        return flank.peak - acos(level);
    }
};

/// A constant push.
struct Rectangular : Lasting<1> {
    static constexpr int lobes = 1;

    template <Number T>
    static T value(const T&)
    {
        return T(1);
    }
    template <class S>
    static std::array<Flank<S>, lobes> flanks()
    {
        return {{{S(0), S(0)}}};
    }
    template <class S>
    static S phase_at(const Flank<S>& flank, const S&)
    {
        return flank.foot;
    }
};

/// Where |Pulse::value| reaches `level` between the ends of a flank that encloses it.
template <class Pulse, class S>
S bracketed_phase(const Flank<S>& flank, const S& level)
{
    using std::abs;
    const auto excess = [&](const S& phase) -> S { return abs(Pulse::value(phase)) - level; };
    std::uintmax_t iterations = 200; // bisection alone would need the bits of S
    const auto bracket = boost::math::tools::toms748_solve(
        excess, flank.foot, flank.peak,
        boost::math::tools::eps_tolerance<S>(std::numeric_limits<S>::digits - 2), iterations);
    return bracket.second; // the upper end: the ground is at least about to lift the block
}

/// Eq. 53: f = (1 - 2 x^2) exp(-x^2), x = phase / 2; phase from -2 pi window to 2 pi window.
struct SymmetricRicker : CutByWindow {
    static constexpr int lobes = 3;

    template <Number T>
    static T value(const T& phase)
    {
        using S = scalar_t<T>;
        const T square = phase * phase * T(S(0.25));
        return (T(S(1)) - (square + square)) * exponential_decay(square);
    }
    template <class S>
    static std::array<Flank<S>, lobes> flanks()
    {
        using std::sqrt;
        const S zero = sqrt(S(2));   // x^2 = 1/2
        const S trough = sqrt(S(6)); // x^2 = 3/2
        return {{{-std::numeric_limits<S>::max(), -trough}, {-zero, S(0)}, {zero, trough}}};
    }
    template <class S>
    static S phase_at(const Flank<S>& flank, const S& level)
    {
        return bracketed_phase<SymmetricRicker>(flank, level);
    }
};

/// Eq. 54: f = z (z^2 - 3) exp(-z^2/2) / 1.38, z = phase / sqrt(3); phase as above. The paper's
/// 1.38 makes the peak 1.000086.
struct AntisymmetricRicker : CutByWindow {
    static constexpr int lobes = 4;

    template <Number T>
    static T value(const T& phase)
    {
        using S = scalar_t<T>;
        using std::sqrt;
        const T z = phase * T(sqrt(S(3)) / 3);
        const T square = z * z;
        const S scale = S(50) / 69; // 1 / 1.38
        return T(scale) * z * (square - T(S(3))) * exponential_decay(T(square * T(S(0.5))));
    }
    template <class S>
    static std::array<Flank<S>, lobes> flanks()
    {
        using std::sqrt;
        const S inner = sqrt(9 - 3 * sqrt(S(6))); // z^2 = 3 - sqrt 6
        const S outer = sqrt(9 + 3 * sqrt(S(6)));
        return {{{-std::numeric_limits<S>::max(), -outer},
                 {S(-3), -inner},
                 {S(0), inner},
                 {S(3), outer}}};
    }
    template <class S>
    static S phase_at(const Flank<S>& flank, const S& level)
    {
        return bracketed_phase<AntisymmetricRicker>(flank, level);
    }
};

/// The phase [rad] from which on |f| of a wavelet stays below 2^log2_level, to within a percent; at
/// least 6 sqrt(2). With z = phase / sqrt 2, or / sqrt 3, |f| <= z^3 exp(-z^2 / 2).
template <class Pulse, Number T>
requires std::derived_from<Pulse, CutByWindow> T end_of_tail(const T& log2_level)
{
    using std::sqrt;
    using S = scalar_t<T>;
    const T least(S(36));
    T square(S(100)); // z^2 = 2 ln (z^3 / level), by iteration
    for (int i = 0; i < 4; ++i) {
        square = (rough_log2(square) * T(S(1.5)) - log2_level) *
                 T(2 * boost::math::constants::ln_two<S>());
        square = greater<T>(square, least);
    }
    return sqrt(square * T(S(std::same_as<Pulse, SymmetricRicker> ? 2 : 3)));
}

/// For each lobe of the pulse the first phase [rad] at which amplitude * |f| exceeds 1 and a block
/// at rest uplifts; infinity where the lobe stays below, or outside the window. amplitude [1].
template <class Pulse, class S>
std::array<S, Pulse::lobes> uplift_phases(const S& amplitude, const S& window)
{
    using std::abs;
    const S never = std::numeric_limits<S>::infinity();
    const S begin = Pulse::begin(window);
    const S end = Pulse::end(window);
    const auto lifts = [&](const S& phase) { return amplitude * abs(Pulse::value(phase)) > 1; };
    const auto flanks = Pulse::template flanks<S>();
    std::array<S, Pulse::lobes> result;
    for (int i = 0; i < Pulse::lobes; ++i) {
        const Flank<S> whole = flanks[std::size_t(i)];
        const S next_foot = i + 1 < Pulse::lobes ? flanks[std::size_t(i) + 1].foot : end;
        // The part of the flank within the pulse; a pulse that begins past the peak has none left,
        // and its first instant is then the highest of the lobe.
        const bool begins_past_peak = whole.peak < begin && begin < next_foot;
        const Flank<S> flank{whole.foot < begin ? begin : whole.foot,
                             begins_past_peak ? begin : (whole.peak < end ? whole.peak : end)};
        S& phase = result[std::size_t(i)];
        if (flank.foot > flank.peak || !lifts(flank.peak)) {
            phase = never;
        } else if (lifts(flank.foot)) {
            phase = flank.foot;
        } else {
            phase = Pulse::phase_at(flank, S(1) / amplitude);
        }
    }
    return result;
}

} // namespace overturn
