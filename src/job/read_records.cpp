#include "read_steps.hpp"

#include "overturn/record/read_record.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/utf8.hpp"

#include <glob.h>
#include <xxhash.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <initializer_list>
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

/// A record as the job gives it.
struct GivenRecord {
    Entry entry;
    std::string file;
};

/// The chosen component of a record. If its file has none of this name, null if the choice may be
/// another file.
const RecordComponent* chosen(const GivenRecord& given, const RecordFile& content,
                              const Entry& choice, bool may_be_file)
{
    const std::string text = component_text(choice);
    const bool is_number = choice.node->is_integer();
    const ChosenComponent chosen = chosen_component(
        content, is_number ? ComponentChoice(integer_of(choice)) : ComponentChoice(text),
        given.file);
    if (chosen.component == nullptr && (is_number || chosen.is_ambiguous || !may_be_file)) {
        refuse(choice, " = {} {}", text, chosen.refusal);
    }
    return chosen.component;
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

/// The text as a pattern that matches only itself.
std::string literally(std::string_view text)
{
    std::string pattern;
    for (const char letter : text) {
        pattern += std::string_view("*?[\\").find(letter) != std::string_view::npos ? "\\" : "";
        pattern += letter;
    }
    return pattern;
}

/// The text with its first folders literally, as long as they exist under these names in the
/// folder: `d \[1]/*.AT2` of `d [1]/*.AT2`.
std::string with_literal_folders(std::string_view text, const fs::path& folder)
{
    std::size_t literal = 0; // length of the folders that exist, with a slash behind each
    std::error_code not_found;
    for (std::size_t end = text.find('/'); end != text.npos; end = text.find('/', literal)) {
        if (!fs::is_directory(folder / text.substr(0, end + 1), not_found)) {
            break;
        }
        literal = end + 1;
    }
    return literally(text.substr(0, literal)) + std::string(text.substr(literal));
}

/// In any order; relative to the folder, unless the pattern is absolute.
std::vector<std::string> files_that_match(const std::string& pattern, const fs::path& folder)
{
    const bool is_absolute = fs::path(pattern).is_absolute();
    const std::string absolute =
        is_absolute ? pattern : literally((folder / "").string()) + pattern;
    glob_t found{};
    std::vector<std::string> files;
    glob(absolute.c_str(), GLOB_NOSORT, nullptr, &found);
    for (std::size_t i = 0; i < found.gl_pathc; ++i) {
        const fs::path path(found.gl_pathv[i]);
        files.push_back((is_absolute ? path : path.lexically_relative(folder)).string());
    }
    globfree(&found);
    return files;
}

/// The files that an entry of scene.record names, which may be a pattern, in byte order. What
/// exists as it is written is not a pattern.
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
    std::vector<std::string> files = files_that_match(with_literal_folders(text, folder), folder);
    if (files.empty()) {
        files = files_that_match(text, folder);
    }
    if (files.empty()) {
        refuse(entry,
               " = {} matches no file. It is relative to the job file, and a pattern: write [*], "
               "[?] and [[] for *, ? and [ themselves.",
               in_quotes(text));
    }
    std::ranges::sort(files);
    const auto other = std::ranges::find_if_not(files, is_utf8);
    if (other != files.end()) {
        refuse(entry, " = {} matches the file {}, whose name is not UTF-8. Rename it.",
               in_quotes(text), as_utf8(*other));
    }
    return files;
}

/// What the records of a job have in common.
struct Reading {
    const Entry& scene;
    fs::path folder; ///< of the job file
    RecordOptions options;
    double gravity;    ///< [m/s2]
    std::size_t count; ///< of records
};

/// The choice of a component for a record, with this key of [scene]: one for all records, or a list
/// with one for each; nullopt if there is none.
std::optional<Entry> choice_of_record(std::size_t record, std::string_view key,
                                      const Reading& reading)
{
    auto entry = find(reading.scene, key);
    if (!entry || !entry->node->is_array()) {
        return entry;
    }
    const std::size_t size =
        array_size(*entry, "a component, or an array with one for each record", "Remove the key.");
    if (size != reading.count) {
        refuse(*entry,
               " has length {}; the number of records is {}. Give one for each record, or a single "
               "value for all.",
               size, reading.count);
    }
    return element(*entry, record);
}

