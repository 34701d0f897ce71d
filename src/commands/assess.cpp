// Which objects of a list topple, and at which strengths. The job is made from the command line;
// the verdicts are those of `topple`.
#include "commands.hpp"
#include "motion_options.hpp"
#include "report/assessment.hpp"
#include "report/job.hpp"
#include "report/print.hpp"
#include "report/progress.hpp"

#include "overturn/file/answer_table.hpp"
#include "overturn/job/job.hpp"
#include "overturn/record/text_file.hpp"
#include "overturn/sweep/in_threads.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/quoting.hpp"
#include "overturn/text/table.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace overturn {

namespace {

constexpr TextFileKind objects_file{"a table", largest_table_file,
                                    "Give the path of a table of objects.", "Split the table."};

void expect_consistent(const AssessOptions& options)
{
    if (options.records.empty() && options.periods.empty()) {
        throw Error(exit_code::usage,
                    "the ground motion is missing. Give --period with the periods of a pulse [s], "
                    "or --record with the files of recorded motions.");
    }
    expect_keys_of_scene(options.overrides);
}

/// Refuses two rows of one name, which no reader of the answer could tell apart. Rows of different
/// objects may have the same name.
void expect_different_names(const Table& table, const std::string& file)
{
    const TableColumn* const names = table.find("name");
    if (names == nullptr) {
        return;
    }
    const TableColumn* const objects = table.find(column_of_azimuths);
    std::map<std::pair<std::string, std::string_view>, std::size_t> rows;
    for (std::size_t i = 0; i < names->texts.size(); ++i) {
        const std::string object = objects != nullptr ? text_in(*objects, i) : "";
        if (const auto [first, is_new] =
                rows.try_emplace({object, std::string_view(names->texts[i])}, i);
            !is_new) {
            throw Error(exit_code::job,
                        "{}:{}: the name {} is that of line {}, too. Give every object a name of "
                        "its own.",
                        file, table.lines[i], in_quotes(shortened(names->texts[i], 40)),
                        table.lines[first->second]);
        }
    }
}

/// The text of a job whose blocks are the objects. Without a strength, the motions are 0.
std::string job_text(const AssessOptions& options)
{
    const Table table = read_table(text_of_file(options.objects, objects_file), options.objects);
    expect_different_names(table, options.objects);
    const auto has = [&](const char* name) { return table.find(name) != nullptr; };
    const bool is_recorded = !options.records.empty();
    std::string text = "[scene]\n";
    text += is_recorded ? fmt::format("record = [{}]\n",
                                      fmt::join(mapped(options.records, quoted_utf8), ", "))
                        : pulse_lines(options.pulse, options.shape);
    text += component_line(options.component);
    text += fmt::format("[blocks]\ntable = {}\n[plane]\n", quoted_utf8(options.objects));
    text += options.scale || (is_recorded && !options.pga)
                ? fmt::format("scale = {}\n", options.scale.value_or(0))
                : fmt::format("pga = {}\n", options.pga.value_or(0));
    if (!is_recorded) {
        text +=
            fmt::format("pulse_period = {{ values = [{}] }}\n", fmt::join(options.periods, ", "));
    }
    if (!has("restitution") && !has("restitution_of_maximum") && !has("velocity_restitution")) {
        text += "restitution_of_maximum = 1\n";
    }
    if (!has("direction")) {
        const std::vector<double> both{0, 180};
        text +=
            fmt::format("direction = {{ values = [{}] }}\n",
                        fmt::join(options.directions.empty() ? both : options.directions, ", "));
    }
    return text;
}

/// What each row is a part of; empty if each is an object.
std::vector<PartOfObject> parts_of_objects(const Table& table, const std::string& file)
{
    std::vector<PartOfObject> parts;
    const TableColumn* const objects = table.find(column_of_azimuths);
    const TableColumn* const samples = table.find(column_of_samples);
    std::map<std::string, std::int64_t> rows;
    std::map<std::string, std::int64_t> numbers;
    for (std::int64_t i = 0; objects != nullptr && i < table.rows(); ++i) {
        const auto row = std::size_t(i);
        if (objects->texts.empty() ? std::isnan(objects->numbers[row])
                                   : objects->texts[row].empty()) {
            throw Error(exit_code::job,
                        "{}:{}: {} is empty. Give every row the name of the object of which it is "
                        "an azimuth.",
                        file, table.lines[row], column_of_azimuths);
        }
        const std::string sample = samples != nullptr ? text_in(*samples, row) : "";
        parts.push_back({rows.emplace(text_in(*objects, row), i).first->second,
                         numbers.emplace(sample, i).first->second});
    }
    return parts;
}

/// Of an object that topples, or may, and has one row.
std::optional<LeastWidths> widths_of_worst(const Problem& problem,
                                           const std::vector<ObjectCase>& cases,
                                           const ObjectAnswer& worst, bool has_azimuths)
{
    if (has_azimuths || worst.verdict.value_or(Verdict::safe) == Verdict::safe) {
        return std::nullopt;
    }
    const auto its = std::ranges::equal_range(cases, worst.object, {}, &ObjectCase::object);
    return least_widths_of(problem, {its.begin(), its.end()}, threads_of_processor());
}

} // namespace

int assess(const AssessOptions& options)
{
    widest_kernel(); // throws if this processor supports none
    expect_consistent(options);
    const Job job = read_job_text(job_text(options), command_line, options.overrides);
    if (!options.json) {
        print_warnings(warnings_on(job));
    }
    if (!options.csv.empty()) {
        expect_place_for_answers(options.csv);
    }
    const std::vector<PartOfObject> parts = parts_of_objects(job.blocks->table, options.objects);
    std::optional<Progress> progress;
    const AssessmentQuestion question{.has_strength = options.pga || options.scale,
                                      .pga_max = options.pga_max,
                                      .is_fine = options.fine,
                                      .parts = parts,
                                      .threads = threads_of_processor(),
                                      .progress = [&](std::size_t done, std::size_t all) {
                                          if (!progress) {
                                              progress.emplace(0, std::int64_t(all), "cases");
                                          }
                                          progress->update(std::int64_t(done));
                                      }};
    const std::vector<ObjectCase> cases = cases_of(job.problem, question);
    const std::vector<ObjectAnswer> answers = answers_of(cases);
    progress.reset();
    const std::optional<LeastWidths> widths =
        widths_of_worst(job.problem, cases, answers.front(), !parts.empty());
    if (!options.csv.empty()) {
        write_answers(options.csv, csv_of(job, answers));
    }
    if (options.json) {
        fmt::print("{}", json_of(job, answers, widths, options));
        return exit_code::complete;
    }
    print_assessment(job, answers, widths, options);
    if (!options.csv.empty()) {
        fmt::print("\n{}: written\n", printable(options.csv));
    }
    return exit_code::complete;
}

} // namespace overturn
