#include "hostile_input.hpp"

#include "overturn/record/read_table.hpp"
#include "overturn/sweep/block_list.hpp"
#include "overturn/sweep/quantity.hpp"

#include <algorithm>
#include <stdexcept>

namespace overturn {

namespace {

void demand(bool condition, const std::string& otherwise)
{
    if (!condition) {
        throw std::logic_error(otherwise);
    }
}

/// The columns of numbers with known names.
Columns columns_of(const Table& table)
{
    Columns columns;
    for (const TableColumn& column : table.columns) {
        demand(!column.name.empty() && table.find(column.name) == &column, "a name is repeated");
        const bool is_text = column.first_text >= 0;
        demand(std::int64_t(column.numbers.size()) == (is_text ? 0 : table.rows()) &&
                   std::int64_t(column.texts.size()) == (is_text ? table.rows() : 0) &&
                   column.first_text < table.rows(),
               "a column does not have a value in each row");
        if (!is_text && find_quantity(column.name) != nullptr) {
            columns[column.name] = column.numbers;
        }
    }
    return columns;
}

} // namespace

Verdict use_as_table(std::string_view bytes)
{
    const std::string name = "table.csv";
    try {
        const Table table = read_table(bytes, name);
        demand(table.rows() > 0 && std::is_sorted(table.lines.begin(), table.lines.end()),
               "the lines of the rows do not ascend");
        const BlockList list = block_list({}, columns_of(table));
        demand(list.size == table.rows(), "the list does not have a block in each row");
        return Verdict::accepted;
    } catch (const TableError& error) {
        const std::string message = error.what();
        demand(message.starts_with(name + ":") && message.ends_with('.'),
               "a refusal does not name the file: " + message);
    } catch (const ListError& error) {
        demand(error.row() >= ListError::no_row, "a refusal names an impossible row");
    }
    return Verdict::refused;
}

} // namespace overturn
