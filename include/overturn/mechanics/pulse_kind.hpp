// The kinds of ground pulses and their names. The formulas are in pulse.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace overturn {

enum class PulseKind {
    one_sine,
    one_cosine,
    symmetric_ricker,
    antisymmetric_ricker,
    half_sine,
    rectangular,
    triangular
};

/// What a pulse satisfies on each of its smooth pieces; determines its Taylor series.
enum class PulseForm {
    linear,   ///< f'' = 0
    harmonic, ///< f'' = -f
    wavelet   ///< a polynomial times a Gaussian; it has no end and is cut by a window
};

/// Properties that distinguish a pulse from others with the same formula.
struct PulseTraits {
    std::string_view name; ///< in job files and result files
    int half_turns;        ///< duration: phase 0 to half_turns pi; 0 for a wavelet
    PulseForm form;
};

/// In the order of the enumerators.
inline constexpr std::array<PulseTraits, 7> pulses{{{"one_sine", 2, PulseForm::harmonic},
                                                    {"one_cosine", 2, PulseForm::harmonic},
                                                    {"symmetric_ricker", 0, PulseForm::wavelet},
                                                    {"antisymmetric_ricker", 0, PulseForm::wavelet},
                                                    {"half_sine", 1, PulseForm::harmonic},
                                                    {"rectangular", 1, PulseForm::linear},
                                                    {"triangular", 1, PulseForm::linear}}};

constexpr const PulseTraits& traits_of(PulseKind kind)
{
    return pulses[std::size_t(kind)];
}

/// Whether the pulse is a Ricker wavelet, which has no end and is cut by a window.
constexpr bool has_window(PulseKind kind)
{
    return traits_of(kind).form == PulseForm::wavelet;
}

/// The largest number of lobes of a pulse.
inline constexpr int most_lobes = 4;

} // namespace overturn
