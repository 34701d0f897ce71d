#include "read_steps.hpp"

#include "deep_key.hpp"
#include "toml_text.hpp"

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

[[noreturn]] void refuse_argument(const std::string& argument, std::string_view text)
{
    throw JobError(fmt::format("{}: {}", place_of_argument(argument), text));
}

std::string_view trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(" \t");
    const std::size_t last = text.find_last_not_of(" \t");
    return first == text.npos ? "" : text.substr(first, last - first + 1);
}

bool is_bare_key(std::string_view key)
{
    return !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char letter) {
        return std::isalnum(letter) != 0 || letter == '_' || letter == '-';
    });
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
    Path path;
    while (true) {
        if (path.size() == most_key_parts) {
            refuse_argument(argument, fmt::format("the key has more than {} parts, but keys of a "
                                                  "job have at most three.",
                                                  most_key_parts));
        }
        const std::size_t dot = dotted_key.find('.');
        const std::string_view key = trimmed(dotted_key.substr(0, dot));
        if (!is_bare_key(key)) {
            refuse_argument(
                argument,
                fmt::format("the key {} is {}. Keys consist of letters, digits, '_' and '-', "
                            "joined by dots, such as plane.frequency.count.",
                            in_quotes(key), key.empty() ? "empty" : "invalid"));
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
        refuse_argument(argument, fmt::format("the value is not valid TOML: {}. Give a number, a "
                                              "\"string\", or a [list].",
                                              problem));
    }
    return *std::move(job);
}

/// The value at the end of the path. Refuses the argument if a table on the path has other keys.
const toml::node& value_at(const toml::table& given, const Path& path, const std::string& argument)
{
    const toml::node* node = &given;
    for (std::size_t depth = 0; depth < path.size(); ++depth) {
        const toml::table& table = *node->as_table();
        if (table.size() != 1) {
            refuse_argument(argument, "there is more than one value. Use one --set for each.");
        }
        node = &table.begin()->second;
    }
    return *node;
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
            refuse_argument(argument, fmt::format("{} is not a table in the job, so it has no keys "
                                                  "to set.",
                                                  fmt::join(path.begin(), end, ".")));
        }
        onto = present->as_table();
        from = entry->second.as_table();
    }
}

void erase_keys(toml::table* table, std::initializer_list<std::string_view> keys)
{
    for (const std::string_view key : keys) {
        if (table != nullptr) {
            table->erase(key);
        }
    }
}

/// Keys of a table of which a job gives at most one.
struct Alternatives {
    std::string_view table;
    std::vector<std::string_view> keys;
};

const std::array<Alternatives, 5> alternatives{{
    {"plane", {"amplitude", "scale", "pga"}},
    {"plane", {"frequency", "pulse_period", "pulse_frequency"}},
    {"plane", {"size", "frequency_parameter"}},
    {"block", {"width", "half_width"}},
    {"block", {"height", "half_height"}},
}};

/// Removes these numbers of a pulse from [scene].
void erase_numbers(toml::table* scene, const auto& is_erased)
{
    for (const auto& [name, number] : shape_numbers) {
        if (is_erased(number)) {
            erase_keys(scene, {name});
        }
    }
}

