// Text from untrusted files, made safe for a terminal.
#pragma once

#include "overturn/record/utf8.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace overturn {

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
