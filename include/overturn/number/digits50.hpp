// Digits50: the reference number type, with 50 decimal digits. Slow.
#pragma once

#include "overturn/number/number.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace overturn {

using Digits50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_50::backend_type,
                                  boost::multiprecision::et_off>;

template <>
struct number_traits<Digits50> : scalar_number_traits<Digits50> {
    static Digits50 pi() { return boost::math::constants::pi<Digits50>(); }
};

} // namespace overturn
