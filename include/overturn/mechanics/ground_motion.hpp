// The ground motion, which all blocks of a spectrum share. It is a run-time value; an integrator
// evaluates it once per step, so that selecting the pulse costs one branch.
#pragma once

#include "overturn/mechanics/pulse_series.hpp"

#include <algorithm>

namespace overturn {

/// A pulse of unit peak over its phase. S: the type of one lane.
template <class S>
struct GroundMotion {
    PulseKind pulse;
    S begin; ///< phases at which the ground motion begins and ends [rad]
    S end;
    S kink;  ///< where two smooth pieces meet [rad]; `begin` if there is none
    S bends; ///< 0 for a piecewise linear pulse, otherwise 1
    std::array<S, most_lobes> peaks; ///< phases of the extrema [rad]; infinite beyond the last

    /// The end of the smooth piece that contains the phase [rad]. No step may cross it.
    template <Number T>
    T end_of_piece(const T& phase) const
    {
        return select<T>(phase < T(kink), T(kink), T(end));
    }

    /// f at each of these phases.
    template <std::size_t count, Number T>
    std::array<T, count> values(const std::array<T, count>& phases) const
    {
        return with_pulse(pulse, [&]<class Pulse>() {
            std::array<T, count> f;
            unrolled<count>([&]<int i>() { f[i] = Pulse::value(phases[i]); });
            return f;
        });
    }

    /// The first `count` Taylor coefficients in t of scale f(phase + rate t), on the smooth piece
    /// that contains or begins at the phase `on`; scale [1], phases [rad], rate [rad per unit of
    /// t].
    template <int count, Number T>
    Coefficients<count, T> series(const T& scale, const T& phase, const T& rate, const T& on) const
    {
        Coefficients<count, T> f;
        if (has_window(pulse)) {
            f = series_of_wavelet<count>(scale, phase, rate);
        } else {
            const Coefficients<2, T> start = with_pulse(pulse, [&]<class Pulse>() {
                return value_and_slope<Pulse>(scale, phase, rate, on);
            });
            f = harmonic_series<count>(start, T(rate * T(bends)));
        }
        return f;
    }
    template <int count, Number T>
    Coefficients<count, T> series(const T& scale, const T& phase, const T& rate) const
    {
        return series<count>(scale, phase, rate, phase);
    }

    /// Per lane: whether f has no extremum between these phases.
    template <Number T>
    mask_t<T> is_monotone(const T& first, const T& last) const
    {
        mask_t<T> monotone = first == first;
        for (const S& peak : peaks) {
            monotone = monotone && !(first < T(peak) && T(peak) < last);
        }
        return monotone;
    }

    static constexpr bool may_be_wavelet = true;
    bool is_wavelet() const { return has_window(pulse); }
    S pieces() const { return S(0); } ///< not worth counting

    bool has_kink() const { return kink != begin; }

private:
    /// Not inlined: its use of registers would make a step with any other pulse 7 % slower.
    template <int count, Number T>
    [[gnu::noinline]] Coefficients<count, T> series_of_wavelet(const T& scale, const T& phase,
                                                               const T& rate) const
    {
        return with_wavelet(pulse, [&]<class Wavelet>() {
            return wavelet_series<Wavelet, count>(scale, phase, rate);
        });
    }
};

/// window: half width of a wavelet [pulse periods]; ignored for other pulses.
template <class S>
GroundMotion<S> ground_motion(PulseKind pulse, const S& window)
{
    const int half_turns = traits_of(pulse).half_turns;
    const S end = has_window(pulse) ? 2 * pi<S>() * window : half_turns * pi<S>();
    GroundMotion<S> motion{.pulse = pulse,
                           .begin = has_window(pulse) ? S(-end) : S(0),
                           .end = end,
                           .kink = has_window(pulse) ? S(-end) : S(0),
                           .bends = S(traits_of(pulse).form == PulseForm::linear ? 0 : 1),
                           .peaks = {}};
    motion.peaks.fill(std::numeric_limits<S>::infinity());
    with_pulse(pulse, [&]<class Pulse>() {
        static_assert(Pulse::lobes <= most_lobes);
        if (Pulse::template kink<S>() < end) {
            motion.kink = Pulse::template kink<S>();
        }
        const auto flanks = Pulse::template flanks<S>();
        std::transform(flanks.begin(), flanks.end(), motion.peaks.begin(),
                       [](const Flank<S>& flank) { return flank.peak; });
    });
    return motion;
}

/// One phase per lobe of a pulse [rad].
template <class S>
using UpliftPhases = std::array<S, most_lobes>;

/// For each lobe of the pulse, the first phase [rad] at which amplitude * |f| exceeds 1 and a block
/// at rest is lifted; infinite if the lobe stays below, is outside the window, or does not exist.
/// amplitude [1].
template <class S>
UpliftPhases<S> uplift_phases(const GroundMotion<S>& motion, const S& amplitude)
{
    using std::abs;
    UpliftPhases<S> result;
    result.fill(std::numeric_limits<S>::infinity());
    with_pulse(motion.pulse, [&]<class Pulse>() {
        const auto lifts = [&](const S& phase) { return amplitude * abs(Pulse::value(phase)) > 1; };
        const auto flanks = Pulse::template flanks<S>();
        for (std::size_t i = 0; i < flanks.size(); ++i) {
            const Flank<S>& whole = flanks[i];
            const S next_foot = i + 1 < flanks.size() ? flanks[i + 1].foot : motion.end;
            // The part of the flank within the pulse. If the pulse begins past the peak, |f| has
            // its largest value of the lobe at the beginning of the pulse.
            const bool begins_past_peak = whole.peak < motion.begin && motion.begin < next_foot;
            const Flank<S> flank{whole.foot < motion.begin ? motion.begin : whole.foot,
                                 begins_past_peak          ? motion.begin
                                 : whole.peak < motion.end ? whole.peak
                                                           : motion.end};
            if (flank.foot > flank.peak || !lifts(flank.peak)) {
                continue;
            }
            result[i] =
                lifts(flank.foot) ? flank.foot : Pulse::phase_at(flank, S(S(1) / amplitude));
        }
    });
    return result;
}

} // namespace overturn