RecordFile content_of(const Entry& entry, const std::string& file, const Reading& reading)
{
    try {
        return read_record((reading.folder / file).string(), reading.options);
    } catch (const Error& error) {
        refuse(entry, ": {}", error.what());
    }
}

/// Refuses a component that does not belong to the horizontal one.
void expect_other(const Entry& choice, const RecordComponent& other,
                  const RecordComponent& horizontal)
{
    if (std::ranges::all_of(other.acceleration, [](double value) { return value == 0; })) {
        refuse(choice, " is zero at all times. Remove it.");
    }
    if (other.time_step != horizontal.time_step ||
        other.acceleration.size() != horizontal.acceleration.size()) {
        refuse(choice,
               " has {} samples at {} s, but the horizontal component has {} at {} s. Both must be "
               "equal.",
               other.acceleration.size(), other.time_step, horizontal.acceleration.size(),
               horizontal.time_step);
    }
    if (std::abs(other.start - horizontal.start) > horizontal.time_step / 2) {
        refuse(
            choice,
            " begins at {} s, but the horizontal component begins at {} s. Give both at the same "
            "times.",
            other.start, horizontal.start);
    }
    if (other.acceleration == horizontal.acceleration) {
        refuse(choice, " = {} has the accelerations of the horizontal component. Give another one.",
               component_text(choice));
    }
}

/// Of several components.
std::vector<std::string>
remarks_on(std::initializer_list<std::reference_wrapper<const RecordComponent>> components)
{
    std::vector<std::string> remarks;
    for (const RecordComponent& component : components) {
        remarks.insert(remarks.end(), component.remarks.begin(), component.remarks.end());
    }
    return remarks;
}

/// What the first of the components that state it says.
std::optional<MotionOf>
stated_motion_of(std::initializer_list<std::reference_wrapper<const RecordComponent>> components)
{
    for (const RecordComponent& component : components) {
        if (component.motion_of) {
            return component.motion_of;
        }
    }
    return std::nullopt;
}

/// The motion, whose name is that of the file and the component.
RecordedMotion read_motion(std::size_t number, const GivenRecord& given, const Reading& reading)
{
    const RecordFile content = content_of(given.entry, given.file, reading);
    const auto choice = choice_of_record(number, "component", reading);
    const RecordComponent& horizontal =
        choice ? *chosen(given, content, *choice, false) : content.components.front();
    if (horizontal.acceleration.size() < 2) {
        refuse(given.entry, " = {} has one sample. A record needs two or more.",
               in_quotes(given.file));
    }
    const auto read_other = [&](const std::optional<Entry>& choice_of_it) -> RecordComponent {
        if (!choice_of_it) {
            return {};
        }
        const RecordComponent* const same_file = chosen(given, content, *choice_of_it, true);
        RecordComponent other =
            same_file != nullptr
                ? *same_file
                : content_of(*choice_of_it, string_of(*choice_of_it), reading).components.front();
        expect_other(*choice_of_it, other, horizontal);
        return other;
    };
    const auto choice_of_vertical = choice_of_record(number, "vertical", reading);
    const auto choice_of_second = choice_of_record(number, "second_component", reading);
    const RecordComponent vertical = read_other(choice_of_vertical);
    const RecordComponent second = read_other(choice_of_second);
    auto record = std::make_shared<const Accelerogram>(
        over_gravity(horizontal, reading.gravity), over_gravity(vertical, reading.gravity),
        horizontal.time_step, over_gravity(second, reading.gravity));
    if (choice_of_second && record->second() == record->upwards()) {
        refuse(*choice_of_second, " = {} is also the vertical component. Correct one of them.",
               component_text(*choice_of_second));
    }
    const RecordedMotion motion{
        .file = given.file,
        .name = fmt::format("{}:{}", given.file, label_of(content, horizontal)),
        .component = horizontal.name,
        .vertical = choice_of_vertical ? component_text(*choice_of_vertical) : "",
        .second = choice_of_second ? component_text(*choice_of_second) : "",
        .is_uncorrected =
            horizontal.is_uncorrected || vertical.is_uncorrected || second.is_uncorrected,
        .remarks = remarks_on({horizontal, second, vertical}),
        .header = mapped(horizontal.header, as_utf8),
        .measures = intensity_measures(record->horizontal(), record->time_step(), reading.gravity),
        .stated_motion_of = stated_motion_of({horizontal, second, vertical}),
        .ground_pga = horizontal.ground_pga,
        .checksum = checksum_of({&record->horizontal(), &record->upwards(), &record->second()}),
        .record = record};
    if (!(motion.measures.pga > 0)) {
        refuse(given.entry, " = {} is zero at all times. Remove it.", in_quotes(given.file));
    }
    return motion;
}

