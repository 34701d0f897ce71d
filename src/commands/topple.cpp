// Whether one block topples under one motion, and at which peak accelerations. The job is made from
// the command line; everything is computed as by `run`, `boundary` and `history`.
#include "commands.hpp"
#include "guarded_reading.hpp"
#include "job_lines.hpp"
#include "only_point.hpp"
#include "output_lines.hpp"
#include "progress.hpp"
#include "toppling.hpp"
#include "verdict_text.hpp"

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
#include <cmath>
#include <limits>
#include <ranges>

namespace overturn {

namespace {

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

/// The job of each direction that is computed.
std::vector<Job> jobs_of(ToppleOptions options)
{
    const auto job = [&] {
        return read_job_text(job_text(options), command_line, options.overrides);
    };
    std::vector<Job> jobs{job()};
    const std::vector<double> directions = directions_of(jobs.front().problem);
    if (directions.size() > 1) {
        jobs.clear();
        for (const double direction : directions) {
            options.direction = direction;
            jobs.push_back(job());
        }
    }
    return jobs;
}

/// A direction that is computed, and the answer for it.
struct DirectedAnswer {
    Job job;
    std::optional<History> history; ///< if the options ask for it
    ToppleAnswer answer;
};

/// The answers for all directions, the worst one first. Histories, which may be refused, are
/// computed before the answers, which may take minutes.
std::vector<DirectedAnswer> answers_for(std::vector<Job> jobs, const ToppleOptions& options)
{
    std::optional<Progress> progress;
    std::vector<DirectedAnswer> all;
    for (Job& job : jobs) {
        auto history =
            options.history.empty() ? std::nullopt : std::optional(history_of_only_point(job));
        all.push_back({std::move(job), std::move(history), {}});
    }
    std::size_t answered = 0;
    ToppleQuestion question{options.pga || options.scale, options.pga, options.pga_max};
    question.progress = [&](std::size_t done, std::size_t restitutions) {
        if (!progress) {
            progress.emplace(0, std::int64_t(all.size() * restitutions), "restitutions");
        }
        progress->update(std::int64_t(answered * restitutions + done));
    };
    for (DirectedAnswer& each : all) {
        each.answer = answer_of(each.job.problem, question);
        ++answered;
    }
    std::ranges::stable_sort(all, is_worse, &DirectedAnswer::answer);
    return all;
}

/// Such as "0.46 at 0.9034 g, 0.65 at 2.1296 g".
std::string friction_to_topple_text(const ToppleAnswer& answer, int decimals)
{
    constexpr std::size_t most = 3;
    const auto toppling = answer.requested().ranges.with(Verdict::topples);
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

/// Dimensions that the command line gives, such as "0.55 m x 2.1 m, height of the centre of mass 1
/// m, ".
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
    return text;
}

void print_question(const std::vector<DirectedAnswer>& all, const ToppleOptions& options)
{
    const Job& job = all.front().job;
    const Scene& scene = job.problem.scene;
    print_row("block", dimensions_text(options.block) + block_line(job));
    const std::string motion = scene.is_recorded()
                                   ? record_lines(job).front()
                                   : fmt::format("{}, period {} s{}", name_of(scene.pulse),
                                                 *options.period, shape_text(scene, ", {} {}"));
    std::string direction;
    if (all.size() > 1) {
        direction = "; directions 0 and 180 degrees, its mirror image";
    } else if (options.direction) {
        direction = fmt::format("; direction {} degrees", *options.direction);
    }
    if (scene.has_two_components()) {
        direction += fmt::format(", {:.3g} g", all.front().answer.unit);
    }
    print_row("motion", motion + direction);
    print_motion_of("", scene.motion_of);
    if (scene.theory != Scene().theory) {
        print_row("theory", name_of(scene.theory));
    }
    const RestitutionAnswer& requested = all.front().answer.requested();
    print_row(
        "restitution",
        std::isnan(requested.share)
            ? fmt::format("r = {:.4g}; r_max is not defined for so wide a block", requested.ratio)
        : requested.share == 1
            ? fmt::format("r = r_max = {:.4g}", requested.ratio)
            : fmt::format("r = {:.4g} = {:.4g} r_max", requested.ratio, requested.share));
}

/// The sentences of the verdict for every direction.
std::vector<std::string> verdicts_of(const std::vector<DirectedAnswer>& all,
                                     const ToppleOptions& options)
{
    std::vector<std::string> sentences;
    for (const auto& [job, history, answer] : all) {
        std::string place;
        if (all.size() > 1) {
            place = fmt::format(" in direction {}", answer.direction);
            place += sentences.empty() ? fmt::format(", worse than {}", all.back().answer.direction)
                                       : "";
        }
        if (answer.verdict) {
            sentences.push_back(verdict_sentence(answer, options.scale, place));
        }
    }
    return sentences;
}

void print_ranges(const Scene& scene, const ToppleAnswer& answer)
{
    const VerdictRanges& requested = answer.requested().ranges;
    const int decimals = requested.decimals(answer.pga);
    print_row("lifts from", fmt::format("{:.4f} g", rounded_down(answer.lifting_pga, 4)));
    print_row("topples", requested.text(decimals) +
                             (requested.ends_in_free_fall
                                  ? fmt::format("; at {:.6g} g the vertical motion cancels gravity",
                                                requested.end_of_search())
                                  : ""));
    if (!answer.friction_to_topple.empty()) {
        print_row("",
                  "friction coefficient to topple: " + friction_to_topple_text(answer, decimals));
    }
    if (answer.by_restitution.size() > 1) {
        fmt::print("\n{:>8}{:>9}   {}\n", "r/r_max", "r",
                   scene.worded("topples at a peak ground acceleration of"));
    }
    for (std::size_t i = 1; i < answer.by_restitution.size(); ++i) {
        const RestitutionAnswer& other = answer.by_restitution[i];
        fmt::print("{:>8.2f}{:>9.4f}   {}\n", other.share, other.ratio,
                   other.ranges.text(other.ranges.decimals(answer.pga)));
    }
}

void print_answer(const std::vector<DirectedAnswer>& all, const ToppleOptions& options)
{
    print_question(all, options);
    std::string_view name = "verdict";
    for (const std::string& sentence : verdicts_of(all, options)) {
        print_row(name, sentence);
        name = "";
    }
    for (const auto& [job, history, answer] : all) {
        if (all.size() > 1) {
            fmt::print("\n");
            print_row("direction", fmt::format("{} degrees", answer.direction));
        }
        if (answer.verdict) {
            print_row("peak tilt", peak_text(answer.peak, slenderness_of_only_block(job)));
        }
        if (answer.friction) {
            print_row("friction", job.problem.scene.worded(friction_text(*answer.friction)));
        }
        print_ranges(job.problem.scene, answer);
    }
    if (all.front().job.problem.scene.is_recorded()) {
        double undecided = 0;
        for (const auto& [job, history, answer] : all) {
            undecided = std::max(undecided, undecided_share(answer));
        }
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

/// The toppling ranges as in the text, not rounded.
std::string json_of_intervals(const VerdictRanges& ranges)
{
    const auto list = mapped(
        ranges.intervals(Verdict::topples, VerdictRanges::most_shown),
        [&](const VerdictInterval& interval) {
            const bool may_go_on = interval.last == ranges.end_of_search();
            return fmt::format("{{\"first\": {}, \"last\": {}, \"share\": {}}}", interval.first,
                               may_go_on ? "null" : json_of(interval.last), interval.share);
        });
    return fmt::format("[{}]", fmt::join(list, ", "));
}

/// pga: the asked acceleration, if any.
std::string json_of(const RestitutionAnswer& answer, const std::optional<double>& pga)
{
    const VerdictRanges& ranges = answer.ranges;
    const auto if_found = [](const std::optional<double>& found) {
        return found ? json_of(*found) : "null";
    };
    const double end = ranges.end_of_search();
    auto toppling = ranges.with(Verdict::topples);
    if (!toppling.empty() && toppling.back().last == end) {
        toppling.back().last = std::numeric_limits<double>::infinity(); // it may go on
    }
    const std::string coarse =
        ranges.coarse ? fmt::format("{{\"first\": {}, \"last\": {}, \"step\": {}}}",
                                    ranges.coarse->first, ranges.coarse->last, ranges.coarse->step)
                      : "null";
    return fmt::format("\"restitution\": {}, \"restitution_of_maximum\": {}, "
                       "\"toppling_pga_below\": {}, \"toppling_pga_above\": {}, "
                       "\"toppling_pga\": {}, \"safe_pga\": {}, \"undecided_pga\": {}, "
                       "\"toppling_intervals\": {}, \"undecided_share\": {}, \"end_of_search\": "
                       "{}, \"coarse_search\": {}",
                       answer.ratio, json_of(answer.share),
                       if_found(pga ? ranges.nearest_below(Verdict::topples, *pga) : std::nullopt),
                       if_found(pga ? ranges.nearest_above(Verdict::topples, *pga) : std::nullopt),
                       json_of(toppling), json_of(ranges.with(Verdict::safe)),
                       json_of(ranges.with(Verdict::undecided)), json_of_intervals(ranges),
                       ranges.undecided_share(), end, coarse);
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

using JsonMembers = std::vector<std::string>;

void add(JsonMembers& members, std::string_view name, const auto& value)
{
    members.push_back(fmt::format("\"{}\": {}", name, value));
}

/// What depends on the direction. verdict: the sentence; empty if no strength is asked for.
JsonMembers json_members_of(const DirectedAnswer& directed, const std::string& verdict)
{
    const auto& [job, history, answer] = directed;
    const auto alpha = slenderness_of_only_block(job);
    const auto pga = answer.verdict ? std::optional(answer.pga) : std::nullopt;
    const auto if_requested = [&](double value) { return pga ? json_of(value) : "null"; };
    JsonMembers members;
    add(members, "direction", answer.direction);
    add(members, "verdict", pga ? in_quotes(verdict) : "null");
    add(members, "topples",
        answer.verdict == Verdict::topples ? "true"
        : answer.verdict == Verdict::safe  ? "false"
                                           : "null");
    add(members, "pga", if_requested(answer.pga));
    add(members, "peak_of_alpha", if_requested(answer.peak));
    add(members, "peak_degrees",
        alpha ? if_requested(in_degrees(answer.peak * *alpha)) : std::string("null"));
    add(members, "friction", answer.friction ? json_of(*answer.friction) : std::string("null"));
    add(members, "lifts_off", answer.friction && std::isinf(*answer.friction));
    const auto friction =
        mapped(answer.friction_to_topple, [](double each) { return json_of(each); });
    add(members, "friction_to_topple", fmt::format("[{}]", fmt::join(friction, ", ")));
    add(members, "lifting_pga", json_of(answer.lifting_pga));
    members.push_back(json_of(answer.requested(), pga));
    std::vector<std::string> others;
    for (std::size_t i = 1; i < answer.by_restitution.size(); ++i) {
        others.push_back(fmt::format("\n    {{{}}}", json_of(answer.by_restitution[i], pga)));
    }
    add(members, "by_restitution", fmt::format("[{}]", fmt::join(others, ",")));
    return members;
}

/// The block and its motion, whatever the direction.
JsonMembers json_members_of(const Job& job, const ToppleOptions& options)
{
    const Scene& scene = job.problem.scene;
    const auto number = [&](const char* name) { return extent_of(job, name)->first; };
    JsonMembers members;
    const auto block = options.block | std::views::transform([](const auto& given) {
                           return fmt::format("\"{}\": {}", given.first, given.second);
                       });
    add(members, "block", fmt::format("{{{}}}", fmt::join(block, ", ")));
    add(members, "motion", json_of_motion(job, options));
    add(members, "motion_of", quoted_utf8(std::string(name_of(scene.motion_of))));
    add(members, "theory", quoted_utf8(std::string(name_of(scene.theory))));
    add(members, "gravity", scene.gravity);
    std::vector<const char*> names{"slenderness", "frequency_parameter"};
    if (!slenderness_of_only_block(job)) {
        names = {"slenderness_plus", "slenderness_minus", "frequency_parameter",
                 "frequency_parameter_minus", "incline"};
    }
    for (const char* name : names) {
        add(members, name, number(name));
    }
    add(members, "pga_max", options.pga_max);
    add(members, "narrower_ranges_exist", scene.is_recorded() ? "true" : "null");
    std::vector<std::string> warnings = remarks_on_records(job);
    if (std::string values = implausible_values(scene, job.problem.grid); !values.empty()) {
        warnings.insert(warnings.begin(), std::move(values));
    }
    add(members, "warnings",
        fmt::format("[{}]", fmt::join(warnings | std::views::transform(quoted_utf8), ", ")));
    return members;
}

/// The answer for the worst direction, and the answers for all.
void print_json(const std::vector<DirectedAnswer>& all, const ToppleOptions& options)
{
    const std::vector<std::string> verdicts = verdicts_of(all, options);
    std::vector<std::string> directions;
    JsonMembers members = json_members_of(all.front().job, options);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const JsonMembers its_members =
            json_members_of(all[i], verdicts.empty() ? "" : verdicts[i]);
        directions.push_back(fmt::format("\n  {{{}}}", fmt::join(its_members, ", ")));
        if (i == 0) {
            members.insert(members.end(), its_members.begin(), its_members.end());
        }
    }
    add(members, "by_direction", fmt::format("[{}]", fmt::join(directions, ",")));
    fmt::print("{{\n  {}\n}}\n", fmt::join(members, ",\n  "));
}

} // namespace

int topple(const ToppleOptions& options)
{
    widest_kernel(); // throws if this processor supports none
    expect_consistent(options);
    std::vector<Job> jobs = jobs_of(options);
    const Job& job = jobs.front();
    if (job.motions.size() > 1) {
        throw Error(exit_code::usage,
                    "--record matches {} files, but topple answers for one motion. "
                    "Give one file; for a suite, write a job for overturn run.",
                    job.motions.size());
    }
    if (!options.json) {
        warn_of_probable_mistakes(job);
    }
    std::optional<SoleWriter> sole_writer;
    if (!options.history.empty()) {
        sole_writer.emplace(options.history);
        const GuardedReading guarded(options.history, sole_writer->lock());
        expect_room_for(options.history, FileKind::history);
    }
    const std::vector<DirectedAnswer> answers = answers_for(std::move(jobs), options);
    if (!options.history.empty()) {
        write_history_file(options.history, answers.front().job, *answers.front().history);
    }
    (options.json ? print_json : print_answer)(answers, options);
    if (!options.history.empty() && !options.json) {
        fmt::print("\n{0}: written{1}; draw it with tools/plot_history {0} --units physical\n",
                   options.history,
                   answers.size() > 1 ? fmt::format(", the motion in direction {}",
                                                    answers.front().answer.direction)
                                      : "");
    }
    return exit_code::complete;
}

} // namespace overturn
