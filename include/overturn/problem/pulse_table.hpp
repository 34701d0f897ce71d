// The shape of a pulse that is given by a table of times over the period, and values.
#pragma once

#include "overturn/problem/given.hpp"
#include "overturn/problem/motion.hpp"

#include <cstddef>
#include <vector>

namespace overturn {

inline constexpr std::size_t most_shape_rows = 1 << 16;

/// Two rows that are closer are a jump for every block; a longer pulse is a record [periods].
inline constexpr double least_shape_step = 1e-9;
inline constexpr double longest_shape = 1000;

/// A pulse, and the number that its values were divided by.
struct ScaledTable {
    TabulatedPulse pulse;
    double peak;    ///< the largest |value|
    double periods; ///< from the first to the last row
};

/// The pulse that begins with the first row, is straight between rows and has the peak 1. times:
/// over the period, ascending [1]; values: in any unit, as many. Throws GivenError with the row
/// that is not allowed, and the column "time" or "value".
ScaledTable pulse_of_table(const std::vector<double>& times, const std::vector<double>& values);

} // namespace overturn
