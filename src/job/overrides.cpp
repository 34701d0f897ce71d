#include "read_steps.hpp"

#include "deep_key.hpp"
#include "toml_text.hpp"

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

[[noreturn]] void refuse_argument(const std::string& argument, std::string_view text)
{
    throw Error(exit_code::job, "{}: {}", place_of_argument(argument), text);
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

/// Removes the coordinates of points, except that at this path, for which is_erased(name) is true.
void erase_coordinates(toml::table& job, const Path& path, const auto& is_erased)
{
    for (const std::string_view table : coordinate_tables) {
        for (const std::string_view name : keys_of(table)) {
            if (!(table == path[0] && path.size() > 1 && name == path[1]) && is_erased(name)) {
                erase_keys(job[table].as_table(), {name});
            }
        }
    }
}

bool is_coordinate(const Path& path)
{
    return path.size() > 1 && std::ranges::count(coordinate_tables, path[0]) > 0 &&
           find_quantity(path[1]) != nullptr;
}

/// Whether the job gives the coordinate at this path, or one that excludes it, outside a table of
/// blocks.
bool has_alternative(const toml::table& job, const Path& path)
{
    return std::ranges::any_of(coordinate_tables, [&](std::string_view table) {
        const std::vector<std::string_view> names = keys_of(table);
        return std::ranges::any_of(names, [&](std::string_view name) {
            return exclude_each_other(name, path[1]) && job[table][name];
        });
    });
}

/// Removes the keys of the job that a new value at this path contradicts.
void drop_contradictions(toml::table& job, const Path& path, const toml::node& value)
{
    if (path[0] == "blocks") {
        erase_coordinates(job, path, [](std::string_view name) {
            return quantity(name).role == Role::block || quantity(name).role == Role::loss;
        });
    }
    if (is_coordinate(path)) {
        // A new shape replaces the table that describes the blocks; a size alone is none.
        const bool is_shape =
            quantity(path[1]).role == Role::block && !are_equivalent(path[1], "size");
        if (is_shape && !has_alternative(job, path)) {
            erase_keys(&job, {"blocks"});
        }
        erase_coordinates(job, path,
                          [&](std::string_view name) { return exclude_each_other(name, path[1]); });
        toml::table* axis = job[path[0]][path[1]].as_table();
        if (path.size() == 3 && path[2] == "values") {
            erase_keys(axis, {"first", "last", "count", "spacing"});
        } else if (path.size() == 3 &&
                   (path[2] == "first" || path[2] == "last" || path[2] == "count")) {
            erase_keys(axis, {"values"});
        }
    }
    toml::table* scene = job["scene"].as_table();
    const bool is_record = path == Path{"scene", "record"};
    const bool replaces_record = path == Path{"scene", "pulse"} && job["scene"]["record"];
    if (is_record || replaces_record) {
        for (const std::string_view key : scene_keys_of(is_record ? KeyOf::pulse : KeyOf::record)) {
            erase_keys(scene, {key});
        }
        erase_coordinates(job, path, [&](std::string_view name) {
            return !applies_to(quantity(name), is_record);
        });
    }
    if (path == Path{"scene", "pulse"}) {
        const auto name =
            std::find(pulse_names.begin(), pulse_names.end(), value.value_or<std::string_view>(""));
        if (name != pulse_names.end()) {
            const auto pulse = PulseKind(name - pulse_names.begin());
            for (const auto& [number, member] : shape_numbers) {
                if (!has_number(pulse, member)) {
                    erase_keys(scene, {number});
                }
            }
        }
    }
}

/// Removes an axis that the job gives as a number, before a key of it is set. If the key is `of` or
/// `spacing`, the number is kept as the list of values.
void replace_number(toml::table& job, toml::table& given, const Path& path)
{
    toml::table* table = job[path[0]].as_table();
    toml::node* axis = table == nullptr ? nullptr : table->get(path[1]);
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
        given[path[0]][path[1]].as_table()->insert("values", std::move(values));
    }
    table->erase(path[1]);
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
    drop_contradictions(job, path, value_at(given, path, argument));
    if (path.size() == 3 && is_coordinate(path)) {
        replace_number(job, given, path);
    }
    move_value(job, given, path, argument);
}

} // namespace overturn
