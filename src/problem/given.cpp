#include "overturn/problem/given.hpp"

#include "grid_checks.hpp"

#include "overturn/problem/coordinates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace overturn {

namespace {

void expect_no_alternatives(const std::vector<Given>& given)
{
    for (std::size_t i = 1; i < given.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const Given& one = given[i];
            const Given& other = given[j];
            if (!exclude_each_other(one.quantity->name, other.quantity->name)) {
                continue;
            }
            const bool is_column = other.as == GivenAs::column && one.as != GivenAs::column;
            throw GivenError(
                GivenError::no_row, one.quantity->name,
                fmt::format(" cannot be combined with {}{}, which {}. Remove one of them.",
                            is_column ? "the column " : "", other.label,
                            are_equivalent(one.quantity->name, other.quantity->name)
                                ? "gives the same quantity"
                                : "describes the block in another way"));
        }
    }
}

/// The place of an axis among the dimensions; smaller is slower. Under records, the size of the
/// block is the fastest.
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

} // namespace

bool applies_to(const Quantity& quantity, bool is_recorded)
{
    switch (quantity.role) {
    case Role::motion: return is_recorded;
    case Role::direction:
    case Role::block:
    case Role::loss: return true;
    case Role::strength: return quantity.name == "pga" || (quantity.name == "scale") == is_recorded;
    case Role::rate: return !is_recorded;
    case Role::derived:
    case Role::setting: break;
    }
    return false;
}

Grid grid_of(const Scene& scene, std::vector<Given> given)
{
    // In the order of all_quantities(), into which these are pointers.
    std::stable_sort(given.begin(), given.end(), [](const Given& one, const Given& other) {
        return one.quantity < other.quantity;
    });
    expect_no_alternatives(given);
    Grid grid;
    Dimension table{std::string(table_dimension), {}};
    for (Given& each : given) {
        Column column{each.quantity, std::move(each.values)};
        if (each.as == GivenAs::column) {
            table.columns.push_back(std::move(column));
        } else if (each.as == GivenAs::number) {
            grid.numbers.push_back(std::move(column));
        } else {
            grid.dimensions.push_back({std::string(each.quantity->name), {std::move(column)}});
        }
    }
    if (!table.columns.empty()) {
        grid.dimensions.push_back(std::move(table));
    }
    // The rows of a table have the place of the width, the first quantity of a block. Under
    // records, the size of the block comes last.
    const bool is_recorded = scene.is_recorded();
    std::stable_sort(grid.dimensions.begin(), grid.dimensions.end(),
                     [&](const Dimension& one, const Dimension& other) {
                         return order_of(one.name, is_recorded) < order_of(other.name, is_recorded);
                     });
    expect_valid(scene, grid);
    return grid;
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
        if (column.values.size() > most) {
            AxisList values;
            for (std::int64_t i = 0; i < most; ++i) {
                values.push_back(column.values[i * (column.values.size() - 1) / (most - 1)]);
            }
            column.values = Axis(values);
        }
    }
    return corners;
}

std::vector<ScaleRange> scales_of(const Scene& scene, const Grid& grid)
{
    const Grid corners = corners_of(grid);
    const Coordinates coordinates(scene, corners);
    // One of scale and pga is given, and the other varies along the dimensions of the strength and
    // the motion.
    const std::string_view derived = corners.find("pga") != nullptr ? "scale" : "pga";
    const std::vector<std::size_t>& dimensions = coordinates.of(derived).dimensions;
    const std::vector<double> scale = coordinates.along(dimensions, "scale");
    const std::vector<double> motion = coordinates.along(dimensions, "motion");
    std::vector<ScaleRange> ranges(scene.records.size(),
                                   {std::numeric_limits<double>::infinity(), 0});
    for (std::size_t i = 0; i < scale.size(); ++i) {
        ScaleRange& range = ranges[Scene::record_index(motion[i])];
        range = {std::min(range.smallest, scale[i]), std::max(range.largest, scale[i])};
    }
    return ranges;
}

} // namespace overturn
