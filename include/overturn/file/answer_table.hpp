// Tables of answers, as comma-separated values.
#pragma once

#include <string>
#include <string_view>

namespace overturn {

/// A column that a file must have to be replaced.
inline constexpr std::string_view column_of_answers = "topples_from";

/// Throws Error if the table cannot be written: the folder is missing or not writable, or a file
/// exists that is not such a table. To be called before the computation.
void expect_place_for_answers(const std::string& path);

/// Replaces an older table atomically. Throws Error.
void write_answers(const std::string& path, std::string_view text);

} // namespace overturn
