#include "read_steps.hpp"
#include "record_choices.hpp"

#include "overturn/record/read_record.hpp"
#include "overturn/record/text_file.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/quoting.hpp"
#include "overturn/text/utf8.hpp"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <set>
#include <string_view>

namespace overturn {

namespace {

namespace fs = std::filesystem;

/// The chosen component of a record. If its file has none of this name, null if the choice may be
/// another file.
const RecordComponent* chosen(const GivenRecord& given, const RecordFile& content,
                              const Choice& choice, bool may_be_file)
{
    const bool is_number = choice.entry.node->is_integer();
    const ChosenComponent chosen = chosen_component(
        content,
        is_number ? ComponentChoice(integer_of(choice.entry)) : ComponentChoice(choice.text),
        given.file);
    if (chosen.component == nullptr && (is_number || chosen.is_ambiguous || !may_be_file)) {
        refuse(choice.entry, " = {} {}", choice.text, chosen.refusal);
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

/// What the records of a job have in common.
struct Reading {
    fs::path folder; ///< of the job file
    RecordOptions options;
    double gravity; ///< [m/s2]
};

RecordFile content_of(const Entry& entry, const std::string& file, const Reading& reading)
{
    try {
        return read_record((reading.folder / file).string(), reading.options);
    } catch (const Error& error) {
        refuse(entry, ": {}", error.what());
    }
}

/// Of the longer component, by which another one may be shorter.
constexpr double largest_missing_share = 0.01;

/// Refuses a component that does not belong to the horizontal one.
void expect_other(const Choice& choice, const RecordComponent& other,
                  const RecordComponent& horizontal)
{
    const auto [shorter, longer] =
        std::minmax({other.acceleration.size(), horizontal.acceleration.size()});
    if (std::ranges::all_of(other.acceleration, [](double value) { return value == 0; })) {
        refuse(choice.entry, " = {} is zero at all times. Remove it.", choice.text);
    }
    if (other.time_step != horizontal.time_step ||
        double(longer - shorter) > largest_missing_share * double(longer)) {
        refuse(
            choice.entry,
            " = {} has {} samples at {} s, but the horizontal component has {} at {} s. The "
            "steps must be equal, and the numbers to within {:g} %, for which zeros are added at "
            "the end. Give components of one motion.",
            choice.text, other.acceleration.size(), other.time_step, horizontal.acceleration.size(),
            horizontal.time_step, 100 * largest_missing_share);
    }
    if (std::abs(other.start - horizontal.start) > horizontal.time_step / 2) {
        refuse(choice.entry,
               " = {} begins at {} s, but the horizontal component begins at {} s. Give both at "
               "the same times.",
               choice.text, other.start, horizontal.start);
    }
    if (other.acceleration == horizontal.acceleration) {
        refuse(choice.entry,
               " = {} has the accelerations of the horizontal component. Give another one.",
               choice.text);
    }
}

/// A component of a motion, and what names it; empty if the motion has none.
struct NamedComponent {
    std::string name; ///< as in the job: a file, or a component
    RecordComponent content;
};

/// The horizontal component, the second one, and the vertical one.
using Components = std::array<NamedComponent, 3>;

std::size_t samples_of(const Components& components)
{
    return std::ranges::max(mapped(
        components, [](const NamedComponent& each) { return each.content.acceleration.size(); }));
}

/// Whether vertical components have such names: "UD", "Up", "HNZ".
bool is_name_of_vertical(std::string_view name)
{
    const bool is_channel_code = name.size() == 3 && name.ends_with('Z');
    return is_channel_code || is_one_of(lower(name), {"ud", "up", "u", "z", "vert", "vertical"});
}

/// Those of the files, on components of other events than that of the first one, on zeros that are
/// added, and on vertical components that are taken for horizontal ones.
std::vector<std::string> remarks_on(const Components& components)
{
    std::vector<std::string> remarks;
    const std::string& event = components[0].content.event;
    for (const auto& [name, content] : components) {
        remarks.insert(remarks.end(), content.remarks.begin(), content.remarks.end());
        if (!event.empty() && !content.event.empty() && content.event != event) {
            remarks.push_back(fmt::format(
                "{} is of {}, but {} of {}: they may be different motions", components[0].name,
                in_quotes(as_utf8(event)), name, in_quotes(as_utf8(content.event))));
        }
        if (&content != &components.back().content && is_name_of_vertical(content.name)) {
            remarks.push_back(fmt::format("{} is called {}, as vertical components are, but is a "
                                          "horizontal one here",
                                          name, in_quotes(as_utf8(content.name))));
        }
        const std::size_t size = content.acceleration.size();
        if (const std::size_t added = samples_of(components) - size; size > 0 && added > 0) {
            remarks.push_back(fmt::format(
                "{} has {} samples, fewer than another component: {} {} added at the end", name,
                size, added, added == 1 ? "zero is" : "zeros are"));
        }
    }
    return remarks;
}

/// What the first of the components that state it says.
std::optional<MotionOf> stated_motion_of(const Components& components)
{
    for (const NamedComponent& component : components) {
        if (component.content.motion_of) {
            return component.content.motion_of;
        }
    }
    return std::nullopt;
}

/// The choices of the components of a record; null: the default, or none.
struct Choices {
    const Choice* component;
    const Choice* second;
    const Choice* vertical;
};

/// The motion, whose name is that of the file and the component.
RecordedMotion read_motion(const GivenRecord& given, const Choices& choices, const Reading& reading)
{
    const RecordFile content = content_of(given.entry, given.file, reading);
    const RecordComponent& horizontal = choices.component != nullptr
                                            ? *chosen(given, content, *choices.component, false)
                                            : content.components.front();
    if (horizontal.acceleration.size() < 2) {
        refuse(given.entry, " = {} has one sample. A record needs two or more.",
               in_quotes(given.file));
    }
    const auto read_other = [&](const Choice* choice) -> NamedComponent {
        if (choice == nullptr) {
            return {};
        }
        const RecordComponent* const same_file = chosen(given, content, *choice, true);
        NamedComponent other{
            choice->text,
            same_file != nullptr
                ? *same_file
                : content_of(choice->entry, choice->text, reading).components.front()};
        expect_other(*choice, other.content, horizontal);
        return other;
    };
    const NamedComponent vertical = read_other(choices.vertical);
    const NamedComponent second = read_other(choices.second);
    const Components components{NamedComponent{given.file, horizontal}, second, vertical};
    const auto over_g = [&](const NamedComponent& component) {
        std::vector<double> accelerations = over_gravity(component.content, reading.gravity);
        accelerations.resize(accelerations.empty() ? 0 : samples_of(components));
        return accelerations;
    };
    auto record = std::make_shared<const Accelerogram>(over_g(components[0]), over_g(vertical),
                                                       horizontal.time_step, over_g(second));
    if (choices.second != nullptr && record->second() == record->upwards()) {
        refuse(choices.second->entry, " = {} is also the vertical component. Correct one of them.",
               choices.second->text);
    }
    const RecordedMotion motion{
        .file = given.file,
        .name = fmt::format("{}:{}", given.file, label_of(content, horizontal)),
        .component = horizontal.name,
        .vertical = vertical.name,
        .second = second.name,
        .is_uncorrected = std::ranges::any_of(
            components, [](const auto& each) { return each.content.is_uncorrected; }),
        .remarks = remarks_on(components),
        .header = mapped(horizontal.header, as_utf8),
        .measures = intensity_measures(record->horizontal(), record->time_step(), reading.gravity),
        .stated_motion_of = stated_motion_of(components),
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
    const Reading reading{folder, read_options(scene), gravity};
    const auto choices =
        mapped(std::array{"component", "second_component", "vertical"},
               [&](const char* key) { return choices_of(key, scene, records, folder); });
    std::vector<RecordedMotion> motions;
    std::set<std::string> known; // file, component and accelerations
    for (const GivenRecord& given : records) {
        const auto choice = [&](std::size_t key) {
            return choices[key].empty() ? nullptr : &choices[key][motions.size()];
        };
        const RecordedMotion& motion =
            motions.emplace_back(read_motion(given, {choice(0), choice(1), choice(2)}, reading));
        const std::string path = canonical_path((reading.folder / given.file).string());
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
