// The cost of accuracy: every method at every tolerance on a sample of a grid. End states are
// compared with 50 digits, verdicts with settled verdicts.
#pragma once

#include "overturn/mechanics/region.hpp"
#include "overturn/number/number.hpp"
#include "overturn/sweep/compute_tile.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace overturn {

class PointRun;
struct Outcomes;

/// The quantiles of the error distributions.
inline constexpr std::array<double, 5> error_quantiles{0.5, 0.9, 0.99, 0.999, 1};

/// Upper limits of the classes of |margin| by which wrong verdicts are counted; the last one is
/// unlimited.
inline constexpr std::array<double, 6> distance_limits{1e-8, 1e-6, 1e-4, 1e-2, 1, infinity};

inline constexpr std::size_t decided_regions = region_names.size();

using ErrorDistribution = std::array<double, error_quantiles.size()>;

/// One method at one tolerance.
struct AccuracyRow {
    Numerics numerics;
    double seconds_per_point = 0; ///< of compute_regions() on one core; set by the caller [s]
    /// Tried, per point: of the last integration only if verdicts are resolved, and of that with
    /// friction only if the block slips.
    double steps = 0;
    double evaluations = 0; ///< per point: of the acceleration (rk45), or of its series (taylor)
    /// Infinite for points with a different kind of end; NaN if there are no points.
    ErrorDistribution angle{};    ///< [rad]
    ErrorDistribution velocity{}; ///< [rad]
    ErrorDistribution margin{};   ///< [1]; without the points that have none
    ErrorDistribution slide{};    ///< of blocks with friction, over R [1]
    std::int64_t wrong_verdicts = 0;
    std::int64_t undecided = 0; ///< points without a verdict
    std::array<std::int64_t, decided_regions> wrong_verdicts_by_region{}; ///< by the true region
    std::array<std::int64_t, distance_limits.size()> wrong_verdicts_by_distance{};
    /// The share of points whose error exceeds its bound, and the median of bound over error; NaN
    /// for settings without error bounds.
    double bound_exceeded = 0;
    double bound_over_error = 0;
};

/// A grid of at most `points` points, spread evenly over this one, which has no table, including
/// the ends of each axis, with at most three values of each quantity other than the strength and
/// the fastest one; one point for each of these and each motion if that is more. points: at
/// least 9.
Grid sample_of(const Grid& grid, std::int64_t points);

/// About `wanted` points, spread over all rows and columns of a grid: their numbers, counted tile
/// by tile and row by row, in ascending order. All points if there are fewer than twice as many.
std::vector<int> evenly_chosen(const Tiling& tiling, std::int64_t wanted);

/// The points on which methods are compared.
struct AccuracySample {
    Grid grid;                  ///< an even sample of that of the job
    std::int64_t in_digits = 0; ///< points that are also computed in 50 digits
    std::int64_t settled = 0;   ///< points with a settled verdict
    std::array<std::int64_t, decided_regions> by_region{};
    std::array<std::int64_t, distance_limits.size()> by_distance{}; ///< of the known margins
};

/// A comparison of methods: first the sample and its reference values, then row by row.
class AccuracyStudy {
public:
    /// Samples at most `points` points of the grid, and computes about `in_digits` in 50 digits.
    AccuracyStudy(const Scene& scene, const Grid& grid, std::int64_t points, std::int64_t in_digits,
                  Kernel kernel);

    const AccuracySample& sample() const { return sample_; }

    /// The row of a setting without the time, which the caller measures.
    AccuracyRow measure(const Numerics& numerics) const;

    /// The computation to be timed: regions only, as in a large job.
    void compute_regions(const Numerics& numerics) const;

private:
    void compute_in_50_digits(std::int64_t wanted);
    void count_verdicts(const Outcomes& outcomes, AccuracyRow& row) const;
    void measure_errors(const Outcomes& outcomes, AccuracyRow& row) const;

    Problem problem_; // of the sample, without numerics and fields
    Kernel kernel_;
    AccuracySample sample_;
    std::shared_ptr<const PointRun> run_; // of the sample, tile by tile
    std::shared_ptr<const Outcomes> truth_;
    std::shared_ptr<const Outcomes> in_50_digits_; // of the points chosen_
    std::vector<int> chosen_;
};

/// The settings that `overturn accuracy` compares: both methods (under a record, only taylor) at
/// every decade from 1e-2 to 1e-14, and with resolve at the tolerances with error bounds, down to
/// 1e-8.
std::vector<Numerics> accuracy_ladder(const Scene& scene);

} // namespace overturn
