// The points of a problem: single values of some quantities, and the product of dimensions, along
// each of which the values of one or more quantities vary together.
#pragma once

#include "overturn/problem/axis.hpp"
#include "overturn/problem/quantity.hpp"
#include "overturn/problem/tile.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// The values of one quantity along a dimension, or a single value.
struct Column {
    const Quantity* quantity;
    Axis values;
};

/// An axis is a dimension of one column, of the same name; the rows of a table are a dimension of
/// several columns.
struct Dimension {
    std::string name;
    std::vector<Column> columns; ///< at least one, of equal length

    std::int64_t size() const { return columns.front().values.size(); }
};

/// The name of the dimension along the rows of a table.
inline constexpr std::string_view table_dimension = "block";

struct Grid {
    std::vector<Column> numbers;       ///< of one value each
    std::vector<Dimension> dimensions; ///< slowest first

    Shape shape() const;
    std::int64_t points() const { return count_points(shape()); }

    /// The values of a quantity; nullptr if the grid does not contain it.
    const Column* find(std::string_view name) const;

    /// Whether the blocks have a friction coefficient.
    bool may_slip() const { return find("friction") != nullptr; }

    /// The place of the dimension along which a quantity of this name or role varies; nullopt if
    /// there is none.
    std::optional<std::size_t> dimension_of(std::string_view name) const;
    std::optional<std::size_t> dimension_of(Role role) const;

    /// Whether the table has a column of this name.
    bool has_table_column(std::string_view name) const;

    /// The row of the table, from 0, that gives a quantity at a place along dimensions, one of
    /// which is that of the table; -1 if it has no column of this name.
    std::int64_t row_of_table(std::string_view name, const std::vector<std::size_t>& along,
                              std::int64_t place) const;

    /// The coordinates that are not columns of the table, without the motion; the fastest first.
    std::vector<const Column*> outside_table() const;

    /// The first quantity of this role, other than a column of a table; nullptr if there is none.
    const Column* axis_or_number(Role role) const;

    /// Whether blocks are described by quantities of two different sides; they may be equal.
    bool has_two_sides() const;

    /// The rows of a table; nullptr if there are none.
    const Dimension* table() const;
};

/// The grid with only the first and the last value of every axis, but all motions and all rows of a
/// table. All coordinates are monotonic functions of each quantity, so that their smallest and
/// largest values are those of the grid.
Grid corners_of(const Grid& grid);

} // namespace overturn
