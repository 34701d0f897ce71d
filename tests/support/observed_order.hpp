// The observed order of convergence.
#pragma once

#include <cmath>
#include <vector>

namespace overturn {

/// The slope of log(error) over -log(steps), by least squares.
template <class Error>
double observed_order(const std::vector<int>& steps, const Error& error)
{
    double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    for (const int n : steps) {
        const double x = -std::log(n);
        const double y = std::log(double(error(n)));
        sum_x += x;
        sum_y += y;
        sum_xx += x * x;
        sum_xy += x * y;
    }
    const double count = double(steps.size());
    return (count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x);
}

} // namespace overturn
