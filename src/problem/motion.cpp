#include "overturn/problem/motion.hpp"

#include "overturn/mechanics/pulse_motion.hpp"
#include "overturn/problem/quantity.hpp"

#include <fmt/format.h>

#include <cmath>

namespace overturn {

namespace {

std::string_view name_of(ShapeNumber number)
{
    return std::find_if(shape_numbers.begin(), shape_numbers.end(),
                        [&](const auto& each) { return each.second == number; })
        ->first;
}

} // namespace

std::optional<NamedPulse> Pulse::named() const
{
    NamedPulse named{name_of(kind), {}};
    for (const auto& [name, number] : shape_numbers) {
        if (has_number(kind, number)) {
            named.numbers.emplace_back(name, shape.*number);
        }
    }
    return named;
}

std::string refusal_of_key(std::string_view pulse, std::string_view others)
{
    return fmt::format(" has no meaning for the pulse \"{}\", only for {}. Remove it.", pulse,
                       others);
}

std::string refusal_of(PulseKind pulse, ShapeNumber number, std::optional<double> value)
{
    if (!has_number(pulse, number)) {
        return value ? refusal_of_key(name_of(pulse), pulses_with(number)) : "";
    }
    const Quantity& rule = quantity(name_of(number));
    if (!value) {
        const bool has_default = number == &PulseShape::window;
        return has_default ? ""
                           : fmt::format(" is missing. Give a number in {}. {}", rule.interval.text,
                                         rule.reason);
    }
    return rule.allows(*value) ? "" : rule.refusal_of(*value);
}

double cut_by_window(const Pulse& pulse)
{
    const PulseMotion<double> motion = pulse_motion<double>(pulse.kind, pulse.shape);
    const double cut = motion.with_formula([&](const auto& f) { return f.value(motion.end); });
    return has_window(pulse.kind) ? std::abs(cut) : 0;
}

} // namespace overturn
