// Intensity measures of a sampled ground acceleration: peaks, Arias intensity and significant
// duration (Arias 1970; Trifunac and Brady 1975). Between samples the acceleration is linear.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace overturn {

struct IntensityMeasures {
    double pga = 0;                  ///< peak of |a| [g]
    double pgv = 0;                  ///< peak of the velocity at the samples [m/s]
    double arias_intensity = 0;      ///< [m/s]
    double significant_duration = 0; ///< between 5 and 95 % of the Arias intensity [s]
};

/// The integral of a^2 from a sample up to the fraction x of an interval, over its length, where a
/// is linear from `first` to `last` [the square of their unit]:
///
///     e(x) = x (first^2 + first a(x) + a(x)^2)/3,  a(x) = first + x (last - first),  0 <= x <= 1
constexpr double energy_of_interval(double first, double last, double x = 1)
{
    const double a = first + x * (last - first);
    return x * (first * first + first * a + a * a) / 3;
}

/// The fraction x with energy_of_interval(first, last, x) = e [1], from a(x)^3 = first^3 + 3 (last
/// - first) e, in a form that needs no division by last - first. The energy must be positive.
inline double fraction_of_interval(double first, double last, double e)
{
    const double a = std::cbrt(first * first * first + 3 * (last - first) * e);
    return std::clamp(3 * e / (first * first + first * a + a * a), 0.0, 1.0);
}

/// The integral of a^2 up to each sample [the square of its unit, times the time step].
inline std::vector<double> energies_at(std::span<const double> a)
{
    std::vector<double> energies(a.size());
    for (std::size_t i = 1; i < a.size(); ++i) {
        energies[i] = energies[i - 1] + energy_of_interval(a[i - 1], a[i]);
    }
    return energies;
}

/// The time at which that integral reaches an energy above 0, at most that of all [time step].
inline double time_of_energy(std::span<const double> a, const std::vector<double>& energies,
                             double energy)
{
    const auto reached = std::lower_bound(energies.begin(), energies.end(), energy);
    const auto i = std::size_t(reached - energies.begin());
    return double(i - 1) + fraction_of_interval(a[i - 1], a[i], energy - energies[i - 1]);
}

/// The velocity at each sample, which starts from rest and is not corrected [unit of a times the
/// time step]:
///
///     v_i = v_(i-1) + (a_(i-1) + a_i)/2
///
/// This is exact at the samples. An extremum between two of them, where a changes sign, is missed.
inline std::vector<double> velocities_at(std::span<const double> a)
{
    std::vector<double> velocities(a.size());
    for (std::size_t i = 1; i < a.size(); ++i) {
        velocities[i] = velocities[i - 1] + (a[i - 1] + a[i]) / 2;
    }
    return velocities;
}

/// The largest |value|.
inline double peak_of(std::span<const double> values)
{
    double peak = 0;
    for (const double value : values) {
        peak = std::max(peak, std::abs(value));
    }
    return peak;
}

/// The intensity measures of an acceleration [g] sampled every `time_step` [s]; gravity [m/s2].
///
///     Arias = pi/(2 gravity) integral of (gravity a)^2 dt,  exact for piecewise linear a
///
/// With fewer than two samples, or if all are 0, only the pga may differ from 0.
inline IntensityMeasures intensity_measures(std::span<const double> acceleration, double time_step,
                                            double gravity)
{
    assert(time_step > 0 && gravity > 0);
    IntensityMeasures measures;
    measures.pga = peak_of(acceleration);
    measures.pgv = gravity * time_step * peak_of(velocities_at(acceleration));
    // Scaled to the peak 1, so that squares neither overflow nor underflow.
    std::vector<double> shape(acceleration.begin(), acceleration.end());
    for (double& a : shape) {
        a /= measures.pga > 0 ? measures.pga : 1;
    }
    const std::vector<double> energies = energies_at(shape);
    if (const double energy = energies.empty() ? 0 : energies.back(); energy > 0) {
        measures.arias_intensity =
            std::numbers::pi / 2 * gravity * measures.pga * measures.pga * energy * time_step;
        measures.significant_duration =
            time_step * (time_of_energy(shape, energies, 0.95 * energy) -
                         time_of_energy(shape, energies, 0.05 * energy));
    }
    return measures;
}

} // namespace overturn
