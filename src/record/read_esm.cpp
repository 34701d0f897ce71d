#include "formats.hpp"
#include "keyed_header.hpp"
#include "numbers.hpp"
#include "stated_unit.hpp"

#include <fmt/ranges.h>

#include <utility>

namespace overturn {

namespace {

void expect_acceleration(const KeyedHeader& header)
{
    const auto kind = header.find("DATA_TYPE:");
    if (kind && lower(kind->value) != "acceleration") {
        kind->lines.refuse("{} is not ACCELERATION. Give the file of the acceleration (.ACC.).",
                           quoted_bytes(trimmed(kind->lines.line())));
    }
}

AccelerationUnit unit_of(const KeyedHeader& header)
{
    const KeyedHeader::Entry entry = header.required("UNITS:");
    const auto stated = stated_units(entry.lines.line(), UnitPlaces::after_units);
    if (stated.size() != 1 || !stated.front().unit) {
        entry.lines.refuse("the unit {} is not understood. Understood are {} and their usual "
                           "spellings, such as cm/s^2. Give the file of the acceleration (.ACC.).",
                           quoted_bytes(entry.value), fmt::join(acceleration_unit_names, ", "));
    }
    return *stated.front().unit;
}

/// Whether the header says that the record was not processed.
bool is_uncorrected(const KeyedHeader& header)
{
    const auto processing = header.find("PROCESSING:");
    const std::string how = processing ? lower(processing->value) : "";
    return how.empty() || how == "none" || how == "no" || contains(how, "unprocessed") ||
           contains(how, "uncorrected");
}

} // namespace

RecordFile read_esm(Lines lines)
{
    KeyedHeader header(lines);
    expect_acceleration(header);
    const AccelerationUnit unit = unit_of(header);
    const KeyedHeader::Entry count = header.required("NDATA:");
    const Announcement announced{.count = count_of(count.lines, count.value, "NDATA"),
                                 .name = "NDATA",
                                 .line = count.lines.number()};
    const KeyedHeader::Entry step = header.required("SAMPLING_INTERVAL_S:");
    const double time_step = time_step_of(step.lines, step.value);
    if (const auto duration = header.find("DURATION_S:"); duration && !duration->value.empty()) {
        expect_duration(duration->lines, number_of(duration->lines, duration->value),
                        {announced.count, time_step});
    }
    const auto stream = header.find("STREAM:");
    const bool is_raw = is_uncorrected(header);
    RecordComponent component{.name = std::string(stream ? stream->value : ""),
                              .acceleration = take_free_numbers(lines, announced),
                              .unit = unit,
                              .time_step = time_step,
                              .is_uncorrected = is_raw,
                              .header = std::move(header).kept()};
    return {.format = "ESM", .components = {std::move(component)}};
}

} // namespace overturn
