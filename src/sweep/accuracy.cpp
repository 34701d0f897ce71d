#include "overturn/sweep/accuracy.hpp"

#include "overturn/number/digits50.hpp"
#include "point_run.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace overturn {

namespace {

/// Counts a point by its true region and, if it has a margin, by that.
void count(const Outcome& truth, auto& by_region, auto& by_distance)
{
    ++by_region[std::size_t(truth.region)];
    if (!std::isnan(truth.margin)) {
        const auto& limits = distance_limits; // without the last one
        ++by_distance[std::size_t(
            std::upper_bound(limits.begin(), limits.end() - 1, std::abs(truth.margin)) -
            limits.begin())];
    }
}

ErrorDistribution distribution(std::vector<double> errors)
{
    ErrorDistribution result{};
    std::sort(errors.begin(), errors.end());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double last = double(errors.size()) - 1;
        result[i] = errors.empty() ? unknown_value
                                   : errors[std::size_t(std::ceil(error_quantiles[i] * last))];
    }
    return result;
}

/// Whether the block fell during the ground motion, as far as the verdict could be settled.
bool is_forced_fall(Region region)
{
    return region == Region::F_plus || region == Region::F_minus;
}

/// All points of a problem, tile by tile.
std::vector<Point> points_of(const Problem& problem)
{
    const Tiling tiling = tiling_of(problem);
    std::vector<Point> points;
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        std::ranges::copy(Coordinates(problem.scene, problem.grid, tiling[i]).points(),
                          std::back_inserter(points));
    }
    return points;
}

} // namespace

Grid sample_of(const Grid& grid, std::int64_t points)
{
    constexpr std::int64_t most_of_others = 3;
    Grid sample = grid;
    Axis number; // instead of an axis that the grid lacks
    Axis* amplitude = &number;
    Axis* frequency = &number;
    auto left = double(points);
    for (Dimension& dimension : sample.dimensions) {
        Column& column = dimension.columns.front();
        const bool is_last = &dimension == &sample.dimensions.back();
        if (column.quantity->role == Role::motion) {
            left /= double(dimension.size());
        } else if (column.quantity->role == Role::strength) {
            amplitude = &column.values;
        } else if (is_last) {
            frequency = &column.values;
        } else {
            column.values = column.values.thinned(most_of_others);
            left /= double(dimension.size());
        }
    }
    const std::int64_t side = std::max<std::int64_t>(1, std::int64_t(std::sqrt(left)));
    const std::int64_t amplitudes = std::clamp<std::int64_t>(
        std::int64_t(left / double(std::min(side, frequency->size()))), 1, amplitude->size());
    *amplitude = amplitude->thinned(amplitudes);
    *frequency =
        frequency->thinned(std::max<std::int64_t>(1, std::int64_t(left / double(amplitudes))));
    return sample;
}

std::vector<int> evenly_chosen(const Tiling& tiling, std::int64_t wanted)
{
    const std::int64_t points = count_points(tiling.shape());
    const double stride = std::max(1.0, double(points) / double(wanted));
    const bool all = stride < 2;
    std::set<int> chosen;
    std::int64_t before = 0;
    double next = all ? 0 : 0.5 * stride;
    // Rows are visited in order. The golden ratio selects the column, so that none is left out.
    double share = 0.5;
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        const Tile tile = tiling[i];
        const auto columns = tile.count.empty() ? 1 : int(tile.count.back());
        for (; next < double(before + tile.points()); next += all ? 1 : stride) {
            const auto point = int(std::int64_t(next) - before);
            share = std::fmod(share + 0.6180339887498949, 1.0);
            const int column = all ? point % columns : int(share * columns);
            chosen.insert(int(before) + point - point % columns + column);
        }
        before += tile.points();
    }
    return {chosen.begin(), chosen.end()};
}

