#include "read_steps.hpp"

#include "motion_names.hpp"
#include "overturn/record/read_record.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/utf8.hpp"
#include "toml_text.hpp"

#include <fmt/format.h>
#include <glob.h>
#include <xxhash.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace overturn {

namespace {

namespace fs = std::filesystem;

// Larger suites are split into several jobs; a pattern cannot fill the memory.
constexpr std::size_t most_records = 10'000;

/// Which component of a file: its name, or its number counted from 1.
struct ComponentChoice {
    Entry entry;
    std::string text; ///< a name, or a number in digits
    bool is_number;
};

ComponentChoice component_choice(const Entry& entry)
{
    if (entry.node->is_string()) {
        return {entry, string_of(entry), false};
    }
    if (!entry.node->is_integer()) {
        refuse(entry, " must be a string (the name of a component) or an integer (its number, "
                      "counted from 1).");
    }
    return {entry, fmt::format("{}", integer_of(entry)), true};
}

std::string names_of(const RecordFile& file)
{
    std::string names;
    for (std::size_t i = 0; i < file.components.size(); ++i) {
        const std::string& name = file.components[i].name;
        names += fmt::format("{}{}", i == 0 ? "" : ", ", i + 1);
        names += name.empty() ? "" : fmt::format(" ({})", in_quotes(name));
    }
    return names;
}

/// The chosen component, or null if the file has none of this name or number.
const RecordComponent* chosen(const RecordFile& file, const ComponentChoice& choice)
{
    for (std::size_t i = 0; i < file.components.size(); ++i) {
        const std::string& name = file.components[i].name;
        if (choice.is_number ? choice.text == fmt::format("{}", i + 1) : choice.text == name) {
            return &file.components[i];
        }
    }
    return nullptr;
}

std::uint64_t checksum_of(const Accelerogram& record)
{
    const auto hash = [](const std::vector<double>& values, std::uint64_t seed) {
        return std::uint64_t(XXH64(values.data(), values.size() * sizeof(double), seed));
    };
    return hash(record.upwards(), hash(record.horizontal(), 0));
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
    // Only the text is a pattern, not the folder of the job.
    std::string pattern;
    if (!fs::path(text).is_absolute()) {
        for (const char letter : (folder / "").string()) {
            pattern += std::string_view("*?[\\").find(letter) != std::string_view::npos ? "\\" : "";
            pattern += letter;
        }
    }
    glob_t found{};
    std::vector<std::string> files;
    if (glob((pattern + text).c_str(), GLOB_NOSORT, nullptr, &found) == 0) {
        for (std::size_t i = 0; i < found.gl_pathc; ++i) {
            const fs::path path(found.gl_pathv[i]);
            files.push_back(fs::path(text).is_absolute()
                                ? path.string()
                                : path.lexically_relative(folder).string());
        }
    }
    globfree(&found);
    if (files.empty()) {
        refuse(entry, fmt::format(" = {} matches no file. It is relative to the job file.",
                                  in_quotes(text)));
    }
    std::sort(files.begin(), files.end());
    const auto other = std::find_if_not(files.begin(), files.end(), is_utf8);
    if (other != files.end()) {
        refuse(entry, fmt::format(" = {} matches the file {}, whose name is not UTF-8. Rename it.",
                                  in_quotes(text), as_utf8(*other)));
    }
    return files;
}

/// The choice for each of `count` records: one for all, or a list with one for each.
std::vector<ComponentChoice> choices_of(const Entry& entry, std::size_t count)
{
    if (!entry.node->is_array()) {
        return std::vector<ComponentChoice>(count, component_choice(entry));
    }
    const std::size_t size =
        array_size(entry, "a component, or an array with one for each record", "Remove the key.");
    if (size != count) {
        refuse(entry,
               fmt::format(
                   " has length {}; the number of records is {}. Give one for each record, or a "
                   "single value for all.",
                   size, count));
    }
    std::vector<ComponentChoice> choices;
    for (std::size_t i = 0; i < size; ++i) {
        choices.push_back(component_choice(element(entry, i)));
    }
    return choices;
}

/// Reads records and adds them to the scene and the job's motions.
class RecordReader {
public:
    RecordReader(const fs::path& folder, const RecordOptions& options, double gravity)
        : folder_(folder), options_(options), gravity_(gravity)
    {}

