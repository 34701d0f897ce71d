#include "overturn/text/quoting.hpp"

#include "overturn/text/utf8.hpp"

#include <boost/algorithm/string/case_conv.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <locale>

namespace overturn {

namespace {

/// In double quotes, with quotes, backslashes and control characters escaped; `bytes`: also all
/// that is not ASCII, as in C instead of TOML.
std::string quoted(std::string_view text, bool bytes)
{
    std::string result = "\"";
    for (const char letter : text) {
        const auto code = static_cast<unsigned char>(letter);
        if (code < 0x20 || code == 0x7f || (bytes && code > 0x7f)) {
            result += bytes ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{:04X}", code);
        } else {
            result += letter == '"' || letter == '\\' ? "\\" : "";
            result += letter;
        }
    }
    return result;
}

} // namespace

std::string in_quotes(std::string_view text)
{
    return quoted(text, false) + '"';
}

std::string quoted_bytes(std::string_view bytes)
{
    constexpr std::size_t longest = 40;
    return quoted(bytes.substr(0, longest), true) + (bytes.size() > longest ? "...\"" : "\"");
}

std::string shortened(std::string_view text, std::size_t longest)
{
    if (text.size() <= longest) {
        return std::string(text);
    }
    // Do not split a UTF-8 character, whose continuation bytes are 10xxxxxx.
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) {
        --end;
    }
    return std::string(text.substr(0, end)) + "...";
}

std::string on_one_line(std::string text)
{
    std::replace_if(
        text.begin(), text.end(), [](unsigned char letter) { return letter < 0x20; }, ' ');
    return text;
}

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view blanks = " \t";
    const std::size_t first = text.find_first_not_of(blanks);
    return first == text.npos ? std::string_view()
                              : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lower(std::string_view text)
{
    return boost::algorithm::to_lower_copy(std::string(text), std::locale::classic());
}

std::string printable(std::string_view text)
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
