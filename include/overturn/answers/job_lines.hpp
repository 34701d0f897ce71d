// What a job contains, for people: coordinates in degrees, metres, seconds and g; recorded ground
// motions; columns of tables; and what is allowed, but probably not what was meant.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/problem/coordinates.hpp"

#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

inline double in_degrees(double angle)
{
    return angle * 180 / std::numbers::pi;
}

/// The extent of a coordinate over all points of a job; nullopt if the coordinate is not known.
std::optional<Extent> extent_of(const Job& job, std::string_view name);

/// R of the side plus of the only block [m]; nullopt if it is not known.
std::optional<double> size_of_only_block(const Job& job);

std::string block_line(const Job& job);

/// A line for each record: its file, components, duration and intensity. Then a line for each that
/// equals another one.
std::vector<std::string> record_lines(const Job& job);

/// The table of the pulse: its file, rows and duration, and by what its values were divided.
std::string shape_line(const ShapeTable& table);

/// A line for each record whose vertical motion cancels gravity at some scale of the job.
std::vector<std::string> free_fall_lines(const Job& job);

/// The names of the columns of the table of a job that describe nothing of a point; empty if there
/// are none.
std::string unused_columns(const Job& job);

/// What a reader of the log of a run must know of its records and columns.
std::vector<std::string> notes_on(const Job& job);

/// What looks like a mistake in the units or in the header of a record, and misspelt columns of a
/// table; without full stops.
std::vector<std::string> warnings_on(const Job& job);

} // namespace overturn
