#include "deep_key.hpp"

namespace overturn {

namespace {

constexpr std::size_t npos = std::string_view::npos;

/// The end of the TOML string that begins at `begin`: with one quote or three, and with escapes if
/// the quotes are double. A newline in a string of one quote is an error, after which the result
/// does not matter.
std::size_t end_of_string(std::string_view text, std::size_t begin)
{
    const char quote = text[begin];
    const std::string_view three = quote == '"' ? R"(""")" : "'''";
    const bool is_long = text.substr(begin).starts_with(three);
    std::size_t end = begin + (is_long ? 3 : 1);
    while (end < text.size() &&
           (is_long ? !text.substr(end).starts_with(three) : text[end] != quote)) {
        end += quote == '"' && text[end] == '\\' ? 2 : 1;
    }
    end += is_long ? 3 : 1;
    // Up to two quotes before the closing three belong to the string.
    for (int i = 0; is_long && i < 2 && end < text.size() && text[end] == quote; ++i) {
        ++end;
    }
    return end;
}

} // namespace

std::size_t find_deep_key(std::string_view text)
{
    constexpr std::string_view between_keys = "\n,=[]{}";
    std::size_t parts = 1;
    std::size_t i = 0;
    while (i < text.size()) {
        const char letter = text[i];
        if (letter == '"' || letter == '\'') {
            i = end_of_string(text, i);
            continue;
        }
        if (letter == '#') {
            i = text.find('\n', i);
            continue;
        }
        if (letter == '.' && ++parts > most_key_parts) {
            return i;
        }
        if (between_keys.find(letter) != npos) {
            parts = 1;
        }
        ++i;
    }
    return npos;
}

} // namespace overturn
