// Files that a job names by a pattern such as "suite/*.AT2", and what its wildcards stand for in
// each of them.
#pragma once

#include "toml_reading.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace overturn {

/// What the wildcards of a pattern stand for in a path, each as short as possible.
using Parts = std::vector<std::string>;

struct Match {
    std::string file;
    Parts parts; ///< empty: the file is not given by a pattern
};

/// Whether the text is a pattern. What exists in the folder as it is written is none.
bool is_pattern(const std::string& text, const std::filesystem::path& folder);

/// The files that an entry of a job names, which may be a pattern, in byte order; relative to the
/// folder, unless it is absolute.
std::vector<Match> files_of(const Entry& entry, const std::filesystem::path& folder);

} // namespace overturn
