// Text of others on a terminal.
#pragma once

#include <string>
#include <string_view>

namespace overturn {

/// The text with a question mark for each control character but the ends of lines: job files and
/// result files may come from anywhere, and a terminal obeys what they say.
inline std::string printable(std::string_view text)
{
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto letter = static_cast<unsigned char>(text[i]);
        const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
        if (letter == 0xc2 && next >= 0x80 && next < 0xa0) { // U+0080 to U+009F in UTF-8
            result += '?';
            ++i;
        } else {
            result += (letter < 0x20 && letter != '\n') || letter == 0x7f ? '?' : text[i];
        }
    }
    return result;
}

} // namespace overturn
