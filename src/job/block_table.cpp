#include "read_steps.hpp"

#include "overturn/record/text_file.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/table.hpp"
#include "overturn/text/utf8.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>

namespace overturn {

namespace {

constexpr TextFileKind table_file{"a table", largest_table_file,
                                  "Give the path of a table, relative to the job file.",
                                  "Split the table."};

constexpr std::string_view motion_column = "motion";

/// Names of columns that the result file needs for itself; the second list: under records.
constexpr std::array<std::string_view, 7> reserved_names{
    "block", "motion_name", "tile", "checksum", "run_token", "crossing", "run"};
constexpr std::array<std::string_view, 5> reserved_under_records{
    "motion_name_length", "record_pga", "pgv", "arias_intensity", "significant_duration"};

// netCDF limits names to 256 bytes, including the suffix of the dimension of a column of texts.
constexpr std::string_view length_suffix = "_length";
constexpr std::size_t longest_name = 255 - length_suffix.size(); // [bytes]

bool is_one_of(std::string_view name, Names names)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The text column whose texts have a length of this name, or nullptr.
const TableColumn* with_length(const Table& table, std::string_view name)
{
    const TableColumn* column = name.ends_with(length_suffix)
                                    ? table.find(name.substr(0, name.size() - length_suffix.size()))
                                    : nullptr;
    return column == nullptr || column->texts.empty() ? nullptr : column;
}

/// The XXH64 of the columns, in hexadecimal digits.
std::string checksum_of(const Table& table)
{
    std::uint64_t hash = 0;
    const auto add = [&](const void* bytes, std::size_t size) { hash = XXH64(bytes, size, hash); };
    for (const TableColumn& column : table.columns) {
        add(column.name.data(), column.name.size());
        add(column.numbers.data(), column.numbers.size() * sizeof(double));
        for (const std::string& text : column.texts) {
            add(text.data(), text.size());
        }
    }
    return fmt::format("{:016x}", hash);
}

void expect_free_name(const BlockTable& blocks, const std::string& name, bool is_recorded)
{
    const auto refuse_name = [&](const std::string& reason) {
        refuse(blocks, {GivenError::no_row, name, reason});
    };
    const Quantity* const quantity_of_name = find_quantity(name);
    const bool is_derived = quantity_of_name != nullptr && quantity_of_name->role == Role::derived;
    if (is_derived || is_one_of(name, reserved_names) || is_one_of(name, field_names()) ||
        (is_recorded && is_one_of(name, reserved_under_records))) {
        refuse_name(" is the name of a variable of the result. Rename the column.");
    }
    if (const TableColumn* texts = with_length(blocks.table, name)) {
        refuse_name(fmt::format(
            " is the name of the dimension of the texts of {} in the result. Rename the column.",
            texts->name));
    }
    const auto lower = [](unsigned char letter) { return std::tolower(letter); };
    for (const Quantity& quantity : all_quantities()) {
        if (name != quantity.name && applies_to(quantity, is_recorded) &&
            std::ranges::equal(name, quantity.name, {}, lower)) {
            refuse_name(fmt::format(" is not the quantity {}, whose name is in lower case. Correct "
                                    "the name, or choose another one.",
                                    quantity.name));
        }
    }
    const auto is_control = [](unsigned char letter) { return letter < 0x20 || letter == 0x7f; };
    const char* reason = name.size() > longest_name              ? "it is too long"
                         : name[0] == '.'                        ? "it begins with a dot"
                         : name.find('/') != name.npos           ? "it contains a slash"
                         : std::ranges::any_of(name, is_control) ? "it contains a control character"
                         : has_white_space(name)                 ? "it contains a blank"
                                                                 : nullptr;
    if (reason != nullptr) {
        throw Error(exit_code::job,
                    "{}:1:{}: the column {} cannot be a variable of a result file, because {}. "
                    "Allowed are up to {} bytes without blanks, slashes and control characters, "
                    "and without a dot at the beginning. Rename the column.",
                    blocks.file, blocks.table.find(name) - blocks.table.columns.data() + 1,
                    in_quotes(shortened(name, 40)), reason, longest_name);
    }
}

/// Refuses values that are not numbers, or not allowed.
void expect_values(const BlockTable& blocks, const TableColumn& column, const Quantity& quantity)
{
    if (column.first_text >= 0) {
        const std::string& text = column.texts[std::size_t(column.first_text)];
        refuse(blocks, {column.first_text, column.name,
                        fmt::format(" = {} is not a number.", in_quotes(shortened(text, 40)))});
    }
    for (std::size_t row = 0; row < column.numbers.size(); ++row) {
        const double value = column.numbers[row];
        if (!quantity.allows(value)) {
            refuse(
                blocks,
                {std::int64_t(row), column.name,
                 std::isnan(value)
                     ? " is empty or not a number. Give a value in every row, or rename the column."
                     : quantity.refusal_of(value)});
        }
    }
}

/// The indices of the motions that have this name, in order: as in Motion::name, or with the file
/// without its folder or also without its ending, or that of the file alone.
std::vector<std::size_t> motions_named(const std::string& name, const std::vector<Motion>& motions)
{
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const Motion& motion = motions[i];
        if (name == motion.name) {
            return {i};
        }
        const std::filesystem::path path(motion.file);
        const std::string suffix = motion.name.substr(motion.file.size());
        for (const std::string& file :
             {path.string(), path.filename().string(), path.stem().string()}) {
            if (name == file || name == file + suffix) {
                found.push_back(i);
                break;
            }
        }
    }
    return found;
}

/// The numbers of the motions that a column names, from 1.
std::vector<double> motion_numbers(const BlockTable& blocks, const TableColumn& column,
                                   const std::vector<Motion>& motions)
{
    std::map<std::string, std::size_t> known;
    std::vector<double> numbers;
    for (const std::string& name : column.texts) {
        if (!known.contains(name)) {
            const auto quoted = [&](std::size_t i) { return in_quotes(motions[i].name); };
            const auto refuse_name = [&](const std::string& reason) {
                refuse(blocks,
                       {std::int64_t(numbers.size()), column.name,
                        fmt::format(" = {} is {}", in_quotes(shortened(name, 40)), reason)});
            };
            const std::vector<std::size_t> found = motions_named(name, motions);
            if (found.empty()) {
                refuse_name(fmt::format(
                    "not a record of the job. Give the name of a file in scene.record, such as {}.",
                    quoted(0)));
            }
            if (found.size() > 1) {
                refuse_name(fmt::format(
                    "the name of several records: {} and {}{}. Give one of these names.",
                    quoted(found[0]), quoted(found[1]), found.size() > 2 ? " and others" : ""));
            }
            known[name] = found[0];
        }
        numbers.push_back(double(known[name] + 1));
    }
    return numbers;
}

/// Refuses a column of texts that name records of a suite: it would not assign them to the blocks.
void expect_no_records(const BlockTable& blocks, const TableColumn& column,
                       const std::vector<Motion>& motions)
{
    const auto names_motion = [&](const std::string& text) {
        return !motions_named(text, motions).empty();
    };
    if (motions.size() > 1 && !column.texts.empty() &&
        std::ranges::all_of(column.texts, names_motion)) {
        refuse(blocks,
               {GivenError::no_row, column.name,
                fmt::format(" names records of the job, but each block is computed under all of "
                            "them. Rename the column to {} to assign the records to the blocks, or "
                            "remove it.",
                            motion_column)});
    }
}

} // namespace

