#include "overturn/problem/fields.hpp"

#include "overturn/mechanics/free_rocking.hpp"
#include "overturn/sweep/outcome.hpp"
#include "overturn/text/mapped.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace overturn {

namespace {

std::vector<FieldFlag> regions(bool with_no_flip)
{
    std::vector<FieldFlag> flags;
    flags.reserve(region_names.size() + 3);
    for (std::size_t code = 0; code < region_names.size(); ++code) {
        flags.push_back({std::uint32_t(code), region_names[code]});
    }
    if (with_no_flip) {
        flags.push_back({no_flip, "no_flip"});
    }
    flags.push_back({std::uint32_t(Region::undecided), "undecided"});
    flags.push_back({std::uint32_t(Region::not_computed), "not_computed"});
    return flags;
}

const std::vector<FieldFlag> region_flags = regions(false);
const std::vector<FieldFlag> region_or_no_flip = regions(true);

/// d theta / d(p t) at the end, with the p of the side plus [rad].
double velocity(const EndOfPoint& end)
{
    const Block<double>& block = end.point.block;
    const double rate = end.outcome.rate;
    return end.outcome.with_sign(block.is_symmetric() ? rate
                                                      : rate * (end.block().frequency_parameter /
                                                                block.frequency_parameter));
}

/// The largest |theta| / alpha during the ground motion and after it [1].
double peak(const EndOfPoint& end)
{
    const Outcome& outcome = end.outcome;
    if (!is_safe(outcome.region)) {
        return is_unsafe(outcome.region) ? infinity : unknown_value;
    }
    return with_theory(end.scene().theory, [&]<Theory theory>() {
        const double so_far = outcome.peak / end.point.block.slenderness;
        return outcome.has(status::slipped)
                   ? so_far // of the whole motion
                   : std::max(so_far, largest_free_tilt<theory>(outcome.end(), end.block()));
    });
}

/// The time from the first uplift to |theta| = pi/2 [1/p].
double fall_time(const EndOfPoint& end)
{
    const Outcome& outcome = end.outcome;
    if (!is_unsafe(outcome.region)) {
        return is_safe(outcome.region) ? infinity : unknown_value;
    }
    if (outcome.has(status::slipped)) {
        return ((outcome.phase - outcome.uplift) / end.point.frequency + outcome.fall_after) *
               end.point.block.frequency_parameter;
    }
    return with_theory(end.scene().theory, [&]<Theory theory>() {
        const double forced = (outcome.phase - end.first_uplift()) / end.point.frequency;
        const double time =
            outcome.has(outcome_flag::fell)
                ? forced
                : forced + time_to_lie_flat<theory, double>(outcome.end(), end.block());
        return time * end.point.block.frequency_parameter;
    });
}

/// A displacement of the base over R of the side plus.
template <auto member>
double slide(const EndOfPoint& end)
{
    return end.outcome.*member / end.point.block.size;
}

/// A number of the outcome as it is.
template <auto member>
auto value_of(const EndOfPoint& end)
{
    return end.outcome.*member;
}

double angle(const EndOfPoint& end)
{
    return end.outcome.with_sign(end.outcome.tilt);
}

std::uint16_t impacts(const EndOfPoint& end)
{
    return end.outcome.stored_impacts(end.scene().motion_traits().lifts_again);
}

std::uint8_t status_bits(const EndOfPoint& end)
{
    return std::uint8_t(end.outcome.flags & outcome_flag::of_status);
}

/// As a function for all points.
template <auto value>
constexpr FieldFunction each{
    [](const EndOfPoint& end) { return double(value(end)); },
    [](EndsOfPoints ends, FieldValues& all) { // a copy, which stores of bytes cannot change
        std::visit(
            [&]<class Value>(std::vector<Value>& values) {
                Value* const to = values.data();
                const int size = ends.size();
                for (int i = 0; i < size; ++i) {
                    to[i] = Value(value(ends[i]));
                }
            },
            all);
    }};

using enum FieldType;

// clang-format off
/// In the order in which messages list them.
const FieldTraits fields[] = {
    {"region", uint8, "region at the end of the ground motion", "",
     "S: safe within the separatrix; S+, S-: safe due to the loss at the next impact; U0: "
     "overturns without another impact; U1, U2: overturns after one or two more impacts; F: falls "
     "during the ground motion",
     {&Outputs::region}, each<value_of<&Outcome::region>>, region_flags, FieldOf::filled_point},
    {"angle", float64, "angle at the end of the ground motion", "rad", "theta", {}, each<angle>},
    {"velocity", float64, "velocity at the end of the ground motion", "rad", "d theta / d(p t)",
     {}, each<velocity>},
    {"margin", float64, "margin, positive where safe", "1", "distance from the other verdict",
     {&Outputs::margin}, each<value_of<&Outcome::margin>>},
    {"error", float64, "bound on the error of the margin", "1",
     "to first order; infinite where it is unknown: an impact or a fall may or may not have "
     "happened, or was only just avoided; a verdict is certain where |margin| is larger",
     {&Outputs::error}, each<value_of<&Outcome::error>>},
    {"peak", float64, "largest |theta| / alpha", "1",
     "during the ground motion and after it; infinite where the block overturns",
     {&Outputs::region, &Outputs::peak}, each<peak>},
    {"fall_time", float64, "time p t from uplift to |theta| = pi/2", "1",
     "infinite where the block does not overturn", {&Outputs::region, &Outputs::phase}, each<fall_time>},
    {"friction_demand", float64, "friction coefficient needed", "1",
     "the largest |along| / normal force of the base on the block, during the ground motion and "
     "after it, impacts excepted; of a block that overturns, until it last passes alpha; infinite "
     "where the block would leave the base",
     {&Outputs::contact}, each<value_of<&Outcome::friction_demand>>},
    {"normal", float64, "smallest normal force over that at rest", "1",
     "over the same times as friction_demand", {&Outputs::contact}, each<value_of<&Outcome::normal>>},
    {"slide", float64, "final slide of the base over R", "1",
     "positive towards the side plus, over R of the side plus, when the block is at rest, or has "
     "fallen; 0 if it does not slip", {&Outputs::slide}, each<slide<&Outcome::slide>>},
    {"slide_peak", float64, "largest |slide| of the base over R", "1", "see slide",
     {&Outputs::slide}, each<slide<&Outcome::slide_peak>>},
    {"impacts", uint16, "impacts during the ground motion", "1", "", {&Outputs::impacts}, each<impacts>,
     {{impact_count::largest, "this_many_or_more"}, {impact_count::not_computed, "not_computed"},
      {impact_count::bounce_series, "bounce_series"}}, FieldOf::filled_point},
    {"steps", uint32, "integration steps tried", "1", "", {&Outputs::steps},
     each<value_of<&Outcome::steps>>, {{step_count::not_computed, "not_computed"}}},
    {"status", uint8, "flags set during the integration", "",
     "0: no flag is set; 255: not computed yet", {}, each<status_bits>,
     {{status::came_to_rest, "came_to_rest"}, {status::cap_was_hit, "cap_was_hit"},
      {status::not_finite, "not_finite"}, {status::unresolved, "unresolved"},
      {status::free_fall, "free_fall"}, {status::lifts_off, "lifts_off"}, {status::slipped, "slipped"},
      {status::jammed, "jammed"}}, FieldOf::point, true},
    {"flip_amplitude", float64, "strength at which the verdict flips", "1",
     "the amplitude of a pulse or the scale of a record, in ascending order; NaN beyond the last "
     "flip. Each flip lies between two amplitudes with settled verdicts, at most `width` apart "
     "relative to their size. If region_below or region_above is undecided, the value is not a "
     "flip but the settled amplitude next to the undecided range. Under a pulse, the steps of the "
     "scan were halved where the margin is not linear or the number of impacts changes, down to "
     "`finest_step` of the amplitude; strips that are narrower, or that the neighbouring "
     "amplitudes do not indicate, may be missed. Under a record, the steps were divided evenly "
     "until each was at most `finest_step` of the amplitude; narrower strips exist and are missed",
     {}, {}, {}, FieldOf::flip},
    {"flip_value", float64, "value at which the verdict flips", "1",
     "a value of the quantity along which the boundary was scanned, in ascending order; NaN beyond "
     "the last flip. Each flip lies between two values with settled verdicts, at most `width` of "
     "the scanned range apart. If region_below or region_above is undecided, the value is not a "
     "flip but the settled value next to the undecided range. Under a pulse, the steps of the scan "
     "were halved where the margin is not linear or the number of impacts changes, down to "
     "`finest_step` of the range; strips that are narrower, or that the neighbouring values do not "
     "indicate, may be missed. Under a record, the steps were divided evenly until each was at "
     "most `finest_step` of the range; narrower strips exist and are missed",
     {}, {}, {}, FieldOf::flip},
    {"region_below", uint8, "region just below the flip", "",
     "if there is no flip, the first entry along `crossing` has the region at the first amplitude "
     "of the scan. A first flip above a safe region is the minimum overturning amplitude. If the "
     "first entry has an unsafe region below, the block overturns at the first amplitude of the "
     "job", {}, {}, region_or_no_flip, FieldOf::flip},
    {"region_above", uint8, "region just above the flip", "",
     "undecided: verdicts could not be settled up to the next flip, or this is the last stored "
     "flip and there are more", {}, {}, region_or_no_flip, FieldOf::flip},
    {"flip_pga", float64, "PGA at which the verdict flips, over g", "1", "", {}, {}, {},
     FieldOf::flip},
    {"unsafe_share", float64, "share of amplitudes that overturn", "1",
     "share of the scanned interval. Under a record, smaller steps find more flips; this share "
     "hardly depends on the step. Flips beyond the last stored flip are included",
     {}, {}, {}, FieldOf::line},
    {"undecided_share", float64, "share of amplitudes without verdict", "1",
     "share of the scanned interval in which the verdict could not be settled",
     {}, {}, {}, FieldOf::line},
    {"evaluated", uint8, "whether the point was integrated", "",
     "filled: all nodes of a cell around the point have its region, and none of the functions "
     "that change it is near zero; by numerical evidence, not by proof", {}, {},
     {{point_origin::filled, "filled"}, {point_origin::integrated, "integrated"},
      {point_origin::not_computed, "not_computed"}}, FieldOf::filling}};
// clang-format on

} // namespace

