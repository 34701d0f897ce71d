#include "overturn/mechanics/rotated_measures.hpp"

#include "overturn/mechanics/intensity_measures.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>

namespace overturn {

namespace {

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
