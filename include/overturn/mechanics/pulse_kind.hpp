// The kinds of ground pulses and their names. The formulas are in pulse.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace overturn {

enum class PulseKind {
    one_sine,
    one_cosine,
    symmetric_ricker,
    antisymmetric_ricker,
    half_sine,
    rectangular,
    triangular,
    sine,
    cosine,
    mavroeidis_papageorgiou
};

/// What a pulse satisfies on each of its smooth pieces; determines its Taylor series.
enum class PulseForm {
    linear,   ///< f'' = 0
    harmonic, ///< f'' = -f
    wavelet,  ///< a polynomial times a Gaussian; it has no end and is cut by a window
    modulated ///< a sum of sines, see ModulatedSine
};

/// The numbers that complete a pulse; each pulse uses its own, see PulseTraits.
struct PulseShape {
    double window = 1; ///< half width of a Ricker wavelet [pulse periods]
    double cycles = 1; ///< duration of a sine or cosine [pulse periods]
    double gamma = 2;  ///< duration of the pulse of Mavroeidis and Papageorgiou [pulse periods]
    double nu = 0;     ///< phase of its oscillation in the middle of the pulse [rad]
};

using ShapeNumber = double PulseShape::*;

/// The numbers with their names in job files and result files.
inline constexpr std::array<std::pair<std::string_view, ShapeNumber>, 4> shape_numbers{
    {{"window", &PulseShape::window},
     {"cycles", &PulseShape::cycles},
     {"gamma", &PulseShape::gamma},
     {"nu", &PulseShape::nu}}};

/// Properties that distinguish a pulse from others with the same formula.
struct PulseTraits {
    std::string_view name; ///< in job files and result files
    int half_turns;        ///< duration: phase 0 to half_turns pi; 0 if PulseShape determines it
    PulseForm form;
    std::array<ShapeNumber, 2> numbers{}; ///< that complete the pulse; null if there are fewer
};

/// In the order of the enumerators.
inline constexpr std::array<PulseTraits, 10> pulses{
    {{"one_sine", 2, PulseForm::harmonic},
     {"one_cosine", 2, PulseForm::harmonic},
     {"symmetric_ricker", 0, PulseForm::wavelet, {&PulseShape::window}},
     {"antisymmetric_ricker", 0, PulseForm::wavelet, {&PulseShape::window}},
     {"half_sine", 1, PulseForm::harmonic},
     {"rectangular", 1, PulseForm::linear},
     {"triangular", 1, PulseForm::linear},
     {"sine", 0, PulseForm::modulated, {&PulseShape::cycles}},
     {"cosine", 0, PulseForm::modulated, {&PulseShape::cycles}},
     {"mavroeidis_papageorgiou", 0, PulseForm::modulated, {&PulseShape::gamma, &PulseShape::nu}}}};

constexpr const PulseTraits& traits_of(PulseKind kind)
{
    return pulses[std::size_t(kind)];
}

/// Whether the pulse is a Ricker wavelet, which has no end and is cut by a window.
constexpr bool has_window(PulseKind kind)
{
    return traits_of(kind).form == PulseForm::wavelet;
}

/// Whether the number completes this pulse.
constexpr bool has_number(PulseKind kind, ShapeNumber number)
{
    const auto& numbers = traits_of(kind).numbers;
    return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
}

/// The largest values: beyond them, `most_lobes` would not suffice.
inline constexpr double most_cycles = 10;
inline constexpr double largest_gamma = 10;

/// The largest number of lobes of a pulse.
inline constexpr int most_lobes = 26;

} // namespace overturn
