#include "job_difference.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace overturn {

namespace {

/// The line of a text that begins at `begin`; of a long one, the part around `place`.
std::string line_around(std::string_view text, std::size_t begin, std::size_t place)
{
    constexpr std::size_t before = 40;
    constexpr std::size_t length = 80;
    if (begin == text.size()) {
        return "(nothing more)";
    }
    const std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
    const std::size_t hidden = line.size() <= length ? 0 : std::max(place - begin, before) - before;
    const std::string_view shown = line.substr(hidden, length);
    return fmt::format("{}{}{}", hidden > 0 ? "..." : "", shown,
                       hidden + shown.size() < line.size() ? "..." : "");
}

/// The part of a line of a resolved job between two words; empty for other lines.
std::string_view part_between(std::string_view before, std::string_view after,
                              std::string_view line)
{
    const std::size_t begin = line.find(before);
    const std::size_t end = line.find(after);
    return begin < end && end != line.npos
               ? line.substr(begin + before.size(), end - begin - before.size())
               : std::string_view();
}

/// The file of a record that a line of a resolved job names.
std::string_view record_named_in(std::string_view line)
{
    return part_between("{ file = ", ", component = ", line);
}

/// The table of blocks, if a resolved job names it before a place in the lines about it.
std::string_view table_named_before(std::string_view job, std::size_t place)
{
    constexpr std::string_view before = "[blocks]\ntable = ";
    const std::size_t section = job.substr(0, place).rfind("\n[");
    const std::string_view lines = section == job.npos ? job : job.substr(section + 1);
    return lines.starts_with(before)
               ? lines.substr(before.size(), lines.find('\n', before.size()) - before.size())
               : std::string_view();
}

} // namespace

std::string differing_line(std::string_view stored, std::string_view given, std::string_view whose)
{
    const auto differ = std::ranges::mismatch(stored, given);
    const auto place = std::size_t(differ.in1 - stored.begin());
    const std::string_view same = given.substr(0, place);
    const std::size_t begin = same.rfind('\n') + 1; // 0 if there is none
    return fmt::format("line {} of its resolved job is\n  {}\nbut in {} it is\n  {}\n",
                       1 + std::ranges::count(same, '\n'), line_around(stored, begin, place), whose,
                       line_around(given, begin, place));
}

std::string first_difference(std::string_view stored, std::string_view given)
{
    constexpr std::string_view restore = "Restore it, or choose another name with -o.";
    const auto differ = std::ranges::mismatch(stored, given);
    const auto place = std::size_t(differ.in1 - stored.begin());
    const std::string_view same = given.substr(0, place);
    const std::size_t begin = same.rfind('\n') + 1; // 0 if there is none
    const auto line_of = [&](std::string_view text) {
        return text.substr(begin, text.find('\n', begin) - begin);
    };
    const std::string_view record = record_named_in(line_of(given));
    const std::string_view former = record_named_in(line_of(stored));
    if (!record.empty() && record == former) {
        return fmt::format("the record {} has changed since then, or is read with other keys "
                           "(component, second_component, vertical, time_step, units, gravity). {}",
                           record, restore);
    }
    if (!record.empty() || !former.empty()) {
        const auto name_of = [](std::string_view name) { return name.empty() ? "none" : name; };
        return fmt::format("its records were others; the first that differs was {}, and is {} in "
                           "this job. A pattern may match other files than then. Restore them, or "
                           "choose another name with -o.",
                           name_of(former), name_of(record));
    }
    const auto table_of = [&](std::string_view job) {
        const auto shape = part_between("shape = { file = ", ", rows = ", line_of(job));
        return shape.empty() ? table_named_before(job, place) : shape;
    };
    const std::string_view table = table_of(given);
    if (table.size() > std::string_view("\"\"").size() && table == table_of(stored)) {
        return fmt::format("the table {} has changed since then. {}", table, restore);
    }
    return differing_line(stored, given, "this job") +
           "Undo the change of the job file, repeat the --set arguments of the first run, or "
           "choose another name with -o.";
}

} // namespace overturn
