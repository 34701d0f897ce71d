// Reads the table of the blocks of a job.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/problem/given.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// The table of a job, and the refusal of its rows and columns.
class BlockTableReader {
public:
    /// file: relative to the folder. Under records, the column `motion` contains their names, or
    /// those of their files. Throws Error.
    BlockTableReader(std::string file, const std::string& folder,
                     const std::vector<Motion>& motions);

    /// The columns that describe points; `motion` as the numbers of the records, from 1.
    std::vector<Given> columns() const;

    bool has(std::string_view column) const { return table_.find(column) != nullptr; }

    /// Throws Error with file, line and column, of which the latter two may be unknown.
    [[noreturn]] void refuse(const GivenError& error) const;

    /// What is stored of the table.
    BlockTable result() &&;

private:
    [[noreturn]] void refuse(std::int64_t row, std::string_view column,
                             std::string_view reason) const;
    std::vector<double> motion_numbers(const std::vector<Motion>& motions) const;
    void expect_free_name(const std::string& name, bool is_recorded) const;

    std::string file_;
    Table table_;
    std::vector<Given> columns_;
};

} // namespace overturn
