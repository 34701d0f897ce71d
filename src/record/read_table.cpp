#include "overturn/record/read_table.hpp"

#include "overturn/text/error.hpp"
#include "overturn/text/utf8.hpp"

#include "lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

namespace overturn {

namespace {

/// A cursor over the values of a table.
class Values {
public:
    Values(std::string_view text, const std::string& name) : rest_(text), name_(&name) {}

    bool at_end() const { return rest_.empty(); }
    const std::string& name() const { return *name_; }
    std::int64_t line() const { return line_; }     ///< of the next value, counted from 1
    std::int64_t column() const { return column_; } ///< of the next value, counted from 1

    /// Reads the next value. It is valid until the next call.
    std::string_view next()
    {
        const std::string_view value =
            !rest_.empty() && rest_.front() == '"' ? quoted_value() : plain_value();
        ends_row_ = rest_.empty() || rest_.front() != ',';
        ++column_;
        if (rest_.starts_with("\r\n")) {
            rest_.remove_prefix(1);
        }
        if (!rest_.empty()) {
            if (ends_row_) {
                ++line_;
                column_ = 1;
            }
            rest_.remove_prefix(1);
        }
        return value;
    }

    /// Whether the value that was read last is the last one of its row.
    bool ends_row() const { return ends_row_; }

    [[noreturn]] void refuse(std::int64_t line, std::int64_t column, std::string_view reason) const
    {
        throw Error(exit_code::job, "{}:{}:{}: {}", *name_, line, column, reason);
    }

private:
    std::string_view plain_value()
    {
        const std::size_t end = std::min(rest_.find_first_of(",\n"), rest_.size());
        std::string_view value = rest_.substr(0, end);
        if (end < rest_.size() && rest_[end] == '\n' && value.ends_with('\r')) {
            value.remove_suffix(1);
        }
        rest_.remove_prefix(value.size());
        return trimmed(value);
    }

    /// In quotes, within which two quotes stand for one, and commas and line ends for themselves.
    std::string_view quoted_value()
    {
        unquoted_.clear();
        const std::int64_t first_column = column_;
        for (std::size_t i = 1;; ++i) {
            if (i >= rest_.size()) {
                refuse(line_, first_column,
                       "the quotes are not closed. Add a quotation mark at the end "
                       "of the value.");
            }
            if (rest_[i] == '"') {
                if (i + 1 < rest_.size() && rest_[i + 1] == '"') {
                    ++i;
                } else {
                    rest_.remove_prefix(i + 1);
                    break;
                }
            }
            unquoted_ += rest_[i];
        }
        if (!rest_.empty() && rest_.front() != ',' && rest_.front() != '\n' &&
            !rest_.starts_with("\r\n")) {
            refuse(line_, first_column,
                   "text follows the closing quotes. Put the whole value in quotes, "
                   "and write quotes in it twice.");
        }
        line_ += std::count(unquoted_.begin(), unquoted_.end(), '\n');
        return unquoted_;
    }

