#include "formats.hpp"
#include "keyed_header.hpp"
#include "numbers.hpp"
#include "stated_numbers.hpp"
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

/// `PGA_CM/S^2: 0.300022`, DURATION_S and TIME_PGA_S, if the header states them
std::vector<StatedNumber> stated_numbers(const KeyedHeader& header)
{
    std::vector<StatedNumber> stated;
    if (const auto duration = header.find("DURATION_S:")) {
        stated.push_back({Stated::duration, duration->lines, "DURATION_S", duration->value});
    }
    if (const auto peak = header.find("PGA_")) {
        const std::size_t colon = std::min(peak->value.find(':'), peak->value.size());
        if (const auto unit = unit_named(trimmed(peak->value.substr(0, colon)))) {
            stated.push_back(
                {Stated::peak, peak->lines, "PGA", word_after(peak->value, ":"), unit});
        }
    }
    if (const auto time = header.find("TIME_PGA_S:")) {
        stated.push_back({Stated::time_of_peak, time->lines, "TIME_PGA_S", time->value});
    }
    return stated;
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
    const auto stream = header.find("STREAM:");
    RecordComponent component{.name = std::string(stream ? stream->value : ""),
                              .event = header.values_of({"EVENT_NAME:", "EVENT_DATE_YYYYMMDD:",
                                                         "EVENT_TIME_HHMMSS:", "STATION_CODE:"}),
                              .acceleration = take_free_numbers(lines, announced),
                              .unit = unit,
                              .time_step = time_step,
                              .is_uncorrected = is_uncorrected(header),
                              .header = header.kept()};
    compare(stated_numbers(header), component, lines, rounding_of(step.value));
    return {.format = "ESM", .components = {std::move(component)}};
}

} // namespace overturn
