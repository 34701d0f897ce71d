#include "overturn/answers/ranges_text.hpp"
#include "overturn/answers/topple.hpp"
#include "overturn/text/mapped.hpp"

#include <fmt/format.h>

namespace overturn {

namespace {

std::string strength_text(const ToppleRequest& request)
{
    return request.scale ? fmt::format("{} times the record", *request.scale)
                         : fmt::format("{} g", *request.pga);
}

} // namespace

std::string unit_of(const Quantity& quantity)
{
    const std::string unit = quantity.printed_units();
    return unit.empty() ? "" : " " + unit;
}

double step_of_search(const Scene& scene, const VariedQuantity& vary)
{
    return (vary.last - vary.first) * (scene.motion_traits().is_sensitive
                                           ? flip_search(scene).finest_step
                                           : widest_step_of_range);
}

VerdictRanges worst_of(const std::vector<DirectedRanges>& all)
{
    return worst_of(mapped(all, &DirectedRanges::ranges));
}

std::string sentence_of(const VerdictRanges& ranges, const ToppleRequest& request)
{
    const VariedQuantity& vary = *request.vary;
    const Quantity* const quantity = vary.quantity;
    const int decimals = decimals_of(ranges, vary.first);
    const auto value = [&](double number) {
        return fmt::format("{:.{}f}{}", number, decimals, unit_of(*vary.quantity));
    };
    const auto from = ranges.safe_from();
    const auto up_to = ranges.safe_up_to();
    std::string where;
    if (up_to == vary.last) {
        where = fmt::format("at all values of {}", quantity->name);
    } else if (from && up_to) {
        where =
            fmt::format("up to {} = {}, and from {} on", quantity->name,
                        value(rounded_down(*up_to, decimals)), value(rounded_up(*from, decimals)));
    } else if (from) {
        where = fmt::format("from {} = {} on", quantity->name, value(rounded_up(*from, decimals)));
    } else if (up_to) {
        where = fmt::format("up to {} = {}", quantity->name, value(rounded_down(*up_to, decimals)));
    } else if (ranges.all.size() == 1 && ranges.all.front().verdict == Verdict::topples) {
        return fmt::format("topples at {} at all values of {}", strength_text(request),
                           quantity->name);
    } else {
        return fmt::format("neither the first nor the last {} is safe at {}", quantity->name,
                           strength_text(request));
    }
    // Under a record, narrow ranges are common.
    return fmt::format("{} at {} {}",
                       request.record.empty() ? "nothing topples" : "nothing is found to topple",
                       strength_text(request), where);
}

} // namespace overturn
