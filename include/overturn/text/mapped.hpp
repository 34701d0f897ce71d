// A list made of another one, element by element.
#pragma once

#include <functional>
#include <iterator>
#include <type_traits>
#include <vector>

namespace overturn {

/// The results of a function, or the values of a member, for the elements of a list.
template <class List, class Function>
auto mapped(const List& list, const Function& function)
{
    using Result = std::invoke_result_t<const Function&, decltype(*std::begin(list))>;
    std::vector<std::remove_cvref_t<Result>> results;
    results.reserve(std::size(list));
    for (const auto& element : list) {
        results.push_back(std::invoke(function, element));
    }
    return results;
}

} // namespace overturn
