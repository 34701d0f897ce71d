// Blocks that are given one by one, as the rows of a table, instead of by the axes of a plane.
#pragma once

#include "overturn/sweep/plane.hpp"

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace overturn {

/// Named columns of equal length. Those that block_list() does not name are not read.
using Columns = std::map<std::string, std::vector<double>>;

/// An error in the columns of a list. The message does not include the place of the error.
class ListError : public std::runtime_error {
public:
    ListError(std::int64_t row, std::string column, const std::string& message)
        : std::runtime_error(message), row_(row), column_(std::move(column))
    {}

    static constexpr std::int64_t no_row = -1;

    std::int64_t row() const { return row_; } ///< from 0; no_row: the columns do not fit together
    const std::string& column() const { return column_; } ///< empty if no column is concerned

private:
    std::int64_t row_;
    std::string column_;
};

/// Reads the columns of a list:
///   - width and height, or half_width and half_height [m], or slenderness [rad] with size (R) [m]
///     or frequency_parameter (p) [1/s]; under pulses without units, slenderness alone;
///   - restitution (r), or restitution_of_maximum (r / r_max);
///   - for motions of their own: amplitude or pga [g], and frequency, pulse_period [s] or
///     pulse_frequency [Hz]; under records, scale or pga [g], and the number of the record.
/// motion: the number of the record of each row; empty: the only one, or none. Throws ListError.
BlockList block_list(const Scene& scene, const Columns& columns,
                     const std::vector<std::int64_t>& motion = {});

} // namespace overturn
