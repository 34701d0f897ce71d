#include "assessment.hpp"

#include "job.hpp"
#include "print.hpp"
#include "topple_ranges.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/quoting.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace overturn {

namespace {

using Json = nlohmann::ordered_json;

constexpr int decimals = 4;

/// A name for the rows that people read: the column `name`, the first column of texts, or the
/// number of the row.
std::string name_of_object(const BlockTable& blocks, std::int64_t object)
{
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

/// The row of an object: the columns of the table, then those of the answer.
Json row_of(const Job& job, const ObjectAnswer& answer)
{
    Json row;
    for (const TableColumn& column : job.blocks->table.columns) {
        const auto i = std::size_t(answer.object);
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
    row["note"] = note_on(answer);
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

std::string note_on(const ObjectAnswer& answer)
{
    std::vector<std::string> notes;
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

void print_assessment(const Job& job, const std::vector<ObjectAnswer>& answers,
                      const AssessOptions& options)
{
    const Scene& scene = job.problem.scene;
    const bool has_strength = answers.front().verdict.has_value();
    const bool may_slip = job.problem.grid.may_slip();
    const std::int64_t cases =
        std::ranges::max(mapped(answers, [](const ObjectAnswer& each) { return each.cases; }));
    print_row("objects", fmt::format("{} in {}", answers.size(), printable(options.objects)));
    if (const Pulse* pulse = scene.pulse()) {
        print_row("motion", fmt::format("{}, period {} s", name_of(pulse->kind),
                                        fmt::join(options.periods, ", ")));
    } else {
        for (const std::string& line : record_lines(job)) {
            print_row("record", scene.worded(line));
        }
    }
    if (has_strength) {
        print_row("strength", scene.worded(options.scale ? fmt::format("scale {}", *options.scale)
                                                         : fmt::format("PGA {} g", *options.pga)));
    }
    if (cases > 1) {
        print_row("cases",
                  fmt::format("up to {} of each object: motions, periods and directions", cases));
    }
    std::size_t width = 6;
    for (const ObjectAnswer& answer : answers) {
        width = std::max(width, name_of_object(*job.blocks, answer.object).size());
    }
    width = std::min<std::size_t>(width, 32);
    fmt::print("\n{:<{}}", "object", width);
    if (has_strength) {
        fmt::print("  {:<16}{:>11}{:>9}", "verdict", "of motions", "tilt");
    }
    fmt::print("{:>13}{}{:>15}", "lifts from", may_slip ? fmt::format("{:>13}", "slides from") : "",
               "topples from");
    if (cases > 1) {
        fmt::print("{:>15}{:>15}", "16 %", "median");
    }
    if (has_strength && may_slip) {
        fmt::print("{:>11}", "slide");
    }
    fmt::print("  note\n");
    for (const ObjectAnswer& answer : answers) {
        std::string name = printable(name_of_object(*job.blocks, answer.object));
        fmt::print("{:<{}}", name.substr(0, width), width);
        if (has_strength) {
            const std::string tilt = std::isnan(answer.peak) ? "unknown"
                                     : std::isinf(answer.peak)
                                         ? "over"
                                         : fmt::format("{:.0f} %", 100 * answer.peak);
            fmt::print("  {:<16}{:>9.0f} %{:>9}", outcome_word(answer),
                       100.0 * double(answer.toppling) / double(answer.cases), tilt);
        }
        const auto moves = [](double pga) {
            return std::isinf(pga) ? std::string("never") : fmt::format("{:.4f} g", pga);
        };
        fmt::print("{:>13}", moves(answer.lifting_pga));
        if (may_slip) {
            fmt::print("{:>13}", answer.moving_pga < answer.lifting_pga ? moves(answer.moving_pga)
                                                                        : "lifts first");
        }
        const auto strength = [&](const std::optional<double>& pga) {
            return strength_text(pga, answer.end_of_search) + " g";
        };
        fmt::print("{:>15}", strength(answer.toppling_pga));
        if (cases > 1) {
            fmt::print("{:>15}{:>15}", strength(answer.percentile_16), strength(answer.median));
        }
        if (has_strength && may_slip) {
            fmt::print("{:>11}", std::isnan(answer.slide)
                                     ? "unknown"
                                     : fmt::format("{:.3g} mm", 1000 * answer.slide));
        }
        const std::string note = note_on(answer);
        fmt::print("{}{}\n", note.empty() ? "" : "  ", note);
    }
    fmt::print("\nStrengths are {}, of the worst case, {}.{}\n",
               scene.worded("peak ground accelerations (PGA)"),
               options.fine
                   ? "searched as by overturn topple"
                   : fmt::format("searched in steps of at most {:.2g} % and refined to {:.2g} %",
                                 100 * toppling_step, 100 * width_of_lowest),
               has_strength ? " The tilt is the largest, over alpha." : "");
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
                    const AssessOptions& options)
{
    const Scene& scene = job.problem.scene;
    Json members;
    members["program_version"] = program_version();
    members["table"] = options.objects;
    Json& motion = members["motion"];
    if (const Pulse* pulse = scene.pulse()) {
        motion["pulse"] = name_of(pulse->kind);
        motion["periods"] = options.periods;
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
    Json& objects = members["objects"] = Json::array();
    for (const ObjectAnswer& answer : answers) {
        objects.push_back(row_of(job, answer));
    }
    return members.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace overturn
