// Strict reading of a TOML tree: each function gives what was asked for, or throws a JobError that
// tells the place, what was found, what is allowed and what to do.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace overturn {

/// Something in a job and its dotted key, such as "plane.frequency.values[1]"; the key of the whole
/// job is empty.
struct Entry {
    const toml::node* node = nullptr;
    std::string key;
};

using Names = std::span<const std::string_view>;

/// What --set arguments are called where a file would have its name.
inline constexpr std::string_view override_prefix = "--set ";

/// "file:line:column", or the --set argument.
std::string place_of(const toml::source_region& source);

/// Throws a JobError: place, key, and the text as it follows the key.
[[noreturn]] void refuse(const Entry& entry, std::string_view text);

/// Makes sure that the entry is a table with no other keys than these. `or_else` precedes "a table"
/// in the message, and names what else the entry may be.
void expect_table(const Entry& entry, Names allowed, std::string_view or_else = "");

/// What a table holds under a name, if anything.
std::optional<Entry> find(const Entry& table, std::string_view name);

/// The same where it must not be missing; `advice` is what to do then.
Entry require(const Entry& table, std::string_view name, std::string_view advice);

/// The number of elements of an array, which must not be empty. `wanted` tells what an entry that
/// is no array must be; `advice` is what to do if it is empty.
std::size_t array_size(const Entry& entry, std::string_view wanted, std::string_view advice);

Entry element(const Entry& array, std::size_t i);

std::string string_of(const Entry& entry);
std::int64_t integer_of(const Entry& entry);
bool truth_of(const Entry& entry);

/// A finite number; integers are accepted, and -0 becomes 0.
double number_of(const Entry& entry);

/// The index of the string in `names`.
std::size_t index_of_name(const Entry& entry, Names names);

/// The enumerator whose name stands at its index in `names`.
template <class Enumeration>
Enumeration choice_of(const Entry& entry, Names names)
{
    return Enumeration(index_of_name(entry, names));
}

} // namespace overturn
