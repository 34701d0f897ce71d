#include "fortran_format.hpp"

#include <charconv>

namespace overturn {

namespace {

/// Removes an integer from the beginning of a text.
std::optional<std::size_t> take_integer(std::string_view& text)
{
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) {
        return std::nullopt;
    }
    text.remove_prefix(std::size_t(end - text.data()));
    return value;
}

/// Removes a character from the beginning of a text, if it is one of these.
bool take_one_of(std::string_view characters, std::string_view& text)
{
    const bool is_found = !text.empty() && characters.find(text[0]) != characters.npos;
    text.remove_prefix(is_found ? 1 : 0);
    return is_found;
}

/// The columns of a format without the opening bracket.
std::optional<Columns> columns_of(std::string_view text)
{
    constexpr std::size_t most = 1000; // columns, and characters per column
    auto per_line = take_integer(text);
    if (take_one_of("pP", text)) { // the scale of numbers with an exponent
        take_one_of(",", text);
        per_line = take_integer(text);
    }
    const bool is_integer = text.starts_with('i') || text.starts_with('I');
    if (!take_one_of("iIfFeEdDgG", text)) {
        return std::nullopt;
    }
    take_one_of("sSnN", text); // ES and EN
    const auto width = take_integer(text);
    Columns columns{.width = width.value_or(0), .per_line = per_line.value_or(1), .decimals = {}};
    if (is_integer) {
        columns.decimals = 0;
    } else if (take_one_of(".", text)) {
        columns.decimals = take_integer(text);
    }
    const auto is_sound = [](std::size_t number) { return 0 < number && number <= most; };
    return is_sound(columns.width) && is_sound(columns.per_line) ? std::optional(columns)
                                                                 : std::nullopt;
}

} // namespace

std::optional<Columns> columns_of_format(std::string_view line)
{
    for (std::size_t open = line.find('('); open != line.npos; open = line.find('(', open + 1)) {
        if (const auto columns = columns_of(trimmed(line.substr(open + 1)))) {
            return columns;
        }
    }
    return std::nullopt;
}

} // namespace overturn
