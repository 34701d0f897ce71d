// The records that a job gives, and the choice of their components.
#pragma once

#include "file_pattern.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// A record as the job gives it.
struct GivenRecord {
    Entry entry;
    std::string file;
    Parts parts; ///< empty: it is not given by a pattern
};

/// A component of a record as the job gives it.
struct Choice {
    Entry entry;
    std::string text; ///< its name, its number in digits, or a file
};

/// The records of [scene]. folder: of the job file.
std::vector<GivenRecord> given_records(const Entry& scene, const std::filesystem::path& folder);

/// The choice of a component for each record, with this key of [scene]: one for all records, a list
/// with one for each, or a pattern of files; empty if the key is missing.
std::vector<Choice> choices_of(std::string_view key, const Entry& scene,
                               const std::vector<GivenRecord>& records,
                               const std::filesystem::path& folder);

} // namespace overturn
