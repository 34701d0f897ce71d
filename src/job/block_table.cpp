#include "read_steps.hpp"

#include "overturn/record/text_file.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/quoting.hpp"
#include "overturn/text/utf8.hpp"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <set>

namespace overturn {

namespace {

constexpr TextFileKind table_file{"a table", largest_table_file,
                                  "Give the path of a table, relative to the job file.",
                                  "Split the table."};

/// Names of columns that every result file needs for itself.
constexpr std::array<std::string_view, 7> reserved_names{
    "block", "motion_name", "tile", "checksum", "run_token", "crossing", "run"};

// netCDF limits names to 256 bytes, including the suffix of the dimension of a column of texts.
constexpr std::string_view length_suffix = "_length";
constexpr std::size_t longest_name = 255 - length_suffix.size(); // [bytes]

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

/// Refuses a name that the result file has for something else, or that it cannot have.
void expect_free_name(const BlockTable& blocks, const std::string& name, const MotionTraits& motion)
{
    const auto refuse_name = [&](const std::string& reason) {
        refuse(blocks, {GivenError::no_row, name, reason});
    };
    const Quantity* const same = find_quantity(name);
    if ((same != nullptr && same->role == Role::derived) || is_one_of(name, reserved_names) ||
        find_field(name) != nullptr || is_one_of(name, motion.variables)) {
        refuse_name(" is the name of a variable of the result. Rename the column.");
    }
    for (const TableColumn& other : blocks.table.columns) {
        if (!other.texts.empty() && name == fmt::format("{}{}", other.name, length_suffix)) {
            refuse_name(fmt::format(" is the name of the dimension of the texts of {} in the "
                                    "result. Rename the column.",
                                    other.name));
        }
    }
    const Quantity* const meant = find_quantity(lower(name));
    if (meant != nullptr && meant != same && meant->applies_under(motion)) {
        refuse_name(fmt::format(" is not the quantity {}, whose name is in lower case. Correct the "
                                "name, or choose another one.",
                                meant->name));
    }
    const auto is_control = [](unsigned char letter) { return letter < 0x20 || letter == 0x7f; };
    if (name.size() > longest_name || name[0] == '.' || name.find('/') != name.npos ||
        std::ranges::any_of(name, is_control) || has_white_space(name)) {
        throw Error(exit_code::job,
                    "{}:1:{}: the column {} cannot be a variable of a result file. Allowed are up "
                    "to {} bytes without blanks, slashes and control characters, and without a dot "
                    "at the beginning. Rename the column.",
                    blocks.file, blocks.table.find(name) - blocks.table.columns.data() + 1,
                    in_quotes(shortened(name, 40)), longest_name);
    }
}

/// A unit in the name of a column, such as width_cm.
struct UnitOfColumn {
    std::string_view suffix;
    std::string_view of; ///< the unit of the quantity
    double multiple;     ///< the unit of the quantity, in this unit
};
constexpr std::array<UnitOfColumn, 5> units_of_columns{{{"_m", "m", 1},
                                                        {"_cm", "m", 100},
                                                        {"_mm", "m", 1000},
                                                        {"_deg", "rad", 180 / std::numbers::pi},
                                                        {"_rad", "rad", 1}}};

/// Converts columns with a unit in their name to those of the quantity. Two of one quantity are
/// refused.
void convert_units(BlockTable& blocks, const MotionTraits& motion)
{
    for (TableColumn& column : blocks.table.columns) {
        for (const UnitOfColumn& unit : units_of_columns) {
            const std::string_view name = column.name;
            const Quantity* const quantity =
                name.ends_with(unit.suffix) && find_quantity(name) == nullptr
                    ? find_quantity(name.substr(0, name.size() - unit.suffix.size()))
                    : nullptr;
            if (quantity == nullptr || quantity->units != unit.of || !quantity->is_coordinate() ||
                !quantity->applies_under(motion)) {
                continue;
            }
            if (blocks.table.find(quantity->name) != nullptr) {
                refuse(blocks, {GivenError::no_row, column.name,
                                fmt::format(" is another column of {}. Remove one of them.",
                                            quantity->name)});
            }
            for (double& value : column.numbers) {
                value /= unit.multiple;
            }
            column.name = quantity->name;
            break;
        }
    }
}

/// Empty cells of quantities that are 0 unless they are given.
void fill_empty_cells(BlockTable& blocks)
{
    for (TableColumn& column : blocks.table.columns) {
        if (is_one_of(column.name, {"center_offset", "incline"})) {
            std::ranges::replace_if(
                column.numbers, [](double value) { return std::isnan(value); }, 0.0);
        }
    }
}

/// Refuses values that are not numbers, or not allowed.
void expect_values(const BlockTable& blocks, const TableColumn& column, const Quantity& quantity)
{
    if (column.first_text >= 0) {
        const std::string& text = column.texts[std::size_t(column.first_text)];
        refuse(blocks, {column.first_text, column.name,
                        fmt::format(" = {} is not a number.{}", in_quotes(shortened(text, 40)),
                                    text.find(',') != text.npos && text.find('.') != text.npos
                                        ? " Write it without separators of thousands."
                                        : "")});
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

/// The indices of motions by name.
using MotionsByName = std::map<std::string, std::vector<std::size_t>, std::less<>>;

/// The names are those in RecordedMotion::name, or with the file without its folder or also without
/// its ending, or that of the file alone; RecordedMotion::name comes first.
MotionsByName by_name(const std::vector<RecordedMotion>& motions)
{
    MotionsByName all;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const std::filesystem::path path(motions[i].file);
        const std::string suffix = motions[i].name.substr(motions[i].file.size());
        std::set<std::string> names;
        for (const auto& file : {path, path.filename(), path.stem()}) {
            names.insert({file.string(), file.string() + suffix});
        }
        for (const std::string& name : names) {
            all[name].push_back(i);
        }
    }
    for (std::size_t i = 0; i < motions.size(); ++i) {
        all[motions[i].name] = {i};
    }
    return all;
}

/// The numbers of the motions that a column names, from 1.
std::vector<double> motion_numbers(const BlockTable& blocks, const TableColumn& column,
                                   const std::vector<RecordedMotion>& motions,
                                   const MotionsByName& known)
{
    std::vector<double> numbers;
    for (const std::string& name : column.texts) {
        const auto quoted = [&](std::size_t i) { return in_quotes(motions[i].name); };
        const auto refuse_name = [&](const std::string& reason) {
            refuse(blocks, {std::int64_t(numbers.size()), column.name,
                            fmt::format(" = {} is {}", in_quotes(shortened(name, 40)), reason)});
        };
        const auto found = known.find(name);
        if (found == known.end()) {
            refuse_name(fmt::format(
                "not a record of the job. Give the name of a file in scene.record, such as {}.",
                quoted(0)));
        }
        const std::vector<std::size_t>& places = found->second;
        if (places.size() > 1) {
            refuse_name(fmt::format(
                "the name of several records: {} and {}{}. Give one of these names.",
                quoted(places[0]), quoted(places[1]), places.size() > 2 ? " and others" : ""));
        }
        numbers.push_back(double(places[0] + 1));
    }
    return numbers;
}

/// Refuses a column of texts that name records of a suite: it would not assign them to the blocks.
void expect_no_records(const BlockTable& blocks, const TableColumn& column,
                       const MotionsByName& known)
{
    const auto names_motion = [&](const std::string& text) { return known.contains(text); };
    if (!column.texts.empty() && std::ranges::all_of(column.texts, names_motion)) {
        refuse(blocks,
               {GivenError::no_row, column.name,
                fmt::format(" names records of the job, but each block is computed under all of "
                            "them. Rename the column to {} to assign the records to the blocks, or "
                            "remove it.",
                            Suite::traits.choice)});
    }
}

} // namespace

BlockTable read_block_table(const std::string& file, const std::string& folder,
                            const MotionTraits& motion, const std::vector<RecordedMotion>& motions)
{
    const std::string path = (std::filesystem::path(folder) / file).string();
    BlockTable blocks{file, read_table(text_of_file(path, table_file), file, motion.choice), ""};
    const MotionsByName known = by_name(motions);
    convert_units(blocks, motion);
    fill_empty_cells(blocks);
    for (TableColumn& column : blocks.table.columns) {
        const Quantity* const quantity = find_quantity(column.name);
        // Under a pulse, the motion is a column like any other.
        if (column.name == motion.choice) {
            column = {column.name, motion_numbers(blocks, column, motions, known), {}};
        } else if (quantity == nullptr || !quantity->is_coordinate() ||
                   quantity->role == Role::motion) {
            expect_free_name(blocks, column.name, motion);
            if (motions.size() > 1) {
                expect_no_records(blocks, column, known);
            }
        } else {
            expect_values(blocks, column, *quantity);
        }
    }
    blocks.checksum = checksum_of(blocks.table);
    return blocks;
}

std::vector<Given> columns_of(const BlockTable& blocks, const MotionTraits& motion)
{
    std::vector<Given> columns;
    for (const TableColumn& column : blocks.table.columns) {
        const Quantity* const quantity = find_quantity(column.name);
        if (quantity != nullptr && quantity->applies_under(motion)) {
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
