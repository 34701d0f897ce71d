// Reads tables of values that are separated by commas (RFC 4180), semicolons or tabs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// A column holds numbers if each of its values is one, or empty, which is read as NaN.
struct TableColumn {
    std::string name;
    std::vector<double> numbers;    ///< empty if the column holds text
    std::vector<std::string> texts; ///< empty if the column holds numbers
    std::int64_t first_text = -1;   ///< the first row whose value is not a number; -1: none
};

struct Table {
    std::vector<TableColumn> columns; ///< at least one, whose names differ
    std::vector<std::int64_t> lines;  ///< of each row in the file, counted from 1; at least one

    std::int64_t rows() const { return std::int64_t(lines.size()); }

    /// The column of this name, or nullptr.
    const TableColumn* find(std::string_view name) const;
};

inline constexpr std::uint64_t largest_table_file = std::uint64_t(1) << 32; ///< [bytes]

/// Reads the text of a file, in UTF-8; `name` replaces the path in messages. The first line names
/// the columns; what separates the first two names separates all values. Unless these are commas,
/// numbers may have a decimal comma. Lines end with LF or CR LF; empty ones at the end are skipped.
/// text_column: a column whose values are texts even if they look like numbers. Throws Error.
Table read_table(std::string_view text, const std::string& name, std::string_view text_column = "");

/// The same for columns of known names: a first line of numbers is a row, other names are replaced,
/// and lines that begin with # are comments. Refuses another number of columns.
Table read_table_of(const std::vector<std::string_view>& columns, std::string_view text,
                    const std::string& name);

} // namespace overturn
