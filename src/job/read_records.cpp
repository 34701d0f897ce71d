#include "read_steps.hpp"

#include "overturn/record/read_record.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/utf8.hpp"

#include <fmt/format.h>
#include <glob.h>
#include <xxhash.h>

#include <algorithm>
#include <filesystem>
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

/// The chosen component, or null if the file has none of this name or number.
const RecordComponent* chosen(const RecordFile& file, const Entry& choice)
{
    const std::string text = component_text(choice);
    for (std::size_t i = 0; i < file.components.size(); ++i) {
        const RecordComponent& component = file.components[i];
        if (text == (choice.node->is_integer() ? fmt::format("{}", i + 1) : component.name)) {
            return &component;
        }
    }
    return nullptr;
}

[[noreturn]] void refuse_component(const Entry& choice, const RecordFile& content,
                                   const std::string& file)
{
    std::string names;
    for (std::size_t i = 0; i < content.components.size(); ++i) {
        const std::string& name = content.components[i].name;
        names += fmt::format("{}{}{}", i == 0 ? "" : ", ", i + 1,
                             name.empty() ? "" : fmt::format(" ({})", in_quotes(name)));
    }
    refuse(choice, " = {} is not a component of {}. It has the components {}.",
           component_text(choice), in_quotes(file), names);
}

/// The name of a component, or its number if it has none, or none of its own, or one that looks
/// like a path.
std::string label_of(const RecordFile& file, const RecordComponent& component)
{
    const auto count = std::ranges::count(file.components, component.name, &RecordComponent::name);
    return component.name.empty() || count > 1 || component.name.find('/') != std::string::npos
               ? fmt::format("{}", &component - file.components.data() + 1)
               : component.name;
}

std::string checksum_of(const Accelerogram& record)
{
    std::uint64_t hash = 0;
    for (const std::vector<double>* values :
         {&record.horizontal(), &record.upwards(), &record.second()}) {
        hash = XXH64(values->data(), values->size() * sizeof(double), hash);
    }
    return fmt::format("{:016x}", hash);
}

/// The files that an entry of scene.record names, which may be a pattern, in byte order.
std::vector<std::string> files_of(const Entry& entry, const fs::path& folder)
{
    const std::string text = string_of(entry);
    if (text.empty() || text.find('\0') != text.npos) {
        refuse(entry, " is not a file name. Give the path of a record, relative to the job file.");
    }
    std::error_code not_found;
    if (text.find_first_of("*?[") == text.npos || fs::exists(folder / text, not_found)) {
        return {text};
    }
    std::string pattern; // the text, but not the folder of the job
    const bool is_absolute = fs::path(text).is_absolute();
    for (const char letter : is_absolute ? "" : (folder / "").string()) {
        pattern += std::string_view("*?[\\").find(letter) != std::string_view::npos ? "\\" : "";
        pattern += letter;
    }
    glob_t found{};
    std::vector<std::string> files;
    glob((pattern + text).c_str(), GLOB_NOSORT, nullptr, &found);
    for (std::size_t i = 0; i < found.gl_pathc; ++i) {
        const fs::path path(found.gl_pathv[i]);
        files.push_back((is_absolute ? path : path.lexically_relative(folder)).string());
    }
    globfree(&found);
    if (files.empty()) {
        refuse(entry, " = {} matches no file. It is relative to the job file.", in_quotes(text));
    }
    std::ranges::sort(files);
    const auto other = std::ranges::find_if_not(files, is_utf8);
    if (other != files.end()) {
        refuse(entry, " = {} matches the file {}, whose name is not UTF-8. Rename it.",
               in_quotes(text), as_utf8(*other));
    }
    return files;
}

/// The choice of a component for each of `count` records, with this key of [scene]: one for all, or
/// a list with one for each; nullopt if there is none.
std::vector<std::optional<Entry>> choices_of(const Entry& scene, std::string_view key,
                                             std::size_t count)
{
    const auto entry = find(scene, key);
    std::vector<std::optional<Entry>> choices(count, entry);
    if (!entry || !entry->node->is_array()) {
        return choices;
    }
    const std::size_t size =
        array_size(*entry, "a component, or an array with one for each record", "Remove the key.");
    if (size != count) {
        refuse(*entry,
               " has length {}; the number of records is {}. Give one for each record, or a single "
               "value for all.",
               size, count);
    }
    for (std::size_t i = 0; i < size; ++i) {
        choices[i] = element(*entry, i);
    }
    return choices;
}