    struct Result {
        Motion motion; ///< without a name
        std::shared_ptr<const Accelerogram> record;
        std::string label; ///< of the component in the file
    };
    Result read(const Entry& entry, const std::string& file,
                const std::optional<ComponentChoice>& component,
                const std::optional<ComponentChoice>& vertical) const
    {
        const RecordFile content = content_of(entry, file);
        const RecordComponent* horizontal =
            component ? chosen(content, *component) : &content.components.front();
        if (horizontal == nullptr) {
            refuse(component->entry,
                   fmt::format(" = {} is not a component of {}. It has the components {}.",
                               component->text, in_quotes(file), names_of(content)));
        }
        Motion motion;
        motion.file = file;
        motion.component = horizontal->name;
        std::transform(horizontal->header.begin(), horizontal->header.end(),
                       std::back_inserter(motion.header), as_utf8);
        std::vector<double> upwards;
        if (vertical) {
            upwards = upwards_of(*vertical, content, *horizontal);
            motion.vertical = vertical->text;
        }
        if (horizontal->acceleration.size() < 2) {
            refuse(entry, fmt::format(" = {} has one sample. A record needs two or more.",
                                      in_quotes(file)));
        }
        auto record = std::make_shared<const Accelerogram>(
            over_gravity(*horizontal, gravity_), std::move(upwards), horizontal->time_step);
        motion.measures = intensity_measures(record->horizontal(), record->time_step(), gravity_);
        motion.checksum = fmt::format("{:016x}", checksum_of(*record));
        if (!(motion.measures.pga > 0)) {
            refuse(entry, fmt::format(" = {} is zero at all times. Remove it.", in_quotes(file)));
        }
        return {std::move(motion), std::move(record), label_of(content, *horizontal)};
    }

private:
    RecordFile content_of(const Entry& entry, const std::string& file) const
    {
        try {
            return read_record((folder_ / file).string(), options_);
        } catch (const Error& error) {
            throw Error(exit_code::job, "{}: {}: {}", place_of(entry.node->source()), entry.key,
                        error.what());
        }
    }

    /// The vertical accelerations over g: a component of the same file, or another file.
    std::vector<double> upwards_of(const ComponentChoice& choice, const RecordFile& content,
                                   const RecordComponent& horizontal) const
    {
        const RecordComponent* component = chosen(content, choice);
        RecordFile other;
        if (component == nullptr) {
            if (choice.is_number) {
                refuse(choice.entry,
                       fmt::format(" = {} is not a component of the file. It has the components "
                                   "{}.",
                                   choice.text, names_of(content)));
            }
            other = content_of(choice.entry, choice.text);
            component = &other.components.front();
        }
        if (component->time_step != horizontal.time_step ||
            component->acceleration.size() != horizontal.acceleration.size()) {
            refuse(choice.entry,
                   fmt::format(" has {} samples at {} s, but the horizontal component has {} at {} "
                               "s. Both must be equal.",
                               component->acceleration.size(), component->time_step,
                               horizontal.acceleration.size(), horizontal.time_step));
        }
        if (component->acceleration == horizontal.acceleration) {
            refuse(choice.entry, fmt::format(" = {} has the accelerations of the horizontal "
                                             "component. Give the vertical one.",
                                             choice.text));
        }
        return over_gravity(*component, gravity_);
    }

    fs::path folder_;
    RecordOptions options_;
    double gravity_;
};

RecordOptions read_options(const Entry& scene)
{
    RecordOptions options;
    if (const auto step = find(scene, "time_step")) {
        options.time_step = number_of(*step);
        expect_allowed(*step, quantity("time_step"), *options.time_step);
    }
    if (const auto units = find(scene, "units")) {
        options.unit = choice_of<AccelerationUnit>(*units, acceleration_unit_names);
    }
    return options;
}

} // namespace

RecordedMotions read_motions(const Entry& scene, const std::string& folder, double gravity)
{
    const Entry entry = require(scene, "record", "Give the path of a record.");
    std::vector<Entry> entries;
    if (entry.node->is_array()) {
        const std::size_t size =
            array_size(entry, "an array of paths", "Give at least one record.");
        for (std::size_t i = 0; i < size; ++i) {
            entries.push_back(element(entry, i));
        }
    } else {
        entries.push_back(entry);
    }
    std::vector<std::pair<Entry, std::string>> files;
    for (const Entry& one : entries) {
        for (const std::string& file : files_of(one, folder)) {
            files.emplace_back(one, file);
        }
    }
    if (files.size() > most_records) {
        refuse(entry, fmt::format(" names {} files, but at most {} are allowed. Split the suite.",
                                  files.size(), most_records));
    }
    std::vector<ComponentChoice> components, verticals;
    if (const auto component = find(scene, "component")) {
        components = choices_of(*component, files.size());
    }
    if (const auto vertical = find(scene, "vertical")) {
        verticals = choices_of(*vertical, files.size());
    }
    const RecordReader reader(folder, read_options(scene), gravity);
    RecordedMotions recorded;
    recorded.is_suite = entry.node->is_array() || files.front().second != string_of(entry);
    std::vector<std::string> labels;
    std::set<std::string> known; // file, component and accelerations
    for (std::size_t i = 0; i < files.size(); ++i) {
        const auto choice = [&](const std::vector<ComponentChoice>& from) {
            return from.empty() ? std::nullopt : std::optional(from[i]);
        };
        const auto& [place, file] = files[i];
        auto [motion, record, label] =
            reader.read(place, file, choice(components), choice(verticals));
        const std::string path = fs::weakly_canonical(fs::path(folder) / file).string();
        if (!known.insert(fmt::format("{}:{}:{}", path, label, motion.checksum)).second) {
            refuse(place, fmt::format(" = {} is listed more than once with the same component, and "
                                      "would count as several motions. List each motion once.",
                                      in_quotes(file)));
        }
        recorded.motions.push_back(std::move(motion));
        recorded.records.push_back(std::move(record));
        labels.push_back(std::move(label));
    }
    name_motions(recorded.motions, labels);
    return recorded;
}

} // namespace overturn
