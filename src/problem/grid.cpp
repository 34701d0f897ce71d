#include "overturn/problem/grid.hpp"

#include "overturn/text/mapped.hpp"

#include <algorithm>

namespace overturn {

Shape Grid::shape() const
{
    return mapped(dimensions, &Dimension::size);
}

namespace {

template <class Holds>
std::optional<std::size_t> first_dimension(const std::vector<Dimension>& dimensions,
                                           const Holds& holds)
{
    const auto found = std::ranges::find_if(dimensions, [&](const Dimension& dimension) {
        return std::ranges::any_of(dimension.columns, holds);
    });
    return found == dimensions.end() ? std::nullopt
                                     : std::optional(std::size_t(found - dimensions.begin()));
}

} // namespace

std::optional<std::size_t> Grid::dimension_of(std::string_view name) const
{
    return first_dimension(dimensions,
                           [&](const Column& column) { return column.quantity->name == name; });
}

std::optional<std::size_t> Grid::dimension_of(Role role) const
{
    return first_dimension(dimensions,
                           [&](const Column& column) { return column.quantity->role == role; });
}

bool Grid::has_table_column(std::string_view name) const
{
    const auto dimension = dimension_of(name);
    return dimension && dimensions[*dimension].name == table_dimension;
}

std::int64_t Grid::row_of_table(std::string_view name, const std::vector<std::size_t>& along,
                                std::int64_t place) const
{
    if (!has_table_column(name)) {
        return -1;
    }
    const std::size_t rows = *dimension_of(name);
    for (auto faster = along.rbegin(); *faster != rows; ++faster) {
        place /= dimensions[*faster].size();
    }
    return place % dimensions[rows].size();
}

const Column* Grid::find(std::string_view name) const
{
    const auto dimension = dimension_of(name);
    const std::vector<Column>& columns = dimension ? dimensions[*dimension].columns : numbers;
    const auto found = std::ranges::find_if(
        columns, [&](const Column& column) { return column.quantity->name == name; });
    return found == columns.end() ? nullptr : &*found;
}

std::vector<const Column*> Grid::outside_table() const
{
    std::vector<const Column*> columns;
    const std::span<const Quantity> quantities = all_quantities();
    for (auto quantity = quantities.rbegin(); quantity != quantities.rend(); ++quantity) {
        const Column* const column = find(quantity->name);
        if (column != nullptr && quantity->role != Role::motion &&
            !has_table_column(quantity->name)) {
            columns.push_back(column);
        }
    }
    return columns;
}

const Column* Grid::axis_or_number(Role role) const
{
    for (const Quantity& quantity : all_quantities()) {
        const Column* const column = quantity.role == role ? find(quantity.name) : nullptr;
        if (column != nullptr && !has_table_column(quantity.name)) {
            return column;
        }
    }
    return nullptr;
}

bool Grid::has_two_sides() const
{
    return std::ranges::any_of(all_quantities(), [&](const Quantity& quantity) {
        return (quantity.scope.shapes & shape::two_sides) != 0 && find(quantity.name) != nullptr;
    });
}

const Dimension* Grid::table() const
{
    const auto found = std::ranges::find(dimensions, table_dimension, &Dimension::name);
    return found == dimensions.end() ? nullptr : &*found;
}

Grid corners_of(const Grid& grid)
{
    Grid corners = grid;
    for (Dimension& dimension : corners.dimensions) {
        Column& column = dimension.columns.front();
        if (dimension.name == table_dimension || dimension.name == "motion") {
            continue;
        }
        // What follows from the shape of a block with two different sides is not monotonic.
        constexpr std::int64_t most_of_shape = 17;
        const std::int64_t most =
            grid.has_two_sides() && column.quantity->role == Role::block ? most_of_shape : 2;
        column.values = column.values.thinned(most);
    }
    return corners;
}

} // namespace overturn