    std::string_view rest_;
    const std::string* name_;
    std::string unquoted_;
    std::int64_t line_ = 1;
    std::int64_t column_ = 1;
    bool ends_row_ = false;
};

/// The number, NaN for an empty value; nullopt if it is text.
std::optional<double> number_in(std::string_view value)
{
    if (value.empty()) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    if (value.front() == '+') {
        value.remove_prefix(1);
    }
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    return error == std::errc() && end == value.data() + value.size() ? std::optional(number)
                                                                      : std::nullopt;
}

std::string_view without_byte_order_mark(std::string_view text)
{
    constexpr std::string_view mark = "\xef\xbb\xbf";
    return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

std::string_view without_empty_lines_at_the_end(std::string_view text)
{
    const std::size_t last = text.find_last_not_of("\r\n");
    return last == text.npos ? "" : text.substr(0, last + 1);
}

/// Refuses the first value that is not UTF-8.
void expect_utf8(Values values)
{
    while (!values.at_end()) {
        const std::int64_t line = values.line();
        const std::int64_t column = values.column();
        const std::string_view value = values.next();
        if (!is_utf8(value)) {
            values.refuse(
                line, column,
                fmt::format("{} is not UTF-8. Save the table in UTF-8.", quoted_bytes(value)));
        }
    }
}

std::vector<TableColumn> read_names(Values& values)
{
    std::vector<TableColumn> columns;
    do {
        const std::int64_t line = values.line();
        const std::int64_t column = values.column();
        std::string name(values.next());
        if (name.empty()) {
            values.refuse(line, column,
                          "the column has no name. Name every column in the first line.");
        }
        const auto is_same = [&](const TableColumn& other) { return other.name == name; };
        if (std::any_of(columns.begin(), columns.end(), is_same)) {
            values.refuse(line, column,
                          fmt::format("the name {} is repeated. Give every column a name "
                                      "of its own.",
                                      quoted_bytes(name)));
        }
        columns.push_back({std::move(name), {}, {}});
    } while (!values.ends_row());
    if (columns.size() == 1 && columns[0].name.find_first_of(";\t|") != std::string::npos) {
        values.refuse(1, 1,
                      fmt::format("{} is one name. Separate names and values by commas, and write "
                                  "numbers with a decimal point.",
                                  quoted_bytes(columns[0].name)));
    }
    return columns;
}

/// Calls visit(column number, value) for every value of a row.
template <class Visit>
void for_each_value_of_row(Values& values, std::size_t columns, const Visit& visit)
{
    const std::int64_t line = values.line();
    for (std::size_t i = 0;; ++i) {
        const std::string_view value = values.next();
        if (i < columns) {
            visit(i, value);
        }
        if (values.ends_row()) {
            if (i + 1 != columns) {
                throw Error(exit_code::job,
                            "{}:{}: the row has {} value{}, but the first line "
                            "names {} column{}. Separate values by commas; put "
                            "a value that contains one in quotes. The decimal "
                            "mark is a point.",
                            values.name(), line, i + 1, i == 0 ? "" : "s", columns,
                            columns == 1 ? "" : "s");
            }
            return;
        }
    }
}

} // namespace

const TableColumn* Table::find(std::string_view name) const
{
    const auto found = std::find_if(columns.begin(), columns.end(),
                                    [&](const TableColumn& each) { return each.name == name; });
    return found == columns.end() ? nullptr : &*found;
}

Table read_table(std::string_view text, const std::string& name, std::string_view text_column)
{
    text = without_empty_lines_at_the_end(without_byte_order_mark(text));
    if (text.empty()) {
        throw Error(exit_code::job,
                    name + ":1: the file is empty. The first line names the columns, such as "
                           "width,height,restitution.");
    }
    if (text.find('\0') != text.npos) {
        throw Error(exit_code::job,
                    name + ": is not a table of text, because it contains NUL characters. Save "
                           "it as comma-separated values in UTF-8.");
    }
    Values values(text, name);
    if (!is_utf8(text)) {
        expect_utf8(values);
    }
    Table table;
    table.columns = read_names(values);
    for (TableColumn& column : table.columns) {
        column.first_text = column.name == text_column ? 0 : column.first_text;
    }
    const Values rows = values;
    while (!values.at_end()) {
        const std::int64_t row = table.rows();
        table.lines.push_back(values.line());
        for_each_value_of_row(values, table.columns.size(), [&](std::size_t i, auto value) {
            TableColumn& column = table.columns[i];
            if (column.first_text < 0) {
                if (const std::optional<double> number = number_in(value)) {
                    column.numbers.push_back(*number);
                } else {
                    column.first_text = row;
                    column.numbers.clear();
                }
            }
        });
    }
    if (table.lines.empty()) {
        throw Error(exit_code::job,
                    name + ":2: the table has no rows. Add a line of values for each block.");
    }
    const auto is_text = [](const TableColumn& column) { return column.first_text >= 0; };
    if (std::any_of(table.columns.begin(), table.columns.end(), is_text)) {
        values = rows;
        while (!values.at_end()) {
            for_each_value_of_row(values, table.columns.size(), [&](std::size_t i, auto value) {
                if (is_text(table.columns[i])) {
                    table.columns[i].texts.emplace_back(value);
                }
            });
        }
    }
    return table;
}

} // namespace overturn