/// What the records of a job have in common.
struct Reading {
    fs::path folder; ///< of the job file
    RecordOptions options;
    double gravity; ///< [m/s2]
};

/// A record as the job gives it.
struct GivenRecord {
    Entry entry;
    std::string file;
    std::optional<Entry> component;
    std::optional<Entry> vertical;
    std::optional<Entry> second;
};

RecordFile content_of(const Entry& entry, const std::string& file, const Reading& reading)
{
    try {
        return read_record((reading.folder / file).string(), reading.options);
    } catch (const Error& error) {
        refuse(entry, ": {}", error.what());
    }
}

/// The first component of a motion.
struct FirstComponent {
    const std::string& file;
    const RecordFile& content;
    const RecordComponent& horizontal;
};

/// Another component of a motion.
struct OtherComponent {
    std::vector<double> acceleration; ///< over g; empty if there is none
    bool is_uncorrected = false;
};

/// Another component of the motion, if there is a choice: it is of the same file, or another file.
/// name: of this component, in messages.
OtherComponent other_component(const std::optional<Entry>& choice_of_it, std::string_view name,
                               const FirstComponent& first, const Reading& reading)
{
    if (!choice_of_it) {
        return {};
    }
    const Entry& choice = *choice_of_it;
    const auto& [file, content, horizontal] = first;
    const RecordComponent* component = chosen(content, choice);
    RecordFile other;
    if (component == nullptr) {
        if (choice.node->is_integer()) {
            refuse_component(choice, content, file);
        }
        other = content_of(choice, string_of(choice), reading);
        component = &other.components.front();
    }
    if (std::ranges::all_of(component->acceleration, [](double value) { return value == 0; })) {
        refuse(choice, " is zero at all times. Remove it.");
    }
    if (component->time_step != horizontal.time_step ||
        component->acceleration.size() != horizontal.acceleration.size()) {
        refuse(choice,
               " has {} samples at {} s, but the horizontal component has {} at {} s. Both must be "
               "equal.",
               component->acceleration.size(), component->time_step, horizontal.acceleration.size(),
               horizontal.time_step);
    }
    if (std::abs(component->start - horizontal.start) > horizontal.time_step / 2) {
        refuse(
            choice,
            " begins at {} s, but the horizontal component begins at {} s. Give both at the same "
            "times.",
            component->start, horizontal.start);
    }
    if (component->acceleration == horizontal.acceleration) {
        refuse(choice, " = {} has the accelerations of the horizontal component. Give the {} one.",
               component_text(choice), name);
    }
    return {over_gravity(*component, reading.gravity), component->is_uncorrected};
}

/// The motion, without a name.
std::pair<Motion, std::shared_ptr<const Accelerogram>> read_motion(const GivenRecord& given,
                                                                   const Reading& reading)
{
    const RecordFile content = content_of(given.entry, given.file, reading);
    const RecordComponent* const horizontal =
        given.component ? chosen(content, *given.component) : &content.components.front();
    if (horizontal == nullptr) {
        refuse_component(*given.component, content, given.file);
    }
    if (horizontal->acceleration.size() < 2) {
        refuse(given.entry, " = {} has one sample. A record needs two or more.",
               in_quotes(given.file));
    }
    const FirstComponent first{given.file, content, *horizontal};
    OtherComponent vertical = other_component(given.vertical, "vertical", first, reading);
    OtherComponent second = other_component(given.second, "second", first, reading);
    auto record = std::make_shared<const Accelerogram>(
        over_gravity(*horizontal, reading.gravity), std::move(vertical.acceleration),
        horizontal->time_step, std::move(second.acceleration));
    if (given.second && record->second() == record->upwards()) {
        refuse(*given.second, " = {} is also the vertical component. Correct one of them.",
               component_text(*given.second));
    }
    Motion motion{
        .file = given.file,
        .name = {},
        .component = horizontal->name,
        .label = label_of(content, *horizontal),
        .vertical = given.vertical ? component_text(*given.vertical) : "",
        .second = given.second ? component_text(*given.second) : "",
        .is_uncorrected =
            horizontal->is_uncorrected || vertical.is_uncorrected || second.is_uncorrected,
        .header = {},
        .measures = intensity_measures(record->horizontal(), record->time_step(), reading.gravity),
        .checksum = checksum_of(*record)};
    std::ranges::transform(horizontal->header, std::back_inserter(motion.header), as_utf8);
    if (!(motion.measures.pga > 0)) {
        refuse(given.entry, " = {} is zero at all times. Remove it.", in_quotes(given.file));
    }
    return {std::move(motion), std::move(record)};
}

