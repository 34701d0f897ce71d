#include "overturn/text/table.hpp"

#include "overturn/text/error.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/parse_number.hpp"
#include "overturn/text/quoting.hpp"
#include "overturn/text/utf8.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace overturn {

namespace {

/// A cursor over the values of a table.
class Values {
public:
    Values(std::string_view text, const std::string& name, bool has_comments)
        : rest_(text), name_(&name), has_comments_(has_comments)
    {
        skip_comments();
        separator_ = separator_in(rest_.substr(0, rest_.find('\n')));
    }

    char separator() const { return separator_; }

    bool at_end() const { return rest_.empty(); }
    std::int64_t next_line() const { return next_line_; } ///< of the next value, counted from 1

    /// Whether the value that was read last is the last one of its row.
    bool ends_row() const { return ends_row_; }

    /// Whether the value that was read last is in quotes.
    bool was_quoted() const { return was_quoted_; }

    /// Reads the next value, in UTF-8. It is valid until the next call.
    std::string_view next()
    {
        line_ = next_line_;
        column_ = ends_row_ ? 1 : column_ + 1;
        was_quoted_ = rest_.starts_with('"');
        const std::string_view value = was_quoted_ ? quoted_value() : plain_value();
        if (!is_utf8(value)) {
            refuse("{} is not UTF-8. Save the table in UTF-8.", quoted_bytes(value));
        }
        ends_row_ = !rest_.starts_with(separator_);
        next_line_ += ends_row_ ? 1 : 0;
        rest_.remove_prefix(std::min<std::size_t>(rest_.starts_with("\r\n") ? 2 : 1, rest_.size()));
        if (ends_row_) {
            skip_comments();
        }
        return value;
    }

    /// Throws an Error about the value that was read last.
    template <class... Arguments>
    [[noreturn]] void refuse(fmt::format_string<Arguments...> reason,
                             Arguments&&... arguments) const
    {
        throw Error(exit_code::job, "{}:{}:{}: {}", *name_, line_, column_,
                    fmt::format(reason, std::forward<Arguments>(arguments)...));
    }

    /// The same about a row.
    [[noreturn]] void refuse_row(std::int64_t line, std::string_view reason) const
    {
        throw Error(exit_code::job, "{}:{}: {}", *name_, line, reason);
    }

private:
    void skip_comments()
    {
        while (has_comments_ && rest_.starts_with('#')) {
            rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size() - 1) + 1);
            ++next_line_;
        }
    }

    std::string_view plain_value()
    {
        std::string_view value =
            rest_.substr(0, rest_.find_first_of(std::string{separator_, '\n'}));
        if (value.ends_with('\r') && rest_.size() > value.size() && rest_[value.size()] == '\n') {
            value.remove_suffix(1);
        }
        rest_.remove_prefix(value.size());
        return trimmed(value);
    }

    /// In quotes, within which two quotes stand for one, and commas and line ends for themselves.
    std::string_view quoted_value()
    {
        unquoted_.clear();
        std::size_t first = 1; // the quotation mark before the next part is part of the value
        do {
            const std::size_t end = rest_.find('"', 1);
            if (end == rest_.npos) {
                refuse("the quotes are not closed. Add a quotation mark at the end of the value.");
            }
            unquoted_ += rest_.substr(first, end - first);
            rest_.remove_prefix(end + 1);
            first = 0;
        } while (rest_.starts_with('"'));
        if (!rest_.empty() && rest_.front() != separator_ && rest_.front() != '\n' &&
            !rest_.starts_with("\r\n")) {
            refuse("text follows the closing quotes. Put the whole value in quotes, and write "
                   "quotes in it twice.");
        }
        next_line_ += std::count(unquoted_.begin(), unquoted_.end(), '\n');
        return unquoted_;
    }

    /// The first of these characters outside of quotes; a comma if there is none.
    static char separator_in(std::string_view first_line)
    {
        bool is_quoted = false;
        for (const char letter : first_line) {
            is_quoted = is_quoted != (letter == '"');
            if (!is_quoted && (letter == ',' || letter == ';' || letter == '\t')) {
                return letter;
            }
        }
        return ',';
    }

    std::string_view rest_;
    const std::string* name_;
    bool has_comments_;
    char separator_;
    std::string unquoted_;
    std::int64_t line_ = 1;
    std::int64_t column_ = 0;
    std::int64_t next_line_ = 1;
    bool ends_row_ = true;
    bool was_quoted_ = false;
};

/// Reads numbers with a decimal point or, unless commas separate the values, a decimal comma.
class Numbers {
public:
    explicit Numbers(char separator) : allows_comma_(separator != ',') {}

    /// The number, NaN for an empty value; nullopt if it is text.
    std::optional<double> in(std::string_view value, const Values& values)
    {
        if (value.empty()) {
            return std::numeric_limits<double>::quiet_NaN();
        }
        std::string text(value);
        const std::size_t comma = allows_comma_ ? text.find(',') : text.npos;
        if (comma != text.npos) {
            text[comma] = '.';
        }
        const ParsedNumber number = parse_number(text);
        if (!is_whole(number, text) || number.error != std::errc()) {
            return std::nullopt;
        }
        const char mark = comma != text.npos                    ? ','
                          : text.find('.') != std::string::npos ? '.'
                                                                : mark_;
        if (allows_comma_ && mark_ != '\0' && mark != mark_) {
            values.refuse("{} has a decimal {}, but a number before it a decimal {}. Write all "
                          "numbers with the same decimal mark, and without separators of "
                          "thousands.",
                          quoted_bytes(value), mark == ',' ? "comma" : "point",
                          mark == ',' ? "point" : "comma");
        }
        mark_ = mark;
        return number.value;
    }

private:
    bool allows_comma_;
    char mark_ = '\0'; // of the numbers before; none yet
};

