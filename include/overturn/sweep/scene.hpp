// What is simulated: the ground's pulse, the theory of the block, and how finely it is integrated.
#pragma once

#include "overturn/mechanics/pulse_kind.hpp"
#include "overturn/mechanics/theory.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace overturn {

enum class RestitutionOf { absolute, maximum };

enum class Method { rk45, taylor };

/// Names as they stand in job files and result files, in the order of the enumerators.
inline constexpr auto pulse_names = [] {
    std::array<std::string_view, pulses.size()> names;
    std::transform(pulses.begin(), pulses.end(), names.begin(),
                   [](const PulseTraits& pulse) { return pulse.name; });
    return names;
}();
inline constexpr std::array<std::string_view, 2> theory_names{"nonlinear", "linear"};
inline constexpr std::array<std::string_view, 2> restitution_of_names{"absolute", "maximum"};
inline constexpr std::array<std::string_view, 2> method_names{"rk45", "taylor"};

constexpr std::string_view name_of(PulseKind pulse)
{
    return traits_of(pulse).name;
}
constexpr std::string_view name_of(Theory theory)
{
    return theory_names[std::size_t(theory)];
}
constexpr std::string_view name_of(RestitutionOf of)
{
    return restitution_of_names[std::size_t(of)];
}
constexpr std::string_view name_of(Method method)
{
    return method_names[std::size_t(method)];
}

struct Scene {
    PulseKind pulse = PulseKind::one_sine;
    Theory theory = Theory::nonlinear;
    double window =
        1; ///< half width of a Ricker wavelet [pulse periods]; without meaning elsewhere
};

struct Numerics {
    Method method = Method::rk45;
    double tolerance = 1e-9; ///< local error per step of tilt and rate, over the slenderness [1]
    bool resolve = false;    ///< whether verdicts in doubt are settled with more digits
};

/// Longer steps of Runge and Kutta do not see their own errors.
inline constexpr double largest_rk45_tolerance_with_error = 1e-4;

/// Whether a point's error is bounded well.
constexpr bool knows_errors(const Numerics& numerics)
{
    return numerics.method == Method::taylor ||
           numerics.tolerance <= largest_rk45_tolerance_with_error;
}

/// The methods that the kernels are compiled for. A Taylor series is written out for its order.
enum class Integrator { runge_kutta, taylor_14, taylor_20 };

/// Where the orders cost the same: on the paper's one-sine spectrum 14 is a fifth cheaper than 20
/// at 1e-5, and a third dearer at 1e-11; no third order gains more than a twentieth anywhere.
inline constexpr double loosest_tolerance_of_order_20 = 3e-8;

constexpr Integrator integrator_of(const Numerics& numerics)
{
    return numerics.method == Method::rk45                      ? Integrator::runge_kutta
           : numerics.tolerance > loosest_tolerance_of_order_20 ? Integrator::taylor_14
                                                                : Integrator::taylor_20;
}

} // namespace overturn
