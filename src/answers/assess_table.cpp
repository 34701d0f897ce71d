#include "overturn/answers/assess.hpp"
#include "overturn/answers/job_lines.hpp"
#include "overturn/answers/json.hpp"
#include "overturn/answers/topple.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/quoting.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace overturn {

namespace {

/// The motion of the worst case: a record, or the period of a pulse.
std::string worst_motion(const Job& job, const ObjectAnswer& answer)
{
    const Grid& grid = job.problem.grid;
    const auto index = [&](std::string_view name) {
        const std::optional<std::size_t> dimension = grid.dimension_of(name);
        return std::size_t(dimension ? answer.place[*dimension] : 0);
    };
    if (!job.motions.empty()) {
        return job.motions[index("motion")].name;
    }
    const Column* const periods = grid.find("pulse_period");
    return periods != nullptr
               ? fmt::format("{:g} s", periods->values[std::int64_t(index("pulse_period"))])
               : "";
}

/// The row of an object: the columns of the table, its name or number, and those of the answer.
Json row_of(const Job& job, const ObjectAnswer& answer)
{
    Json row;
    for (const TableColumn& column : job.blocks->table.columns) {
        const auto i = std::size_t(answer.row);
        row[column.name] =
            column.texts.empty() ? if_finite(column.numbers[i]) : Json(column.texts[i]);
    }
    if (!row.contains("object")) {
        row["object"] = name_of_object(*job.blocks, answer.object);
    }
    const bool has_strength = answer.verdict.has_value();
    row["lifts_from"] = if_finite(answer.lifting_pga);
    if (job.problem.grid.may_slip()) {
        row["slides_from"] =
            answer.moving_pga < answer.lifting_pga ? if_finite(answer.moving_pga) : Json();
    }
    row["topples_from"] = if_known(answer.toppling_pga);
    row["undecided_from"] = if_known(answer.undecided_pga);
    row["worst_motion"] = worst_motion(job, answer);
    row["end_of_search"] = answer.end_of_search;
    row["median"] = if_known(answer.median);
    row["percentile_16"] = if_known(answer.percentile_16);
    row["cases"] = answer.cases;
    row["pga"] = has_strength ? Json(answer.pga) : Json();
    row["verdict"] = has_strength ? Json(outcome_word(answer)) : Json();
    row["share_toppling"] =
        has_strength ? Json(double(answer.toppling) / double(answer.cases)) : Json();
    row["share_undecided"] =
        has_strength ? Json(double(answer.undecided) / double(answer.cases)) : Json();
    const bool may_be_near = has_strength && answer.verdict != Verdict::topples;
    row["factor_below"] =
        may_be_near && answer.factor_below > 0 ? Json(answer.factor_below) : Json();
    row["factor_above"] = may_be_near ? if_finite(answer.factor_above) : Json();
    // Infinite, as JSON cannot say, if it topples.
    row["peak_of_alpha"] = has_strength ? if_finite(answer.peak) : Json();
    if (job.problem.grid.may_slip()) {
        row["slide"] = has_strength ? if_finite(answer.slide) : Json();
    }
    row["note"] = note_on(job, answer);
    return row;
}

/// A cell of RFC 4180.
std::string cell_of(const Json& value)
{
    if (value.is_null()) {
        return "";
    }
    if (!value.is_string()) {
        return value.dump();
    }
    auto text = value.get<std::string>();
    return text.find_first_of(",\"\r\n") == std::string::npos
               ? text
               : fmt::format("\"{}\"", boost::algorithm::replace_all_copy(text, "\"", "\"\""));
}

/// A share of a strength; with two digits, if that is more than one percent.
std::string percent(double share)
{
    return share < 0.1 ? fmt::format("{:.2g} %", 100 * share)
                       : fmt::format("{:.0f} %", 100 * share);
}

} // namespace

std::string name_of_object(const BlockTable& blocks, std::int64_t object)
{
    if (const TableColumn* const objects = blocks.table.find(column_of_azimuths)) {
        return text_in(*objects, std::size_t(object));
    }
    const TableColumn* column = blocks.table.find("name");
    for (const TableColumn& each : blocks.table.columns) {
        column = column == nullptr && !each.texts.empty() ? &each : column;
    }
    return column != nullptr && !column->texts.empty() ? column->texts[std::size_t(object)]
                                                       : fmt::format("{}", object + 1);
}

