#include "channels.hpp"

#include <algorithm>
#include <regex>

namespace overturn {

namespace {

/// The columns of the first format of Fortran in a line: (8F10.5), (10I8), (1E15.6), (1P5E15.6) and
/// the like. nullopt if there is none.
std::optional<Columns> columns_of_format(std::string_view line)
{
    static const std::regex format(
        R"(\([ \t]{0,9}([0-9]{1,3}[pP],?)?([0-9]{0,3})([iIfFeEdDgG])[sSnN]?([0-9]{1,3})(?![0-9])(\.([0-9]{1,9}))?)");
    std::cmatch found;
    if (!std::regex_search(line.data(), line.data() + line.size(), found, format)) {
        return std::nullopt;
    }
    const auto number = [&](std::size_t group, std::size_t otherwise) {
        return found.length(group) == 0 ? otherwise : std::stoul(found.str(group));
    };
    Columns columns{.width = number(4, 0), .per_line = number(2, 1), .decimals = {}};
    if (found.length(6) > 0 || lower(found.str(3)) == "i") {
        columns.decimals = number(6, 0);
    }
    return columns.width > 0 && columns.per_line > 0 ? std::optional(columns) : std::nullopt;
}

} // namespace

void expect_corrected_accelerogram(const Lines& lines)
{
    if (contains(lines.line(), "uncorrected")) {
        lines.refuse("this is an uncorrected accelerogram (V1A or volume 1). Give the corrected "
                     "one (V2A or volume 2).");
    }
    if (!contains(lines.line(), "accelerogram")) {
        lines.refuse("{} is not the first line of a channel, such as Corrected accelerogram. Give "
                     "the file as it was published.",
                     lines.quoted());
    }
}

ChannelName channel_name(Lines header, std::size_t end)
{
    static const std::regex channel(R"(^[ \t]*(?:sta +)?chan?[:.]?[ \t]*[^ :(]*[ \t]*:(.*)$)",
                                    std::regex::icase);
    constexpr std::string_view location = "location:";
    constexpr std::size_t most_characters = 200; // std::regex calls itself for each
    while (header.number() + 1 < end && header.next()) {
        const std::string line(header.line().substr(0, most_characters));
        std::smatch found;
        if (!std::regex_match(line, found, channel)) {
            continue;
        }
        const std::string text(trimmed(found.str(1)));
        const std::size_t place = place_after(text, location);
        const std::size_t before_place = place == text.npos ? place : place - location.size();
        const std::size_t last =
            std::min({text.find('('), text.find("  "), text.find('\t'), before_place, text.size()});
        std::string_view rest = place == text.npos ? std::string_view(text).substr(last)
                                                   : std::string_view(text).substr(place);
        rest = rest.starts_with('(') ? "" : rest;
        return {std::string(trimmed(text.substr(0, last))), std::string(trimmed(rest))};
    }
    return {};
}

namespace {

Announcement announcement(const Lines& lines, std::string_view name)
{
    return {count_of(lines, first_word(lines.line()), "the number of values"), name,
            lines.number()};
}

Columns announced_columns(const Lines& lines, const std::optional<Columns>& usual)
{
    const auto stated = columns_of_format(lines.line());
    if (!stated && !usual) {
        lines.refuse("the line states no format of the values, such as Format=(8F10.5). Give the "
                     "file as it was published.");
    }
    return stated ? *stated : *usual;
}

} // namespace

std::vector<double> take_announced(Lines& lines, std::string_view name,
                                   const std::optional<Columns>& usual)
{
    const Announcement announced = announcement(lines, name);
    return take_columns(lines, announced_columns(lines, usual), announced);
}

std::vector<Printed> take_announced_as_printed(Lines& lines, std::string_view name)
{
    const Announcement announced = announcement(lines, name);
    return take_printed(lines, announced_columns(lines, {}), announced);
}

} // namespace overturn
