// Whether one block topples under one motion, and at which peak accelerations. The job is made from
// the command line; everything is computed as by `run`, `boundary` and `history`.
#include "commands.hpp"
#include "guarded_reading.hpp"
#include "job_lines.hpp"
#include "only_point.hpp"
#include "output_lines.hpp"
#include "progress.hpp"
#include "verdict_ranges.hpp"

#include "overturn/file/sole_writer.hpp"
#include "overturn/file/study_files.hpp"
#include "overturn/problem/plausibility.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/quoting.hpp"
#include "overturn/text/utf8.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ranges>

namespace overturn {

namespace {

struct RestitutionAnswer {
    double share; ///< r / r_max; NaN if there is no r_max
    double ratio; ///< r
    VerdictRanges ranges;
};

struct ToppleAnswer {
    std::optional<Verdict> verdict; ///< nullopt if not requested
    double peak = 0;                ///< |theta| / alpha
    std::optional<double> friction; ///< see Field::friction; nullopt in the linear theory
    /// For each toppling range of the requested restitution: the largest friction from uplift to
    /// its lower end, NaN if one is unknown; empty in the linear theory.
    std::vector<double> friction_to_topple;
    double pga = 0; ///< of the requested point
    double lifting_pga = 0;
    std::vector<RestitutionAnswer> by_restitution; ///< the requested one first
};

/// The name of a file or component, or another text, as a string of TOML and JSON. Throws Error if
/// it is not UTF-8.
std::string quoted_utf8(const std::string& text)
{
    if (!is_utf8(text)) {
        throw Error(exit_code::usage, "{} is not UTF-8. Rename the file.", as_utf8(text));
    }
    return in_quotes(text);
}

/// The text of a job with a single point. If the command line gives no strength, its motion is 0.
std::string job_text(const ToppleOptions& options)
{
    const bool is_recorded = !options.record.empty();
    std::string text = "[scene]\n";
    text += is_recorded ? fmt::format("record = {}\n", quoted_utf8(options.record))
                        : fmt::format("pulse = {}\n", quoted_utf8(options.pulse));
    if (!options.component.empty()) {
        const bool is_number =
            options.component.find_first_not_of("0123456789") == std::string::npos &&
            !options.component.starts_with('0');
        text += fmt::format("component = {}\n",
                            is_number ? options.component : quoted_utf8(options.component));
    }
    text += "[plane]\n";
    text += options.scale || (is_recorded && !options.pga)
                ? fmt::format("scale = {}\n", options.scale.value_or(0))
                : fmt::format("pga = {}\n", options.pga.value_or(0));
    if (!is_recorded) {
        text += fmt::format("pulse_period = {}\n", *options.period);
    }
    text += options.restitution ? fmt::format("restitution = {}\n", *options.restitution)
                                : fmt::format("restitution_of_maximum = {}\n",
                                              options.restitution_of_maximum.value_or(1));
    if (options.direction) {
        text += fmt::format("direction = {}\n", *options.direction);
    }
    text += "[block]\n";
    for (const auto& [name, value] : options.block) {
        text += fmt::format("{} = {}\n", name, value);
    }
    return text;
}

/// What the parser of the command line does not check.
void expect_consistent(const ToppleOptions& options)
{
    const auto refuse_if = [](bool wrong, const char* message) {
        if (wrong) {
            throw Error(exit_code::usage, message);
        }
    };
    refuse_if(options.record.empty() && !options.period,
              "the ground motion is missing. Give --period with the period of a pulse [s], or "
              "--record with the file of a recorded motion.");
    for (const std::string& argument : options.overrides) {
        refuse_if(!argument.starts_with("scene.") || argument.starts_with("scene.pulse") ||
                      argument.starts_with("scene.record"),
                  "--set takes keys of [scene] here, such as scene.gravity. The other options give "
                  "the block and the motion.");
    }
    refuse_if(!options.history.empty() && !options.pga && !options.scale,
              "--history is that of one acceleration. Give --pga or --scale.");
}

/// See ToppleAnswer::friction_to_topple. unit: the peak acceleration of the strength 1.
std::vector<double> friction_to_topple(const Problem& of_one_point, const VerdictRanges& ranges,
                                       double unit)
{
    const Scene& scene = of_one_point.scene;
    const auto toppling = ranges.with(Verdict::topples);
    if (toppling.empty() || scene.theory != Theory::nonlinear) {
        return {};
    }
    // At the end itself, whether the block topples, and with it the friction, may be unknown.
    const std::vector<double> ends = mapped(toppling, [](const VerdictRange& range) {
        return range.first + std::min(1e-6 * range.first, (range.last - range.first) / 2);
    });
    std::vector<double> accelerations = ends;
    if (const double highest = accelerations.back(); ranges.lifting < highest) {
        const std::vector<double> scan = scanned_accelerations(scene, ranges.lifting, highest);
        accelerations.insert(accelerations.end(), scan.begin(), scan.end());
    }
    std::ranges::sort(accelerations);
    const auto [begin, end] = std::ranges::unique(accelerations);
    accelerations.erase(begin, end);
    const std::vector<double> strengths = mapped(accelerations, [&](double acceleration) {
        return scene.is_recorded() ? acceleration / unit : acceleration;
    });
    Problem problem = of_one_point;
    std::erase_if(problem.grid.numbers,
                  [](const Column& number) { return number.quantity->role == Role::strength; });
    const std::string strength = scene.is_recorded() ? "scale" : "pga";
    problem.grid.dimensions = {{strength, {{&quantity(strength), Axis(AxisList(strengths))}}}};
    const std::vector<double> friction = accurate_values(problem, Field::friction);
    std::vector<double> needed;
    double largest = 0; // NaN as soon as one is unknown
    for (std::size_t i = 0; i < accelerations.size(); ++i) {
        const bool is_covered = std::isnan(largest) || std::islessequal(friction[i], largest);
        largest = is_covered ? largest : friction[i];
        if (needed.size() < ends.size() && accelerations[i] == ends[needed.size()]) {
            needed.push_back(largest);
        }
    }
    return needed;
}

/// In the order of the enumerators of Verdict.
constexpr std::array<std::string_view, 3> verdict_texts{"does not topple", "topples", "undecided"};

ToppleAnswer answer_of(const Job& job, const ToppleOptions& options)
{
    ToppleAnswer answer;
    const Scene& scene = job.problem.scene;
    const Point point = only_point_of(job);
    const double unit = pga_of_unit(scene, point);
    if (!(unit > 0)) {
        throw Error(
            exit_code::job,
            "the record has no motion in the direction of {} degrees: its components cancel. "
            "Choose another --direction.",
            options.direction.value_or(0));
    }
    const double of_direction = std::signbit(point.amplitude) ? -1 : 1; // mirrored
    answer.pga = options.pga ? *options.pga : std::abs(point.amplitude) * unit;
    if (options.pga || options.scale) {
        answer.peak = accurate_values(job.problem, Field::peak).front();
        answer.verdict = std::isnan(answer.peak)   ? Verdict::undecided
                         : std::isinf(answer.peak) ? Verdict::topples
                                                   : Verdict::safe;
        if (scene.theory == Theory::nonlinear) {
            answer.friction = accurate_values(job.problem, Field::friction).front();
        }
    }
    answer.lifting_pga = lifting_pga(scene, point);
    const double requested = point.block.restitution;
    const auto r_max = r_max_of_only_block(job);
    std::vector<double> ratios{requested};
    if (r_max) {
        for (const double share : {0.8, 0.85, 0.9, 0.95, 1.0}) {
            ratios.push_back(share * *r_max);
        }
    }
    Progress progress(0, std::int64_t(ratios.size()), "restitutions");
    const auto show_progress = [&] {
        progress.update(std::int64_t(answer.by_restitution.size()));
        return false;
    };
    const double end = std::max(options.pga_max, answer.pga);
    for (const double ratio : ratios) {
        if (!answer.by_restitution.empty() && ratio == requested) {
            answer.by_restitution.push_back(answer.by_restitution.front());
            continue;
        }
        BoundaryLine line{.point = point, .unit = of_direction * unit};
        line.point.block.restitution = ratio;
        answer.by_restitution.push_back(
            {r_max ? ratio / *r_max : std::numeric_limits<double>::quiet_NaN(), ratio,
             verdict_ranges(scene, line, answer.lifting_pga, end, answer.pga, show_progress)});
    }
    answer.friction_to_topple =
        friction_to_topple(job.problem, answer.by_restitution.front().ranges, unit);
    return answer;
}

/// Such as "0.46 at 0.9034 g, 0.65 at 2.1296 g".
std::string friction_to_topple_text(const ToppleAnswer& answer, int decimals)
{
    constexpr std::size_t most = 3;
    const auto toppling = answer.by_restitution.front().ranges.with(Verdict::topples);
    std::vector<std::string> list;
    for (std::size_t i = 0; i < std::min(most, toppling.size()); ++i) {
        const double friction = answer.friction_to_topple[i];
        list.push_back(fmt::format("{} at {:.{}f} g",
                                   std::isnan(friction) ? "unknown"
                                   : std::isinf(friction)
                                       ? "infinite"
                                       : fmt::format("{:.2f}", rounded_up(friction, 2)),
                                   rounded_down(toppling[i].first, decimals), decimals));
    }
    return fmt::format("{}{}", fmt::join(list, ", "),
                       toppling.size() > most ? ", and so on (see --json)" : "");
}

std::string friction_text(double friction)
{
    return std::isnan(friction) ? "unknown"
           : std::isinf(friction)
               ? "the block would leave the ground, so that the verdict is doubtful"
               : fmt::format("the verdict holds if the coefficient is at least {:.2f}",
                             rounded_up(friction, 2));
}

/// The numbers that complete a pulse, each with its name in this format.
std::string shape_text(const Scene& scene, const char* format)
{
    std::string text;
    for (const auto& [name, number] : shape_numbers) {
        if (has_number(scene.pulse, number)) {
            text += fmt::format(fmt::runtime(format), name, scene.shape.*number);
        }
    }
    return text;
}

/// Dimensions that the command line gives, such as "0.55 m x 2.1 m, incline 1.5 degrees, ".
std::string dimensions_text(const std::map<std::string, double>& given)
{
    std::string text;
    if (given.contains("width") && given.contains("height")) {
        text = fmt::format("{} m x {} m, ", given.at("width"), given.at("height"));
    }
    for (const char* name : {"center_height", "center_offset", "radius_of_gyration"}) {
        if (given.contains(name)) {
            text += fmt::format("{} {} m, ", quantity(name).long_name, given.at(name));
        }
    }
    if (given.contains("incline")) {
        text += fmt::format("incline {:.4g} degrees, ", in_degrees(given.at("incline")));
    }
    return text;
}

void print_question(const Job& job, const ToppleOptions& options)
{
    const Scene& scene = job.problem.scene;
    print_row("block", dimensions_text(options.block) + block_line(job));
    const std::string motion = scene.is_recorded()
                                   ? record_lines(job).front()
                                   : fmt::format("{}, period {} s{}", name_of(scene.pulse),
                                                 *options.period, shape_text(scene, ", {} {}"));
    std::string direction;
    if (options.direction) {
        direction = fmt::format("; direction {} degrees", *options.direction);
    }
    if (scene.has_two_components()) {
        direction += fmt::format(", {:.3g} g", pga_of_unit(scene, only_point_of(job)));
    }
    print_row("motion", motion + direction);
    if (scene.theory != Theory::nonlinear) {
        print_row("theory", name_of(scene.theory));
    }
}

void print_answer(const Job& job, const ToppleOptions& options, const ToppleAnswer& answer)
{
    const auto alpha = slenderness_of_only_block(job);
    const RestitutionAnswer& requested = answer.by_restitution.front();
    const Scene& scene = job.problem.scene;
    const bool is_recorded = scene.is_recorded();
    const int decimals = requested.ranges.decimals(answer.pga);
    print_question(job, options);
    print_row(
        "restitution",
        std::isnan(requested.share)
            ? fmt::format("r = {:.4g}; r_max is not defined for so wide a block", requested.ratio)
        : requested.share == 1
            ? fmt::format("r = r_max = {:.4g}", requested.ratio)
            : fmt::format("r = {:.4g} = {:.4g} r_max", requested.ratio, requested.share));
    if (answer.verdict) {
        const std::string_view verdict = verdict_texts[std::size_t(*answer.verdict)];
        print_row("verdict", options.pga
                                 ? fmt::format("{} at {} g", verdict, *options.pga)
                                 : fmt::format("{} at {} times the record, {:.{}f} g", verdict,
                                               *options.scale, answer.pga, decimals));
        print_row("peak tilt", peak_text(answer.peak, alpha));
        if (answer.friction) {
            print_row("friction", friction_text(*answer.friction));
        }
    }
    print_row("lifts from", fmt::format("{:.4f} g", rounded_down(answer.lifting_pga, 4)));
    print_row("topples", requested.ranges.text(decimals, 20) +
                             (requested.ranges.ends_in_free_fall
                                  ? fmt::format("; at {:.6g} g the vertical motion cancels gravity",
                                                requested.ranges.end_of_search())
                                  : ""));
    if (!answer.friction_to_topple.empty()) {
        print_row("",
                  "friction coefficient to topple: " + friction_to_topple_text(answer, decimals));
    }
    if (answer.by_restitution.size() > 1) {
        fmt::print("\n{:>8}{:>9}   topples at a peak ground acceleration of\n", "r/r_max", "r");
    }
    for (std::size_t i = 1; i < answer.by_restitution.size(); ++i) {
        const RestitutionAnswer& other = answer.by_restitution[i];
        fmt::print("{:>8.2f}{:>9.4f}   {}\n", other.share, other.ratio,
                   other.ranges.text(other.ranges.decimals(answer.pga), 6));
    }
    if (is_recorded) {
        const double undecided = std::ranges::max(
            answer.by_restitution | std::views::transform([](const RestitutionAnswer& each) {
                return each.ranges.undecided_share();
            }));
        fmt::print("\nUnder a record, ranges narrower than the steps of {:.1g} % may be missed. {} "
                   "of the searched accelerations {} undecided.\n",
                   100 * toppling_step,
                   undecided > 0 ? fmt::format("Up to {:.2g} %", 100 * undecided) : "None",
                   undecided > 0 ? "are" : "is");
    }
}

/// JSON has neither NaN nor infinity.
std::string json_of(double value)
{
    return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

/// A list of [first, last].
std::string json_of(const std::vector<VerdictRange>& ranges)
{
    const auto list = mapped(ranges, [](const VerdictRange& range) {
        return fmt::format("[{}, {}]", range.first, json_of(range.last));
    });
    return fmt::format("[{}]", fmt::join(list, ", "));
}

std::string json_of(const RestitutionAnswer& answer)
{
    const VerdictRanges& ranges = answer.ranges;
    const double end = ranges.end_of_search();
    auto toppling = ranges.with(Verdict::topples);
    if (!toppling.empty() && toppling.back().last == end) {
        toppling.back().last = std::numeric_limits<double>::infinity(); // it may go on
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
        return fmt::format("{{\"pulse\": \"{}\", \"period\": {}{}}}", name_of(scene.pulse),
                           *options.period, shape_text(scene, ", \"{}\": {}"));
    }
    const Motion& motion = job.motions.front();
    return fmt::format("{{\"record\": {}, \"component\": {}, \"second_component\": {}, "
                       "\"vertical\": {}, \"uncorrected\": {}}}",
                       quoted_utf8(motion.file), quoted_utf8(motion.component),
                       motion.second.empty() ? "null" : quoted_utf8(motion.second),
                       motion.vertical.empty() ? "null" : quoted_utf8(motion.vertical),
                       motion.is_uncorrected);
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
    std::vector<std::string> warnings = remarks_on_records(job);
    if (std::string values = implausible_values(job.problem.scene, job.problem.grid);
        !values.empty()) {
        warnings.insert(warnings.begin(), std::move(values));
    }
    fmt::print("{{\n");
    const auto block = options.block | std::views::transform([](const auto& given) {
                           return fmt::format("\"{}\": {}", given.first, given.second);
                       });
    member("block", fmt::format("{{{}}}", fmt::join(block, ", ")));
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
    const auto friction = answer.friction_to_topple |
                          std::views::transform([](double each) { return json_of(each); });
    member("friction_to_topple", fmt::format("[{}]", fmt::join(friction, ", ")));
    member("gravity", job.problem.scene.gravity);
    member("lifting_pga", json_of(answer.lifting_pga));
    member("pga_max", options.pga_max);
    member("narrower_ranges_exist", job.problem.scene.is_recorded() ? "true" : "null");
    member("warnings",
           fmt::format("[{}]", fmt::join(warnings | std::views::transform(quoted_utf8), ", ")));
    fmt::print("  {},\n  \"by_restitution\": [", json_of(answer.by_restitution.front()));
    for (std::size_t i = 1; i < answer.by_restitution.size(); ++i) {
        fmt::print("{}\n    {{{}}}", i > 1 ? "," : "", json_of(answer.by_restitution[i]));
    }
    fmt::print("\n  ]\n}}\n");
}

void write_history(const Job& job, const std::string& path)
{
    const SoleWriter sole_writer(path);
    {
        const GuardedReading guarded(path, sole_writer.lock());
        expect_room_for(path, FileKind::history);
    }
    write_history_file(path, job, history_of_only_point(job));
}

} // namespace

int topple(const ToppleOptions& options)
{
    widest_kernel(); // throws if this processor supports none
    expect_consistent(options);
    const Job job = read_job_text(job_text(options), command_line, options.overrides);
    if (job.motions.size() > 1) {
        throw Error(exit_code::usage,
                    "--record matches {} files, but topple answers for one motion. "
                    "Give one file; for a suite, write a job for overturn run.",
                    job.motions.size());
    }
    if (!options.json) {
        warn_of_probable_mistakes(job);
    }
    if (!options.history.empty()) {
        write_history(job, options.history);
    }
    const ToppleAnswer answer = answer_of(job, options);
    (options.json ? print_json : print_answer)(job, options, answer);
    if (!options.history.empty() && !options.json) {
        fmt::print("\n{0}: written; draw it with tools/plot_history {0} --units physical\n",
                   options.history);
    }
    return exit_code::complete;
}

} // namespace overturn
