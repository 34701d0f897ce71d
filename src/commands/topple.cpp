// Whether one block topples under one motion, and at which peak accelerations, or at which values
// of another quantity. The job is made from the command line; everything is computed as by `run`,
// `boundary` and `history`.
#include "commands.hpp"
#include "motion_options.hpp"
#include "point_history.hpp"
#include "prepare_output.hpp"
#include "report/job.hpp"
#include "report/json_outputs.hpp"
#include "report/print.hpp"
#include "report/progress.hpp"
#include "report/topple_answer.hpp"
#include "report/topple_ranges.hpp"
#include "report/varied_answer.hpp"

#include "overturn/file/history_and_accuracy_files.hpp"
#include "overturn/problem/axis.hpp"
#include "overturn/sweep/in_threads.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/text/error.hpp"

#include <algorithm>
#include <numeric>

namespace overturn {

namespace {

/// The values of a varied quantity in its job, which show whether those between are allowed.
constexpr int values_in_job = 17;

/// The text of a job with a single point, or with values of a varied quantity. If the command line
/// gives no strength, its motion is 0.
std::string job_text(const ToppleOptions& options)
{
    const bool is_recorded = !options.record.empty();
    std::string text = "[scene]\n";
    text += is_recorded ? fmt::format("record = {}\n", quoted_utf8(options.record))
                        : pulse_lines(options.pulse, options.shape);
    text += component_line(options.component);
    text += "[plane]\n";
    text += options.scale || (is_recorded && !options.pga)
                ? fmt::format("scale = {}\n", options.scale.value_or(0))
                : fmt::format("pga = {}\n", options.pga.value_or(0));
    if (!is_recorded) {
        text += fmt::format("pulse_period = {}\n", *options.period);
    }
    if (options.restitution) {
        text += fmt::format("restitution = {}\n", *options.restitution);
    } else if (options.velocity_restitution) {
        text += fmt::format("velocity_restitution = {}\n", *options.velocity_restitution);
    } else if (options.restitution_of_maximum ||
               !(options.vary && options.vary->quantity->role == Role::loss)) {
        text += fmt::format("restitution_of_maximum = {}\n",
                            options.restitution_of_maximum.value_or(1));
    }
    if (options.vary) {
        const auto& [quantity, first, last] = *options.vary;
        text += fmt::format("{} = {{ first = {}, last = {}, count = {} }}\n", quantity->name, first,
                            last, first < last ? values_in_job : 1);
    }
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
    const auto refuse_if = [](bool wrong, const std::string& message) {
        if (wrong) {
            throw Error(exit_code::usage, message);
        }
    };
    refuse_if(options.record.empty() && !options.period,
              "the ground motion is missing. Give --period with the period of a pulse [s], or "
              "--record with the file of a recorded motion.");
    expect_keys_of_scene(options.overrides);
    refuse_if(options.without_search && !options.pga && !options.scale,
              "--no-search leaves the verdict at one acceleration. Give --pga or --scale.");
    refuse_if(!options.history.empty() && !options.pga && !options.scale,
              "--history is that of one acceleration. Give --pga or --scale.");
    if (options.vary) {
        const std::string name(options.vary->quantity->name);
        refuse_if(!options.pga && !options.scale,
                  "--vary searches at one acceleration. Give --pga or --scale.");
        refuse_if(
            options.block.contains(name) || (name == "restitution" && options.restitution) ||
                (name == "velocity_restitution" && options.velocity_restitution) ||
                (name == "restitution_of_maximum" && options.restitution_of_maximum),
            fmt::format("--vary {0} cannot be combined with a value of {0}. Remove one.", name));
    }
}

Job job_of(const ToppleOptions& options)
{
    return read_job_text(job_text(options), command_line, options.overrides);
}

/// A sentence on the values of the varied quantity that describe a block, if some do.
std::string possible_values(const ToppleOptions& options)
{
    const auto& [quantity, first, last] = *options.vary;
    const auto is_possible = [&](double value) {
        ToppleOptions at = options;
        at.vary->first = at.vary->last = value;
        try {
            job_of(at);
            return true;
        } catch (const Error&) {
            return false;
        }
    };
    const std::vector<double> values = Axis(AxisRange{first, last, values_in_job}).values();
    const auto begin = std::ranges::find_if(values, is_possible);
    if (begin == values.end()) {
        return "";
    }
    // The last possible value on the way from a possible to an impossible one.
    const auto end_between = [&](double possible, double impossible) {
        constexpr int halvings = 12;
        for (int i = 0; i < halvings; ++i) {
            const double middle = std::midpoint(possible, impossible);
            (is_possible(middle) ? possible : impossible) = middle;
        }
        return possible;
    };
    const auto end = std::find_if_not(begin, values.end(), is_possible);
    constexpr int decimals = 4;
    const double least =
        begin == values.begin() ? first : rounded_up(end_between(*begin, *(begin - 1)), decimals);
    const double largest =
        end == values.end() ? last : rounded_down(end_between(*(end - 1), *end), decimals);
    return fmt::format(" Possible are values from {} to {}.", least, largest);
}

/// The job of each direction that is computed.
std::vector<Job> jobs_of(ToppleOptions options)
{
    const auto job = [&] {
        try {
            return job_of(options);
        } catch (const Error& error) {
            throw Error(error.code(),
                        error.what() + (options.vary ? possible_values(options) : ""));
        }
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

void expect_motion(const Problem& problem)
{
    if (!(pga_of_unit(problem.scene, only_point_of(problem)) > 0)) {
        throw Error(
            exit_code::job,
            "the record has no motion in the direction of {} degrees: its components cancel. "
            "Choose another --direction.",
            directions_of(problem).front());
    }
}

/// The answers for all directions, the worst one first. Histories, which may be refused, are
/// computed before the answers, which may take minutes.
std::vector<DirectedAnswer> answers_for(std::vector<Job> jobs, const ToppleOptions& options)
{
    std::optional<Progress> progress;
    std::vector<DirectedAnswer> all;
    for (Job& job : jobs) {
        expect_motion(job.problem);
        auto history =
            options.history.empty() ? std::nullopt : std::optional(history_of_only_point(job));
        all.push_back({std::move(job), std::move(history), {}});
    }
    std::size_t answered = 0;
    ToppleQuestion question{.has_strength = options.pga || options.scale,
                            .pga = options.pga,
                            .pga_max = options.pga_max,
                            .searches = !options.without_search,
                            .threads = threads_of_processor()};
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

int topple_varied(const std::vector<Job>& jobs, const ToppleOptions& options)
{
    std::vector<DirectedRanges> all;
    for (const Job& job : jobs) {
        expect_motion(job.problem);
        const auto& [quantity, first, last] = *options.vary;
        all.push_back({job, directions_of(job.problem).front(),
                       ranges_along(job.problem, *quantity, first, last)});
    }
    if (options.json) {
        fmt::print("{}", json_of(all, options));
    } else {
        print_varied(all, options);
    }
    return exit_code::complete;
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
                    "Give one file; for a suite, use overturn assess with a table of one "
                    "object, or write a job for overturn run.",
                    job.motions.size());
    }
    if (!options.json) {
        print_warnings(warnings_on(job));
    }
    if (options.vary) {
        return topple_varied(jobs, options);
    }
    std::optional<OutputLock> output_lock;
    if (!options.history.empty()) {
        output_lock.emplace(options.history);
        expect_study_output(job, options.history, FileKind::history, *output_lock);
    }
    const std::vector<DirectedAnswer> answers = answers_for(std::move(jobs), options);
    if (!options.history.empty()) {
        write_history_file(options.history, answers.front().job, *answers.front().history);
    }
    if (options.json) {
        fmt::print("{}", json_of(answers, options));
        return exit_code::complete;
    }
    print_answer(answers, options);
    if (!options.history.empty()) {
        fmt::print("\n{0}: written{1}; draw it with tools/plot_history {0} --units physical\n",
                   options.history,
                   answers.size() > 1 ? fmt::format(", the motion in direction {}",
                                                    answers.front().answer.direction)
                                      : "");
    }
    return exit_code::complete;
}

} // namespace overturn
