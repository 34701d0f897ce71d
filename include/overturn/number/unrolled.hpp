// A loop that is unrolled at compile time.
#pragma once

#include <utility>

namespace overturn {

/// Calls `body.template operator()<i>()` for i = 0, 1, ..., count - 1.
template <int count, class Body>
constexpr void unrolled(const Body& body)
{
    [&]<int... i>(std::integer_sequence<int, i...>) {
        (body.template operator()<i>(), ...);
    }(std::make_integer_sequence<int, count>());
}

} // namespace overturn
