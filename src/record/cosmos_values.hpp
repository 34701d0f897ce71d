// The numbers of a file in COSMOS format, each block of which is announced by a line.
#pragma once

#include "lines.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace overturn {

/// Takes the values that the current line announces, such as `100 Real-header values follow on 20
/// lines, Format= (5F15.6)`.
std::vector<double> take_announced(Lines& lines, std::string_view name);

/// Integers or real numbers of a header, counted from 1 as in the description of the format.
class CosmosValues {
public:
    /// Takes the lines up to the one that contains the name, and the values that it announces.
    CosmosValues(Lines& lines, Header& header, std::string_view name);

    /// nullopt if it is missing or unknown, such as -999.
    std::optional<double> operator[](std::size_t number) const;

    /// At the line that announces them.
    const Lines& lines() const { return lines_; }

private:
    Lines lines_;
    std::vector<double> values_;
};

} // namespace overturn
