#include "formats.hpp"
#include "keyed_header.hpp"
#include "numbers.hpp"
#include "stated_unit.hpp"

#include <utility>

namespace overturn {

namespace {

/// Whether the header says that the record was not processed.
bool is_uncorrected(const KeyedHeader& header)
{
    const auto processing = header.find("PROCESSING:");
    const std::string how = processing ? lower(processing->value) : "";
    return how.empty() || how == "none" || how == "no" || contains(how, "unprocessed") ||
           contains(how, "uncorrected");
}

} // namespace

RecordFile read_esm(Lines lines, const RecordOptions&)
{
    KeyedHeader header(lines);
    if (const auto kind = header.find("DATA_TYPE:"); kind && lower(kind->value) != "acceleration") {
        refuse_motion(kind->lines);
    }
    const KeyedHeader::Entry units = header.required("UNITS:");
    const AccelerationUnit unit = unit_of_samples(units.lines, units.value);
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
                              .header = header.kept()};
    return {.format = "ESM", .components = {std::move(component)}};
}

} // namespace overturn
