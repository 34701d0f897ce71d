#include "check_lengths.hpp"

#include "overturn/problem/given.hpp"
#include "overturn/text/mapped.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

namespace overturn {

namespace {

/// What a coordinate that follows from lengths in metres never exceeds.
struct LengthLimit {
    std::string_view coordinate;
    double most;
    const char* message;    ///< the format of a larger value
    std::string_view cause; ///< which is refused; empty: the largest length
};

/// Of an object 100 m high; what is given in centimetres is mostly 1 m high or more. A length in
/// centimetres beside others in metres is 100 times too large; true ratios are at most 1 or 2.
constexpr double largest_size = 50;
constexpr const char* of_size = "the half diagonal R is {:.4g} m, above 50 m";
constexpr LengthLimit limits[]{
    {"size", largest_size, of_size, ""},
    {"size_plus", largest_size, of_size, ""},
    {"size_minus", largest_size, of_size, ""},
    {"gyration_over_size", 10, "it is {:.4g} R, above 10 R", "radius_of_gyration"},
    {"center_over_half_height", 20, "it is {:.4g} times half the height of the block, above 20",
     "center_height"},
};

struct Length {
    std::string_view name;
    double value; ///< [m]
};
using Lengths = std::vector<Length>;

/// Whether an object of at most this size [m] may have these lengths.
bool are_plausible(const Lengths& lengths, double largest)
{
    constexpr double least = 0.02;   // [m]
    constexpr double most_ratio = 2; // of the centre's height or the radius of gyration
    double of_block = 0;
    for (const Length& length : lengths) {
        const bool is_of_mass =
            length.name == "radius_of_gyration" || length.name == "center_height";
        of_block = std::max(of_block, is_of_mass ? 0 : length.value);
    }
    return std::ranges::all_of(lengths, [&](const Length& length) {
        const bool is_whole = length.name == "width" || length.name == "height";
        return (length.value >= least || length.name == "center_offset") &&
               length.value <= most_ratio * of_block &&
               (is_whole ? 1 : 2) * length.value <= largest;
    });
}

/// The lengths in metres if they are in centimetres or millimetres: all of them, or those above 10,
/// or the cause of the refusal only. Empty if none of this makes an object.
Lengths in_metres(const Lengths& given, std::string_view cause)
{
    using Choice = std::function<bool(const Length&)>;
    const auto is_any = [](const Length&) { return true; };
    const auto is_large = [](const Length& length) { return length.value > 10; };
    const auto is_cause = [&](const Length& length) { return length.name == cause; };
    // Up to 8 m, an object is probably given in centimetres rather than in millimetres.
    for (const auto& [unit, largest] : {std::pair(0.01, 8.0), std::pair(0.001, 20.0)}) {
        for (const Choice& is_wrong : {Choice(is_any), Choice(is_large), Choice(is_cause)}) {
            const Lengths lengths = mapped(given, [&](const Length& length) {
                return Length{length.name, length.value * (is_wrong(length) ? unit : 1)};
            });
            if (are_plausible(lengths, largest)) {
                return lengths;
            }
        }
    }
    return {};
}

/// Such as ": 0.42 m x 1.55 m, center_height 0.7 m?", or a full stop if there are no lengths.
std::string question_of(const Lengths& lengths)
{
    std::vector<std::string> texts;
    for (const Length& length : lengths) {
        if (length.name == "height" && lengths.front().name == "width") {
            texts.front() = fmt::format("{:.6g} m x {:.6g} m", lengths.front().value, length.value);
        } else {
            texts.push_back(fmt::format("{} {:.6g} m", length.name, length.value));
        }
    }
    return texts.empty() ? "." : fmt::format(": {}?", fmt::join(texts, ", "));
}

std::vector<std::string_view> given_lengths(const Grid& corners)
{
    std::vector<std::string_view> names;
    for (const Quantity& quantity : all_quantities()) {
        if (quantity.role == Role::block && quantity.units == "m" &&
            corners.find(quantity.name) != nullptr) {
            names.push_back(quantity.name);
        }
    }
    return names;
}

} // namespace

void expect_metres(const Scene& scene, const Coordinates& coordinates, const Grid& corners)
{
    constexpr double largest_gravity = 30; // [m/s2]
    const bool has_effect = corners.find("frequency") == nullptr;
    const std::vector<std::string_view> names = given_lengths(corners);
    if (!has_effect || scene.gravity > largest_gravity || names.empty()) {
        return;
    }
    const std::vector<std::size_t> dimensions = coordinates.dimensions_of_any(names);
    for (const LengthLimit& limit : limits) {
        if (!coordinates.has(limit.coordinate)) {
            continue;
        }
        const std::vector<double> values = coordinates.along(dimensions, limit.coordinate);
        const auto beyond =
            std::ranges::find_if(values, [&](double value) { return value > limit.most; });
        if (beyond == values.end()) {
            continue;
        }
        const auto place = beyond - values.begin();
        const Lengths lengths = mapped(names, [&](std::string_view name) {
            return Length{name, coordinates.along(dimensions, name)[std::size_t(place)]};
        });
        const auto cause = limit.cause.empty()
                               ? std::ranges::max_element(lengths, {}, &Length::value)
                               : std::ranges::find(lengths, limit.cause, &Length::name);
        throw GivenError(corners.row_of_table(cause->name, dimensions, place), cause->name,
                         fmt::format(" = {}: {}. Lengths are in metres{}", cause->value,
                                     fmt::format(fmt::runtime(limit.message), *beyond),
                                     question_of(in_metres(lengths, cause->name))));
    }
}

} // namespace overturn
