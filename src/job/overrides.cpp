#include "read_steps.hpp"

#include "deep_key.hpp"

#include "overturn/text/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <vector>

namespace overturn {

namespace {

using Path = std::vector<std::string>;

// An argument may be a list of thousands of values; messages quote its beginning.
constexpr std::size_t longest_place = 100;

/// The beginning of the argument, on one line, as the place in messages.
std::string place_of_argument(const std::string& argument)
{
    return on_one_line(std::string(override_prefix) + shortened(argument, longest_place));
}

template <class... Arguments>
[[noreturn]] void refuse_argument(const std::string& argument,
                                  fmt::format_string<Arguments...> text, Arguments&&... arguments)
{
    throw Error(exit_code::job, "{}: {}", place_of_argument(argument),
                fmt::format(text, std::forward<Arguments>(arguments)...));
}

/// Whether a text can only be a string without quotes: it begins with a letter and has no quotes,
/// brackets, comments or newlines.
bool is_unquoted_string(std::string_view text)
{
    const auto is_special = [](unsigned char letter) {
        return letter < 0x20 ||
               std::string_view("\"'[]{}#=\\").find(char(letter)) != std::string::npos;
    };
    return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) != 0 &&
           std::none_of(text.begin(), text.end(), is_special);
}

Path path_of(const std::string& argument, std::string_view dotted_key)
{
    const auto is_allowed = [](unsigned char letter) {
        return std::isalnum(letter) != 0 || letter == '_' || letter == '-';
    };
    Path path;
    while (true) {
        const std::size_t dot = dotted_key.find('.');
        const std::string_view key = trimmed(dotted_key.substr(0, dot));
        if (key.empty() || !std::ranges::all_of(key, is_allowed)) {
            refuse_argument(argument,
                            "the key {} is {}. Keys consist of letters, digits, '_' and '-', "
                            "joined by dots, such as plane.frequency.count.",
                            in_quotes(key), key.empty() ? "empty" : "invalid");
        }
        path.emplace_back(key);
        if (dot == dotted_key.npos) {
            return path;
        }
        dotted_key.remove_prefix(dot + 1);
    }
}

/// A job with this entry only, whose source is the argument. A value that is not TOML may be a
/// string without quotes.
toml::table job_of(const std::string& argument, const Path& path, std::string_view value)
{
    std::string problem;
    const auto parsed = [&](std::string_view value_text) -> std::optional<toml::table> {
        const std::string text = fmt::format("{} = {}", fmt::join(path, "."), value_text);
        if (find_deep_key(text) != text.npos) {
            problem = fmt::format("a key has more than {} parts", most_key_parts);
            return std::nullopt;
        }
        try {
            return toml::parse(text, place_of_argument(argument));
        } catch (const toml::parse_error& error) {
            problem = on_one_line(std::string(error.description()));
            return std::nullopt;
        }
    };
    std::optional<toml::table> job = parsed(value);
    if (!job && is_unquoted_string(value)) {
        job = parsed(in_quotes(value));
    }
    if (!job) {
        refuse_argument(argument,
                        "this is not valid TOML: {}. Give a number, a \"string\", or a [list].",
                        problem);
    }
    return *std::move(job);
}

/// Refuses the argument if it gives more than the value at the end of the path.
void expect_one_value(const toml::table& given, const Path& path, const std::string& argument)
{
    const toml::table* table = &given;
    for (std::size_t depth = 0; depth < path.size(); ++depth) {
        if (table->size() != 1) {
            refuse_argument(argument, "there is more than one value. Use one --set for each.");
        }
        table = table->begin()->second.as_table();
    }
}

/// Moves the value at the end of the path to the same path in the job. A moved node keeps its
/// source position; a copied one would lose it.
void move_value(toml::table& job, toml::table& given, const Path& path, const std::string& argument)
{
    toml::table* onto = &job;
    toml::table* from = &given;
    for (std::size_t depth = 0;; ++depth) {
        const auto entry = from->begin();
        toml::node* present = onto->get(path[depth]);
        if (present == nullptr || depth + 1 == path.size()) {
            onto->insert_or_assign(entry->first, std::move(entry->second));
            return;
        }
        if (!present->is_table()) {
            const auto end = path.begin() + std::ptrdiff_t(depth + 1);
            refuse_argument(argument, "{} is not a table in the job, so it has no keys to set.",
                            fmt::join(path.begin(), end, "."));
        }
        onto = present->as_table();
        from = entry->second.as_table();
    }
}

void erase(toml::table& job, std::string_view table, std::string_view key)
{
    if (toml::table* const present = job[table].as_table()) {
        present->erase(key);
    }
}

bool is_coordinate(const Path& path)
{
    return path.size() > 1 && std::ranges::count(coordinate_tables, path[0]) > 0 &&
           find_quantity(path[1]) != nullptr;
}

/// Removes the coordinates of points that a new value at this path contradicts.
void drop_coordinates(toml::table& job, const Path& path)
{
    const bool is_record = path == Path{"scene", "record"};
    const bool is_other_motion =
        is_record || (path == Path{"scene", "pulse"} && job["scene"]["record"]);
    const auto is_contradicted = [&](const Quantity& other) {
        return path[0] == "blocks"   ? other.role == Role::block || other.role == Role::loss
               : is_coordinate(path) ? exclude_each_other(other.name, path[1])
                                     : is_other_motion && !applies_to(other, is_record);
    };
    bool is_alternative = false;
    for (const std::string_view table : coordinate_tables) {
        for (const std::string_view name : keys_of(table)) {
            if (job[table][name] && is_contradicted(quantity(name))) {
                is_alternative = true;
                if (path[0] != table || path[1] != name) {
                    erase(job, table, name);
                }
            }
        }
    }
    // A new shape replaces the table that describes the blocks; a size alone is none.
    if (is_coordinate(path) && !is_alternative && quantity(path[1]).role == Role::block &&
        !are_equivalent(path[1], "size")) {
        job.erase("blocks");
    }
}

/// Removes the keys of [scene] that a new value at this path contradicts.
void drop_scene(toml::table& job, const Path& path, const toml::table& given)
{
    const bool is_record = path == Path{"scene", "record"};
    const bool is_pulse = path == Path{"scene", "pulse"};
    if (is_record || (is_pulse && job["scene"]["record"])) {
        for (const std::string_view key : scene_keys_of(is_record ? Under::pulse : Under::record)) {
            erase(job, "scene", key);
        }
    }
    const auto pulse =
        std::ranges::find(pulse_names, given["scene"]["pulse"].value_or<std::string_view>(""));
    for (const auto& [number, member] : shape_numbers) {
        if (is_pulse && pulse != pulse_names.end() &&
            !has_number(PulseKind(pulse - pulse_names.begin()), member)) {
            erase(job, "scene", number);
        }
    }
}

/// Removes what contradicts a new value of this key of an axis: its values if it becomes a range,
/// or the reverse, or the axis if it is a number. For `of` and `spacing`, the number is kept as the
/// list of values.
void drop_parts(toml::table& job, toml::table& given, const Path& path)
{
    const auto axis = job[path[0]][path[1]];
    const bool keeps_values = path[2] == "of" || path[2] == "spacing";
    if (axis.is_number()) {
        if (keeps_values) {
            given[path[0]][path[1]].as_table()->insert("values",
                                                       toml::array{std::move(*axis.node())});
        }
        erase(job, path[0], path[1]);
    } else if (toml::table* const table = axis.as_table(); table != nullptr && !keeps_values) {
        for (const std::string_view part : axis_keys()) {
            if ((part == "values") != (path[2] == "values")) {
                table->erase(part);
            }
        }
    }
}

} // namespace

void apply_override(toml::table& job, const std::string& argument)
{
    const std::size_t equals = argument.find('=');
    if (equals == argument.npos) {
        refuse_argument(argument,
                        "there is no '='. Give key.path=value, such as plane.frequency.count=100.");
    }
    const Path path = path_of(argument, std::string_view(argument).substr(0, equals));
    const std::string_view value = trimmed(std::string_view(argument).substr(equals + 1));
    if (value.empty()) {
        refuse_argument(argument,
                        "the value is missing. Give it after the '='; an empty string is \"\".");
    }
    toml::table given = job_of(argument, path, value);
    expect_one_value(given, path, argument);
    drop_coordinates(job, path);
    drop_scene(job, path, given);
    if (path.size() == 3 && is_coordinate(path)) {
        drop_parts(job, given, path);
    }
    move_value(job, given, path, argument);
}

} // namespace overturn