std::span<const FieldTraits> all_fields()
{
    return fields;
}

const FieldTraits* find_field(std::string_view name)
{
    const auto found = std::ranges::find(fields, name, &FieldTraits::name);
    return found == std::end(fields) ? nullptr : found;
}

const FieldTraits& traits_of(Field field)
{
    const FieldTraits* found = find_field(field.name);
    assert(found != nullptr);
    return *found;
}

std::vector<Field> spectrum_fields()
{
    std::vector<Field> of_points;
    for (const FieldTraits& traits : fields) {
        if (traits.value.at != nullptr) {
            of_points.push_back({traits.name});
        }
    }
    return of_points;
}

std::variant<std::uint8_t, std::uint16_t, std::uint32_t, double, float> fill_value(Field field)
{
    switch (traits_of(field).type) {
    case FieldType::uint8:
        static_assert(status::not_computed == std::uint8_t(Region::not_computed) &&
                      status::not_computed == point_origin::not_computed);
        return status::not_computed;
    case FieldType::uint16: return impact_count::not_computed;
    case FieldType::uint32: return step_count::not_computed;
    case FieldType::float64: break;
    }
    if (field.precision == Precision::single_precision) {
        return std::numeric_limits<float>::quiet_NaN();
    }
    return unknown_value;
}

FieldValues not_computed(Field field, std::int64_t points)
{
    return std::visit(
        [&](auto value) { return FieldValues(std::vector(std::size_t(points), value)); },
        fill_value(field));
}

float in_single_precision(double value)
{
    if (!std::isfinite(value)) {
        return float(value);
    }
    constexpr double largest = std::numeric_limits<float>::max();
    const auto nearest = float(std::clamp(value, -largest, largest));
    for (const float limit : {0.0F, 1.0F}) {
        if (nearest == limit && value != limit) {
            return std::nextafter(limit, float(value > limit ? infinity : -infinity));
        }
    }
    return nearest;
}

FieldValues as_stored(Field field, FieldValues computed)
{
    if (field.precision == Precision::single_precision) {
        if (const auto* numbers = std::get_if<std::vector<double>>(&computed)) {
            return mapped(*numbers, in_single_precision);
        }
    }
    return computed;
}

std::size_t bytes_per_point(Field field)
{
    return std::visit([](auto value) { return sizeof value; }, fill_value(field));
}

} // namespace overturn
