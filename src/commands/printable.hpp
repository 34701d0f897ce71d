// Text of others on a terminal.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace overturn {

/// How many bytes of UTF-8 the first letter takes; 0 if they are none.
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

/// The text with a question mark for each control character but the ends of lines, and for what is
/// no UTF-8: job files and result files may come from anywhere, and a terminal obeys what they say.
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
