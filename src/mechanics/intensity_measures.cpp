#include "overturn/mechanics/intensity_measures.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

namespace overturn {

namespace {

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
double fraction_of_interval(double first, double last, double e)
{
    const double a = std::cbrt(first * first * first + 3 * (last - first) * e);
    return std::clamp(3 * e / (first * first + first * a + a * a), 0.0, 1.0);
}

/// The integral of a^2 up to each sample [the square of its unit, times the time step].
std::vector<double> energies_at(std::span<const double> a)
{
    std::vector<double> energies(a.size());
    for (std::size_t i = 1; i < a.size(); ++i) {
        energies[i] = energies[i - 1] + energy_of_interval(a[i - 1], a[i]);
    }
    return energies;
}

/// The time at which that integral reaches an energy above 0, at most that of all [time step].
double time_of_energy(std::span<const double> a, const std::vector<double>& energies, double energy)
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
std::vector<double> velocities_at(std::span<const double> a)
{
    std::vector<double> velocities(a.size());
    for (std::size_t i = 1; i < a.size(); ++i) {
        velocities[i] = velocities[i - 1] + (a[i - 1] + a[i]) / 2;
    }
    return velocities;
}

struct RotatedPeaks {
    double median;
    double largest;
};

/// Of what has these components at each sample.
RotatedPeaks rotated_peaks(std::span<const double> first, std::span<const double> second)
{
    std::array<double, 180> peaks{};
    for (std::size_t degrees = 0; degrees < peaks.size(); ++degrees) {
        const auto direction = HorizontalDirection::of(double(degrees));
        for (std::size_t i = 0; i < first.size(); ++i) {
            peaks[degrees] =
                std::max(peaks[degrees], std::abs(direction.component(first[i], second[i])));
        }
    }
    std::ranges::sort(peaks);
    return {(peaks[89] + peaks[90]) / 2, peaks.back()};
}

} // namespace

double peak_of(std::span<const double> values)
{
    double peak = 0;
    for (const double value : values) {
        peak = std::max(peak, std::abs(value));
    }
    return peak;
}

IntensityMeasures intensity_measures(std::span<const double> acceleration, double time_step,
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

RotatedMeasures rotated_measures(const Accelerogram& record, double gravity)
{
    assert(record.second().size() == record.horizontal().size());
    const RotatedPeaks pga = rotated_peaks(record.horizontal(), record.second());
    const RotatedPeaks pgv =
        rotated_peaks(velocities_at(record.horizontal()), velocities_at(record.second()));
    const double unit = gravity * record.time_step();
    return {pga.median, pga.largest, unit * pgv.median, unit * pgv.largest};
}

} // namespace overturn
