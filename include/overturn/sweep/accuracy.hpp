// What accuracy costs in time: every method at every tolerance on a sample of a plane, its ends
// held against 50 digits, its verdicts against verdicts that are settled.
#pragma once

#include "overturn/mechanics/region.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/scene.hpp"
#include "overturn/sweep/sweep_tile.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace overturn {

/// Shares of the points whose errors are at most the values given for them.
inline constexpr std::array<double, 5> error_quantiles{0.5, 0.9, 0.99, 0.999, 1};

/// Upper ends of the classes of |margin| by which flips are counted; the last one has none.
inline constexpr std::array<double, 6> distance_limits{
    1e-8, 1e-6, 1e-4, 1e-2, 1, std::numeric_limits<double>::infinity()};

inline constexpr std::size_t decided_regions = 9; ///< S to F-

using ErrorDistribution = std::array<double, error_quantiles.size()>;

/// One method at one tolerance.
struct AccuracyRow {
    Numerics numerics;
    double seconds_per_point = 0; ///< of compute_regions(), on one core; left to the caller [s]
    double steps = 0;             ///< tried, per point; with resolve, of the last integration alone
    double evaluations = 0; ///< per point: of the acceleration (rk45), or of its series (taylor)
    ErrorDistribution
        angle{}; ///< [rad]; infinite from where on points end otherwise, not a number of none
    ErrorDistribution velocity{};                                ///< [rad]
    ErrorDistribution margin{};                                  ///< [1]
    std::int64_t flips = 0;                                      ///< verdicts that are wrong
    std::int64_t undecided = 0;                                  ///< points without one
    std::array<std::int64_t, decided_regions> flips_by_region{}; ///< by the true region
    std::array<std::int64_t, distance_limits.size()> flips_by_distance{};
    /// Where errors are known: the share of points whose error exceeds its bound, and the median of
    /// bound over error; not a number elsewhere.
    double bound_exceeded = 0;
    double bound_over_error = 0;
};

/// The points on which methods are compared.
struct AccuracySample {
    Plane plane;                ///< of the job's, spread evenly
    std::int64_t in_digits = 0; ///< points among them that are computed in 50 digits, too
    std::int64_t settled = 0;   ///< points whose verdict is known
    std::array<std::int64_t, decided_regions> by_region{};
    std::array<std::int64_t, distance_limits.size()> by_distance{};
};

/// A comparison at work: the sample and what is true of it first, then row by row.
class AccuracyStudy {
public:
    /// Takes at most `points` points of the plane, and about `in_digits` of them in 50 digits.
    AccuracyStudy(const Scene& scene, const Plane& plane, std::int64_t points,
                  std::int64_t in_digits, Kernel kernel);

    const AccuracySample& sample() const { return sample_; }

    /// All that is known of a setting but the time that it takes.
    AccuracyRow measure(const Numerics& numerics) const;

    /// What is timed: regions alone, as a large job asks for them.
    void compute_regions(const Numerics& numerics) const;

private:
    struct DigitsTruth {
        std::int64_t tile;
        int point;
        bool fell;
        double angle, velocity, margin;
    };

    void settle_verdicts();
    void compute_in_digits(std::int64_t wanted);

    Scene scene_;
    Kernel kernel_;
    AccuracySample sample_;
    std::vector<TileFields> truth_; // by tile: region, margin
    std::vector<DigitsTruth> in_digits_;
};

/// The methods and tolerances that `overturn accuracy` compares: both at every decade from 1e-2 to
/// 1e-14, and resolved from those at which errors are known, down to 1e-8.
std::vector<Numerics> accuracy_ladder();

} // namespace overturn
