#include "overturn/sweep/quantity.hpp"

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
