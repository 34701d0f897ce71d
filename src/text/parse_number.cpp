#include "overturn/text/parse_number.hpp"

#include <fmt/format.h>

#include <charconv>

#ifndef __cpp_lib_to_chars // libc++ converts no floating-point numbers
#include <cerrno>
#include <cmath>
#include <locale.h>
#include <stdlib.h>
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

ParsedNumber parse_unsigned_or_negative(std::string_view text)
{
    static const locale_t of_c = newlocale(LC_ALL_MASK, "C", locale_t());
    // Without blanks before it, hexadecimal digits, and the parentheses that may follow nan.
    const std::string word(text.substr(0, text.find_first_not_of("+-.0123456789AEFINTYaefinty")));
    if (word.starts_with('+')) {
        return {};
    }
    char* end = nullptr;
    errno = 0;
    const double value = strtod_l(word.c_str(), &end, of_c);
    // It may also report numbers that are subnormal.
    const bool is_in_range = errno != ERANGE || (std::isfinite(value) && value != 0);
    return {is_in_range ? value : 0, std::size_t(end - word.c_str()),
            is_in_range ? std::errc() : std::errc::result_out_of_range};
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

std::string advice_on_decimal_comma(std::string_view text)
{
    const std::size_t comma = text.find(',');
    if (comma == text.npos) {
        return "";
    }
    std::string number(text);
    number[comma] = '.';
    if (!is_whole(parse_number(number), number)) {
        return "";
    }
    std::string whole; // the comma may separate thousands
    if (comma > 0 && text.size() == comma + 4) {
        whole = fmt::format(" or {}{}", text.substr(0, comma), text.substr(comma + 1));
    }
    return fmt::format(" Numbers have a decimal point: write {}{} instead of {}.", number, whole,
                       text);
}

} // namespace overturn
