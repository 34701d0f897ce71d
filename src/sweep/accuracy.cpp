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

double median(std::vector<double> values)
{
    if (values.empty()) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
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
    settle_verdicts();
    compute_in_digits(in_digits);
}

Problem AccuracyStudy::problem(const Numerics& numerics, std::vector<Field> fields) const
{
    return {scene_, sample_.grid, numerics, Product::spectrum, std::move(fields)};
}

void AccuracyStudy::settle_verdicts()
{
    const Problem settled = problem(most_accurate, {Field::region, Field::margin});
    const Tiling tiling = tiling_of(settled);
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        truth_.push_back(compute_tile(settled, tiling[i], kernel_));
        const auto& regions = values_of<std::uint8_t>(truth_.back(), 0);
        for (std::size_t point = 0; point < regions.size(); ++point) {
            if (regions[point] < decided_regions) {
                ++sample_.settled;
                ++sample_.by_region[regions[point]];
                ++sample_.by_distance[distance_class(values_of<double>(truth_.back(), 1)[point])];
            }
        }
    }
}

void AccuracyStudy::compute_in_digits(std::int64_t wanted)
{
    const Tiling tiling = tiling_of(problem(most_accurate, {}));
    const std::vector<std::vector<int>> chosen = evenly_chosen(tiling, wanted);
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        const Coordinates coordinates(scene_, sample_.grid, tiling[i]);
        const std::vector<std::int64_t> motions = coordinates.motions(); // of a tile, all are equal
        const PointRun run(scene_, coordinates.points(), kernel_, nullptr,
                           motions.empty() ? 0 : motions.front());
        Outcomes outcomes(std::size_t(run.size()), {.margin = true});
        for (const int point : chosen[std::size_t(i)]) {
            run.run_in_more_digits<Digits50>(point, outcomes);
            if (!(outcomes.flags[point] & outcome_flag::undecided)) {
                in_digits_.push_back({i, point, (outcomes.flags[point] & outcome_flag::fell) != 0,
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
    const Problem regions = problem(numerics, {Field::region});
    const Tiling tiling = tiling_of(regions);
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        compute_tile(regions, tiling[i], kernel_);
    }
}

AccuracyRow AccuracyStudy::measure(const Numerics& numerics) const
{
    AccuracyRow row;
    row.numerics = numerics;

    std::vector<Field> requested{Field::region, Field::angle, Field::velocity, Field::margin,
                                 Field::steps};
    const bool with_bounds = knows_errors(numerics);
    if (with_bounds) {
        requested.push_back(Field::error);
    }
    const Problem studied = problem(numerics, requested);
    const Tiling tiling = tiling_of(studied);
    std::vector<double> angle, velocity, margin, ratios;
    std::int64_t exceeded = 0;
    double steps = 0;
    auto exact = in_digits_.begin();
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        const TileFields fields = compute_tile(studied, tiling[i], kernel_);
        const auto& true_region = values_of<std::uint8_t>(truth_[std::size_t(i)], 0);
        const auto& true_margin = values_of<double>(truth_[std::size_t(i)], 1);
        const auto& region = values_of<std::uint8_t>(fields, 0);
        for (std::size_t point = 0; point < region.size(); ++point) {
            steps += values_of<std::uint32_t>(fields, 4)[point];
            if (region[point] >= decided_regions) {
                ++row.undecided;
            } else if (true_region[point] < decided_regions &&
                       is_safe(Region(region[point])) != is_safe(Region(true_region[point]))) {
                ++row.wrong_verdicts;
                ++row.wrong_verdicts_by_region[true_region[point]];
                ++row.wrong_verdicts_by_distance[distance_class(true_margin[point])];
            }
        }
        for (; exact != in_digits_.end() && exact->tile == i; ++exact) {
            const auto point = std::size_t(exact->point);
            // Only one of the two blocks fell, so their ends cannot be compared.
            const bool differs = fell(region[point]) != exact->fell;
            const auto error = [&](std::size_t field, double true_value) {
                const double value = values_of<double>(fields, field)[point];
                const double found = std::abs(value - true_value);
                return differs || !std::isfinite(found) ? std::numeric_limits<double>::infinity()
                                                        : found;
            };
            angle.push_back(error(1, exact->angle));
            velocity.push_back(error(2, exact->velocity));
            margin.push_back(error(3, exact->margin));
            if (with_bounds) {
                const double bound = values_of<double>(fields, 5)[point];
                exceeded += margin.back() > bound;
                if (margin.back() > 0 && std::isfinite(bound)) {
                    ratios.push_back(bound / margin.back());
                }
            }
        }
    }
    const double points = double(sample_.grid.points());
    row.steps = steps / points;
    row.evaluations = row.steps * (numerics.method == Method::rk45 ? 6 : 1);
    row.angle = distribution(angle);
    row.velocity = distribution(velocity);
    row.margin = distribution(margin);
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    row.bound_exceeded = with_bounds ? double(exceeded) / double(in_digits_.size()) : unknown;
    row.bound_over_error = with_bounds ? median(ratios) : unknown;
    return row;
}

} // namespace overturn
