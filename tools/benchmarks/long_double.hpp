// long double as a number type of overturn, for references. To be included before other headers of
// overturn: their templates find only the fma of numbers without a namespace that is declared
// before them.
#pragma once

#include <cmath>

namespace overturn::arithmetic {
inline long double fma(long double a, long double b, long double c)
{
    return std::fma(a, b, c);
}
} // namespace overturn::arithmetic

#include "overturn/number/number.hpp"

namespace overturn {
template <>
struct number_traits<long double> : scalar_number_traits<long double> {};
} // namespace overturn
