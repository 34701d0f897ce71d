// Reads a whole file of text. With job/file_pattern, all that touches the file system below the
// result files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace overturn {

/// A kind of file, for messages.
struct TextFileKind {
    std::string_view noun;         ///< such as "a job file"
    std::uint64_t largest;         ///< larger files are refused [bytes]
    std::string_view wanted;       ///< advice if it cannot be read
    std::string_view if_too_large; ///< advice
};

/// The content of the file. Throws Error, whose message begins with the path.
std::string text_of_file(const std::string& path, const TextFileKind& kind);

/// The path without links and dots: equal for equal files.
std::string canonical_path(const std::string& path);

} // namespace overturn
