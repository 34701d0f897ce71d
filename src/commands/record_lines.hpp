// The lines that `check` and `run` print about recorded ground motions and columns of tables.
#pragma once

#include "overturn/text/quoting.hpp"

#include "overturn/job/job.hpp"
#include "overturn/problem/given.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace overturn {

/// Lines of a large suite beyond this number are left out.
inline constexpr std::size_t most_record_lines = 10;

inline void shorten(std::vector<std::string>& lines)
{
    if (lines.size() > most_record_lines) {
        const std::size_t more = lines.size() - most_record_lines;
        lines.resize(most_record_lines);
        lines.push_back(fmt::format("and {} more {}", more, noun_of(more, "records")));
    }
}

/// A line for each record whose accelerations are those of an earlier one under another name.
inline std::vector<std::string> lines_of_equal_records(const Job& job)
{
    std::vector<std::string> lines;
    std::map<std::pair<std::string, double>, std::string> names;
    for (std::size_t i = 0; i < job.motions.size(); ++i) {
        const Motion& motion = job.motions[i];
        const double time_step = job.problem.scene.records[i]->time_step();
        const auto [first, is_new] =
            names.emplace(std::pair(motion.checksum, time_step), motion.name);
        if (!is_new) {
            lines.push_back(printable(
                fmt::format("{}: the same accelerations as {}; it counts as another motion",
                            motion.name, first->second)));
        }
    }
    shorten(lines);
    return lines;
}

/// A line for each record: its file, components, duration and intensity. Then a line for each that
/// equals another one.
inline std::vector<std::string> record_lines(const Job& job)
{
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < job.motions.size(); ++i) {
        const Motion& motion = job.motions[i];
        const Accelerogram& record = *job.problem.scene.records[i];
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

/// A line for each record whose vertical motion cancels gravity at some scale of the job.
inline std::vector<std::string> free_fall_lines(const Job& job)
{
    std::vector<std::string> lines;
    const Scene& scene = job.problem.scene;
    if (!scene.is_recorded()) {
        return lines;
    }
    const std::vector<ScaleRange> scales = scales_of(scene, job.problem.grid);
    for (std::size_t i = 0; i < scales.size(); ++i) {
        const double largest = scene.records[i]->free_fall_scale();
        if (std::isfinite(largest) && !(scales[i].largest < largest)) {
            lines.push_back(printable(fmt::format(
                "{}: from the scale {:.6g} on, its vertical motion cancels gravity; these points "
                "are undecided (status 16, free_fall)",
                job.motions[i].name, largest)));
        }
    }
    shorten(lines);
    return lines;
}

/// The names of the columns of the table of a job that describe nothing of a point; empty if there
/// are none.
inline std::string unused_columns(const Job& job)
{
    std::string names;
    if (job.blocks) {
        for (const TableColumn& column : job.blocks->table.columns) {
            if (!job.problem.grid.has_table_column(column.name)) {
                names += (names.empty() ? "" : ", ") + column.name;
            }
        }
    }
    return printable(names);
}

/// What a reader of the log of a run must know of its records and columns.
inline std::vector<std::string> notes_on(const Job& job)
{
    std::vector<std::string> lines = lines_of_equal_records(job);
    const std::vector<std::string> free_fall = free_fall_lines(job);
    lines.insert(lines.end(), free_fall.begin(), free_fall.end());
    if (const std::string names = unused_columns(job); !names.empty()) {
        lines.push_back("columns without effect: " + names);
    }
    return lines;
}

} // namespace overturn
