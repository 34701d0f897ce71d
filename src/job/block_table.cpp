#include "block_table.hpp"

#include "motion_names.hpp"
#include "overturn/text/table.hpp"
#include "overturn/text/text_file.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/utf8.hpp"
#include "toml_reading.hpp"
#include "toml_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace overturn {

namespace {

constexpr TextFileKind table_file{"a table", largest_table_file,
                                  "Give the path of a table, relative to the job file.",
                                  "Split the table."};

constexpr std::string_view motion_column = "motion";

/// Names of columns that the result file needs for itself; the second list: under records.
constexpr std::array<std::string_view, 8> reserved_names{
    "block", "motion_name", "tile", "checksum", "run_token", "crossing", "motion_number", "run"};
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
    if (!name.ends_with(length_suffix)) {
        return nullptr;
    }
    const TableColumn* column = table.find(name.substr(0, name.size() - length_suffix.size()));
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

} // namespace

BlockTableReader::BlockTableReader(std::string file, const std::string& folder,
                                   const std::vector<Motion>& motions)
    : file_(std::move(file)),
      table_(read_table(text_of_file((std::filesystem::path(folder) / file_).string(), table_file),
                        file_, motions.empty() ? "" : motion_column))
{
    const bool is_recorded = !motions.empty();
    for (TableColumn& column : table_.columns) {
        const Quantity* quantity = find_quantity(column.name);
        if (is_recorded && column.name == motion_column) {
            std::vector<double> numbers = motion_numbers(motions);
            column = {"motion_number", numbers, {}};
            columns_.push_back(
                {quantity, std::string(motion_column), Axis(std::move(numbers)), GivenAs::column});
            continue;
        }
        // Under a pulse, the motion is a column like any other.
        if (quantity == nullptr || !quantity->is_coordinate() || quantity->role == Role::motion) {
            expect_free_name(column.name, is_recorded);
            continue;
        }
        if (column.first_text >= 0) {
            const std::string& text = column.texts[std::size_t(column.first_text)];
            refuse(column.first_text, column.name,
                   fmt::format("{} = {} is not a number.", column.name,
                               in_quotes(shortened(text, 40))));
        }
        for (std::size_t row = 0; row < column.numbers.size(); ++row) {
            const double value = column.numbers[row];
            if (std::isnan(value)) {
                refuse(std::int64_t(row), column.name,
                       fmt::format("{} is empty or not a number. Give a value in every row, or "
                                   "rename the column.",
                                   column.name));
            }
            if (!quantity->allows(value)) {
                refuse(std::int64_t(row), column.name,
                       fmt::format("{} = {} is outside {}. {}", column.name, value,
                                   quantity->interval, quantity->reason));
            }
        }
        if (applies_to(*quantity, is_recorded)) {
            columns_.push_back({quantity, column.name, Axis(column.numbers), GivenAs::column});
        }
    }
}

std::vector<Given> BlockTableReader::columns() const
{
    return columns_;
}

BlockTable BlockTableReader::result() &&
{
    std::string checksum = checksum_of(table_);
    return {std::move(file_), std::move(table_), std::move(checksum)};
}

void BlockTableReader::refuse(const GivenError& error) const
{
    const bool is_column = table_.find(error.quantity()) != nullptr;
    refuse(error.row(), error.quantity(),
           is_column && error.row() < 0 ? std::string_view(error.what()).substr(1)
                                        : error.quantity() + error.what());
}

void BlockTableReader::refuse(std::int64_t row, std::string_view column,
                              std::string_view reason) const
{
    const auto found = std::find_if(table_.columns.begin(), table_.columns.end(),
                                    [&](const TableColumn& each) { return each.name == column; });
    const std::int64_t line = row < 0 ? 1 : table_.lines[std::size_t(row)];
    std::string place = fmt::format("{}:{}", file_, line);
    if (found != table_.columns.end()) {
        place += fmt::format(":{}", found - table_.columns.begin() + 1);
    }
    const bool names_column = row < 0 && found != table_.columns.end();
    throw Error(exit_code::job, "{}: {}{}{}", place, names_column ? column : "",
                names_column ? " " : "", reason);
}

std::vector<double> BlockTableReader::motion_numbers(const std::vector<Motion>& motions) const
{
    const TableColumn& column = *table_.find(motion_column);
    std::map<std::string, std::int64_t> known;
    std::vector<double> numbers;
    for (std::int64_t row = 0; row < table_.rows(); ++row) {
        const std::string& name = column.texts[std::size_t(row)];
        if (!known.contains(name)) {
            const std::vector<std::int64_t> found = motions_named(name, motions);
            if (found.empty()) {
                refuse(
                    row, motion_column,
                    fmt::format("motion = {} is not a record of the job. Give the name of a file "
                                "in scene.record, such as {}.",
                                in_quotes(shortened(name, 40)), in_quotes(motions[0].name)));
            }
            if (found.size() > 1) {
                const auto name_of = [&](std::int64_t i) {
                    return in_quotes(motions[std::size_t(i)].name);
                };
                refuse(row, motion_column,
                       fmt::format("motion = {} is the name of several records: {} and {}{}. Give "
                                   "one of these names.",
                                   in_quotes(name), name_of(found[0]), name_of(found[1]),
                                   found.size() > 2 ? " and others" : ""));
            }
            known[name] = found[0];
        }
        numbers.push_back(double(known[name] + 1));
    }
    return numbers;
}

void BlockTableReader::expect_free_name(const std::string& name, bool is_recorded) const
{
    if (is_one_of(name, reserved_names) || is_one_of(name, field_names()) ||
        (is_recorded && is_one_of(name, reserved_under_records))) {
        refuse(GivenError::no_row, name,
               "is the name of a variable of the result. Rename the column.");
    }
    if (const TableColumn* texts = with_length(table_, name)) {
        refuse(GivenError::no_row, name,
               fmt::format("is the name of the dimension of the texts of {} in the result. "
                           "Rename the column.",
                           texts->name));
    }
    const bool has_control = std::any_of(name.begin(), name.end(), [](unsigned char letter) {
        return letter < 0x20 || letter == 0x7f;
    });
    const char* reason = name.size() > longest_name    ? "it is too long"
                         : name[0] == '.'              ? "it begins with a dot"
                         : name.find('/') != name.npos ? "it contains a slash"
                         : has_control                 ? "it contains a control character"
                         : has_white_space(name)       ? "it contains a blank"
                                                       : nullptr;
    if (reason != nullptr) {
        throw Error(
            exit_code::job,

            "{}:1:{}: the column {} cannot be a variable of a result file, because {}. Allowed "
            "are up to {} bytes without blanks, slashes and control characters, and without a "
            "dot at the beginning. Rename the column.",
            file_, table_.find(name) - table_.columns.data() + 1, in_quotes(shortened(name, 40)),
            reason, longest_name);
    }
}

} // namespace overturn
