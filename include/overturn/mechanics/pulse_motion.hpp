// A pulse as the ground motion, which all blocks of a spectrum share. It is a run-time value; an
// integrator evaluates it once per step, so that selecting the pulse costs one branch.
#pragma once

#include "overturn/mechanics/modulated_sine.hpp"

#include <cassert>

namespace overturn {

/// One value per lobe of a pulse. Only these are copied: copies of most_lobes values would make a
/// spectrum 2 % slower. The copies are inlined, as the kernels of all instruction sets copy
/// doubles.
template <class T>
struct PerLobe {
    int count = 0;
    std::array<T, most_lobes> values;

    PerLobe() {}
    [[gnu::always_inline]] PerLobe(const PerLobe& other) { *this = other; }
    [[gnu::always_inline]] PerLobe& operator=(const PerLobe& other)
    {
        count = other.count;
        for (std::size_t i = 0; i < std::size_t(count); ++i) {
            values[i] = other.values[i];
        }
        return *this;
    }

    void push_back(const T& value) { values[std::size_t(count++)] = value; }
    auto begin() const { return values.begin(); }
    auto end() const { return values.begin() + count; }
};

/// A pulse of unit peak over its phase. S: the type of one lane.
template <class S>
struct PulseMotion {
    PulseKind pulse;
    PulseForm form;
    S begin; ///< phases at which the ground motion begins and ends [rad]
    S end;
    S kink;    ///< where two smooth pieces meet [rad]; `begin` if there is none
    S fastest; ///< frequency of the fastest harmonic [pulse frequency]; 0 if piecewise linear
    ModulatedSine<S> sine; ///< if the pulse is one
    PerLobe<S> peaks;      ///< phases of the extrema [rad]

    /// Calls visit(formula) with the formula of the pulse, whose `value` is f.
    template <class Visitor>
    auto with_formula(const Visitor& visit) const
    {
        return with_pulse(
            pulse, [&]<class Pulse>() { return visit(Pulse()); }, [&] { return visit(sine); });
    }

    /// The end of the smooth piece that contains the phase [rad]. No step may cross it.
    template <Number T>
    T end_of_piece(const T& phase) const
    {
        return select<T>(phase < T(kink), T(kink), T(end));
    }

