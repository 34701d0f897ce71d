#include "overturn/sweep/quantity.hpp"

#include "overturn/mechanics/pulse_kind.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace overturn {

namespace {

bool is_positive(double value)
{
    return value > 0 && std::isfinite(value);
}

bool is_not_negative(double value)
{
    return value >= 0 && std::isfinite(value);
}

bool is_energy_ratio(double value)
{
    return value > 0 && value <= 1;
}

// Below 1e-100, squares of velocity over alpha exceed the range of a double.
bool is_slenderness(double value)
{
    return value >= 1e-100 && value < std::numbers::pi / 2;
}

// At 8 periods the wavelets are below 1e-178 of their peak.
bool is_window(double value)
{
    return value > 0 && value <= 8;
}

bool is_count_of_cycles(double value)
{
    static_assert(most_cycles == 10);
    return value >= 0.5 && value <= most_cycles && 2 * value == std::floor(2 * value);
}

bool is_gamma(double value)
{
    static_assert(largest_gamma == 10);
    return value > 1 && value <= largest_gamma;
}

bool is_share(double value)
{
    return value >= 0 && value <= 1;
}

bool is_phase(double value)
{
    return std::abs(value) <= 2 * std::numbers::pi;
}

// Below this range the round-off of a step is as large as the tolerance; above it verdicts are not
// reliable.
bool is_tolerance(double value)
{
    return value >= 1e-14 && value <= 1e-2;
}

constexpr std::string_view positive = "(0, inf)";
constexpr std::string_view not_negative = "[0, inf)";
constexpr std::string_view of_length = "It is a length in metres.";

constexpr std::array quantities{
    Quantity{"width", "m", positive, is_positive, of_length},
    Quantity{"height", "m", positive, is_positive, of_length},
    Quantity{"half_width", "m", positive, is_positive, of_length},
    Quantity{"half_height", "m", positive, is_positive, of_length},
    Quantity{"slenderness", "rad", "[1e-100, pi/2)", is_slenderness,
             "It is arctan(width / height) in radians; a degree is 0.01745."},
    Quantity{"size", "m", positive, is_positive, "It is the half diagonal of the block in metres."},
    Quantity{"frequency_parameter", "s-1", positive, is_positive,
             "It is p = sqrt(3g / 4R) in 1/s."},
    Quantity{"restitution", "1", "(0, 1]", is_energy_ratio,
             "A block cannot gain energy at an impact, nor lose all of it."},
    Quantity{"restitution_of_maximum", "1", positive, is_positive,
             "It is a share of the largest restitution (Eq. 17)."},
    Quantity{"frequency", "1", positive, is_positive, "The frequency of a pulse must be positive."},
    Quantity{"pulse_period", "s", positive, is_positive,
             "It is the period of the pulse in seconds."},
    Quantity{"pulse_frequency", "s-1", positive, is_positive,
             "It is the frequency of the pulse in Hz."},
    Quantity{"amplitude", "1", not_negative, is_not_negative,
             "It is the magnitude of the peak ground acceleration."},
    Quantity{"scale", "1", not_negative, is_not_negative, "It is the factor on the record."},
    Quantity{"pga", "1", not_negative, is_not_negative,
             "It is the peak ground acceleration over g."},
    Quantity{"window", "1", "(0, 8]", is_window, "It is the half width in pulse periods."},
    Quantity{"cycles", "1", "{0.5, 1, 1.5, ..., 10}", is_count_of_cycles,
             "It is the duration in pulse periods, a multiple of 0.5."},
    Quantity{"gamma", "1", "(1, 10]", is_gamma, "It is the duration in pulse periods."},
    Quantity{"nu", "rad", "[-2 pi, 2 pi]", is_phase,
             "It is the phase of the oscillation in the middle of the pulse, in radians."},
    Quantity{"gravity", "m s-2", positive, is_positive, "It is g in m/s2."},
    Quantity{"time_step", "s", positive, is_positive,
             "It is the time between two samples in seconds."},
    Quantity{"audit", "1", "[0, 1]", is_share,
             "It is the share of the filled points that are integrated as well."},
    Quantity{"tolerance", "1", "[1e-14, 0.01]", is_tolerance,
             "It is the local error per step, relative to the size of the motion."},
};

} // namespace

const Quantity* find_quantity(std::string_view name)
{
    const auto found = std::find_if(quantities.begin(), quantities.end(),
                                    [&](const Quantity& each) { return each.name == name; });
    return found == quantities.end() ? nullptr : &*found;
}

const Quantity& quantity(std::string_view name)
{
    const Quantity* found = find_quantity(name);
    assert(found != nullptr);
    return *found;
}

} // namespace overturn
