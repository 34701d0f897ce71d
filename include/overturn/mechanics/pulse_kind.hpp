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

/// Properties that distinguish a pulse from others with the same formula.
struct PulseTraits {
    std::string_view name; ///< in job files and result files
    int half_turns;        ///< duration: phase 0 to half_turns pi; 0 for a wavelet, cut by a window
    bool is_linear;        ///< on each of its smooth pieces
};

/// In the order of the enumerators.
inline constexpr std::array<PulseTraits, 7> pulses{{{"one_sine", 2, false},
                                                    {"one_cosine", 2, false},
                                                    {"symmetric_ricker", 0, false},
                                                    {"antisymmetric_ricker", 0, false},
                                                    {"half_sine", 1, false},
                                                    {"rectangular", 1, true},
                                                    {"triangular", 1, true}}};

constexpr const PulseTraits& traits_of(PulseKind kind)
{
    return pulses[std::size_t(kind)];
}

/// Whether the pulse is a Ricker wavelet, which has no end and is cut by a window.
constexpr bool has_window(PulseKind kind)
{
    return traits_of(kind).half_turns == 0;
}

/// The largest number of lobes of a pulse.
inline constexpr int most_lobes = 4;

} // namespace overturn
