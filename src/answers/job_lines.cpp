#include "overturn/answers/job_lines.hpp"

#include "overturn/job/schema.hpp"
#include "overturn/mechanics/block.hpp"
#include "overturn/problem/plausibility.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/nearest_name.hpp"
#include "overturn/text/quoting.hpp"

#include <boost/algorithm/string/predicate.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <ranges>
#include <utility>

namespace overturn {

std::optional<Extent> extent_of(const Job& job, std::string_view name)
{
    const Grid corners = corners_of(job.problem.grid);
    const Coordinates coordinates(job.problem.scene, corners);
    return coordinates.has(name) ? std::optional(extent_of(coordinates.of(name).values))
                                 : std::nullopt;
}

namespace {

std::string degrees_text(const Extent& angle)
{
    return Extent{in_degrees(angle.first), in_degrees(angle.last)}.text(" degrees");
}

/// What describes blocks with two different sides: the incline unless the base is level, alpha, p
/// and R of the sides plus and minus, r_max.
std::string two_sides_line(const Job& job)
{
    const auto of_both = [&](std::string_view plus, std::string_view minus, const auto& text) {
        return fmt::format("{} (+), {} (-)", text(*extent_of(job, plus)),
                           text(*extent_of(job, minus)));
    };
    const auto in = [](std::string_view unit) {
        return [unit](const Extent& extent) { return extent.text(unit); };
    };
    constexpr double rounding = 1e-12; // [rad], of an incline that angles and distances imply
    const Extent incline = *extent_of(job, "incline");
    const bool is_level = std::max(-incline.first, incline.last) < rounding;
    return fmt::format("{}alpha = {}; R = {}; p = {} (g = {} m/s2); r_max = {}{}",
                       is_level ? "" : fmt::format("incline {}, ", degrees_text(incline)),
                       of_both("slenderness_plus", "slenderness_minus", degrees_text),
                       of_both("size_plus", "size_minus", in(" m")),
                       of_both("frequency_parameter", "frequency_parameter_minus", in(" 1/s")),
                       job.problem.scene.gravity, extent_of(job, "largest_restitution")->text(""),
                       job.blocks ? ", r = " + extent_of(job, "restitution")->text("") : "");
}

/// Lines of a large suite beyond this number are left out.
constexpr std::size_t most_record_lines = 10;

void shorten(std::vector<std::string>& lines)
{
    if (lines.size() > most_record_lines) {
        const std::size_t more = lines.size() - most_record_lines;
        lines.resize(most_record_lines);
        lines.push_back(fmt::format("and {} more {}", more, noun_of(more, "records")));
    }
}

/// A line for each record whose accelerations are those of an earlier one under another name.
std::vector<std::string> lines_of_equal_records(const Job& job)
{
    std::vector<std::string> lines;
    std::map<std::pair<std::string, double>, std::string> names;
    for (const RecordedMotion& motion : job.motions) {
        const auto [first, is_new] =
            names.emplace(std::pair(motion.checksum, motion.record->time_step()), motion.name);
        if (!is_new) {
            lines.push_back(printable(
                fmt::format("{}: the same accelerations as {}; it counts as another motion",
                            motion.name, first->second)));
        }
    }
    shorten(lines);
    return lines;
}

/// How many words of the name of a quantity or of its synonyms begin with four letters that the
/// column contains, ignoring case.
int shared_words(std::string_view column, std::string_view quantity)
{
    std::string words(quantity);
    words += quantity == "incline"         ? "_lean_tilt"
             : quantity == "center_offset" ? "_eccentricity"
                                           : "";
    return int(std::ranges::count_if(words | std::views::split('_'), [&](const auto& word) {
        const auto beginning = std::string_view(word.begin(), word.end()).substr(0, 4);
        return beginning.size() > 2 && boost::algorithm::icontains(column, beginning);
    }));
}

/// Whether a number of the job is r_max, the restitution of blocks of which none is known.
bool is_largest_restitution(const Column& number)
{
    return number.quantity->name == "restitution_of_maximum" && number.values.values().front() == 1;
}

/// The quantity that a column without effect probably gives: its name is misspelt, or shares a word
/// with it, as in incline_deg. Empty if there is none, or if the points do not lack it.
std::string_view quantity_meant_by(std::string_view column, const Grid& grid)
{
    const auto is_lacking = [&](std::string_view name) {
        const auto excludes = [&](const Column& given) {
            return given.quantity->name == name || exclude_each_other(given.quantity->name, name);
        };
        return std::ranges::none_of(grid.numbers,
                                    [&](const Column& number) {
                                        return excludes(number) && !is_largest_restitution(number);
                                    }) &&
               std::ranges::none_of(grid.dimensions, [&](const Dimension& each) {
                   return std::ranges::any_of(each.columns, excludes);
               });
    };
    std::vector<std::string_view> names = keys_of("plane");
    std::erase_if(names, [&](std::string_view name) { return !is_lacking(name); });
    // The coefficient of restitution is the ratio of velocities.
    if (boost::algorithm::icontains(column, "coef") &&
        boost::algorithm::icontains(column, "restitution") && is_lacking("velocity_restitution")) {
        return "velocity_restitution";
    }
    if (const std::string_view nearest = nearest_name(column, names); !nearest.empty()) {
        return nearest;
    }
    std::string_view meant;
    int most = 0;
    for (const std::string_view name : names) {
        if (const int shared = shared_words(column, name); shared > most) {
            most = shared;
            meant = name;
        }
    }
    return meant;
}

} // namespace

std::vector<std::string> free_fall_lines(const Job& job)
{
    std::vector<std::string> lines;
    const Scene& scene = job.problem.scene;
    const std::vector<Extent> scales = scales_of(scene, job.problem.grid);
    for (std::size_t i = 0; i < scales.size(); ++i) {
        const double largest = scene.records()[i]->free_fall_scale();
        if (std::isfinite(largest) && !(scales[i].last < largest)) {
            lines.push_back(printable(fmt::format(
                "{}: from the scale {:.6g} on, its vertical motion cancels gravity; these points "
                "are undecided (status 16, free_fall)",
                job.motions[i].name, largest)));
        }
    }
    shorten(lines);
    return lines;
}

std::string unused_columns(const Job& job)
{
    if (!job.blocks) {
        return "";
    }
    auto names = job.blocks->table.columns | std::views::transform(&TableColumn::name) |
                 std::views::filter([&](const std::string& name) {
                     return !job.problem.grid.has_table_column(name) &&
                            name != column_of_azimuths && name != column_of_samples;
                 });
    return printable(fmt::format("{}", fmt::join(names, ", ")));
}

std::optional<double> size_of_only_block(const Job& job)
{
    for (const char* name : {"size", "size_plus"}) {
        if (const auto extent = extent_of(job, name)) {
            return extent->first;
        }
    }
    return std::nullopt;
}

std::string block_line(const Job& job)
{
    std::string line;
    if (job.blocks) {
        line = fmt::format("{} of {}: ", job.blocks->table.rows(), job.blocks->file);
    }
    if (job.problem.grid.has_two_sides()) {
        return line + two_sides_line(job);
    }
    const Extent alpha = *extent_of(job, "slenderness");
    line += "alpha = " + degrees_text(alpha);
    if (job.blocks) {
        line += ", r = " + extent_of(job, "restitution")->text("");
    } else if (const auto least = r_max_of(alpha.last)) {
        line += ", r_max = " + Extent{*least, largest_restitution(alpha.first)}.text("");
    }
    if (const auto size = extent_of(job, "size")) {
        line += fmt::format(", R = {}, p = {} (g = {} m/s2)", size->text(" m"),
                            extent_of(job, "frequency_parameter")->text(" 1/s"),
                            job.problem.scene.gravity);
    }
    return line;
}

std::vector<std::string> record_lines(const Job& job)
{
    std::vector<std::string> lines;
    for (const RecordedMotion& motion : job.motions) {
        const Accelerogram& record = *motion.record;
        const std::string component =
            (motion.component.empty() ? "" : fmt::format(", component {}", motion.component)) +
            (motion.second.empty() ? ""
                                   : fmt::format(", second {} up to {:.3g} g", motion.second,
                                                 record.in_direction(90).peak())) +
            (motion.vertical.empty() ? ""
                                     : fmt::format(", vertical {} up to {:.3g} g", motion.vertical,
                                                   record.upwards_peak())) +
            (motion.is_uncorrected ? ", not corrected" : "");
        lines.push_back(printable(fmt::format("{}{}: {} samples, {:.6g} s, {:.3g} g, {:.3g} m/s",
                                              motion.file, component, record.samples(),
                                              double(record.samples() - 1) * record.time_step(),
                                              motion.measures.pga, motion.measures.pgv)));
    }
    shorten(lines);
    const std::vector<std::string> equal = lines_of_equal_records(job);
    lines.insert(lines.end(), equal.begin(), equal.end());
    return lines;
}

std::string shape_line(const ShapeTable& table)
{
    return printable(fmt::format("{}{} rows over {:.6g} {}, values divided by {:.6g}",
                                 table.file.empty() ? "" : table.file + ": ",
                                 table.shape->samples(), table.periods,
                                 table.periods == 1 ? "period" : "periods", table.peak));
}

std::vector<std::string> notes_on(const Job& job)
{
    std::vector<std::string> lines = lines_of_equal_records(job);
    const std::vector<std::string> free_fall = free_fall_lines(job);
    lines.insert(lines.end(), free_fall.begin(), free_fall.end());
    if (const std::string names = unused_columns(job); !names.empty()) {
        lines.push_back("columns not used in the computation: " + names);
    }
    return lines;
}

namespace {

/// The directions in which a motion is computed [degree].
std::vector<double> directions_in(const Grid& grid)
{
    const Column* const given = grid.find("direction");
    return given == nullptr ? std::vector<double>{0} : given->values.values();
}

bool is_along_first(double direction)
{
    return std::remainder(direction, 180) == 0;
}

/// Whether a column of a table, such as depth_cm, is the other side of the base and shorter than
/// the width in some row. width: in metres.
bool is_depth_below(const TableColumn& column, const TableColumn& width)
{
    constexpr std::array<std::pair<std::string_view, double>, 4> units{
        {{"depth", 1}, {"depth_m", 1}, {"depth_cm", 0.01}, {"depth_mm", 0.001}}};
    const auto unit =
        std::ranges::find(units, column.name, &std::pair<std::string_view, double>::first);
    if (unit == units.end()) {
        return false;
    }
    for (std::size_t row = 0; row < column.numbers.size(); ++row) {
        if (unit->second * column.numbers[row] < width.numbers[row]) {
            return true;
        }
    }
    return false;
}

} // namespace

std::vector<std::string> warnings_on(const Job& job)
{
    const Grid& grid = job.problem.grid;
    std::vector<std::string> warnings;
    if (std::string values = implausible_values(job.problem.scene, grid); !values.empty()) {
        warnings.push_back(std::move(values));
    }
    for (const RecordedMotion& motion : job.motions) {
        std::ranges::copy_if(motion.remarks, std::back_inserter(warnings),
                             [&](const auto& remark) { return !is_one_of(remark, warnings); });
        if (motion.ground_pga && grid.find("pga") != nullptr) {
            warnings.push_back(fmt::format(
                "pga is the peak of the floor, {:.4g} g in {} as it stands, where ground_pga = "
                "{:.4g} g (for this earthquake, give scale = 1)",
                motion.measures.pga, motion.file, *motion.ground_pga));
        }
    }
    if (job.problem.scene.has_two_components() &&
        std::ranges::all_of(directions_in(grid), is_along_first)) {
        warnings.push_back("the second horizontal component has no effect, since the motion is "
                           "computed only in the "
                           "direction of the first one; give several values of direction, such as "
                           "0, 15, 30 ... 345");
    }
    for (const TableColumn& column :
         job.blocks ? job.blocks->table.columns : std::vector<TableColumn>()) {
        if (grid.has_table_column(column.name)) {
            continue;
        }
        if (is_one_of(column.name, keys_of("scene")) || find_quantity(column.name) != nullptr) {
            warnings.push_back(
                fmt::format("the column {} of {} has no effect: it is a key of the job, but not a "
                            "property of the blocks under this motion",
                            in_quotes(column.name), job.blocks->file));
        } else if (const TableColumn* width = job.blocks->table.find("width");
                   width != nullptr && is_depth_below(column, *width)) {
            warnings.push_back(fmt::format("the column {} of {} has no effect, but the depth of an "
                                           "object is smaller than its width: "
                                           "it topples first over its shorter side. Give that as "
                                           "the width, or both as rows with the "
                                           "same {}",
                                           in_quotes(column.name), job.blocks->file,
                                           column_of_azimuths));
        } else if (const std::string_view meant = quantity_meant_by(column.name, grid);
                   !meant.empty()) {
            warnings.push_back(fmt::format("the column {} of {} has no effect (did you mean {}?)",
                                           in_quotes(column.name), job.blocks->file, meant));
        }
    }
    return warnings;
}

} // namespace overturn
