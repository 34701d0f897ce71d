#include "report/history.hpp"
#include "commands.hpp"
#include "prepare_output.hpp"
#include "report/job.hpp"
#include "report/print.hpp"

#include "overturn/answers/history.hpp"
#include "overturn/answers/job_lines.hpp"
#include "overturn/file/history_and_accuracy_files.hpp"
#include "overturn/job/job.hpp"
#include "overturn/job/schema.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/parse_number.hpp"
#include "overturn/text/quoting.hpp"

#include <ranges>
#include <string_view>

namespace overturn {

namespace {

/// An --at argument, its axis, and the --set argument that gives the axis a single value.
struct At {
    std::string given;
    std::string axis;
    std::string override;
};

/// before: the argument before it, from which a decimal comma may have cut it.
At read_at(const std::string& given, std::string_view before)
{
    const std::size_t equals = std::min(given.find('='), given.size());
    const std::string_view text = given;
    const std::string axis(trimmed(text.substr(0, equals)));
    const std::string_view value = trimmed(text.substr(std::min(equals + 1, given.size())));
    if (!is_one_of(axis, keys_of("plane")) || value.empty()) {
        throw Error(exit_code::usage,
                    "--at {}: write AXIS=VALUE, where AXIS is one of {}, such as "
                    "--at frequency=3,amplitude=1.5.{}",
                    given, fmt::join(keys_of("plane"), ", "),
                    advice_on_decimal_comma(
                        fmt::format("{},{}", before.substr(before.find('=') + 1), given)));
    }
    if (!is_whole(parse_number(value), value)) {
        throw Error(exit_code::usage, "--at {}: {} is not a number. Give one, such as --at {}=3.",
                    given, value, axis);
    }
    return {given, axis, fmt::format("plane.{}.values=[{}]", axis, value)};
}

/// Refuses two values of one axis, or of two axes that give the same quantity. Messages name the
/// --at argument, not the override that it stands for.
Job read_job_at(const HistoryOptions& options)
{
    std::vector<At> places;
    std::vector<std::string> overrides = options.job.overrides;
    for (const std::string& given : options.at) {
        const At at = read_at(given, places.empty() ? "" : places.back().given);
        for (const At& other : places) {
            if (exclude_each_other(at.axis, other.axis)) {
                throw Error(exit_code::usage,
                            "--at {}: {} gives the same quantity. Give one value.", at.given,
                            other.given);
            }
        }
        overrides.push_back(at.override);
        places.push_back(at);
    }
    try {
        return read_job(options.job.path, overrides);
    } catch (const Error& error) {
        const std::string_view message = error.what();
        for (const At& at : places) {
            const std::string place = "--set " + at.override;
            if (message.starts_with(place)) {
                throw Error(exit_code::job, "--at {}{}", at.given, message.substr(place.size()));
            }
        }
        throw;
    }
}

Job read_job_of_one_point(const HistoryOptions& options)
{
    Job job = read_job_at(options);
    if (job.blocks) {
        throw Error(exit_code::usage,
                    "{} lists its blocks in {}, but a history follows one block. "
                    "Give [block] and [plane] instead of [blocks].",
                    options.job.path, job.blocks->file);
    }
    if (job.motions.size() > 1) {
        const RecordedMotion& first = job.motions.front();
        std::string choice = "--set scene.record=" + first.file;
        choice += first.second.empty() ? "" : " --set scene.second_component=" + first.second;
        choice += first.vertical.empty() ? "" : " --set scene.vertical=" + first.vertical;
        throw Error(exit_code::usage,
                    "{} has {} records, but a history needs exactly one. Choose one, for example "
                    "with {}.",
                    options.job.path, job.motions.size(), choice);
    }
    for (const Dimension& dimension : job.problem.grid.dimensions | std::views::reverse) {
        const Axis& values = dimension.columns.front().values;
        if (values.size() > 1) {
            throw Error(
                exit_code::usage,
                "{} has {} values of plane.{}, from {} to {}, but a history needs exactly one. "
                "Choose one, for example with --at {}={}.",
                options.job.path, values.size(), dimension.name, values.first(), values.last(),
                dimension.name, values.first());
        }
    }
    return job;
}

} // namespace

int history(const HistoryOptions& options)
{
    widest_kernel(); // throws if this processor supports none
    const Job job = read_job_of_one_point(options);
    const OutputLock output_lock(options.output);
    expect_study_output(options.output, FileKind::history, output_lock);
    print_warnings(warnings_on(job));
    HistoryView view{.samples = options.samples};
    if (options.until > 0) {
        view.until = options.until;
    }
    const History history = history_of_only_point(job, view);
    print_history(job, history);
    write_history_file(options.output, job, history);
    fmt::print("\n{0}: written; draw it with tools/plot_history {0}\n", options.output);
    return exit_code::complete;
}

} // namespace overturn
