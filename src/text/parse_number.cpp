#include "overturn/text/parse_number.hpp"

#include <charconv>

#ifndef __cpp_lib_to_chars // libc++ converts no floating-point numbers
#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cmath>
#include <locale.h>
#include <stdlib.h>
#include <string>
#endif

namespace overturn {

namespace {

#ifdef __cpp_lib_to_chars

ParsedNumber parse_unsigned_or_negative(std::string_view text)
{
    ParsedNumber number;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number.value);
    number.length = std::size_t(end - text.data());
    number.error = error == std::errc::result_out_of_range ? error : std::errc();
    return number;
}

#else

/// The number of digits that a text begins with.
std::size_t digits_of(std::string_view text)
{
    return std::min(text.find_first_not_of("0123456789"), text.size());
}

/// The length of the number that a text begins with, as for std::from_chars.
std::size_t length_of_number(std::string_view text)
{
    const std::size_t sign = text.starts_with('-') ? 1 : 0;
    const std::string_view rest = text.substr(sign);
    for (const std::string_view name : {"infinity", "inf", "nan"}) {
        if (boost::algorithm::istarts_with(rest, name)) {
            return sign + name.size();
        }
    }
    std::size_t end = digits_of(rest);
    std::size_t digits = end;
    if (rest.substr(end).starts_with('.')) {
        digits += digits_of(rest.substr(end + 1));
        end += 1 + digits_of(rest.substr(end + 1));
    }
    if (digits == 0) {
        return 0;
    }
    if (const std::string_view tail = rest.substr(end); !tail.empty() && (tail[0] | 32) == 'e') {
        const std::size_t before = tail.size() > 1 && (tail[1] == '+' || tail[1] == '-') ? 2 : 1;
        const std::size_t exponent = digits_of(tail.substr(std::min(before, tail.size())));
        end += exponent > 0 ? before + exponent : 0;
    }
    return sign + end;
}

ParsedNumber parse_unsigned_or_negative(std::string_view text)
{
    static const locale_t of_c = newlocale(LC_ALL_MASK, "C", locale_t());
    const std::size_t length = length_of_number(text);
    const std::string word(text.substr(0, length));
    const double value = strtod_l(word.c_str(), nullptr, of_c);
    const std::size_t mantissa = std::min(word.find_first_of("eE"), word.size());
    const bool is_name = word.find_first_of("iInN") != word.npos;
    const bool is_zero = word.substr(0, mantissa).find_first_of("123456789") == word.npos;
    if (is_name || (std::isfinite(value) && (value != 0 || is_zero))) {
        return {value, length};
    }
    return {0, length, std::errc::result_out_of_range};
}

#endif

} // namespace

ParsedNumber parse_number(std::string_view text)
{
    const std::size_t plus = text.starts_with('+') && !text.starts_with("+-") ? 1 : 0;
    ParsedNumber number = parse_unsigned_or_negative(text.substr(plus));
    number.length += number.length > 0 ? plus : 0;
    return number;
}

} // namespace overturn
