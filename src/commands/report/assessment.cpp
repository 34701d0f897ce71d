#include "assessment.hpp"

#include "job.hpp"
#include "print.hpp"
#include "topple_ranges.hpp"
#include "varied_answer.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/quoting.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace overturn {

namespace {

using Json = nlohmann::ordered_json;

constexpr int decimals = 4;

/// A name for the rows that people read: the column of objects, the column `name`, the first column
/// of texts, or the number of the row.
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

/// A number of a table or an answer; null if it is not known or above the search.
Json known(double value)
{
    return std::isfinite(value) ? Json(value) : Json();
}
Json known(const std::optional<double>& value)
{
    return value ? Json(*value) : Json();
}

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

/// The row of an object: the columns of the table, then those of the answer.
Json row_of(const Job& job, const ObjectAnswer& answer)
{
    Json row;
    for (const TableColumn& column : job.blocks->table.columns) {
        const auto i = std::size_t(answer.row);
        row[column.name] = column.texts.empty() ? known(column.numbers[i]) : Json(column.texts[i]);
    }
    const bool has_strength = answer.verdict.has_value();
    row["lifts_from"] = known(answer.lifting_pga);
    if (job.problem.grid.may_slip()) {
        row["slides_from"] =
            answer.moving_pga < answer.lifting_pga ? known(answer.moving_pga) : Json();
    }
    row["topples_from"] = known(answer.toppling_pga);
    row["undecided_from"] = known(answer.undecided_pga);
    row["worst_motion"] = worst_motion(job, answer);
    row["end_of_search"] = answer.end_of_search;
    row["median"] = known(answer.median);
    row["percentile_16"] = known(answer.percentile_16);
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
    row["factor_above"] = may_be_near ? known(answer.factor_above) : Json();
    // Infinite, as JSON cannot say, if it topples.
    row["peak_of_alpha"] = has_strength ? known(answer.peak) : Json();
    if (job.problem.grid.may_slip()) {
        row["slide"] = has_strength ? known(answer.slide) : Json();
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
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
        return text;
    }
    std::string quoted = "\"";
    for (const char letter : text) {
        quoted += letter == '"' ? "\"\"" : std::string(1, letter);
    }
    return quoted + "\"";
}

std::string strength_text(const std::optional<double>& pga, double end)
{
    return pga ? fmt::format("{:.4f}", rounded_down(*pga, decimals))
               : fmt::format("above {:.4g}", end);
}

/// A share of a strength; with two digits, if that is more than one percent.
std::string percent(double share)
{
    return share < 0.1 ? fmt::format("{:.2g} %", 100 * share)
                       : fmt::format("{:.0f} %", 100 * share);
}

} // namespace

std::string text_in(const TableColumn& column, std::size_t row)
{
    return column.texts.empty() ? fmt::format("{}", column.numbers[row]) : column.texts[row];
}