RecordOptions read_options(const Entry& scene)
{
    RecordOptions options;
    if (const auto step = find(scene, "time_step")) {
        options.time_step = quantity_of(*step, quantity("time_step"));
    }
    if (const auto units = find(scene, "units")) {
        options.unit = choice_of<AccelerationUnit>(*units, acceleration_unit_names);
    }
    return options;
}

/// The records that [scene] gives, with a component of each.
std::vector<GivenRecord> given_records(const Entry& scene, const fs::path& folder)
{
    const Entry entry = *find(scene, "record");
    const std::size_t size =
        entry.node->is_array() ? array_size(entry, "an array of paths", "Give at least one record.")
                               : 1;
    std::vector<GivenRecord> records;
    for (std::size_t i = 0; i < size; ++i) {
        const Entry one = entry.node->is_array() ? element(entry, i) : entry;
        for (std::string& file : files_of(one, folder)) {
            records.push_back({one, std::move(file), {}, {}, {}});
        }
    }
    if (records.size() > most_records) {
        refuse(entry, " names {} files, but at most {} are allowed. Split the suite.",
               records.size(), most_records);
    }
    const auto components = choices_of(scene, "component", records.size());
    const auto verticals = choices_of(scene, "vertical", records.size());
    const auto seconds = choices_of(scene, "second_component", records.size());
    for (std::size_t i = 0; i < records.size(); ++i) {
        records[i].component = components[i];
        records[i].vertical = verticals[i];
        records[i].second = seconds[i];
    }
    return records;
}

/// Sets the name of every motion: its file; if several motions are of one file, the file and the
/// component, as in "WTMC.V2A:N28W"; if these have several other components, also those.
void name_motions(std::vector<Motion>& motions)
{
    std::map<std::string, int> of_file, of_component;
    for (Motion& motion : motions) {
        motion.name = motion.file + ":" + motion.label;
        ++of_file[motion.file];
        ++of_component[motion.name];
    }
    for (Motion& motion : motions) {
        if (of_file[motion.file] == 1) {
            motion.name = motion.file;
        } else if (of_component[motion.name] > 1) {
            for (const std::string& other : {motion.second, motion.vertical}) {
                motion.name += other.empty() ? "" : ":" + other;
            }
        }
    }
}

} // namespace

RecordedMotions read_motions(const Entry& scene, const std::string& folder, double gravity)
{
    const std::vector<GivenRecord> records = given_records(scene, folder);
    const Reading reading{folder, read_options(scene), gravity};
    RecordedMotions recorded;
    const Entry& first = records.front().entry;
    recorded.is_suite =
        find(scene, "record")->node->is_array() || records.front().file != string_of(first);
    std::set<std::string> known; // file, component and accelerations
    for (const GivenRecord& given : records) {
        auto [motion, record] = read_motion(given, reading);
        const std::string path = fs::weakly_canonical(reading.folder / given.file).string();
        if (!known.insert(fmt::format("{}:{}:{}", path, motion.label, motion.checksum)).second) {
            refuse(given.entry,
                   " = {} is listed more than once with the same component, and would count as "
                   "several motions. List each motion once.",
                   in_quotes(given.file));
        }
        recorded.motions.push_back(std::move(motion));
        recorded.records.push_back(std::move(record));
    }
    name_motions(recorded.motions);
    return recorded;
}

} // namespace overturn