std::vector<Numerics> accuracy_ladder(const Scene& scene)
{
    constexpr std::array tolerances{1e-2, 1e-3,  1e-4,  1e-5,  1e-6,  1e-7, 1e-8,
                                    1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14};
    const MotionTraits& motion = scene.motion_traits();
    std::vector<Numerics> ladder;
    for (const bool resolve : {false, true}) {
        for (const Method method : {Method::rk45, Method::taylor}) {
            for (const double tolerance : tolerances) {
                const Numerics numerics{method, tolerance, resolve};
                // With a smaller tolerance, nothing is left to resolve.
                const bool is_allowed = method == motion.method || motion.has_other_methods;
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
    : problem_{.scene = scene, .grid = sample_of(grid, points)}, kernel_(kernel),
      sample_{.grid = problem_.grid},
      run_(std::make_shared<PointRun>(scene, points_of(problem_), kernel)),
      truth_(std::make_shared<Outcomes>(
          outcomes_of(*run_, most_accurate, {.region = true, .margin = true})))
{
    for (int i = 0; i < truth_->size(); ++i) {
        const Outcome& truth = (*truth_)[i];
        if (is_decided(truth.region)) {
            ++sample_.settled;
            count(truth, sample_.by_region, sample_.by_distance);
        }
    }
    compute_in_50_digits(in_digits);
}

void AccuracyStudy::compute_in_50_digits(std::int64_t wanted)
{
    chosen_ = evenly_chosen(tiling_of(problem_), wanted);
    Outcomes exact(truth_->size(), {.margin = true});
    for (const int point : chosen_) {
        if (run_->has_friction()) {
            run_->let_slip_in_50_digits(point, exact);
        } else {
            run_->run_in_more_digits<Digits50>(point, exact);
        }
    }
    std::erase_if(chosen_, [&](int point) {
        return exact[point].has(outcome_flag::without_end) || !is_decided(exact[point].region);
    });
    sample_.in_digits = std::int64_t(chosen_.size());
    in_50_digits_ = std::make_shared<Outcomes>(std::move(exact));
}

void AccuracyStudy::compute_regions(const Numerics& numerics) const
{
    Problem problem = problem_;
    problem.numerics = numerics;
    problem.fields = {Field::region};
    const Tiling tiling = tiling_of(problem);
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        compute_tile(problem, tiling[i], kernel_);
    }
}

AccuracyRow AccuracyStudy::measure(const Numerics& numerics) const
{
    const Outcomes outcomes = outcomes_of(*run_, numerics,
                                          {.error = knows_errors(numerics),
                                           .region = true,
                                           .margin = true,
                                           .steps = true,
                                           .slide = run_->has_friction()});
    AccuracyRow row;
    row.numerics = numerics;
    count_verdicts(outcomes, row);
    measure_errors(outcomes, row);
    return row;
}

void AccuracyStudy::count_verdicts(const Outcomes& outcomes, AccuracyRow& row) const
{
    double steps = 0;
    double evaluations = 0;
    for (int point = 0; point < outcomes.size(); ++point) {
        const Outcome& found = outcomes[point];
        const Outcome& truth = (*truth_)[point];
        const bool is_series = row.numerics.method == Method::taylor || found.has(status::slipped);
        steps += found.steps;
        evaluations += found.steps * (is_series ? 1 : 6);
        if (!is_decided(found.region)) {
            ++row.undecided;
        } else if (is_decided(truth.region) && is_safe(found.region) != is_safe(truth.region)) {
            ++row.wrong_verdicts;
            count(truth, row.wrong_verdicts_by_region, row.wrong_verdicts_by_distance);
        }
    }
    row.steps = steps / double(sample_.grid.points());
    row.evaluations = evaluations / double(sample_.grid.points());
}

void AccuracyStudy::measure_errors(const Outcomes& outcomes, AccuracyRow& row) const
{
    const bool with_bounds = knows_errors(row.numerics);
    std::vector<double> angle, velocity, margin, slide, ratios;
    std::int64_t exceeded = 0;
    for (const int point : chosen_) {
        const Outcome& found = outcomes[point];
        const Outcome& exact = (*in_50_digits_)[point];
        // If only one of the two blocks fell, their ends cannot be compared.
        const bool differ = is_forced_fall(found.region) != exact.has(outcome_flag::fell);
        const auto error = [&](Field field) {
            const auto value_of = [&](const Outcomes& of) {
                const EndsOfPoints ends{*run_, of.of_points.get()};
                return traits_of(field).value.at(ends[point]);
            };
            const double apart = std::abs(value_of(outcomes) - value_of(*in_50_digits_));
            return differ || !std::isfinite(apart) ? infinity : apart;
        };
        angle.push_back(error(Field::angle));
        velocity.push_back(error(Field::velocity));
        if (run_->has_friction()) {
            slide.push_back(error(Field::slide));
        }
        if (std::isnan(found.margin) && std::isnan((*in_50_digits_)[point].margin)) {
            continue; // it slips after the ground motion
        }
        margin.push_back(error(Field::margin));
        if (with_bounds) {
            exceeded += margin.back() > found.error;
            if (margin.back() > 0 && std::isfinite(found.error)) {
                ratios.push_back(found.error / margin.back());
            }
        }
    }
    row.angle = distribution(angle);
    row.velocity = distribution(velocity);
    row.margin = distribution(margin);
    row.slide = distribution(slide);
    static_assert(error_quantiles[0] == 0.5); // the median
    row.bound_exceeded = with_bounds ? double(exceeded) / double(margin.size()) : unknown_value;
    row.bound_over_error = with_bounds ? distribution(ratios)[0] : unknown_value;
}

} // namespace overturn
