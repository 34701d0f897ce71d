// Random points in the range of realistic blocks and pulses.
#pragma once

#include "support/one_point.hpp"

#include <random>

namespace overturn {

/// Slenderness 0.08 to 0.45, more than half of the largest restitution, always lifted.
inline PulsePoint<double> random_point(std::mt19937_64& generator)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    const double slenderness = 0.08 + 0.37 * uniform(generator);
    return {slenderness, largest_restitution(slenderness) * (0.55 + 0.45 * uniform(generator)),
            0.5 + 9 * uniform(generator), 1.05 + 10 * uniform(generator)};
}

} // namespace overturn
