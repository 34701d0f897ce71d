#include "topple_answer.hpp"

#include "one_point.hpp"
#include "output_lines.hpp"

#include "overturn/problem/plausibility.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/quoting.hpp"
#include "overturn/text/utf8.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>

namespace overturn {

namespace {

/// JSON has neither NaN nor infinity.
std::string json_of(double value)
{
    return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

/// A list of [first, last].
std::string json_of(const std::vector<std::pair<double, double>>& ranges)
{
    std::vector<std::string> list;
    for (const auto& [first, last] : ranges) {
        list.push_back(fmt::format("[{}, {}]", first, json_of(last)));
    }
    return fmt::format("[{}]", fmt::join(list, ", "));
}

std::string json_of(const RestitutionAnswer& answer)
{
    const VerdictRanges& ranges = answer.ranges;
    const double end = ranges.end_of_search();
    auto toppling = ranges.with(Verdict::topples);
    if (!toppling.empty() && toppling.back().second == end) {
        toppling.back().second = std::numeric_limits<double>::infinity(); // it may go on
    }
    const std::string coarse =
        ranges.coarse ? fmt::format("{{\"first\": {}, \"last\": {}, \"step\": {}}}",
                                    ranges.coarse->first, ranges.coarse->last, ranges.coarse->step)
                      : "null";
    return fmt::format(
        "\"restitution\": {}, \"restitution_of_maximum\": {}, "
        "\"toppling_pga\": {}, \"safe_pga\": {}, \"undecided_pga\": {}, "
        "\"undecided_share\": {}, \"end_of_search\": {}, \"coarse_search\": {}",
        answer.ratio, json_of(answer.share), json_of(toppling), json_of(ranges.with(Verdict::safe)),
        json_of(ranges.with(Verdict::undecided)), ranges.undecided_share(), end, coarse);
}

std::string json_of_motion(const Job& job, const ToppleOptions& options)
{
    if (job.motions.empty()) {
        const Scene& scene = job.problem.scene;
        std::string shape;
        for (const auto& [name, number] : shape_numbers) {
            if (has_number(scene.pulse, number)) {
                shape += fmt::format(", \"{}\": {}", name, scene.shape.*number);
            }
        }
        return fmt::format("{{\"pulse\": \"{}\", \"period\": {}{}}}", name_of(scene.pulse),
                           *options.period, shape);
    }
    const Motion& motion = job.motions.front();
    return fmt::format("{{\"record\": {}, \"component\": {}, \"second_component\": {}, "
                       "\"vertical\": {}, \"uncorrected\": {}}}",
                       quoted_utf8(motion.file), quoted_utf8(motion.component),
                       motion.second.empty() ? "null" : quoted_utf8(motion.second),
                       motion.vertical.empty() ? "null" : quoted_utf8(motion.vertical),
                       motion.is_uncorrected);
}

} // namespace

std::string quoted_utf8(const std::string& text)
{
    if (!is_utf8(text)) {
        throw Error(exit_code::usage, "{} is not UTF-8. Rename the file.", as_utf8(text));
    }
    return in_quotes(text);
}

void print_json(const Job& job, const ToppleOptions& options, const ToppleAnswer& answer)
{
    const auto alpha = slenderness_of_only_block(job);
    const auto if_requested = [&](double value) {
        return answer.verdict ? json_of(value) : "null";
    };
    const auto member = [](std::string_view name, const auto& value) {
        fmt::print("  \"{}\": {},\n", name, value);
    };
    const std::string warning = implausible_values(job.problem.scene, job.problem.grid);
    fmt::print("{{\n");
    std::vector<std::string> of_block;
    for (const auto& [name, value] : options.block) {
        of_block.push_back(fmt::format("\"{}\": {}", name, value));
    }
    member("block", fmt::format("{{{}}}", fmt::join(of_block, ", ")));
    member("motion", json_of_motion(job, options));
    member("direction", options.direction.value_or(0));
    member("theory", quoted_utf8(std::string(name_of(job.problem.scene.theory))));
    member("topples", answer.verdict == Verdict::topples ? "true"
                      : answer.verdict == Verdict::safe  ? "false"
                                                         : "null");
    member("pga", if_requested(answer.pga));
    member("peak_of_alpha", if_requested(answer.peak));
    member("peak_degrees",
           alpha ? if_requested(in_degrees(answer.peak * *alpha)) : std::string("null"));
    member("friction", answer.friction ? json_of(*answer.friction) : std::string("null"));
    member("lifts_off", answer.friction && std::isinf(*answer.friction) ? "true" : "false");
    if (alpha) {
        member("slenderness", *alpha);
    } else {
        member("slenderness_plus", extent_of(job, "slenderness_plus")->first);
        member("slenderness_minus", extent_of(job, "slenderness_minus")->first);
    }
    member("frequency_parameter", extent_of(job, "frequency_parameter")->first);
    if (!alpha) {
        member("frequency_parameter_minus", extent_of(job, "frequency_parameter_minus")->first);
    }
    std::vector<std::string> friction;
    for (const double each : answer.friction_to_topple) {
        friction.push_back(json_of(each));
    }
    member("friction_to_topple", fmt::format("[{}]", fmt::join(friction, ", ")));
    member("gravity", job.problem.scene.gravity);
    member("lifting_pga", json_of(answer.lifting_pga));
    member("pga_max", options.pga_max);
    member("narrower_ranges_exist", job.problem.scene.is_recorded() ? "true" : "null");
    member("warnings", fmt::format("[{}]", warning.empty() ? "" : quoted_utf8(warning)));
    fmt::print("  {},\n  \"by_restitution\": [", json_of(answer.by_restitution.front()));
    for (std::size_t i = 1; i < answer.by_restitution.size(); ++i) {
        fmt::print("{}\n    {{{}}}", i > 1 ? "," : "", json_of(answer.by_restitution[i]));
    }
    fmt::print("\n  ]\n}}\n");
}

} // namespace overturn