std::string outcome_word(const ObjectAnswer& answer)
{
    if (!answer.verdict) {
        return "";
    }
    return answer.verdict == Verdict::topples     ? "topples"
           : answer.verdict == Verdict::undecided ? "undecided"
           : answer.peak > 0 && answer.slides     ? "rocks and slides"
           : answer.peak > 0                      ? "rocks"
           : answer.slides                        ? "slides"
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

namespace {

/// A column of the printed table.
struct PrintedColumn {
    std::string format; ///< of its cells
    std::string_view heading;
    std::function<std::string(const ObjectAnswer&)> cell;
};

std::vector<PrintedColumn> printed_columns(const Job& job, const std::vector<ObjectAnswer>& answers,
                                           bool has_cases)
{
    const auto name = [&blocks = *job.blocks](const ObjectAnswer& answer) {
        return printable(name_of_object(blocks, answer.object));
    };
    const std::size_t longest =
        std::ranges::max(mapped(answers, [&](const auto& answer) { return name(answer).size(); }));
    const std::size_t width = std::clamp<std::size_t>(longest, 6, 32);
    std::vector<PrintedColumn> columns;
    const auto add = [&](std::string format, std::string_view heading, const auto& cell) {
        columns.push_back({std::move(format), heading, cell});
    };
    // Columns that differ in the strength that they show.
    const auto add_strength = [&](std::string_view heading, auto ObjectAnswer::*pga) {
        add("{:>15}", heading, [pga](const ObjectAnswer& answer) {
            return strength_text(answer.*pga, answer.end_of_search) + " g";
        });
    };
    const auto moves = [](double pga) {
        return std::isinf(pga) ? std::string("never")
                               : fmt::format("{:.4f} g", rounded_down(pga, decimals));
    };
    const bool has_strength = answers.front().verdict.has_value();
    const bool may_slip = job.problem.grid.may_slip();
    add(fmt::format("{{:<{}}}", width), "object",
        [=](const ObjectAnswer& answer) { return name(answer).substr(0, width); });
    if (has_strength) {
        add("  {:<16}", "verdict", outcome_word);
        add("{:>11}", "of motions", [](const ObjectAnswer& answer) {
            return fmt::format("{:.0f} %", 100.0 * double(answer.toppling) / double(answer.cases));
        });
        add("{:>9}", "tilt", [](const ObjectAnswer& answer) -> std::string {
            return std::isnan(answer.peak)   ? "unknown"
                   : std::isinf(answer.peak) ? "over"
                                             : fmt::format("{:.0f} %", 100 * answer.peak);
        });
    }
    add("{:>13}", "lifts from",
        [=](const ObjectAnswer& answer) { return moves(answer.lifting_pga); });
    if (may_slip) {
        add("{:>13}", "slides from", [=](const ObjectAnswer& answer) {
            return answer.moving_pga < answer.lifting_pga ? moves(answer.moving_pga)
                                                          : "lifts first";
        });
    }
    add_strength("topples from", &ObjectAnswer::toppling_pga);
    if (has_cases) {
        add_strength("16 %", &ObjectAnswer::percentile_16);
        add_strength("median", &ObjectAnswer::median);
    }
    if (has_strength && may_slip) {
        add("{:>11}", "slide", [](const ObjectAnswer& answer) -> std::string {
            return std::isnan(answer.slide) ? "unknown"
                                            : fmt::format("{:.3g} mm", 1000 * answer.slide);
        });
    }
    add("{}", "  note", [&job](const ObjectAnswer& answer) {
        const std::string note = note_on(job, answer);
        return note.empty() ? "" : "  " + note;
    });
    return columns;
}

/// How wide the object must be to stand in all cases, and in all but one or two.
std::string widths_text(const std::string& name, const Scene& scene, const LeastWidths& widths)
{
    const std::size_t cases = widths.safe_from.size();
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < std::min<std::size_t>(cases, 3); ++i) {
        const double from = widths.safe_from[cases - 1 - i];
        if (!std::isinf(from)) {
            parts.push_back(fmt::format("from {:.4f} m{}", rounded_up(from, decimals),
                                        i > 0       ? fmt::format(" in {} of {}", cases - i, cases)
                                        : cases > 1 ? " in all cases"
                                                    : ""));
        }
    }
    const double step = step_of_search(scene, {&quantity("width"), widths.width, widths.end});
    return fmt::format(
        "{} is {:.4g} m wide. {}, as searched up to {:.4g} m in steps of {:.1g} m, and "
        "finer ones near the result: single widths between them may topple.",
        name, widths.width,
        parts.empty() ? "No wider one is known to stand"
                      : fmt::format("With more width, it stands {}", fmt::join(parts, ", ")),
        widths.end, step);
}

} // namespace

