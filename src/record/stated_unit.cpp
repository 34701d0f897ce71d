#include "stated_unit.hpp"

#include <boost/algorithm/string.hpp>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

namespace overturn {

double units_per_m_per_s2(AccelerationUnit unit)
{
    constexpr std::array<double, names_of<AccelerationUnit>.size()> numbers{0, 1, 100, 1000, 100};
    return numbers[std::size_t(unit)];
}

std::string in_few_spellings(std::string_view text)
{
    using Replacement = std::pair<const char*, const char*>;
    constexpr Replacement characters[] = {
        {"\u00a0", " "}, {"\u2009", " "}, {"\u202f", " "}, {"\t", " "},     {"\u00b7", " "},
        {"\u22c5", " "}, {"\u00b2", "2"}, {"\xb2", "2"},   {"\u00b3", "3"}, {"\u207b", "-"},
        {"\u2212", "-"}, {"\u00b5", "u"}, {"\u03bc", "u"}, {"\u039c", "u"}, {"\u00d7", "*"},
        {"**", ""},      {"^", ""},       {"'", ""}};
    constexpr Replacement spellings[] = {
        {"seconds", "s"},   {"second", "s"},     {"secs", "s"},        {"sec", "s"},
        {"meter", "metre"}, {"metres", "metre"}, {"centimetre", "cm"}, {"millimetre", "mm"},
        {"metre", "m"},     {" squared", "2"},   {" square", "2"},     {" per ", "/"},
        {"_per_", "/"},     {" /", "/"},         {"/ ", "/"},          {" *", "*"},
        {"* ", "*"},        {"s*s", "ss"},       {"(ss", "ss"},        {"/s/s", "/s2"},
        {"/ss", "/s2"},     {"mps2", "m/s2"},    {"ms2", "m/s2"},      {"m s2", "m/s2"},
        {"m_s2", "m/s2"},   {"ms-2", "m/s2"},    {"m s-2", "m/s2"},    {"m_s-2", "m/s2"}};
    std::string result = lower(text);
    for (const auto& [spelling, usual] : characters) {
        boost::algorithm::replace_all(result, spelling, usual);
    }
    const auto are_blanks = [](char first, char second) { return first == ' ' && second == ' '; };
    result.erase(std::unique(result.begin(), result.end(), are_blanks), result.end());
    for (const auto& [spelling, usual] : spellings) {
        boost::algorithm::replace_all(result, spelling, usual);
    }
    return result;
}

std::optional<AccelerationUnit> unit_named(std::string_view name)
{
    using enum AccelerationUnit;
    const std::string text =
        boost::algorithm::trim_copy_if(in_few_spellings(name), boost::algorithm::is_any_of(" .()"));
    return is_one_of(text, {"g", "gs", "gn", "g0", "gravity"}) ? std::optional(g)
           : is_one_of(text, {"gal", "gals", "cm/s2"})         ? std::optional(cm_per_s2)
           : text == "mm/s2"                                   ? std::optional(mm_per_s2)
           : text == "m/s2"                                    ? std::optional(m_per_s2)
                                                               : std::nullopt;
}

AccelerationUnit unit_of_samples(const Lines& lines, std::string_view name)
{
    const auto unit = unit_named(name);
    if (!unit) {
        lines.refuse("the unit {} of the samples is not understood. Understood are {} and their "
                     "usual spellings, such as cm/sec2. Give the file of the acceleration, or the "
                     "values as text with their unit.",
                     quoted_bytes(name), fmt::join(names_of<AccelerationUnit>, ", "));
    }
    return *unit;
}

std::string_view text_after(std::string_view line, std::string_view word)
{
    const std::size_t place = place_after(line, word);
    const std::string_view rest = place == line.npos ? "" : line.substr(place);
    const std::string_view text =
        rest.substr(std::min(rest.find_first_not_of(" \t:="), rest.size()));
    return trimmed(text.substr(0, text.find_first_of("(),;")));
}

std::string how_to_state(std::string_view option)
{
    return fmt::format(
        "scene.{0} in a job, --set scene.{0}=... on the command line, or {0}=... in Python",
        option);
}

} // namespace overturn