RecordOptions read_options(const Entry& scene)
{
    RecordOptions options;
    if (const auto step = find(scene, "time_step")) {
        options.time_step = quantity_of(*step, quantity("time_step"));
    }
    if (const auto units = find(scene, "units")) {
        options.unit = choice_of<AccelerationUnit>(*units);
    }
    return options;
}

/// The records that [scene] gives.
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
            records.push_back({one, std::move(file)});
        }
    }
    if (records.size() > most_records) {
        refuse(entry, " names {} files, but at most {} are allowed. Split the suite.",
               records.size(), most_records);
    }
    return records;
}

/// Shortens the names, in which files are followed by components, as in "WTMC.V2A:N28W": to the
/// file if it has one motion only. Those that are equal are followed by the other components.
void shorten_names(std::vector<RecordedMotion>& motions)
{
    std::map<std::string, int> of_file, of_component;
    for (const RecordedMotion& motion : motions) {
        ++of_file[motion.file];
        ++of_component[motion.name];
    }
    for (RecordedMotion& motion : motions) {
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

std::string checksum_of(std::initializer_list<const std::vector<double>*> lists)
{
    std::uint64_t hash = 0;
    for (const std::vector<double>* values : lists) {
        hash = XXH64(values->data(), values->size() * sizeof(double), hash);
    }
    return fmt::format("{:016x}", hash);
}

std::vector<RecordedMotion> read_motions(const Entry& scene, const std::string& folder,
                                         double gravity)
{
    const std::vector<GivenRecord> records = given_records(scene, folder);
    const Reading reading{scene, folder, read_options(scene), gravity, records.size()};
    std::vector<RecordedMotion> motions;
    std::set<std::string> known; // file, component and accelerations
    for (const GivenRecord& given : records) {
        const RecordedMotion& motion =
            motions.emplace_back(read_motion(motions.size(), given, reading));
        const std::string path = fs::weakly_canonical(reading.folder / given.file).string();
        const std::string component = motion.name.substr(motion.file.size());
        if (!known.insert(path + component + ":" + motion.checksum).second) {
            refuse(given.entry,
                   " = {} is listed more than once with the same component, and would count as "
                   "several motions. List each motion once.",
                   in_quotes(given.file));
        }
    }
    shorten_names(motions);
    return motions;
}

MotionOf read_motion_of(const Entry& scene, const std::vector<RecordedMotion>& motions)
{
    const auto given = find(scene, "motion_of");
    const MotionOf otherwise = given ? choice_of<MotionOf>(*given) : MotionOf::ground;
    std::map<MotionOf, std::string> files;
    for (const RecordedMotion& motion : motions) {
        const MotionOf of_file = motion.stated_motion_of.value_or(otherwise);
        if (given && of_file != otherwise) {
            refuse(*given,
                   " = \"{}\", but the file {} states motion_of = {}. Remove the key, or correct "
                   "the file.",
                   name_of(otherwise), in_quotes(motion.file), name_of(of_file));
        }
        files.emplace(of_file, motion.file);
    }
    if (files.size() > 1) {
        refuse(*find(scene, "record"),
               ": {} is the motion of a floor, but {} does not state that it is one. Give the "
               "motions of floors and of the ground to different jobs; if all are of floors, give "
               "motion_of = \"floor\".",
               in_quotes(files.at(MotionOf::floor)), in_quotes(files.at(MotionOf::ground)));
    }
    return files.empty() ? otherwise : files.begin()->first;
}

} // namespace overturn
