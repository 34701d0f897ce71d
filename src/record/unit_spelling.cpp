#include "unit_spelling.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace overturn {

namespace {

using Words = std::span<const std::string_view>;

bool is_one_of(std::string_view word, Words words)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr bool is_letter(char character)
{
    return 'a' <= character && character <= 'z';
}

constexpr bool is_digit(char character)
{
    return '0' <= character && character <= '9';
}

} // namespace

std::string simplified(std::string_view line)
{
    constexpr std::array<std::pair<std::string_view, std::string_view>, 7> letters{
        {{"\xc2\xb2", "2"},      // superscript 2
         {"\xb2", "2"},          // in Latin-1
         {"\xc2\xb3", "3"},      // superscript 3
         {"\xe2\x81\xbb", "-"},  // superscript minus
         {"\xe2\x88\x92", "-"},  // minus
         {"\xc2\xb7", ""},       // dot
         {"\xe2\x8b\x85", ""}}}; // dot
    std::string text;
    while (!line.empty()) {
        const auto* found = std::find_if(letters.begin(), letters.end(), [&](const auto& letter) {
            return line.starts_with(letter.first);
        });
        if (found != letters.end()) {
            text += found->second;
            line.remove_prefix(found->first.size());
        } else {
            text += 'A' <= line[0] && line[0] <= 'Z' ? char(line[0] - 'A' + 'a') : line[0];
            line.remove_prefix(1);
        }
    }
    return text;
}

std::string normal_form(std::string_view word)
{
    constexpr std::array<std::pair<std::string_view, std::string_view>, 22> synonyms{{
        {"per", "/"},          {"sec", "s"},          {"secs", "s"},        {"second", "s"},
        {"seconds", "s"},      {"squared", "2"},      {"square", "2"},      {"sq", "2"},
        {"gs", "g"},           {"gravity", "g"},      {"gravities", "g"},   {"gals", "gal"},
        {"meter", "m"},        {"meters", "m"},       {"metre", "m"},       {"metres", "m"},
        {"centimeter", "cm"},  {"centimeters", "cm"}, {"centimetre", "cm"}, {"centimetres", "cm"},
        {"millimeters", "mm"}, {"millimetres", "mm"},
    }};
    std::string result;
    std::string letters;
    const auto finish = [&] {
        const auto found = std::find_if(synonyms.begin(), synonyms.end(), [&](const auto& synonym) {
            return synonym.first == letters;
        });
        result += found == synonyms.end() ? letters : std::string(found->second);
        letters.clear();
    };
    for (const char letter : word) {
        if (is_letter(letter)) {
            letters += letter;
        } else if (letter != '\'') { // as in g's
            finish();
            result += std::string_view("^*._").find(letter) == std::string_view::npos
                          ? std::string(1, letter)
                          : "";
        }
    }
    finish();
    return result;
}

std::optional<AccelerationUnit> unit_of(std::string_view normal)
{
    if (normal == "g") {
        return AccelerationUnit::g;
    }
    if (normal == "gal") {
        return AccelerationUnit::cm_per_s2;
    }
    using Length = std::pair<std::string_view, AccelerationUnit>;
    for (const auto& [length, unit] :
         {Length("mm", AccelerationUnit::mm_per_s2), Length("cm", AccelerationUnit::cm_per_s2),
          Length("m", AccelerationUnit::m_per_s2)}) {
        for (const std::string_view rest : {"/s/s", "/s2", "/ss", "s-2", "s2", "ps2"}) {
            if (normal == std::string(length) + std::string(rest)) {
                return unit;
            }
        }
    }
    return std::nullopt;
}

bool is_operator(std::string_view word)
{
    constexpr std::array<std::string_view, 6> words{"per",     "times",      "x",
                                                    "divided", "multiplied", "squared"};
    return is_one_of(word, words) ||
           std::string_view("/*^").find(word[0]) != std::string_view::npos;
}

bool resembles_unit(std::string_view word)
{
    constexpr std::array<std::string_view, 38> names{
        "g",    "gs",           "gal",  "gals", "mgal",    "mg",     "ug",    "cms",
        "cmss", "mm",           "cm",   "dm",   "km",      "ft",     "feet",  "foot",
        "inch", "inches",       "si",   "cgs",  "mks",     "metric", "count", "counts",
        "mss",  "mps",          "cmps", "mmps", "mms",     "volt",   "volts", "ms",
        "msec", "milliseconds", "us",   "min",  "minutes", "hours"};
    const auto end = std::find_if_not(word.begin(), word.end(), is_letter);
    const std::string_view name = word.substr(0, std::size_t(end - word.begin()));
    const bool is_short = name == "m" || name == "in"; // also an initial, and a preposition
    return (is_short && end != word.end()) || is_one_of(name, names) ||
           (name.size() > 2 && is_one_of(normal_form(name), names));
}

bool is_time(std::string_view word)
{
    constexpr std::array<std::string_view, 7> units{"ms",  "msec",    "milliseconds", "us",
                                                    "min", "minutes", "hours"};
    return is_one_of(word, units);
}

bool is_always_unit(std::string_view word)
{
    constexpr std::array<std::string_view, 5> units{"n/kg", "si", "mks", "cgs", "mgal"};
    return is_one_of(word, units);
}

bool is_length_over_time(std::string_view word)
{
    constexpr std::array<std::string_view, 8> lengths{"mm", "cm", "dm", "km",
                                                      "m",  "ft", "in", "inches"};
    const std::string normal = normal_form(word);
    const std::size_t slash = std::min(normal.find('/'), normal.size());
    return normal == "cmss" ||
           (is_one_of(normal.substr(0, slash), lengths) && normal.substr(slash).starts_with("/s") &&
            (normal.size() == slash + 2 || !is_letter(normal[slash + 2])));
}

bool is_number_like(std::string_view word)
{
    return is_digit(word[0]) || (word.size() > 1 && word[0] == '.' && is_digit(word[1]));
}

std::optional<std::string_view> after_factor(std::string_view word)
{
    constexpr std::array<std::string_view, 8> names{"%",      "percent",    "milli",       "micro",
                                                    "tenths", "hundredths", "thousandths", "tenth"};
    std::size_t end = 0;
    for (const std::string_view name : names) {
        end = word.starts_with(name) ? std::max(end, name.size()) : end;
    }
    if (end == 0 && !is_number_like(word)) {
        return std::nullopt;
    }
    end = end > 0 ? end : word.find_first_not_of("0123456789.+-*/^");
    const std::string_view rest = word.substr(std::min(end, word.size()));
    return rest.starts_with('-') ? rest.substr(1) : rest;
}

} // namespace overturn
