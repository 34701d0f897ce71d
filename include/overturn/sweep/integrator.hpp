// The methods that the kernels are compiled for, and which of them serves a tolerance.
#pragma once

#include "overturn/sweep/scene.hpp"

namespace overturn {

/// A Taylor series is written out for its order.
enum class Integrator { runge_kutta, taylor_14, taylor_20 };

/// Where the orders cost the same: on the paper's one-sine spectrum 14 is a fifth cheaper than 20
/// at 1e-5, and a third dearer at 1e-11; no third order gains more than a twentieth anywhere.
inline constexpr double loosest_tolerance_of_order_20 = 3e-8;

constexpr Integrator integrator_of(const Numerics& numerics)
{
    if (numerics.method == Method::rk45) {
        return Integrator::runge_kutta;
    }
    return numerics.tolerance > loosest_tolerance_of_order_20 ? Integrator::taylor_14
                                                              : Integrator::taylor_20;
}

} // namespace overturn
