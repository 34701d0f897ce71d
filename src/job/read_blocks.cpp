#include "read_steps.hpp"

#include "motion_names.hpp"
#include "overturn/record/read_table.hpp"
#include "overturn/record/text_file.hpp"
#include "overturn/record/utf8.hpp"
#include "overturn/sweep/block_list.hpp"
#include "toml_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xxhash.h>

#include <algorithm>
#include <filesystem>

namespace overturn {

namespace {

constexpr std::array<std::string_view, 5> described_keys{"table", "rows", "columns", "own_motions",
                                                         "checksum"};

constexpr TextFileKind table_file{"a table", largest_table_file,
                                  "Give the path of a table, relative to the job file.",
                                  "Split the table."};

constexpr std::string_view motion_column = "motion";

/// Names of columns that the result file needs for itself; the second list: under records.
constexpr std::array<std::string_view, 9> reserved_names{
    "block",     "motion_name", "restitution_ratio", "tile", "checksum",
    "run_token", "crossing",    "motion_number",     "run"};
constexpr std::array<std::string_view, 5> reserved_under_records{
    "motion_name_length", "record_pga", "pgv", "arias_intensity", "significant_duration"};

// netCDF limits names to 256 bytes, including the suffix of the dimension of a column of texts.
constexpr std::string_view length_suffix = "_length";
constexpr std::size_t longest_name = 255 - length_suffix.size(); // [bytes]

bool is_one_of(std::string_view name, Names names)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The table of a job, and the refusal of its rows and columns.
class TableReader {
public:
    /// Under records, the column `motion` contains names.
    TableReader(std::string file, const std::string& folder, bool is_recorded)
        : file_(std::move(file)),
          table_(std::make_shared<Table>(read_table(
              text_of_file<JobError>((std::filesystem::path(folder) / file_).string(), table_file),
              file_, is_recorded ? motion_column : "")))
    {}

    const std::shared_ptr<const Table>& table() const { return table_; }

    /// Throws JobError with file, line and column, of which the latter two may be unknown.
    [[noreturn]] void refuse(std::int64_t row, std::string_view column,
                             std::string_view reason) const
    {
        const auto found =
            std::find_if(table_->columns.begin(), table_->columns.end(),
                         [&](const TableColumn& each) { return each.name == column; });
        const std::int64_t line = row < 0 ? 1 : table_->lines[std::size_t(row)];
        std::string place = fmt::format("{}:{}", file_, line);
        if (found != table_->columns.end()) {
            place += fmt::format(":{}", found - table_->columns.begin() + 1);
        }
        const bool names_column = row < 0 && found != table_->columns.end();
        throw JobError(fmt::format("{}: {}{}{}", place, names_column ? column : "",
                                   names_column ? " " : "", reason));
    }

    /// The columns of numbers that block_list() reads. Their values must be numbers.
    Columns columns(bool is_recorded) const
    {
        Columns columns;
        for (const TableColumn& column : table_->columns) {
            if (find_quantity(column.name) == nullptr) {
                expect_free_name(column.name, is_recorded);
                continue;
            }
            if (column.first_text >= 0) {
                const std::string& text = column.texts[std::size_t(column.first_text)];
                refuse(column.first_text, column.name,
                       fmt::format("{} = {} is not a number.", column.name,
                                   in_quotes(shortened(text, 40))));
            }
            const auto missing = std::find_if(column.numbers.begin(), column.numbers.end(),
                                              [](double value) { return std::isnan(value); });
            if (missing != column.numbers.end()) {
                refuse(missing - column.numbers.begin(), column.name,
                       fmt::format("{} is empty or not a number. Give a value in every row, or "
                                   "rename the column.",
                                   column.name));
            }
            columns[column.name] = column.numbers;
        }
        return columns;
    }

    /// The number of the record of each row; empty without a column `motion`.
    std::vector<std::int64_t> motions(const std::vector<Motion>& motions) const
    {
        const TableColumn* column = table_->find(motion_column);
        std::vector<std::int64_t> numbers;
        if (column == nullptr || motions.empty()) {
            return numbers;
        }
        for (std::int64_t row = 0; row < table_->rows(); ++row) {
            numbers.push_back(motion_named(column->texts[std::size_t(row)], motions, row));
        }
        return numbers;
    }

private:
    /// The only motion of this name, see motions_named().
    std::int64_t motion_named(const std::string& name, const std::vector<Motion>& motions,
                              std::int64_t row) const
    {
        if (const auto known = numbers_.find(name); known != numbers_.end()) {
            return known->second;
        }
        const std::vector<std::int64_t> found = motions_named(name, motions);
        if (found.empty()) {
            refuse(row, motion_column,
                   fmt::format("motion = {} is not a record of the job. Give the name of a file "
                               "in scene.record, such as {}.",
                               in_quotes(shortened(name, 40)), in_quotes(motions[0].name)));
        }
        if (found.size() > 1) {
            const auto name_of = [&](std::int64_t i) {
                return in_quotes(motions[std::size_t(i)].name);
            };
            refuse(
                row, motion_column,
                fmt::format("motion = {} is the name of several records: {}{}. Give one of these "
                            "names.",
                            in_quotes(name), name_of(found[0]) + " and " + name_of(found[1]),
                            found.size() > 2 ? " and others" : ""));
        }
        return numbers_[name] = found[0];
    }

