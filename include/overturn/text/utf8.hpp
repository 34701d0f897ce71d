// Text in UTF-8 (RFC 3629), and what to make of other bytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace overturn {

/// The number of bytes in the first character of a text that is not empty; 0 if it is not UTF-8.
inline std::size_t letter_length(std::string_view text)
{
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xc2 && first < 0xe0 ? 2
                               : first >= 0xe0 && first < 0xf0 ? 3
                               : first >= 0xf0 && first < 0xf5 ? 4
                                                               : 0;
    if (length == 0 || length > text.size()) {
        return 0;
    }
    // Longer forms than necessary, surrogates, and numbers beyond U+10FFFF are excluded.
    const unsigned char least = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    const unsigned char most = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    for (std::size_t i = 1; i < length; ++i) {
        if (byte(i) < (i == 1 ? least : 0x80) || byte(i) > (i == 1 ? most : 0xbf)) {
            return 0;
        }
    }
    return length;
}

inline bool is_utf8(std::string_view text)
{
    while (!text.empty()) {
        const std::size_t length = letter_length(text);
        if (length == 0) {
            return false;
        }
        text.remove_prefix(length);
    }
    return true;
}

/// The text with each byte that is not UTF-8 read as Latin-1.
inline std::string as_utf8(std::string_view text)
{
    std::string result;
    while (!text.empty()) {
        const std::size_t length = letter_length(text);
        if (length > 0) {
            result += text.substr(0, length);
        } else {
            const auto byte = static_cast<unsigned char>(text[0]);
            result += char(0xc0 | byte >> 6);
            result += char(0x80 | (byte & 0x3f));
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return result;
}

/// Whether a text in UTF-8 contains white space: blanks, line ends and other separators of Unicode.
inline bool has_white_space(std::string_view text)
{
    constexpr std::string_view spaces =
        " \t\n\v\f\r\u0085\u00a0\u1680\u2000\u2001\u2002\u2003\u2004\u2005\u2006\u2007\u2008"
        "\u2009\u200a\u2028\u2029\u202f\u205f\u3000";
    while (!text.empty()) {
        const std::string_view letter = text.substr(0, letter_length(text));
        if (spaces.find(letter) != spaces.npos) {
            return true;
        }
        text.remove_prefix(letter.size());
    }
    return false;
}

/// The text without the byte-order mark at its beginning.
inline std::string_view without_byte_order_mark(std::string_view text)
{
    constexpr std::string_view mark = "\ufeff";
    return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

} // namespace overturn
