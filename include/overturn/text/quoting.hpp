// Texts in messages, jobs and JSON: quoted, shortened, trimmed, and safe for a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace overturn {

/// A string of TOML and JSON: in double quotes, with quotes, backslashes and control characters
/// escaped. The text must be UTF-8, which is kept.
std::string in_quotes(std::string_view text);

/// Any bytes, for messages: in double quotes, at most 40 of them, with all but printable ASCII
/// escaped.
std::string quoted_bytes(std::string_view bytes);

/// The beginning of a text in UTF-8, followed by "..." if the text has more bytes than this.
std::string shortened(std::string_view text, std::size_t longest);

/// The noun for a count: "tile" for 1, "tiles" otherwise; `plural` ends in s.
constexpr std::string_view noun_of(auto count, std::string_view plural)
{
    return plural.substr(0, plural.size() - (count == 1 ? 1 : 0));
}

/// Line ends and other control characters become blanks.
std::string on_one_line(std::string text);

/// The text without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// The text with ASCII letters in lower case.
std::string lower(std::string_view text);

/// Replaces each control character except newline, and each byte of invalid UTF-8, by a question
/// mark. Job files and result files are untrusted, and could contain terminal escape sequences.
std::string printable(std::string_view text);

} // namespace overturn
