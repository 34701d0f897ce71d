#include "varied_answer.hpp"

#include "job.hpp"
#include "print.hpp"
#include "topple_answer.hpp"
#include "topple_ranges.hpp"

#include "overturn/text/mapped.hpp"

#include <fmt/format.h>

namespace overturn {

namespace {

/// Such as " m"; empty without units.
std::string unit_of(const Quantity& quantity)
{
    const std::string unit = quantity.printed_units();
    return unit.empty() ? "" : " " + unit;
}

std::string strength_text(const ToppleOptions& options)
{
    return options.scale ? fmt::format("{} times the record", *options.scale)
                         : fmt::format("{} g", *options.pga);
}

std::string steps_text(const Scene& scene, const VariedQuantity& vary)
{
    return fmt::format("searched in steps of {:.4g}{}{}; narrower ranges may be missed",
                       step_of_search(scene, vary), unit_of(*vary.quantity),
                       scene.motion_traits().is_sensitive
                           ? ""
                           : ", halved where the motion indicates more changes");
}

} // namespace

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

std::string sentence_of(const VerdictRanges& ranges, const ToppleOptions& options)
{
    const VariedQuantity& vary = *options.vary;
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
        return fmt::format("topples at {} at all values of {}", strength_text(options),
                           quantity->name);
    } else {
        return fmt::format("neither the first nor the last {} is safe at {}", quantity->name,
                           strength_text(options));
    }
    // Under a record, narrow ranges are common.
    return fmt::format("{} at {} {}",
                       options.record.empty() ? "nothing topples" : "nothing is found to topple",
                       strength_text(options), where);
}

void print_varied(const std::vector<DirectedRanges>& all, const ToppleOptions& options)
{
    const Problem& problem = all.front().job.problem;
    const VariedQuantity& vary = *options.vary;
    const auto text = [&](const VerdictRanges& ranges) {
        return text_of(ranges, decimals_of(ranges, vary.first), most_intervals,
                       unit_of(*vary.quantity));
    };
    print_block_and_motion(all.front().job, options, all.size());
    if (vary.quantity->role != Role::loss) {
        const double share = options.restitution_of_maximum.value_or(1);
        print_row("restitution",
                  options.restitution || options.velocity_restitution
                      ? fmt::format("r = {:.4g}", extent_of(all.front().job, "restitution")->first)
                  : share == 1 ? "r = r_max"
                               : fmt::format("r = {:.4g} r_max", share));
    }
    const VerdictRanges worst = worst_of(all);
    print_row("verdict", sentence_of(worst, options));
    print_row("topples", text(worst));
    for (const DirectedRanges& each : all.size() > 1 ? all : std::vector<DirectedRanges>()) {
        print_row("", fmt::format("in direction {}: {}", each.direction, text(each.ranges)));
    }
    print_row("", steps_text(problem.scene, vary));
}

} // namespace overturn