std::string text_in(const TableColumn& column, std::size_t row)
{
    return column.texts.empty() ? fmt::format("{}", column.numbers[row]) : column.texts[row];
}

std::string outcome_word(const ObjectAnswer& answer)
{
    return !answer.verdict                      ? ""
           : answer.verdict != Verdict::safe    ? std::string(name_of(*answer.verdict))
           : answer.peak > 0 && answer.slides() ? "rocks and slides"
           : answer.peak > 0                    ? "rocks"
           : answer.slides()                    ? "slides"
                                                : "stands";
}

std::string note_on(const Job& job, const ObjectAnswer& answer)
{
    std::vector<std::string> notes;
    const Table& table = job.blocks->table;
    if (const TableColumn* const names = table.find("name");
        names != nullptr && table.find(column_of_azimuths) != nullptr) {
        notes.push_back("weakest: " + printable(text_in(*names, std::size_t(answer.row))));
    }
    if (answer.undecided > 0) {
        notes.push_back(fmt::format("undecided under {} of {}", answer.undecided, answer.cases));
    }
    if (answer.undecided_pga) {
        notes.push_back(fmt::format("undecided from {:.4f} g", *answer.undecided_pga));
    }
    if (answer.verdict == Verdict::safe) {
        constexpr double near = 1.1;
        const double below = answer.factor_below;
        const double above = answer.factor_above;
        if (below > 0) {
            notes.push_back(fmt::format(
                "topples at {} less{}", percent(1 - below),
                std::isinf(above) ? "" : fmt::format(" and {} more", percent(above - 1))));
        } else if (above < near) {
            notes.push_back(fmt::format("topples at {} more", percent(above - 1)));
        }
    }
    if (!answer.toppling_pga) {
        notes.push_back(fmt::format("searched up to {:.4g} g", answer.end_of_search));
    }
    return fmt::format("{}", fmt::join(notes, "; "));
}

std::string csv_of(const Assessment& assessment)
{
    std::string text;
    for (const ObjectAnswer& answer : assessment.answers) {
        const Json row = row_of(assessment.job, answer);
        std::vector<std::string> names;
        std::vector<std::string> cells;
        for (const auto& [name, value] : row.items()) {
            names.push_back(cell_of(Json(name)));
            cells.push_back(cell_of(value));
        }
        if (text.empty()) {
            text = fmt::format("{}\n", fmt::join(names, ","));
        }
        text += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return text;
}

std::string json_of(const Assessment& assessment, const AssessRequest& request,
                    std::string_view program_version)
{
    const auto& [job, cases, answers, widths] = assessment;
    const Scene& scene = job.problem.scene;
    Json members;
    members["program_version"] = program_version;
    members["table"] = request.objects;
    Json& motion = members["motion"];
    if (const auto pulse = scene.named_pulse()) {
        motion["pulse"] = pulse->name;
        motion["periods"] = request.periods;
        if (job.shape) {
            motion["shape"] = job.shape->file;
            motion["shape_peak"] = job.shape->peak;
        }
    } else {
        motion["records"] =
            mapped(job.motions, [](const RecordedMotion& each) { return each.name; });
    }
    members["motion_of"] = name_of(scene.motion_of);
    members["theory"] = name_of(scene.theory);
    members["gravity"] = scene.gravity;
    members["pga"] = if_known(request.pga);
    members["scale"] = if_known(request.scale);
    members["pga_max"] = request.pga_max;
    members["search"] = request.fine ? "fine" : "steps";
    members["step_of_search"] = request.fine ? Json() : Json(toppling_step);
    members["width_of_search"] = request.fine ? Json() : Json(width_of_lowest);
    members["warnings"] = warnings_on(job);
    Json& least_widths = members["least_widths"];
    if (widths) {
        least_widths["object"] = name_of_object(*job.blocks, widths->object);
        least_widths["width"] = widths->width;
        least_widths["end_of_search"] = widths->end;
        least_widths["step_of_search"] =
            step_of_search(scene, {&quantity("width"), widths->width, widths->end});
        least_widths["safe_from"] = mapped(widths->safe_from, if_finite);
    }
    Json& objects = members["objects"] = Json::array();
    for (const ObjectAnswer& answer : answers) {
        objects.push_back(row_of(job, answer));
    }
    return text_of(members);
}

} // namespace overturn