    /// The text column whose texts have a length of this name, or nullptr.
    const TableColumn* with_length(std::string_view name) const
    {
        if (!name.ends_with(length_suffix)) {
            return nullptr;
        }
        const TableColumn* column =
            table_->find(name.substr(0, name.size() - length_suffix.size()));
        return column == nullptr || column->texts.empty() ? nullptr : column;
    }

    void expect_free_name(const std::string& name, bool is_recorded) const
    {
        if (is_one_of(name, reserved_names) || is_one_of(name, field_names) ||
            (is_recorded && is_one_of(name, reserved_under_records))) {
            refuse(ListError::no_row, name,
                   "is the name of a variable of the result. Rename the column.");
        }
        if (const TableColumn* texts = with_length(name)) {
            refuse(ListError::no_row, name,
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
            throw JobError(fmt::format(
                "{}:1:{}: the column {} cannot be a variable of a result file, because {}. Allowed "
                "are up to {} bytes without blanks, slashes and control characters, and without a "
                "dot at the beginning. Rename the column.",
                file_, table_->find(name) - table_->columns.data() + 1,
                in_quotes(shortened(name, 40)), reason, longest_name));
        }
    }

    std::string file_;
    std::shared_ptr<const Table> table_;
    mutable std::map<std::string, std::int64_t> numbers_; // of the motions found so far
};

/// The list of a job in a result file: of the right size, without values.
BlockTable described_blocks(const Entry& entry, Job& job)
{
    expect_table(entry, described_keys);
    const auto of_resolved_job = [&](std::string_view name) {
        return require(entry, name, "It is part of every resolved job.");
    };
    BlockTable blocks;
    blocks.file = string_of(of_resolved_job("table"));
    blocks.checksum = string_of(of_resolved_job("checksum"));
    const Entry columns = of_resolved_job("columns");
    const std::size_t count = array_size(columns, "an array of names", "");
    for (std::size_t i = 0; i < count; ++i) {
        blocks.columns.push_back(string_of(element(columns, i)));
    }
    const Entry rows_entry = of_resolved_job("rows");
    const std::int64_t rows = integer_of(rows_entry);
    if (rows < 1 || rows > std::int64_t(largest_table_file)) {
        refuse(rows_entry, fmt::format(" = {} is not a number of rows.", rows));
    }
    auto list = std::make_shared<BlockList>();
    list->size = rows;
    list->has_own_motions = boolean_of(of_resolved_job("own_motions"));
    job.plane.list = list;
    return blocks;
}

/// The table with the numbers of the motions, counted from 1, instead of their names.
Table with_motion_numbers(Table table, const BlockList& list)
{
    for (TableColumn& column : table.columns) {
        if (column.name == motion_column && !list.motion.empty()) {
            column = {"motion_number", {}, {}};
            for (const std::int64_t motion : list.motion) {
                column.numbers.push_back(double(motion + 1));
            }
        }
    }
    return table;
}

} // namespace

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

void restore_blocks(Job& job, Table table)
{
    Columns columns;
    for (const TableColumn& column : table.columns) {
        const bool is_motion = column.name == "scale" || column.name == "pga";
        if (find_quantity(column.name) != nullptr && !(job.scene.is_recorded() && is_motion)) {
            columns[column.name] = column.numbers;
        }
    }
    try {
        auto list = std::make_shared<BlockList>(block_list(job.scene, columns));
        list->has_own_motions = job.plane.list->has_own_motions;
        job.plane.list = std::move(list);
    } catch (const ListError& error) {
        throw JobError(error.what());
    }
    job.blocks->table = std::make_shared<Table>(std::move(table));
}

BlockTable read_blocks(const Entry& entry, const std::string& folder, Job& job, JobText kind)
{
    if (kind == JobText::resolved) {
        return described_blocks(entry, job);
    }
    expect_table(entry, blocks_keys);
    const Entry table = require(entry, "table", "Give the path of a table of blocks.");
    try {
        const TableReader reader(string_of(table), folder, job.scene.is_recorded());
        try {
            job.plane.list = std::make_shared<BlockList>(block_list(
                job.scene, reader.columns(job.scene.is_recorded()), reader.motions(job.motions)));
        } catch (const ListError& error) {
            reader.refuse(error.row(), error.column(), error.what());
        }
        BlockTable blocks;
        blocks.file = string_of(table);
        blocks.table =
            std::make_shared<Table>(with_motion_numbers(*reader.table(), *job.plane.list));
        blocks.checksum = checksum_of(*blocks.table);
        for (const TableColumn& column : blocks.table->columns) {
            blocks.columns.push_back(column.name);
        }
        return blocks;
    } catch (const TableError& error) {
        throw JobError(error.what());
    }
}

} // namespace overturn