/// Removes the keys of the job that a new value at this path contradicts.
void drop_contradictions(toml::table& job, const Path& path, const toml::node& value)
{
    if (path[0] == "blocks") {
        erase_keys(&job, {"block"});
        erase_keys(job["plane"].as_table(),
                   {"slenderness", "restitution", "size", "frequency_parameter"});
    }
    if (path[0] == "block") {
        erase_keys(&job, {"blocks"});
        erase_keys(job["plane"].as_table(), {"slenderness", "size", "frequency_parameter"});
    }
    if (path[0] == "plane" && path.size() >= 2 && path[1] == "slenderness") {
        erase_keys(&job, {"block", "blocks"});
    }
    if (path[0] == "plane" && path.size() == 3) {
        toml::table* axis = job["plane"][path[1]].as_table();
        if (path[2] == "values") {
            erase_keys(axis, {"first", "last", "count", "spacing"});
        } else if (path[2] == "first" || path[2] == "last" || path[2] == "count") {
            erase_keys(axis, {"values"});
        }
    }
    if (path.size() >= 2) {
        for (const Alternatives& group : alternatives) {
            if (path[0] == group.table &&
                std::find(group.keys.begin(), group.keys.end(), path[1]) != group.keys.end()) {
                for (const std::string_view key : group.keys) {
                    if (key != path[1]) {
                        erase_keys(job[group.table].as_table(), {key});
                    }
                }
            }
        }
    }
    if (path == Path{"scene", "record"}) {
        erase_keys(job["scene"].as_table(), {"pulse"});
        erase_numbers(job["scene"].as_table(), [](ShapeNumber) { return true; });
        erase_keys(job["plane"].as_table(),
                   {"amplitude", "frequency", "pulse_period", "pulse_frequency"});
    }
    if (path == Path{"scene", "pulse"}) {
        if (job["scene"]["record"]) {
            erase_keys(job["scene"].as_table(),
                       {"record", "component", "vertical", "time_step", "units"});
            erase_keys(job["plane"].as_table(), {"scale", "pga", "size", "frequency_parameter"});
        }
        const auto name =
            std::find(pulse_names.begin(), pulse_names.end(), value.value_or<std::string_view>(""));
        if (name != pulse_names.end()) {
            const auto pulse = PulseKind(name - pulse_names.begin());
            erase_numbers(job["scene"].as_table(),
                          [&](ShapeNumber number) { return !has_number(pulse, number); });
        }
    }
}

/// Removes an axis that the job gives as a number, before a key of it is set. If the key is `of` or
/// `spacing`, the number is kept as the list of values.
void replace_number(toml::table& job, toml::table& given, const Path& path)
{
    toml::table* plane = job["plane"].as_table();
    toml::node* axis = plane == nullptr ? nullptr : plane->get(path[1]);
    if (axis == nullptr || !axis->is_number()) {
        return;
    }
    if (path[2] == "of" || path[2] == "spacing") {
        toml::array values; // of moved nodes, which keep their source position
        axis->visit([&](auto& number) {
            if constexpr (toml::is_number<decltype(number)>) {
                values.push_back(std::move(number));
            }
        });
        given["plane"][path[1]].as_table()->insert("values", std::move(values));
    }
    plane->erase(path[1]);
}

} // namespace

bool exclude_each_other(std::string_view axis, std::string_view other)
{
    return axis == other ||
           std::any_of(alternatives.begin(), alternatives.end(), [&](const Alternatives& group) {
               const auto has = [&](std::string_view key) {
                   return std::find(group.keys.begin(), group.keys.end(), key) != group.keys.end();
               };
               return group.table == "plane" && has(axis) && has(other);
           });
}

std::vector<std::string> override_keys()
{
    std::vector<std::string> keys{"title"};
    const auto add = [&](std::string_view table, Names names) {
        for (const std::string_view name : names) {
            keys.push_back(fmt::format("{}.{}", table, name));
        }
    };
    add("scene", scene_keys);
    for (const std::string_view axis : axis_names) {
        const std::string table = fmt::format("plane.{}", axis);
        keys.push_back(table);
        add(table, axis == "restitution" ? Names(restitution_keys) : Names(axis_keys));
    }
    add("block", block_keys);
    add("blocks", blocks_keys);
    add("numerics", numerics_keys);
    add("output", output_keys);
    return keys;
}

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
    drop_contradictions(job, path, value_at(given, path, argument));
    if (path[0] == "plane" && path.size() == 3) {
        replace_number(job, given, path);
    }
    move_value(job, given, path, argument);
}

} // namespace overturn
