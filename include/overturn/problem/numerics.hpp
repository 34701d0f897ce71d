// The numerics of the integration.
#pragma once

#include "overturn/text/names.hpp"

#include <array>
#include <string_view>

namespace overturn {

enum class Method { rk45, taylor };

/// In job files and result files.
template <>
inline constexpr std::array<std::string_view, 2> names_of<Method>{"rk45", "taylor"};

struct Numerics {
    Method method = Method::rk45;
    /// Local error per step, relative to the size of the motion or, if smaller, to alpha [1].
    double tolerance = 1e-9;
    bool resolve = false; ///< settle verdicts in doubt with more digits
};

/// For answers about single points and for references.
inline constexpr Numerics most_accurate{
    .method = Method::taylor, .tolerance = 1e-13, .resolve = true};

/// The default tolerance if verdicts are resolved: about one in a thousand needs more digits; at
/// looser tolerances errors are not known well.
inline constexpr double tolerance_to_resolve_from = 1e-4;

/// The error estimate of longer Runge-Kutta steps is not reliable.
inline constexpr double largest_rk45_tolerance_with_error = 1e-4;

/// Whether the error of a point is bounded reliably.
constexpr bool knows_errors(const Numerics& numerics)
{
    return numerics.method == Method::taylor ||
           numerics.tolerance <= largest_rk45_tolerance_with_error;
}

/// The methods for which kernels are compiled: Taylor series with their order, and those for
/// recorded ground motions in double and in 31 digits.
enum class Integrator { runge_kutta, taylor_14, taylor_20, recorded, recorded_31 };

/// Order 14 takes less time than 20 for errors above 1e-8 under the one-sine pulse, and above 1e-10
/// to 1e-12 under the others. For an error of 1e-9 under the one-sine pulse, order 20 needs a
/// tolerance of 2e-7. Orders 12 and 18 save up to 5 %, but every third term is large after an
/// uplift by a linear pulse: if the last one is not of order 3 n - 1, the error may exceed its
/// bound.
inline constexpr double loosest_tolerance_of_order_20 = 2e-7;

} // namespace overturn
