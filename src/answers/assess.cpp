#include "overturn/answers/assess.hpp"

#include "motion_lines.hpp"

#include "overturn/record/text_file.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/quoting.hpp"
#include "overturn/text/table.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace overturn {

namespace {

constexpr TextFileKind objects_file{"a table", largest_table_file,
                                    "Give the path of a table of objects.", "Split the table."};

void expect_consistent(const AssessRequest& request)
{
    if (request.records.empty() && request.periods.empty()) {
        throw Error(exit_code::usage,
                    "the ground motion is missing. Give --period with the periods of a pulse [s], "
                    "or --record with the files of recorded motions.");
    }
    expect_keys_of_scene(request.overrides);
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
std::string job_text(const AssessRequest& request)
{
    const Table table = read_table(text_of_file(request.objects, objects_file), request.objects);
    expect_different_names(table, request.objects);
    const auto has = [&](const char* name) { return table.find(name) != nullptr; };
    const std::string records =
        request.records.empty()
            ? ""
            : fmt::format("[{}]", fmt::join(mapped(request.records, quoted_utf8), ", "));
    std::string text = motion_lines(request, records);
    if (records.empty()) {
        text +=
            fmt::format("pulse_period = {{ values = [{}] }}\n", fmt::join(request.periods, ", "));
    }
    if (!has("restitution") && !has("restitution_of_maximum") && !has("velocity_restitution")) {
        text += "restitution_of_maximum = 1\n";
    }
    if (!has("direction")) {
        const std::vector<double> both{0, 180};
        text +=
            fmt::format("direction = {{ values = [{}] }}\n",
                        fmt::join(request.directions.empty() ? both : request.directions, ", "));
    }
    return text + fmt::format("[blocks]\ntable = {}\n", quoted_utf8(request.objects));
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

} // namespace

Job job_of(const AssessRequest& request)
{
    expect_consistent(request);
    return read_job_text(job_text(request), command_line, request.overrides);
}

Assessment assessment_of(Job job, const AssessRequest& request, int threads,
                         const std::function<void(std::size_t done, std::size_t all)>& progress)
{
    const std::vector<PartOfObject> parts = parts_of_objects(job.blocks->table, request.objects);
    const AssessmentQuestion question{.has_strength = request.has_strength(),
                                      .pga_max = request.pga_max,
                                      .is_fine = request.fine,
                                      .parts = parts,
                                      .threads = threads,
                                      .progress = progress};
    std::vector<ObjectCase> cases = cases_of(job.problem, question);
    std::vector<ObjectAnswer> answers = answers_of(cases);
    return {std::move(job), std::move(cases), std::move(answers), {}};
}

std::optional<LeastWidths> least_widths_of(const Assessment& assessment, int threads)
{
    const auto& [job, cases, answers, widths] = assessment;
    const ObjectAnswer& worst = answers.front();
    if (job.blocks->table.find(column_of_azimuths) != nullptr ||
        worst.verdict.value_or(Verdict::safe) == Verdict::safe) {
        return std::nullopt;
    }
    const auto its = std::ranges::equal_range(cases, worst.object, {}, &ObjectCase::object);
    return least_widths_of(job.problem, {its.begin(), its.end()}, threads);
}

} // namespace overturn
