// Numbers in texts, correctly rounded and independent of the locale.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

namespace overturn {

/// The number that a text begins with.
struct ParsedNumber {
    double value = 0;
    std::size_t length = 0; ///< characters that belong to the number; 0 if there is none
    /// std::errc(), or result_out_of_range: too large for a double, or not 0 but too small
    std::errc error = std::errc();
};

/// Reads the number that a text begins with. Its syntax is that of std::from_chars, which includes
/// inf and nan, but no blanks before the number; a plus sign may precede it.
ParsedNumber parse_number(std::string_view text);

/// Whether the whole text is one number.
inline bool is_whole(const ParsedNumber& number, std::string_view text)
{
    return number.length > 0 && number.length == text.size();
}

/// Of a number with a comma, " Numbers have a decimal point: write 0.42 instead of 0,42."; empty
/// for other texts.
std::string advice_on_decimal_comma(std::string_view text);

} // namespace overturn
