#include "overturn/problem/grid.hpp"

#include <algorithm>

namespace overturn {

namespace {

template <class Holds>
std::optional<std::size_t> first_dimension(const std::vector<Dimension>& dimensions,
                                           const Holds& holds)
{
    const auto found =
        std::find_if(dimensions.begin(), dimensions.end(), [&](const Dimension& dimension) {
            return std::any_of(dimension.columns.begin(), dimension.columns.end(), holds);
        });
    return found == dimensions.end() ? std::nullopt
                                     : std::optional(std::size_t(found - dimensions.begin()));
}

} // namespace

Shape Grid::shape() const
{
    Shape shape;
    for (const Dimension& dimension : dimensions) {
        shape.push_back(dimension.size());
    }
    return shape;
}

const Column* Grid::find(std::string_view name) const
{
    const auto in = [&](const std::vector<Column>& columns) {
        const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& column) {
            return column.quantity->name == name;
        });
        return found == columns.end() ? nullptr : &*found;
    };
    const Column* found = in(numbers);
    for (const Dimension& dimension : dimensions) {
        found = found != nullptr ? found : in(dimension.columns);
    }
    return found;
}

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

const Column* Grid::axis_or_number(Role role) const
{
    for (const Column& column : numbers) {
        if (column.quantity->role == role) {
            return &column;
        }
    }
    for (const Dimension& dimension : dimensions) {
        if (dimension.name != table_dimension && dimension.columns.front().quantity->role == role) {
            return &dimension.columns.front();
        }
    }
    return nullptr;
}

const Dimension* Grid::table() const
{
    const auto found =
        std::find_if(dimensions.begin(), dimensions.end(),
                     [](const Dimension& each) { return each.name == table_dimension; });
    return found == dimensions.end() ? nullptr : &*found;
}

int order_of(std::string_view dimension, bool is_recorded)
{
    const auto place = [](std::string_view name) {
        return int(find_quantity(name) - all_quantities().data());
    };
    const bool is_size = dimension == "size" || dimension == "frequency_parameter";
    return dimension == table_dimension ? place("width")
           : is_recorded && is_size     ? int(all_quantities().size())
                                        : place(dimension);
}

} // namespace overturn
