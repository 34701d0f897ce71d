// The simulated scene (ground pulse and theory of the block) and the numerics of its integration.
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

/// Names in job files and result files, in the order of the enumerators.
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
    double window = 1; ///< half width of a Ricker wavelet [pulse periods]; ignored for other pulses
};

struct Numerics {
    Method method = Method::rk45;
    double tolerance =
        1e-9;             ///< local error per step, over the size of the motion, at most alpha [1]
    bool resolve = false; ///< settle verdicts in doubt with more digits
};

/// The error estimate of longer Runge-Kutta steps is not reliable.
inline constexpr double largest_rk45_tolerance_with_error = 1e-4;

/// Whether the error of a point is bounded reliably.
constexpr bool knows_errors(const Numerics& numerics)
{
    return numerics.method == Method::taylor ||
           numerics.tolerance <= largest_rk45_tolerance_with_error;
}

/// The methods for which kernels are compiled, with the order of a Taylor series.
enum class Integrator { runge_kutta, taylor_12, taylor_18 };

/// Both orders take the same time for an error of about 1e-8. For the paper's one-sine spectrum, 12
/// takes an eighth less time than 18 for an error of 1e-6, and two fifths more for 1e-12; over all
/// pulses, no third order saves more than a tenth anywhere.
inline constexpr double loosest_tolerance_of_order_18 = 3e-6;

constexpr Integrator integrator_of(const Numerics& numerics)
{
    return numerics.method == Method::rk45                      ? Integrator::runge_kutta
           : numerics.tolerance > loosest_tolerance_of_order_18 ? Integrator::taylor_12
                                                                : Integrator::taylor_18;
}

} // namespace overturn
