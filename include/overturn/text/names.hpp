// The names of enumerators in jobs, files and messages: one table per enumeration.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace overturn {

/// The names of all enumerators, in their order. Specialised next to the enumeration; empty for all
/// others.
template <class Enumeration>
inline constexpr std::array<std::string_view, 0> names_of{};

template <class Enumeration>
concept Named = !names_of<Enumeration>.empty();

template <Named Enumeration>
constexpr std::string_view name_of(Enumeration value)
{
    return names_of<Enumeration>[std::size_t(value)];
}

/// The enumerator of this name; nullopt if there is none.
template <Named Enumeration>
constexpr std::optional<Enumeration> enumerator_named(std::string_view name)
{
    const auto& names = names_of<Enumeration>;
    const auto found = std::ranges::find(names, name);
    return found == names.end() ? std::nullopt : std::optional(Enumeration(found - names.begin()));
}

} // namespace overturn
