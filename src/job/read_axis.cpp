#include "read_steps.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace overturn {

namespace {

// Each process stores the values of all axes; `check`, which scans a line of amplitudes, takes 400
// bytes for each value.
constexpr std::int64_t most_values = 10'000'000;

AxisList read_list(const Entry& entry, const Quantity& rule)
{
    const std::size_t size =
        array_size(entry, "an array of numbers, such as [0.5, 1.0]", "Give at least one value.");
    AxisList values;
    values.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
        const Entry entry_of_value = element(entry, i);
        const double value = quantity_of(entry_of_value, rule);
        if (i > 0 && !(value > values.back())) {
            refuse(entry_of_value,
                   " = {} {} the value before it, {}. Sort the values in ascending order, and give "
                   "each once.",
                   value, value == values.back() ? "repeats" : "is below", values.back());
        }
        values.push_back(value);
    }
    return values;
}

/// Whether the computed values are guaranteed to ascend; otherwise neighbours might coincide. All
/// values are in [0, last].
///
/// Linear: the rounding error of first + (last - first) i / (count - 1) is below 1.5 eps last, and
/// the final rounding adds 0.5 eps last, so neighbours 4 eps last apart cannot coincide.
/// Logarithmic: with L = log(last / first), the rounding error of the logarithm of a value
/// first pow(last / first, i / (count - 1)) is below 0.5 eps (L + 4).
bool surely_ascends(const AxisRange& range)
{
    if (range.count <= 2) {
        return true;
    }
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    const double steps = double(range.count - 1);
    if (range.spacing == Spacing::log) {
        const double extent = std::log(range.last / range.first);
        return extent / steps >= 4 * epsilon * (1 + extent);
    }
    // Rounding errors of subnormal numbers are absolute.
    const double least_step =
        std::fmax(epsilon * range.last, std::numeric_limits<double>::denorm_min());
    return (range.last - range.first) / steps >= 4 * least_step;
}

void check_range(const Entry& entry, const AxisRange& range)
{
    const auto [first, last, count, spacing] = range;
    const Entry first_entry = *find(entry, "first");
    const Entry count_entry = *find(entry, "count");
    if (first > last) {
        refuse(first_entry, " = {} is above last = {}. Axes must ascend. Swap first and last.",
               first, last);
    }
    if (count == 1 && first != last) {
        refuse(count_entry,
               " = 1 needs first = last, but first = {} and last = {}. Raise count, or make them "
               "equal.",
               first, last);
    }
    if (count > 1 && first == last) {
        refuse(
            count_entry,
            " = {} needs first below last, but both are {}. Set count = 1, or change one of them.",
            count, first);
    }
    if (spacing == Spacing::log && !(first > 0)) {
        refuse(first_entry,
               " = {} cannot start a logarithmic range. Raise it above 0, or use spacing = "
               "\"linear\".",
               first);
    }
    // The values and intermediate results must not overflow.
    const double widest =
        spacing == Spacing::log ? last / first : (last - first) * double(count - 1);
    if (!std::isfinite(widest)) {
        refuse(first_entry,
               " = {} is too far from last = {} for double precision. Move them closer together.",
               first, last);
    }
    if (!surely_ascends(range)) {
        refuse(count_entry,
               " = {} is too large: neighbouring values between {} and {} would coincide in double "
               "precision. Lower it.",
               count, first, last);
    }
}

AxisRange read_range(const Entry& entry, const Quantity& rule)
{
    constexpr std::string_view advice = "Give first, last and count, or values.";
    AxisRange range;
    range.first = quantity_of(require(entry, "first", advice), rule);
    range.last = quantity_of(require(entry, "last", advice), rule);
    const Entry count = require(entry, "count", advice);
    range.count = integer_of(count);
    if (range.count < 1) {
        refuse(count, " = {} is below 1. An axis has at least one value.", range.count);
    }
    range.spacing = choice_of(entry, "spacing", spacing_names, range.spacing);
    check_range(entry, range);
    if (range.count > most_values) {
        refuse(count, " = {} is above {}, the maximum for one axis. Lower it.", range.count,
               most_values);
    }
    return range;
}

} // namespace

Axis read_axis(const Entry& entry, const Quantity& rule, Names keys)
{
    if (entry.node->is_number()) {
        return Axis(AxisList{quantity_of(entry, rule)});
    }
    expect_table(entry, keys, "a number, or ");
    const auto values = find(entry, "values");
    if (!values) {
        return Axis(read_range(entry, rule));
    }
    for (const std::string_view key : {"first", "last", "count", "spacing"}) {
        if (const auto other = find(entry, key)) {
            refuse(*other, " cannot be combined with {}.values. Remove one of them.", entry.key);
        }
    }
    return Axis(read_list(*values, rule));
}

} // namespace overturn
