// Formats of Fortran that a header states, such as (8F10.5).
#pragma once

#include "numbers.hpp"

#include <optional>
#include <string_view>

namespace overturn {

/// The columns of the first format of a line: (8F10.5), (10I8), (1E15.6), (1P5E15.6) and the like.
/// Other words in brackets are skipped. nullopt if there is none.
std::optional<Columns> columns_of_format(std::string_view line);

} // namespace overturn
