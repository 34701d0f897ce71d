#include "field_attributes.hpp"

#include "attributes.hpp"
#include "layout.hpp"

#include "overturn/sweep/boundary.hpp"

#include <fmt/format.h>

#include <limits>

namespace overturn {

namespace {

using hdf5::write_attribute;

void describe_region(hid_t dataset)
{
    write_attribute(dataset, "long_name", "region of the block's state at the end of the pulse");
    write_attribute(dataset, "flag_values",
                    std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 254, 255});
    write_attribute(dataset, "flag_meanings",
                    fmt::format("{} undecided not_computed", fmt::join(region_names, " ")));
    write_attribute(
        dataset, "comment",
        "S safe within the separatrix, S_plus and S_minus safe thanks to the loss at the "
        "first impact, U0 overturns without impact, U1 overturns after one impact, "
        "F overturned during the pulse");
}

void describe_region_beside_flip(hid_t dataset, const char* long_name, const char* comment)
{
    write_attribute(dataset, "long_name", long_name);
    write_attribute(dataset, "flag_values",
                    std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, no_flip, 254, 255});
    write_attribute(dataset, "flag_meanings",
                    fmt::format("{} no_flip undecided not_computed", fmt::join(region_names, " ")));
    write_attribute(dataset, "comment", comment);
}

void describe_status(hid_t dataset)
{
    write_attribute(dataset, "long_name", "incidents on the way to the end of the pulse");
    write_attribute(dataset, "flag_masks",
                    std::vector<std::uint8_t>{status::came_to_rest, status::cap_was_hit,
                                              status::not_finite, status::unresolved});
    write_attribute(dataset, "flag_meanings", "came_to_rest cap_was_hit not_finite unresolved");
    write_attribute(dataset, "comment", "0 is a point without incident, 255 one not computed yet");
}

void describe_impacts(hid_t dataset)
{
    write_attribute(dataset, "long_name", "number of impacts during the pulse");
    write_attribute(dataset, "units", "1");
    write_attribute(dataset, "flag_values",
                    std::vector<std::uint16_t>{impact_count::largest, impact_count::not_computed,
                                               impact_count::bounce_series});
    write_attribute(dataset, "flag_meanings", "this_many_or_more not_computed bounce_series");
}

void describe_steps(hid_t dataset)
{
    write_attribute(dataset, "long_name", "integration steps tried");
    write_attribute(dataset, "units", "1");
    write_attribute(dataset, "flag_values", std::vector<std::uint32_t>{step_count::not_computed});
    write_attribute(dataset, "flag_meanings", "not_computed");
}

/// NaN is what readers take for missing, so it can be declared; on the integer fields a declared
/// fill value would turn codes into floats.
void describe_number(hid_t dataset, const char* long_name, const char* units)
{
    write_attribute(dataset, "long_name", long_name);
    write_attribute(dataset, "units", units);
    write_attribute(dataset, "_FillValue", std::numeric_limits<double>::quiet_NaN());
}

} // namespace

void write_field_attributes(hid_t dataset, Field field, const std::string& coordinates)
{
    switch (field) {
    case Field::region: describe_region(dataset); break;
    case Field::status: describe_status(dataset); break;
    case Field::impacts: describe_impacts(dataset); break;
    case Field::angle:
        describe_number(dataset, "angle theta of the block at the end of the pulse", "rad");
        break;
    case Field::velocity:
        describe_number(dataset, "d theta / d(p t) at the end of the pulse", "rad");
        break;
    case Field::margin:
        describe_number(dataset, "distance of the verdict from flipping, positive where safe", "1");
        break;
    case Field::error:
        describe_number(dataset, "bound of the error of the margin", "1");
        write_attribute(
            dataset, "comment",
            "to first order; infinite where it is not known: an impact or a fall may or "
            "may not have happened, or was close; a verdict holds where the margin is "
            "larger");
        break;
    case Field::peak:
        describe_number(dataset, "largest |theta| / alpha, during the pulse and after it", "1");
        write_attribute(dataset, "comment", "infinite where the block overturns");
        break;
    case Field::fall_time:
        describe_number(dataset, "p t from the first uplift to |theta| = pi/2", "1");
        write_attribute(dataset, "comment", "infinite where the block does not overturn");
        break;
    case Field::steps: describe_steps(dataset); break;
    case Field::flip_amplitude:
        describe_number(dataset,
                        "amplitude at which the verdict flips, in ascending order; not a number "
                        "beyond the last flip",
                        "1");
        write_attribute(dataset, "width", flip_width);
        write_attribute(dataset, "finest_step", finest_step);
        write_attribute(
            dataset, "comment",
            "two amplitudes at most `width` of themselves apart, with settled verdicts, are on "
            "either side. Where a region beside it is undecided, it is the last amplitude that was "
            "settled, and no flip. Between neighbours of scan_amplitude the steps were halved "
            "where margins "
            "bend or impacts change, down to `finest_step` of the amplitude. Missed can be thinner "
            "strips, and strips between two neighbours of which neither tells");
        break;
    case Field::region_below:
        describe_region_beside_flip(
            dataset, "region just below the flip",
            "where there is no flip: of the first crossing, the region at the first of "
            "scan_amplitude. A first flip from a safe region is the minimum overturning amplitude; "
            "where the first crossing has an unsafe region below, the block overturns at the first "
            "amplitude looked at");
        break;
    case Field::region_above:
        describe_region_beside_flip(
            dataset, "region just above the flip",
            "undecided: up to the next flip verdicts could not be settled; or it is the last "
            "crossing, and there are more");
        break;
    }
    write_attribute(dataset, "coordinates", coordinates);
}

} // namespace overturn
