// Text from untrusted files, made safe for a terminal.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace overturn {

/// The number of bytes in the first UTF-8 character; 0 if it is invalid.
inline std::size_t letter_length(std::string_view text)
{
    const auto first = static_cast<unsigned char>(text[0]);
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xc2 && first < 0xe0 ? 2
                               : first >= 0xe0 && first < 0xf0 ? 3
                               : first >= 0xf0 && first < 0xf5 ? 4
                                                               : 0;
    const auto continues = [](char byte) {
        return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
    };
    const bool is_whole = length > 0 && length <= text.size() &&
                          std::all_of(text.begin() + 1, text.begin() + length, continues);
    return is_whole ? length : 0;
}

/// Replaces each control character except newline, and each byte of invalid UTF-8, by a question
/// mark. Job files and result files are untrusted, and could contain terminal escape sequences.
inline std::string printable(std::string_view text)
{
    std::string result;
    while (!text.empty()) {
        const std::size_t length = letter_length(text);
        const auto first = static_cast<unsigned char>(text[0]);
        const bool is_control =
            (length == 1 && first < 0x20 && first != '\n') || first == 0x7f ||
            (first == 0xc2 && length == 2 && static_cast<unsigned char>(text[1]) < 0xa0);
        if (length == 0 || is_control) {
            result += '?';
        } else {
            result += text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return result;
}

} // namespace overturn
