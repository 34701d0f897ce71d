// Whether a list contains a value.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <string_view>

namespace overturn {

/// list: also words in braces.
template <class Value, class List = std::initializer_list<std::string_view>>
constexpr bool is_one_of(const Value& value, const List& list)
{
    return std::ranges::find(list, value) != std::ranges::end(list);
}

} // namespace overturn
