// Text in UTF-8 (RFC 3629), and what to make of other bytes.
#pragma once

#include <boost/locale/utf.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>

namespace overturn {

/// The number of bytes in the first character of a text that is not empty; 0 if it is not UTF-8.
inline std::size_t letter_length(std::string_view text)
{
    namespace utf = boost::locale::utf;
    const char* next = text.data();
    const utf::code_point letter = utf::utf_traits<char>::decode(next, text.data() + text.size());
    return utf::is_valid_codepoint(letter) ? std::size_t(next - text.data()) : 0;
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
        } else { // Unicode begins with Latin-1
            boost::locale::utf::utf_traits<char>::encode(static_cast<unsigned char>(text[0]),
                                                         std::back_inserter(result));
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return result;
}

/// Whether a text in UTF-8 contains white space: blanks, line ends and other separators of Unicode.
inline bool has_white_space(std::string_view text)
{
    constexpr std::string_view spaces[] = {
        " ",      "\t",     "\n",     "\v",     "\f",     "\r",     "\u0085", "\u00a0", "\u1680",
        "\u2000", "\u2001", "\u2002", "\u2003", "\u2004", "\u2005", "\u2006", "\u2007", "\u2008",
        "\u2009", "\u200a", "\u2028", "\u2029", "\u202f", "\u205f", "\u3000"};
    return std::any_of(std::begin(spaces), std::end(spaces),
                       [&](std::string_view space) { return text.find(space) != text.npos; });
}

/// The text without the byte-order mark at its beginning.
inline std::string_view without_byte_order_mark(std::string_view text)
{
    constexpr std::string_view mark = "\ufeff";
    return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

} // namespace overturn