    /// The first `count` Taylor coefficients in t of scale f(phase + rate t), on the smooth piece
    /// that contains or begins at the phase `on`; scale [1], phases [rad], rate [rad per unit of
    /// t].
    template <int count, Number T>
    Coefficients<count, T> series(const T& scale, const T& phase, const T& rate, const T& on) const
    {
        Coefficients<count, T> f;
        if (form == PulseForm::wavelet || form == PulseForm::modulated) {
            f = series_by_formula<count>(scale, phase, rate);
        } else {
            const Coefficients<2, T> start = with_pulse(
                pulse,
                [&]<class Pulse>() { return value_and_slope<Pulse>(scale, phase, rate, on); },
                [] { return Coefficients<2, T>(); }); // not called
            f = harmonic_series<count>(start, T(rate * T(fastest)));
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

    bool is_wavelet() const { return form == PulseForm::wavelet; }
    S pieces() const { return S(0); } ///< too few to raise the step limit

    bool has_kink() const { return kink != begin; }

    /// |f''| is less than this [1].
    S largest_curvature() const { return fastest > S(1) ? S(2 * fastest * fastest) : S(2); }

    /// |f^(order)| is at most this on each smooth piece [1]; 0 < order <= 4.
    S largest_derivative(int order) const
    {
        switch (form) {
        case PulseForm::linear: return order == 1 && has_kink() ? S(2) / pi<S>() : S(0);
        case PulseForm::harmonic: return S(1);
        case PulseForm::wavelet: return S(largest_derivative_of_wavelet(pulse, order));
        case PulseForm::modulated: break;
        }
        return sine.largest_derivative(order);
    }

private:
    /// Not inlined: its use of registers would make a step with any other pulse 7 % slower.
    template <int count, Number T>
    [[gnu::noinline]] Coefficients<count, T> series_by_formula(const T& scale, const T& phase,
                                                               const T& rate) const
    {
        if (form == PulseForm::modulated) {
            return sine.template series<count>(scale, phase, rate);
        }
        return pulse == PulseKind::symmetric_ricker
                   ? wavelet_series<PulseKind::symmetric_ricker, count>(scale, phase, rate)
                   : wavelet_series<PulseKind::antisymmetric_ricker, count>(scale, phase, rate);
    }
};

/// The formula before find_peaks() scales it.
template <class S>
ModulatedSine<S> modulated_sine(PulseKind pulse, const PulseShape& shape)
{
    const S half = S(1) / 2;
    return pulse == PulseKind::sine ? ModulatedSine<S>{half, S(0), S(0), S(1)}
           : pulse == PulseKind::cosine
               ? ModulatedSine<S>{half, S(0), S(1), S(0)}
               : ModulatedSine<S>{-half, 1 / S(shape.gamma), sin(S(shape.nu)), cos(S(shape.nu))};
}

/// Finds the extrema of a ModulatedSine and scales it to a peak of 1.
template <class S>
void find_peaks(PulseMotion<S>& motion, const PulseShape& shape)
{
    motion.sine = modulated_sine<S>(motion.pulse, shape);
    std::vector<double> extrema;
    append_extrema(modulated_sine<double>(motion.pulse, shape), double(motion.begin),
                   double(motion.end), extrema);
    assert(extrema.size() + 2 <= most_lobes);
    motion.peaks.push_back(motion.begin);
    for (const double extremum : extrema) {
        motion.peaks.push_back(motion.sine.extremum_near(S(extremum)));
    }
    motion.peaks.push_back(motion.end);
    if (motion.sine.q == 0) {
        return;
    }
    motion.fastest = 1 + motion.sine.q;
    const auto highest = [&] {
        S value(0);
        for (const S& peak : motion.peaks) {
            value = greater<S>(abs(motion.sine.value(peak)), value);
        }
        return value;
    };
    motion.sine.scale /= highest();
    while (highest() > 1) { // by rounding
        motion.sine.scale *= 1 - std::numeric_limits<S>::epsilon();
    }
}

/// The pulse with the numbers of the shape that complete it; the others are ignored.
template <class S>
PulseMotion<S> pulse_motion(PulseKind pulse, const PulseShape& shape = {})
{
    const PulseForm form = traits_of(pulse).form;
    const bool is_centred = has_window(pulse) || has_number(pulse, &PulseShape::gamma);
    const S end = has_window(pulse)                        ? 2 * pi<S>() * S(shape.window)
                  : has_number(pulse, &PulseShape::cycles) ? 2 * pi<S>() * S(shape.cycles)
                  : is_centred                             ? pi<S>() * S(shape.gamma)
                                                           : traits_of(pulse).half_turns * pi<S>();
    const S begin = is_centred ? S(-end) : S(0);
    PulseMotion<S> motion{.pulse = pulse,
                          .form = form,
                          .begin = begin,
                          .end = end,
                          .kink = pulse == PulseKind::triangular ? S(pi<S>() / 2) : begin,
                          .fastest = S(form == PulseForm::linear ? 0 : 1),
                          .sine = {},
                          .peaks = {}};
    const auto add_peaks = [&]<class Pulse>() {
        for (const Flank<S>& flank : Pulse::template flanks<S>()) {
            motion.peaks.push_back(flank.peak);
        }
    };
    with_pulse(pulse, add_peaks, [&] { find_peaks(motion, shape); });
    return motion;
}

/// The amplitudes of the lobes in which f is positive and negative, over the acceleration that
/// lifts the block on the side to which such a lobe pushes it [1]. Equal if the block is symmetric.
template <class S>
struct LobeAmplitudes {
    S positive;
    S negative;
};

/// The part of a flank within the pulse, with |f| at its ends.
template <class S>
struct FlankInPulse {
    Flank<S> flank;
    S foot_height = S(0);     ///< negative if f has the other sign than at the peak [1]
    S peak_height = S(0);     ///< 0 if the flank is outside the pulse [1]
    bool is_negative = false; ///< the sign of f at the peak
    /// The uplift of a block that is lifted at the foot: the foot, or infinite if it was lifted
    /// before [rad].
    S uplift_at_foot = flank.foot;
};

/// The flanks of a pulse. Those of a ModulatedSine, which is monotone between two peaks, are all
/// that is between them.
template <class S>
PerLobe<FlankInPulse<S>> flanks_of(const PulseMotion<S>& motion)
{
    PerLobe<FlankInPulse<S>> result;
    const auto of_formula = [&]<class Pulse>() {
        const auto flanks = Pulse::template flanks<S>();
        for (std::size_t i = 0; i < flanks.size(); ++i) {
            const Flank<S>& whole = flanks[i];
            const S next_foot = i + 1 < flanks.size() ? flanks[i + 1].foot : motion.end;
            // If the pulse begins past the peak, |f| has its largest value of the lobe at the
            // beginning of the pulse.
            const bool begins_past_peak = whole.peak < motion.begin && motion.begin < next_foot;
            FlankInPulse<S> part{{whole.foot < motion.begin ? motion.begin : whole.foot,
                                  begins_past_peak          ? motion.begin
                                  : whole.peak < motion.end ? whole.peak
                                                            : motion.end}};
            if (part.flank.foot <= part.flank.peak) {
                part.foot_height = abs(Pulse::value(part.flank.foot));
                part.peak_height = abs(Pulse::value(part.flank.peak));
                part.is_negative = Pulse::value(part.flank.peak) < 0;
            }
            result.push_back(part);
        }
    };
    const auto between_peaks = [&] {
        S foot = motion.begin;
        for (const S& peak : motion.peaks) {
            const bool is_negative = motion.sine.value(peak) < 0;
            const S sign(is_negative ? -1 : 1);
            result.push_back({{foot, peak},
                              sign * motion.sine.value(foot),
                              sign * motion.sine.value(peak),
                              is_negative,
                              foot < peak ? std::numeric_limits<S>::infinity() : peak});
            foot = peak;
        }
    };
    with_pulse(motion.pulse, of_formula, between_peaks);
    return result;
}

/// The largest values of f and of -f; 0 if they are not positive [1].
template <class S>
LobeAmplitudes<S> largest_lobes(const PulseMotion<S>& motion)
{
    LobeAmplitudes<S> largest{S(0), S(0)};
    for (const FlankInPulse<S>& part : flanks_of(motion)) {
        S& most = part.is_negative ? largest.negative : largest.positive;
        most = greater<S>(part.peak_height, most);
    }
    return largest;
}

/// For each lobe of the pulse, the first phase [rad] at which amplitude * |f| exceeds 1 and a block
/// at rest is lifted; infinite if the lobe stays below, is outside the window, or does not exist.
/// flanks: flanks_of(motion).
template <class S>
PerLobe<S> uplift_phases(const PulseMotion<S>& motion, const PerLobe<FlankInPulse<S>>& flanks,
                         const LobeAmplitudes<S>& amplitudes)
{
    return motion.with_formula([&](const auto& formula) {
        PerLobe<S> result;
        for (const FlankInPulse<S>& part : flanks) {
            const S& amplitude = part.is_negative ? amplitudes.negative : amplitudes.positive;
            result.push_back(
                !(amplitude * part.peak_height > 1) ? std::numeric_limits<S>::infinity()
                : amplitude * part.foot_height > 1  ? part.uplift_at_foot
                                                    : formula.phase_at(part.flank, amplitude));
        }
        return result;
    });
}

} // namespace overturn