BlockTable read_block_table(const std::string& file, const std::string& folder,
                            const std::vector<Motion>& motions)
{
    const std::string path = (std::filesystem::path(folder) / file).string();
    const bool is_recorded = !motions.empty();
    BlockTable blocks{
        file, read_table(text_of_file(path, table_file), file, is_recorded ? motion_column : ""),
        ""};
    for (TableColumn& column : blocks.table.columns) {
        const Quantity* const quantity = find_quantity(column.name);
        // Under a pulse, the motion is a column like any other.
        if (is_recorded && column.name == motion_column) {
            column = {column.name, motion_numbers(blocks, column, motions), {}};
        } else if (quantity == nullptr || !quantity->is_coordinate() ||
                   quantity->role == Role::motion) {
            expect_free_name(blocks, column.name, is_recorded);
            expect_no_records(blocks, column, motions);
        } else {
            expect_values(blocks, column, *quantity);
        }
    }
    blocks.checksum = checksum_of(blocks.table);
    return blocks;
}

std::vector<Given> columns_of(const BlockTable& blocks, bool is_recorded)
{
    std::vector<Given> columns;
    for (const TableColumn& column : blocks.table.columns) {
        const Quantity* const quantity = find_quantity(column.name);
        if (quantity != nullptr && applies_to(*quantity, is_recorded)) {
            columns.push_back({quantity, column.name, Axis(column.numbers), GivenAs::column});
        }
    }
    return columns;
}

void refuse(const BlockTable& blocks, const GivenError& error)
{
    const Table& table = blocks.table;
    const TableColumn* const column = table.find(error.quantity());
    throw Error(exit_code::job, "{}:{}{}: {}{}", blocks.file,
                error.row() < 0 ? 1 : table.lines[std::size_t(error.row())],
                column == nullptr ? "" : fmt::format(":{}", column - table.columns.data() + 1),
                error.quantity(), error.what());
}

} // namespace overturn
