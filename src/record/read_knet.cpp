#include "formats.hpp"
#include "keyed_header.hpp"
#include "numbers.hpp"
#include "stated_numbers.hpp"
#include "stated_unit.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace overturn {

namespace {

/// The number of `100Hz`.
double samples_per_second(const KeyedHeader::Entry& entry)
{
    const bool has_unit = lower(entry.value).ends_with("hz");
    return sampling_rate_of(
        entry.lines, trimmed(entry.value.substr(0, entry.value.size() - (has_unit ? 2 : 0))));
}

/// [1]
Announcement announcement(const KeyedHeader& header, double rate)
{
    const KeyedHeader::Entry duration = header.required("Duration Time(s)");
    const double count = number_of(duration.lines, duration.value) * rate;
    if (!(count > 0.5 && count <= double(most_samples))) {
        duration.lines.refuse("{} s at {} Hz are {} samples, but must be from 1 to {}. Correct it, "
                              "or give another record.",
                              duration.value, rate, count, most_samples);
    }
    return {.count = std::size_t(std::lround(count)),
            .name = "the product of Duration Time(s) and Sampling Freq(Hz)",
            .line = duration.lines.number()};
}

/// `7845(gal)/8223790`
struct ScaleFactor {
    double acceleration; ///< [gal]
    double counts;       ///< of this acceleration
};

ScaleFactor scale_factor(const KeyedHeader::Entry& entry)
{
    constexpr std::string_view unit = "(gal)";
    const std::string_view text = entry.value;
    const std::size_t after = place_after(text, unit);
    const std::string_view rest = after == text.npos ? "" : trimmed(text.substr(after));
    if (!rest.starts_with('/')) {
        entry.lines.refuse("the scale factor is {}, but must be gal over counts, as in "
                           "7845(gal)/8223790. Give the file as it was published.",
                           quoted_bytes(text));
    }
    const ScaleFactor factor{
        .acceleration = number_of(entry.lines, trimmed(text.substr(0, after - unit.size()))),
        .counts = number_of(entry.lines, trimmed(rest.substr(1)))};
    if (!(factor.acceleration > 0 && factor.counts > 0)) {
        entry.lines.refuse("both numbers of the scale factor {} must be above 0. Correct them.",
                           quoted_bytes(text));
    }
    return factor;
}

/// `Max. Acc. (gal)   6.847`, if the header states it in a unit that is understood
std::vector<StatedNumber> stated_peak(const KeyedHeader& header)
{
    const auto peak = header.find("Max. Acc.");
    const std::string_view text = peak ? peak->value : "";
    const std::string_view before = text.substr(0, text.find(')'));
    const auto unit = unit_named(trimmed(before.substr(before.find('(') + 1)));
    if (!unit) {
        return {};
    }
    return {{Stated::peak, peak->lines, "Max. Acc.", word_after(text, ")"), unit}};
}

} // namespace

RecordFile read_knet(Lines lines, const RecordOptions&)
{
    KeyedHeader header(lines);
    const double rate = samples_per_second(header.required("Sampling Freq(Hz)"));
    const KeyedHeader::Entry scale = header.required("Scale Factor");
    const ScaleFactor factor = scale_factor(scale);
    const Announcement announced = announcement(header, rate);
    const std::string_view direction = header.required("Dir.").value;
    // Directions 1 to 6 of KiK-net: those of the borehole, then those of the surface.
    constexpr std::array<std::string_view, 6> names{"NS1", "EW1", "UD1", "NS2", "EW2", "UD2"};
    const std::size_t number =
        direction.size() == 1 ? std::size_t(direction[0] - '1') : names.size();
    const bool of_kiknet = number < names.size();
    RecordComponent component{
        .name = std::string(of_kiknet ? names[number] : direction),
        .event = header.values_of({"Origin Time", "Station Code"}),
        .acceleration = acceleration_of_counts(scale.lines, take_free_numbers(lines, announced),
                                               factor.acceleration, factor.counts),
        .unit = AccelerationUnit::gal,
        .time_step = 1 / rate,
        .is_uncorrected = true,
        .header = header.kept()};
    compare(stated_peak(header), component, lines, 0);
    return {.format = of_kiknet ? "KiK-net" : "K-NET", .components = {std::move(component)}};
}

} // namespace overturn
