// Numbers in files of recorded motions, read exactly and independently of the locale.
#pragma once

#include "lines.hpp"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace overturn {

/// Whether a word is a number, as number_of reads it; it may be infinite, NaN or out of range.
bool is_number(std::string_view word);

/// Whether a number stands for an unknown one, as -999 in COSMOS and CSMIP, and -32768 and 1.7e38
/// in SMC do.
bool is_mark_of_unknown(double number);

/// Half a unit of the last digit of a number: 0.005 for 163.82, 500 for 1.63E+05.
double rounding_of(std::string_view number);

/// Converts a word to a number, correctly rounded. The syntax is that of C, or of Fortran with the
/// exponent letter D and without leading zeros (-.5D-01). Refuses other words, and numbers that are
/// not finite or beyond double precision.
double number_of(const Lines& lines, std::string_view word);

/// A number of points, from `least` to most_samples. Refuses other words. `what` precedes it in
/// messages, such as "NPTS".
std::size_t count_of(const Lines& lines, std::string_view word, std::string_view what,
                     std::size_t least = 1);

/// A time step above 0 [s]. Refuses other words.
double time_step_of(const Lines& lines, std::string_view word);

/// A number of samples per second whose inverse is finite. Refuses other words.
double sampling_rate_of(const Lines& lines, std::string_view word);

/// The numbers of a header that announce the samples, for messages.
struct Announcement {
    std::size_t count;     ///< of samples
    std::string_view name; ///< such as "NPTS"
    std::size_t line;      ///< in which the count is
};

/// All numbers of the remaining lines. They are separated by blanks or by their signs, as in
/// .5E-02-.5E-02. Refuses more and fewer than announced.
std::vector<double> take_free_numbers(Lines& lines, const Announcement& announced);

/// Numbers in columns of equal width [characters].
struct Columns {
    std::size_t width;
    std::size_t per_line;
    std::optional<std::size_t> decimals = {}; ///< if known; tells numbers that touch from cut ones
};

/// A number of a header, as it is printed.
struct Printed {
    Lines lines; ///< at its line
    std::string_view word;
};

/// The announced numbers, from the next lines that are not blank. Refuses lines with more or fewer
/// numbers, numbers that continue beyond their column, and what is not a number. Keeps the first
/// 1000, which is more than any header needs.
std::vector<Printed> take_printed(Lines& lines, const Columns& columns,
                                  const Announcement& announced);

/// The same, converted.
std::vector<double> take_columns(Lines& lines, const Columns& columns,
                                 const Announcement& announced);

/// The text of a column, counted from 0, without blanks; empty if the line is too short.
std::string_view column_of(std::string_view line, std::size_t width, std::size_t index);

/// The accelerations of counts c with the mean m, which is the offset of the sensor:
///
///     a = (c - m) acceleration / counts
///
/// `counts` is the number of counts of `acceleration`, in any unit. lines: where both are stated.
/// Refuses numbers whose accelerations are not finite.
std::vector<double> acceleration_of_counts(const Lines& lines, std::vector<double> samples,
                                           double acceleration, double counts);

} // namespace overturn
