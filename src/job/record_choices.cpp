#include "record_choices.hpp"

#include "overturn/text/mapped.hpp"

#include <fmt/ranges.h>

#include <map>
#include <set>

namespace overturn {

namespace {

namespace fs = std::filesystem;

// Larger suites are split into several jobs; a pattern cannot fill the memory.
constexpr std::size_t most_records = 10'000;

/// A component of a file as the job gives it: its name, or its number in digits.
std::string component_text(const Entry& entry)
{
    if (!entry.node->is_string() && !entry.node->is_integer()) {
        refuse(entry, " must be a string (the name of a component) or an integer (its number, "
                      "counted from 1).");
    }
    return entry.node->is_string() ? string_of(entry) : fmt::format("{}", integer_of(entry));
}

std::string list_text(const Parts& parts)
{
    return fmt::format("{}", fmt::join(mapped(parts, in_quotes), ", "));
}

/// For each record, the file that another pattern matches with the same parts.
std::vector<Choice> paired_files(const Entry& entry, const std::vector<GivenRecord>& records,
                                 const fs::path& folder)
{
    const std::string pattern = in_quotes(string_of(entry));
    const std::vector<Match> matches = files_of(entry, folder);
    std::map<Parts, std::string> files;
    for (const Match& match : matches) {
        files.emplace(match.parts, match.file);
    }
    std::set<Parts> of_records;
    std::vector<Choice> choices;
    for (const GivenRecord& record : records) {
        const std::size_t wildcards = matches.front().parts.size();
        if (record.parts.size() != wildcards) {
            refuse(entry,
                   " = {} has {} wildcards, but scene.record, which names {}, has {}. Files are "
                   "paired by the parts of their names that the wildcards stand for: give patterns "
                   "with equal numbers of them, or a list with one file for each record.",
                   pattern, wildcards, in_quotes(record.file), record.parts.size());
        }
        const auto found = files.find(record.parts);
        if (found == files.end()) {
            refuse(entry,
                   " = {} matches no file that pairs with the record {}: none has {} in place of "
                   "the wildcards. Add the file, or exclude the record.",
                   pattern, in_quotes(record.file), list_text(record.parts));
        }
        of_records.insert(record.parts);
        choices.push_back({entry, found->second});
    }
    for (const Match& match : matches) {
        if (!of_records.contains(match.parts)) {
            refuse(entry,
                   " = {} matches {}, which pairs with no record: scene.record has none with {} in "
                   "place of the wildcards. Add the record, or exclude the file.",
                   pattern, in_quotes(match.file), list_text(match.parts));
        }
    }
    return choices;
}

} // namespace

std::vector<GivenRecord> given_records(const Entry& scene, const fs::path& folder)
{
    const Entry entry = *find(scene, "record");
    const std::size_t size =
        entry.node->is_array() ? array_size(entry, "an array of paths", "Give at least one record.")
                               : 1;
    std::vector<GivenRecord> records;
    for (std::size_t i = 0; i < size; ++i) {
        const Entry one = entry.node->is_array() ? element(entry, i) : entry;
        for (Match& match : files_of(one, folder)) {
            records.push_back({one, std::move(match.file), std::move(match.parts)});
        }
    }
    if (records.size() > most_records) {
        refuse(entry, " names {} files, but at most {} are allowed. Split the suite.",
               records.size(), most_records);
    }
    return records;
}

std::vector<Choice> choices_of(std::string_view key, const Entry& scene,
                               const std::vector<GivenRecord>& records, const fs::path& folder)
{
    const auto entry = find(scene, key);
    if (!entry) {
        return {};
    }
    if (!entry->node->is_array()) {
        const std::string text = component_text(*entry);
        return key != "component" && entry->node->is_string() && is_pattern(text, folder)
                   ? paired_files(*entry, records, folder)
                   : std::vector<Choice>(records.size(), {*entry, text});
    }
    const std::size_t size =
        array_size(*entry, "a component, or an array with one for each record", "Remove the key.");
    if (size != records.size()) {
        refuse(*entry,
               " has length {}; the number of records is {}. Give one for each record, or a single "
               "value for all.",
               size, records.size());
    }
    std::vector<Choice> choices;
    for (std::size_t i = 0; i < size; ++i) {
        const Entry one = element(*entry, i);
        choices.push_back({one, component_text(one)});
    }
    return choices;
}

} // namespace overturn
