#include "overturn/sweep/accuracy.hpp"

#include "overturn/number/digits50.hpp"
#include "point_run.hpp"
#include "sample.hpp"

#include <algorithm>
#include <cmath>

namespace overturn {

namespace {

bool fell(std::uint8_t region)
{
    return region == std::uint8_t(Region::F_plus) || region == std::uint8_t(Region::F_minus);
}

std::size_t distance_class(double margin)
{
    return std::size_t(
        std::upper_bound(distance_limits.begin(), distance_limits.end() - 1, std::abs(margin)) -
        distance_limits.begin());
}

ErrorDistribution distribution(std::vector<double> errors)
{
    ErrorDistribution result{};
    std::sort(errors.begin(), errors.end());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double last = double(errors.size()) - 1;
        result[i] = errors.empty() ? std::numeric_limits<double>::quiet_NaN()
                                   : errors[std::size_t(std::ceil(error_quantiles[i] * last))];
    }
    return result;
}

template <class T>
const std::vector<T>& values_of(const TileFields& fields, std::size_t i)
{
    return std::get<std::vector<T>>(fields.values[i]);
}

} // namespace

std::vector<Numerics> accuracy_ladder(const Scene& scene)
{
    constexpr std::array tolerances{1e-2, 1e-3,  1e-4,  1e-5,  1e-6,  1e-7, 1e-8,
                                    1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14};
    std::vector<Numerics> ladder;
    for (const bool resolve : {false, true}) {
        for (const Method method : {Method::rk45, Method::taylor}) {
            for (const double tolerance : tolerances) {
                const Numerics numerics{method, tolerance, resolve};
                // With a smaller tolerance, nothing is left to resolve.
                const bool is_allowed = method == Method::taylor || !scene.is_recorded();
                if (is_allowed && (!resolve || (knows_errors(numerics) && tolerance >= 1e-8))) {
                    ladder.push_back(numerics);
                }
            }
        }
    }
    return ladder;
}

AccuracyStudy::AccuracyStudy(const Scene& scene, const Grid& grid, std::int64_t points,
                             std::int64_t in_digits, Kernel kernel)
    : scene_(scene), kernel_(kernel)
{
    sample_.grid = sample_of(grid, points);
    truth_ = computed(most_accurate, {Field::region, Field::margin});
    for (const TileFields& tile : truth_) {
        const auto& regions = values_of<std::uint8_t>(tile, 0);
        for (std::size_t point = 0; point < regions.size(); ++point) {
            if (regions[point] < decided_regions) {
                ++sample_.settled;
                ++sample_.by_region[regions[point]];
                ++sample_.by_distance[distance_class(values_of<double>(tile, 1)[point])];
            }
        }
    }
    compute_in_digits(in_digits);
}

std::vector<TileFields> AccuracyStudy::computed(const Numerics& numerics,
                                                std::vector<Field> fields) const
{
    const Problem problem{scene_, sample_.grid, numerics, Product::spectrum, std::move(fields)};
    const Tiling tiling = tiling_of(problem);
    std::vector<TileFields> tiles;
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        tiles.push_back(compute_tile(problem, tiling[i], kernel_));
    }
    return tiles;
}

void AccuracyStudy::compute_in_digits(std::int64_t wanted)
{
    const Tiling tiling = tiling_of({.scene = scene_, .grid = sample_.grid});
    const std::vector<std::vector<int>> chosen = evenly_chosen(tiling, wanted);
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        const PointRun run(scene_, Coordinates(scene_, sample_.grid, tiling[i]).points(), kernel_);
        Outcomes outcomes(std::size_t(run.size()), {.margin = true});
        for (const int point : chosen[std::size_t(i)]) {
            run.run_in_more_digits<Digits50>(point, outcomes);
            if (!(outcomes.flags[point] & outcome_flag::without_end)) {
                in_digits_.push_back({std::size_t(i), std::size_t(point),
                                      (outcomes.flags[point] & outcome_flag::fell) != 0,
                                      outcomes.side[point] * outcomes.tilt[point],
                                      outcomes.side[point] * outcomes.rate[point],
                                      outcomes.margin[point]});
            }
        }
    }
    sample_.in_digits = std::int64_t(in_digits_.size());
}

void AccuracyStudy::compute_regions(const Numerics& numerics) const
{
    computed(numerics, {Field::region});
}

AccuracyRow AccuracyStudy::measure(const Numerics& numerics) const
{
    std::vector<Field> fields{Field::region, Field::angle, Field::velocity, Field::margin,
                              Field::steps};
    if (knows_errors(numerics)) {
        fields.push_back(Field::error);
    }
    const std::vector<TileFields> tiles = computed(numerics, fields);
    AccuracyRow row;
    row.numerics = numerics;
    count_verdicts(tiles, row);
    measure_errors(tiles, row);
    return row;
}

void AccuracyStudy::count_verdicts(const std::vector<TileFields>& tiles, AccuracyRow& row) const
{
    double steps = 0;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const auto& region = values_of<std::uint8_t>(tiles[i], 0);
        const auto& true_region = values_of<std::uint8_t>(truth_[i], 0);
        const auto& true_margin = values_of<double>(truth_[i], 1);
        for (std::size_t point = 0; point < region.size(); ++point) {
            steps += values_of<std::uint32_t>(tiles[i], 4)[point];
            if (region[point] >= decided_regions) {
                ++row.undecided;
            } else if (true_region[point] < decided_regions &&
                       is_safe(Region(region[point])) != is_safe(Region(true_region[point]))) {
                ++row.wrong_verdicts;
                ++row.wrong_verdicts_by_region[true_region[point]];
                ++row.wrong_verdicts_by_distance[distance_class(true_margin[point])];
            }
        }
    }
    row.steps = steps / double(sample_.grid.points());
    row.evaluations = row.steps * (row.numerics.method == Method::rk45 ? 6 : 1);
}

void AccuracyStudy::measure_errors(const std::vector<TileFields>& tiles, AccuracyRow& row) const
{
    const bool with_bounds = knows_errors(row.numerics);
    std::vector<double> angle, velocity, margin, ratios;
    std::int64_t exceeded = 0;
    for (const DigitsTruth& exact : in_digits_) {
        const TileFields& tile = tiles[exact.tile];
        // Only one of the two blocks fell, so their ends cannot be compared.
        const bool differs = fell(values_of<std::uint8_t>(tile, 0)[exact.point]) != exact.fell;
        const auto error = [&](std::size_t field, double true_value) {
            const double found = std::abs(values_of<double>(tile, field)[exact.point] - true_value);
            return differs || !std::isfinite(found) ? std::numeric_limits<double>::infinity()
                                                    : found;
        };
        angle.push_back(error(1, exact.angle));
        velocity.push_back(error(2, exact.velocity));
        margin.push_back(error(3, exact.margin));
        if (with_bounds) {
            const double bound = values_of<double>(tile, 5)[exact.point];
            exceeded += margin.back() > bound;
            if (margin.back() > 0 && std::isfinite(bound)) {
                ratios.push_back(bound / margin.back());
            }
        }
    }
    row.angle = distribution(angle);
    row.velocity = distribution(velocity);
    row.margin = distribution(margin);
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    static_assert(error_quantiles[0] == 0.5); // the median
    row.bound_exceeded = with_bounds ? double(exceeded) / double(in_digits_.size()) : unknown;
    row.bound_over_error = with_bounds ? distribution(ratios)[0] : unknown;
}

} // namespace overturn
