// Reads a whole file of text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace overturn {

/// A kind of file, for messages.
struct TextFileKind {
    std::string_view noun;         ///< such as "a job file"
    std::size_t largest;           ///< larger files are refused [bytes]
    std::string_view wanted;       ///< advice if it cannot be read
    std::string_view if_too_large; ///< advice
};

/// The content of the file. Throws Error, whose message begins with the path.
std::string text_of_file(const std::string& path, const TextFileKind& kind);

} // namespace overturn