void print_assessment(const Job& job, const std::vector<ObjectAnswer>& answers,
                      const std::optional<LeastWidths>& widths, const AssessOptions& options)
{
    const Scene& scene = job.problem.scene;
    const bool has_strength = answers.front().verdict.has_value();
    const std::int64_t cases =
        std::ranges::max(mapped(answers, [](const ObjectAnswer& each) { return each.cases; }));
    print_row("objects", fmt::format("{} in {}", answers.size(), printable(options.objects)));
    if (const auto pulse = scene.named_pulse()) {
        print_row("motion",
                  fmt::format("{}, period {} s{}", pulse->name, fmt::join(options.periods, ", "),
                              job.shape ? "; " + shape_line(*job.shape) : ""));
    } else {
        for (const std::string& line : record_lines(job)) {
            print_row("record", scene.worded(line));
        }
    }
    const Column* const share = job.problem.grid.find("restitution_of_maximum");
    if (share != nullptr && share->values.size() == 1) {
        print_row("restitution", share->values[0] == 1
                                     ? "r_max, the largest one of each object"
                                     : fmt::format("{} of r_max", share->values[0]));
    }
    if (has_strength) {
        print_row("strength", scene.worded(options.scale ? fmt::format("scale {}", *options.scale)
                                                         : fmt::format("PGA {} g", *options.pga)));
    }
    if (cases > 1) {
        print_row("cases",
                  fmt::format("up to {} of each object: motions, periods and directions", cases));
    }
    const std::vector<PrintedColumn> columns = printed_columns(job, answers, cases > 1);
    fmt::print("\n");
    for (const PrintedColumn& column : columns) {
        fmt::print(fmt::runtime(column.format), column.heading);
    }
    fmt::print("\n");
    for (const ObjectAnswer& answer : answers) {
        for (const PrintedColumn& column : columns) {
            fmt::print(fmt::runtime(column.format), column.cell(answer));
        }
        fmt::print("\n");
    }
    fmt::print("\nStrengths are {}, of the worst case, {}.{}\n",
               scene.worded("peak ground accelerations (PGA)"),
               options.fine
                   ? "searched as by overturn topple"
                   : fmt::format("searched in steps of at most {:.2g} % and refined to {:.2g} %",
                                 100 * toppling_step, 100 * width_of_lowest),
               has_strength ? " The tilt is the largest, over alpha." : "");
    if (widths) {
        fmt::print("{}\n", widths_text(printable(name_of_object(*job.blocks, widths->object)),
                                       scene, *widths));
    }
}

std::string csv_of(const Job& job, const std::vector<ObjectAnswer>& answers)
{
    std::string text;
    for (const ObjectAnswer& answer : answers) {
        const Json row = row_of(job, answer);
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

std::string json_of(const Job& job, const std::vector<ObjectAnswer>& answers,
                    const std::optional<LeastWidths>& widths, const AssessOptions& options)
{
    const Scene& scene = job.problem.scene;
    Json members;
    members["program_version"] = program_version();
    members["table"] = options.objects;
    Json& motion = members["motion"];
    if (const auto pulse = scene.named_pulse()) {
        motion["pulse"] = pulse->name;
        motion["periods"] = options.periods;
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
    members["pga"] = known(options.pga);
    members["scale"] = known(options.scale);
    members["pga_max"] = options.pga_max;
    members["search"] = options.fine ? "fine" : "steps";
    members["step_of_search"] = options.fine ? Json() : Json(toppling_step);
    members["width_of_search"] = options.fine ? Json() : Json(width_of_lowest);
    members["warnings"] = warnings_on(job);
    Json& least_widths = members["least_widths"];
    if (widths) {
        least_widths["object"] = name_of_object(*job.blocks, widths->object);
        least_widths["width"] = widths->width;
        least_widths["end_of_search"] = widths->end;
        least_widths["step_of_search"] =
            step_of_search(scene, {&quantity("width"), widths->width, widths->end});
        least_widths["safe_from"] =
            mapped(widths->safe_from, [](double each) { return known(each); });
    }
    Json& objects = members["objects"] = Json::array();
    for (const ObjectAnswer& answer : answers) {
        objects.push_back(row_of(job, answer));
    }
    return members.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace overturn
