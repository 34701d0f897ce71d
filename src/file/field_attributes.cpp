#include "field_attributes.hpp"

#include "attributes.hpp"
#include "layout.hpp"

#include "overturn/sweep/boundary.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace overturn {

namespace {

using hdf5::write_attribute;

/// The attributes of a field. An empty text or list is left out.
struct Description {
    std::string long_name;
    const char* units;
    const char* comment = "";
    std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<std::uint32_t>>
        codes = {};
    std::string meanings = ""; ///< of the codes, in their order
};

Description description_of(Field field, const Job& job)
{
    const std::string regions = fmt::format("{}", fmt::join(region_names, " "));
    const std::vector<std::uint8_t> regions_or_none{0, 1, 2, 3, 4, 5, 6, 7, 8, no_flip, 254, 255};
    const std::string or_none = regions + " no_flip undecided not_computed";
    const bool is_recorded = job.scene.is_recorded();
    switch (field) {
    case Field::region:
        return {"region at the end of the ground motion", "",
                "S: safe within the separatrix; S+, S-: safe due to the loss at the next impact; "
                "U0: overturns without another impact; U1: overturns after one more impact; "
                "F: falls during the ground motion",
                std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 254, 255},
                regions + " undecided not_computed"};
    case Field::status:
        return {"flags set during the integration", "", "0: no flag is set; 255: not computed yet",
                std::vector<std::uint8_t>{status::came_to_rest, status::cap_was_hit,
                                          status::not_finite, status::unresolved,
                                          status::free_fall},
                "came_to_rest cap_was_hit not_finite unresolved free_fall"};
    case Field::impacts:
        return {"impacts during the ground motion", "1", "",
                std::vector<std::uint16_t>{impact_count::largest, impact_count::not_computed,
                                           impact_count::bounce_series},
                "this_many_or_more not_computed bounce_series"};
    case Field::angle: return {"angle at the end of the ground motion", "rad", "theta"};
    case Field::velocity:
        return {"velocity at the end of the ground motion", "rad", "d theta / d(p t)"};
    case Field::margin:
        return {"margin, positive where safe", "1", "distance from the other verdict"};
    case Field::error:
        return {"bound on the error of the margin", "1",
                "to first order; infinite where it is unknown: an impact or a fall may or may "
                "not have happened, or was only just avoided; a verdict is certain where |margin| "
                "is larger"};
    case Field::peak:
        return {"largest |theta| / alpha", "1",
                "during the ground motion and after it; infinite where the block overturns"};
    case Field::fall_time:
        return {"time p t from uplift to |theta| = pi/2", "1",
                "infinite where the block does not overturn"};
    case Field::steps:
        return {"integration steps tried", "1", "",
                std::vector<std::uint32_t>{step_count::not_computed}, "not_computed"};
    case Field::flip_amplitude:
        return {
            fmt::format("{} at which the verdict flips", is_recorded ? "scale" : "amplitude"), "1",
            is_recorded
                ? "in ascending order; NaN beyond the last flip. Each flip lies between two "
                  "amplitudes with settled verdicts, at most `width` "
                  "apart relative to their size. If region_below or region_above is undecided, the "
                  "value is not a flip but the settled amplitude next to the undecided range. The "
                  "steps of the scan were divided evenly until each was at most `finest_step` of "
                  "the amplitude. Narrower strips exist and are missed"
                : "in ascending order; NaN beyond the last flip. Each flip lies between two "
                  "amplitudes with settled verdicts, at most `width` "
                  "apart relative to their size. If region_below or region_above is undecided, the "
                  "value is not a flip but the settled amplitude next to the undecided range. "
                  "Between neighbours of the scan the steps were halved where the margin is not "
                  "linear or the number of impacts changes, down to `finest_step` of the "
                  "amplitude. Strips that are narrower, or that the neighbouring amplitudes do not "
                  "indicate, may be missed"};
    case Field::flip_pga: return {"PGA at which the verdict flips, over g", "1"};
    case Field::region_below:
        return {
            "region just below the flip", "",
            "if there is no flip, the first entry along `crossing` has the region at the first "
            "amplitude of the scan. A first flip above a safe region is the minimum overturning "
            "amplitude. If the first entry has an unsafe region below, the block overturns at the "
            "first amplitude of the job",
            regions_or_none, or_none};
    case Field::region_above:
        return {"region just above the flip", "",
                "undecided: verdicts could not be settled up to the next flip, or this is the last "
                "stored flip and there are more",
                regions_or_none, or_none};
    case Field::unsafe_share:
        return {"share of amplitudes that overturn", "1",
                "share of the scanned interval. Under a record, smaller steps find more flips; "
                "this share hardly depends on the "
                "step. Flips beyond the last stored flip are included"};
    case Field::evaluated:
        return {"whether the point was integrated", "",
                "filled: all nodes of a cell around the point have its region, and none of the "
                "functions that change it is near zero; by numerical evidence, not by proof",
                std::vector<std::uint8_t>{point_origin::filled, point_origin::integrated,
                                          point_origin::not_computed},
                "filled integrated not_computed"};
    case Field::undecided_share:
        return {"share of amplitudes without verdict", "1",
                "share of the scanned interval in which the verdict could not be settled"};
    }
    return {};
}

} // namespace

void write_field_attributes(hid_t dataset, Field field, const Job& job,
                            const std::string& coordinates)
{
    const Description description = description_of(field, job);
    write_attribute(dataset, "long_name", description.long_name);
    write_attribute(dataset, "units", description.units);
    // Readers interpret NaN as missing, so it can be declared; a fill value declared on an integer
    // field would make them convert codes to floats.
    const auto fill = layout::stored_as(field).fill;
    if (const auto* not_a_number = std::get_if<double>(&fill)) {
        write_attribute(dataset, "_FillValue", *not_a_number);
    }
    if (field == Field::flip_amplitude) {
        const SearchResolution resolution = search_resolution(job.scene);
        write_attribute(dataset, "width", resolution.flip_width);
        write_attribute(dataset, "finest_step", resolution.finest_step);
    }
    std::visit(
        [&](const auto& codes) {
            if (!codes.empty()) {
                write_attribute(dataset, field == Field::status ? "flag_masks" : "flag_values",
                                codes);
            }
        },
        description.codes);
    write_attribute(dataset, "flag_meanings", description.meanings);
    write_attribute(dataset, "comment", description.comment);
    write_attribute(dataset, "coordinates", coordinates);
}

} // namespace overturn
