#include "overturn/problem/fields.hpp"

#include "overturn/mechanics/region.hpp"
#include "overturn/text/mapped.hpp"

#include <limits>

namespace overturn {

namespace {

std::vector<FieldFlag> regions(bool with_no_flip)
{
    std::vector<FieldFlag> flags;
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

const std::vector<FieldFlag> impact_flags{{impact_count::largest, "this_many_or_more"},
                                          {impact_count::not_computed, "not_computed"},
                                          {impact_count::bounce_series, "bounce_series"}};
const std::vector<FieldFlag> step_flags{{step_count::not_computed, "not_computed"}};
const std::vector<FieldFlag> status_flags{
    {status::came_to_rest, "came_to_rest"}, {status::cap_was_hit, "cap_was_hit"},
    {status::not_finite, "not_finite"},     {status::unresolved, "unresolved"},
    {status::free_fall, "free_fall"},       {status::lifts_off, "lifts_off"}};
const std::vector<FieldFlag> origin_flags{{point_origin::filled, "filled"},
                                          {point_origin::integrated, "integrated"},
                                          {point_origin::not_computed, "not_computed"}};

/// In the order of the enumerators.
const std::array<FieldTraits, count_of_fields> fields{{
    {"region", FieldType::uint8, "region at the end of the ground motion", "",
     "S: safe within the separatrix; S+, S-: safe due to the loss at the next impact; U0: "
     "overturns without another impact; U1, U2: overturns after one or two more impacts; F: falls "
     "during the ground motion",
     regions(false)},
    {"angle", FieldType::float64, "angle at the end of the ground motion", "rad", "theta"},
    {"velocity", FieldType::float64, "velocity at the end of the ground motion", "rad",
     "d theta / d(p t)"},
    {"margin", FieldType::float64, "margin, positive where safe", "1",
     "distance from the other verdict"},
    {"error", FieldType::float64, "bound on the error of the margin", "1",
     "to first order; infinite where it is unknown: an impact or a fall may or may not have "
     "happened, or was only just avoided; a verdict is certain where |margin| is larger"},
    {"peak", FieldType::float64, "largest |theta| / alpha", "1",
     "during the ground motion and after it; infinite where the block overturns"},
    {"fall_time", FieldType::float64, "time p t from uplift to |theta| = pi/2", "1",
     "infinite where the block does not overturn"},
    {"friction", FieldType::float64, "friction coefficient needed", "1",
     "the largest |along| / normal force of the base on the block, during the ground motion and "
     "after it, impacts excepted; of a block that overturns, until it last passes alpha; infinite "
     "where the block would leave the base"},
    {"normal", FieldType::float64, "smallest normal force over that at rest", "1",
     "over the same times as the friction"},
    {"impacts", FieldType::uint16, "impacts during the ground motion", "1", "", impact_flags},
    {"steps", FieldType::uint32, "integration steps tried", "1", "", step_flags},
    {"status", FieldType::uint8, "flags set during the integration", "",
     "0: no flag is set; 255: not computed yet", status_flags, true},
    {"flip_amplitude", FieldType::float64, "strength at which the verdict flips", "1",
     "the amplitude of a pulse or the scale of a record, in ascending order; NaN beyond the last "
     "flip. Each flip lies between two amplitudes with settled verdicts, at most `width` apart "
     "relative to their size. If region_below or region_above is undecided, the value is not a "
     "flip but the settled amplitude next to the undecided range. Under a pulse, the steps of the "
     "scan were halved where the margin is not linear or the number of impacts changes, down to "
     "`finest_step` of the amplitude; strips that are narrower, or that the neighbouring "
     "amplitudes do not indicate, may be missed. Under a record, the steps were divided evenly "
     "until each was at most `finest_step` of the amplitude; narrower strips exist and are missed"},
    {"region_below", FieldType::uint8, "region just below the flip", "",
     "if there is no flip, the first entry along `crossing` has the region at the first amplitude "
     "of the scan. A first flip above a safe region is the minimum overturning amplitude. If the "
     "first entry has an unsafe region below, the block overturns at the first amplitude of the "
     "job",
     regions(true)},
    {"region_above", FieldType::uint8, "region just above the flip", "",
     "undecided: verdicts could not be settled up to the next flip, or this is the last stored "
     "flip and there are more",
     regions(true)},
    {"flip_pga", FieldType::float64, "PGA at which the verdict flips, over g", "1", ""},
    {"unsafe_share", FieldType::float64, "share of amplitudes that overturn", "1",
     "share of the scanned interval. Under a record, smaller steps find more flips; this share "
     "hardly depends on the step. Flips beyond the last stored flip are included"},
    {"undecided_share", FieldType::float64, "share of amplitudes without verdict", "1",
     "share of the scanned interval in which the verdict could not be settled"},
    {"evaluated", FieldType::uint8, "whether the point was integrated", "",
     "filled: all nodes of a cell around the point have its region, and none of the functions "
     "that change it is near zero; by numerical evidence, not by proof",
     origin_flags},
}};

} // namespace

const FieldTraits& traits_of(Field field)
{
    return fields[std::size_t(field)];
}

std::vector<std::string_view> field_names()
{
    return mapped(fields, &FieldTraits::name);
}

std::vector<std::string_view> spectrum_field_names()
{
    std::vector<std::string_view> names = field_names();
    names.resize(std::size_t(Field::status) + 1);
    return names;
}

std::variant<std::uint8_t, std::uint16_t, std::uint32_t, double> fill_value(Field field)
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
    return std::numeric_limits<double>::quiet_NaN();
}

FieldValues not_computed(Field field, std::int64_t points)
{
    return std::visit(
        [&](auto value) { return FieldValues(std::vector(std::size_t(points), value)); },
        fill_value(field));
}

std::size_t bytes_per_point(Field field)
{
    return std::visit([](auto value) { return sizeof value; }, fill_value(field));
}

} // namespace overturn
