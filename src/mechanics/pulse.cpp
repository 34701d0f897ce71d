#include "overturn/mechanics/pulse.hpp"

#include "overturn/number/digits50.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <cstdint>

namespace overturn {

template <class S>
S where_it_reaches_zero(const std::function<S(const S&)>& increasing, const S& low, const S& high)
{
    std::uintmax_t iterations = 200; // bisection needs one per bit of S
    const auto bracket = boost::math::tools::toms748_solve(
        increasing, low, high,
        boost::math::tools::eps_tolerance<S>(std::numeric_limits<S>::digits - 2), iterations);
    return bracket.second; // the upper end, where the function is not below 0
}

template double where_it_reaches_zero(const std::function<double(const double&)>&, const double&,
                                      const double&);
template Digits50 where_it_reaches_zero(const std::function<Digits50(const Digits50&)>&,
                                        const Digits50&, const Digits50&);

} // namespace overturn
