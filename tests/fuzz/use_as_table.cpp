#include "hostile_input.hpp"

#include "overturn/problem/pulse_table.hpp"
#include "overturn/problem/quantity.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/table.hpp"

#include <algorithm>
#include <functional>

namespace overturn {

namespace {

/// The columns of numbers with the names of coordinates. Their values are allowed.
std::vector<Given> columns_of(const Table& table)
{
    std::vector<Given> columns;
    for (const TableColumn& column : table.columns) {
        demand(!column.name.empty() && table.find(column.name) == &column, "a name is repeated");
        const bool is_text = column.first_text >= 0;
        demand(std::int64_t(column.numbers.size()) == (is_text ? 0 : table.rows()) &&
                   std::int64_t(column.texts.size()) == (is_text ? table.rows() : 0) &&
                   column.first_text < table.rows(),
               "a column does not have a value in each row");
        const Quantity* quantity = find_quantity(column.name);
        if (!is_text && quantity != nullptr && quantity->applies_under(Pulse::traits) &&
            std::ranges::all_of(column.numbers,
                                [&](double value) { return quantity->allows(value); })) {
            columns.push_back({quantity, column.name, Axis(column.numbers), GivenAs::column});
        }
    }
    return columns;
}

/// As the shape of a pulse.
void use_as_shape(std::string_view bytes, const std::string& name)
{
    try {
        const Table table = read_table_of({"time", "value"}, bytes, name);
        demand(table.columns.size() == 2, "the shape of a pulse does not have two columns");
        if (table.columns[0].first_text < 0 && table.columns[1].first_text < 0) {
            const ScaledTable scaled =
                pulse_of_table(table.columns[0].numbers, table.columns[1].numbers);
            const Accelerogram& shape = *scaled.pulse.shape;
            demand(std::ranges::is_sorted(shape.phases(), std::ranges::less_equal()) &&
                       shape.peak() == 1,
                   "the shape of a pulse does not ascend to the peak 1");
        }
    } catch (const Error& error) {
        demand(std::string_view(error.what()).starts_with(name + ":"),
               "a refusal does not name the file");
    } catch (const GivenError& error) {
        demand(error.row() >= GivenError::no_row, "a refusal names an impossible row");
    }
}

} // namespace

Response use_as_table(std::string_view bytes)
{
    const std::string name = "table.csv";
    use_as_shape(bytes, name);
    try {
        const Table table = read_table(bytes, name);
        demand(table.rows() > 0 && std::is_sorted(table.lines.begin(), table.lines.end()),
               "the lines of the rows do not ascend");
        const Grid grid = grid_of({}, columns_of(table));
        demand(grid.points() == table.rows(), "the grid does not have a point for each row");
        return Response::accepted;
    } catch (const Error& error) {
        const std::string message = error.what();
        demand(message.starts_with(name + ":") && message.ends_with('.'),
               "a refusal does not name the file: " + message);
    } catch (const GivenError& error) {
        demand(error.row() >= GivenError::no_row, "a refusal names an impossible row");
        demand(find_quantity(error.quantity()) != nullptr, "a refusal names no quantity");
    }
    return Response::refused;
}

} // namespace overturn
