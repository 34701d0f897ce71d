// What the comments of a text state: units, and the time step. Words that may contradict what the
// user has given are refused; a comment can be corrected or removed.
#pragma once

#include "lines.hpp"
#include "overturn/record/read_record.hpp"

#include <optional>
#include <string_view>

namespace overturn {

/// Whether a line of text is a comment.
bool is_comment(std::string_view line);

/// The value of a comment `KEY = VALUE`, without quotes; nullopt if it is another comment.
std::optional<std::string_view> value_of(std::string_view comment, std::string_view key);

/// Proceeds to the next line that is neither blank nor a comment; false if there is none.
bool next_content(Lines& lines);

/// Refuses a comment that states another unit of the samples than this one, in brackets, in the
/// name of a column (acc_g) or anywhere else, a multiple (g/10, 0.01 g, % of g), or a unit of time
/// other than the second. Units of other quantities (depth (km), Vs30 (m/s): 360, PGA 0.35 g, 1.25
/// V/g) and definitions (g = 9.81) are skipped. A unit of acceleration is that of the samples
/// unless the words before it say that it is not; another one only if they name acceleration or a
/// column.
void expect_unit(const Lines& comment, AccelerationUnit unit);

/// Refuses a comment about velocities or displacements, such as "velocity time series". Peak
/// values, velocities of waves and displacements of faults are skipped.
void expect_no_other_motion(const Lines& comment);

/// Refuses a comment that states a time step or a rate, as in DT= .01, "time step: 10 ms" or
/// "sampling rate 100 Hz", but not this time step [s].
void expect_time_step(const Lines& comment, double time_step);

} // namespace overturn