std::vector<TableColumn> read_names(Values& values)
{
    std::vector<TableColumn> columns;
    do {
        std::string name(values.next());
        if (name.empty()) {
            values.refuse("the column has no name. Name every column in the first line.");
        }
        if (!values.was_quoted() && name.find_first_of(",;\t|") != std::string::npos) {
            values.refuse("{} is one name. Separate all names and values by commas, or all by "
                          "semicolons or tabs.",
                          quoted_bytes(name));
        }
        const auto is_same = [&](const TableColumn& other) { return other.name == name; };
        if (std::any_of(columns.begin(), columns.end(), is_same)) {
            values.refuse("the name {} is repeated. Give every column a name of its own.",
                          quoted_bytes(name));
        }
        columns.push_back({std::move(name), {}, {}});
    } while (!values.ends_row());
    return columns;
}

/// Calls visit(line, column number, value, values) for every value of the remaining rows, which
/// must have this number of columns.
template <class Visit>
void for_each_value(Values values, std::size_t columns, const Visit& visit)
{
    while (!values.at_end()) {
        const std::int64_t line = values.next_line();
        std::size_t size = 0;
        do {
            const std::string_view value = values.next();
            if (size < columns) {
                visit(line, size, value, values);
            }
            ++size;
        } while (!values.ends_row());
        if (size != columns) {
            values.refuse_row(
                line,
                fmt::format("the row has {} {}, but the first line names {} {}. "
                            "Separate values as the names; put a value that contains the "
                            "separator in quotes.{}",
                            size, noun_of(size, "values"), columns, noun_of(columns, "columns"),
                            values.separator() == ',' ? " The decimal mark is a point." : ""));
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

namespace {

/// Passes the names of known columns, unless the first line is a row of numbers.
std::vector<TableColumn> columns_named(const std::vector<std::string_view>& names, Values& values)
{
    Values behind_names = values;
    Numbers numbers(values.separator());
    std::size_t size = 0;
    bool is_row = true;
    do {
        is_row = numbers.in(behind_names.next(), behind_names) && is_row;
        ++size;
    } while (!behind_names.ends_row());
    if (size != names.size()) {
        values.next();
        values.refuse("the line has {} {}, but the table has {} columns: {}. Separate them by "
                      "commas, semicolons or tabs.",
                      size, noun_of(size, "columns"), names.size(), fmt::join(names, ", "));
    }
    values = is_row ? values : behind_names;
    return mapped(names, [](std::string_view name) {
        return TableColumn{std::string(name), {}, {}};
    });
}

/// names: of known columns; empty: those of the first line.
Table read_columns(std::string_view text, const std::string& name, std::string_view text_column,
                   const std::vector<std::string_view>& names)
{
    text = without_byte_order_mark(text);
    text = text.substr(0, text.find_last_not_of("\r\n") + 1);
    Values values(text, name, !names.empty());
    if (text.empty()) {
        values.refuse_row(1, names.empty() ? "the file is empty. The first line names the columns, "
                                             "such as width,height,restitution."
                                           : "the file is empty.");
    }
    if (text.find('\0') != text.npos) {
        throw Error(exit_code::job,
                    "{}: is not a table of text, because it contains NUL characters. Save it as "
                    "comma-separated values in UTF-8.",
                    name);
    }
    Table table;
    table.columns = names.empty() ? read_names(values) : columns_named(names, values);
    for (TableColumn& column : table.columns) {
        column.first_text = column.name == text_column ? 0 : column.first_text;
    }
    Numbers numbers(values.separator());
    for_each_value(values, table.columns.size(),
                   [&](std::int64_t line, std::size_t i, auto value, const Values& at) {
                       if (i == 0) {
                           table.lines.push_back(line);
                       }
                       TableColumn& column = table.columns[i];
                       if (column.first_text >= 0) {
                           return;
                       }
                       if (const std::optional<double> number = numbers.in(value, at)) {
                           column.numbers.push_back(*number);
                       } else {
                           column.first_text = table.rows() - 1;
                           column.numbers.clear();
                       }
                   });
    if (table.lines.empty()) {
        values.refuse_row(2, names.empty()
                                 ? "the table has no rows. Add a line of values for each block."
                                 : "the table has no rows. Add lines of numbers.");
    }
    const auto is_text = [](const TableColumn& column) { return column.first_text >= 0; };
    if (std::any_of(table.columns.begin(), table.columns.end(), is_text)) {
        for_each_value(values, table.columns.size(),
                       [&](std::int64_t, std::size_t i, auto value, auto&) {
                           if (is_text(table.columns[i])) {
                               table.columns[i].texts.emplace_back(value);
                           }
                       });
    }
    return table;
}

} // namespace

Table read_table(std::string_view text, const std::string& name, std::string_view text_column)
{
    return read_columns(text, name, text_column, {});
}

Table read_table_of(const std::vector<std::string_view>& columns, std::string_view text,
                    const std::string& name)
{
    return read_columns(text, name, "", columns);
}

} // namespace overturn
