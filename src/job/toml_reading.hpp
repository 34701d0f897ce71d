// Strict reading of a TOML tree: each function returns the requested value, or throws an Error
// that names the place, what was found, what is allowed and what to do.
#pragma once

#include "overturn/problem/quantity.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/names.hpp"
#include "overturn/text/quoting.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace overturn {

/// A node of a job and its dotted key, such as "plane.frequency.values[1]"; the key of the whole
/// job is empty.
struct Entry {
    const toml::node* node = nullptr;
    std::string key;
};

using Names = std::span<const std::string_view>;

/// Precedes a --set argument in messages, in place of the name of a file.
inline constexpr std::string_view override_prefix = "--set ";

/// Maximum number of parts of a dotted key; those of a job have at most three.
inline constexpr std::size_t most_key_parts = 16;

/// The position of a key with more parts in a TOML text; npos if there is none. toml++ creates
/// nested tables for the parts, and destroys them recursively, which would overflow the stack.
std::size_t find_deep_key(std::string_view text);

/// The tree of a text; path: of its file, or override_prefix and an argument. `advice` says what to
/// do if it is not TOML.
toml::table parse_toml(const std::string& text, const std::string& path, std::string_view advice);

/// "file:line:column", or the --set argument.
std::string place_of(const toml::source_region& source);

/// Throws an Error with the place, the key, and the text that follows the key, which is formatted
/// as by fmt::format().
template <class... Arguments>
[[noreturn]] void refuse(const Entry& entry, fmt::format_string<Arguments...> text,
                         Arguments&&... arguments)
{
    throw Error(exit_code::job, "{}: {}{}", place_of(entry.node->source()), entry.key,
                fmt::format(text, std::forward<Arguments>(arguments)...));
}

/// Throws Error unless the entry is a table with these keys only. `or_else` precedes "a table"
/// in the message, and names other allowed types.
void expect_table(const Entry& entry, Names allowed, std::string_view or_else = "");

/// Whether a --set argument gives the value.
bool is_override(const toml::node& node);

/// The entry of a table with this name; nullopt if there is none.
std::optional<Entry> find(const Entry& table, std::string_view name);

/// The same for a required entry; `advice` says what to do if it is missing.
Entry require(const Entry& table, std::string_view name, std::string_view advice);

/// A table of the job, which has only keys_of() its name; an empty one if it is missing.
Entry table_of(const Entry& job, std::string_view name);

/// The number of elements of an array, which must not be empty. For the messages, `wanted` names
/// the required type, and `advice` says what to do if the array is empty.
std::size_t array_size(const Entry& entry, std::string_view wanted, std::string_view advice);

Entry element(const Entry& array, std::size_t i);

std::string string_of(const Entry& entry);
std::int64_t integer_of(const Entry& entry);

/// A finite number; integers are accepted, and -0 becomes 0.
double number_of(const Entry& entry);

/// A number in the interval of the quantity.
double quantity_of(const Entry& entry, const Quantity& rule);

/// The same for a key with the name of a quantity; `otherwise` if it is missing.
double quantity_of(const Entry& table, std::string_view name, double otherwise);

/// A key of a table; `otherwise` if it is missing.
bool boolean_of(const Entry& table, std::string_view name, bool otherwise);

/// The shortest text from which the same double is read, always with the syntax of a float.
std::string float_text(double value);

/// The index of the string in `names`.
std::size_t index_of_name(const Entry& entry, Names names);

/// The enumerator of this name.
template <class Enumeration>
Enumeration choice_of(const Entry& entry, Names names = names_of<Enumeration>)
{
    return Enumeration(index_of_name(entry, names));
}

/// The same for a key of a table; `otherwise` if it is missing.
template <class Enumeration>
Enumeration choice_of(const Entry& table, std::string_view name, Enumeration otherwise)
{
    const auto entry = find(table, name);
    return entry ? choice_of<Enumeration>(*entry) : otherwise;
}

} // namespace overturn
