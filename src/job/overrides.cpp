#include "read_steps.hpp"

#include "overturn/text/is_one_of.hpp"
#include "overturn/text/parse_number.hpp"

#include <cctype>
#include <string_view>
#include <vector>

namespace overturn {

namespace {

using Path = std::vector<std::string>;

/// Whether a text can only be a string without quotes: it begins with a letter and has no quotes,
/// brackets, comments or control characters.
bool is_unquoted_string(std::string_view text)
{
    return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) != 0 &&
           text.find_first_of("\"'[]{}#=\\") == text.npos && on_one_line(std::string(text)) == text;
}

/// A job with the value of the argument only, whose source is the argument. A value that is not
/// TOML may be a string without quotes.
toml::table job_of(const std::string& argument)
{
    // An argument may be a list of thousands of values; messages quote its beginning.
    constexpr std::size_t longest_place = 100;
    const std::string place =
        on_one_line(std::string(override_prefix) + shortened(argument, longest_place));
    constexpr std::string_view advice =
        "Give key.path=value, such as plane.frequency.count=100; strings need \"quotes\".";
    try {
        return parse_toml(argument, place, advice);
    } catch (const Error&) {
        const std::size_t value = argument.find('=') + 1; // 0: there is none
        const std::string_view word = trimmed(std::string_view(argument).substr(value));
        if (const std::string on_comma = advice_on_decimal_comma(word); !on_comma.empty()) {
            throw Error(exit_code::job, "{}: {} is not a number.{}", place, word, on_comma);
        }
        if (value == 0 || !is_unquoted_string(word)) {
            throw;
        }
        return parse_toml(argument.substr(0, value) + in_quotes(word), place, advice);
    }
}

/// The keys that lead to the only value of a job.
Path path_of(const toml::table& given)
{
    Path path;
    const toml::table* table = &given;
    while (table != nullptr && !table->is_inline()) { // { ... } is a value
        if (table->size() != 1) {
            refuse({&given, ""}, "there is not exactly one value. Use one --set for each.");
        }
        const auto entry = table->begin();
        path.emplace_back(entry->first.str());
        table = entry->second.as_table();
    }
    return path;
}

/// Moves the value at the end of the path to the same path in the job. A moved node keeps its
/// source position; a copied one would lose it.
void move_value(toml::table& job, toml::table& given, const Path& path)
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
            refuse({&given, fmt::format("{}", fmt::join(path.begin(), end, "."))},
                   " is not a table in the job, so it has no keys to set.");
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
    return path.size() > 1 && is_one_of(path[0], coordinate_tables) &&
           find_quantity(path[1]) != nullptr;
}

/// Removes the coordinates of points that contradict a new value at this path, other than the one
/// at the path. Returns whether there are any, including that one.
template <class Contradicts>
bool drop_coordinates(toml::table& job, const Path& path, const Contradicts& contradict)
{
    bool found = false;
    for (const std::string_view table : coordinate_tables) {
        for (const std::string_view name : keys_of(table)) {
            if (job[table][name] && contradict(quantity(name))) {
                found = true;
                if (path[0] != table || path[1] != name) {
                    erase(job, table, name);
                }
            }
        }
    }
    return found;
}

/// Removes the keys that contradict a new value at this path.
void drop_keys(toml::table& job, const Path& path, const toml::table& given)
{
    const bool is_record = path == Path{"scene", "record"};
    const bool is_pulse = path == Path{"scene", "pulse"};
    if (is_record || (is_pulse && job["scene"]["record"])) {
        const MotionTraits& motion = is_record ? Suite::traits : Pulse::traits;
        for (const std::string_view key : keys_of("scene", motion.under_others)) {
            erase(job, "scene", key);
        }
        drop_coordinates(job, path,
                         [&](const Quantity& other) { return !other.applies_under(motion); });
    }
    const auto name = given["scene"]["pulse"].value_or<std::string_view>("");
    const auto pulse = enumerator_named<PulseKind>(name);
    const bool is_table = name == TabulatedPulse::name;
    for (const auto& [number, member] : shape_numbers) {
        if (is_table || (pulse && !has_number(*pulse, member))) {
            erase(job, "scene", number);
        }
    }
    if (path == Path{"numerics", "fill"} && !given["numerics"]["fill"].value_or(true)) {
        erase(job, "numerics", "audit");
    }
    if (pulse) {
        erase(job, "scene", "shape");
    }
    if (path[0] == "blocks") {
        // Other keys that a column contradicts are dropped when the table has been read.
        drop_coordinates(job, path, [](const Quantity& other) {
            return other.role == Role::block && other.scope.shapes != 0;
        });
    }
    // A new shape replaces the table that describes the blocks; a size alone is none.
    if (is_coordinate(path) &&
        !drop_coordinates(
            job, path,
            [&](const Quantity& other) { return exclude_each_other(other.name, path[1]); }) &&
        quantity(path[1]).role == Role::block && !are_equivalent(path[1], "size")) {
        job.erase("blocks");
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
        for (const std::string_view part : axis_keys) {
            if ((part == "values") != (path[2] == "values")) {
                table->erase(part);
            }
        }
    }
}

} // namespace

void apply_override(toml::table& job, const std::string& argument)
{
    toml::table given = job_of(argument);
    const Path path = path_of(given);
    drop_keys(job, path, given);
    if (path.size() == 3 && is_coordinate(path)) {
        drop_parts(job, given, path);
    }
    move_value(job, given, path);
}

} // namespace overturn
