#include "overturn/sweep/toppling.hpp"

#include "point_run.hpp"

#include "overturn/mechanics/sliding.hpp"
#include "overturn/mechanics/theory/theories.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/sweep/in_threads.hpp"
#include "overturn/text/mapped.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>

namespace overturn {

namespace {

/// The strengths of a point in its direction, in units of g. unit: the peak acceleration of the
/// strength 1.
BoundaryLine line_of(const Point& point, double unit)
{
    return {.point = point, .unit = std::signbit(point.amplitude) ? -unit : unit};
}

/// See ToppleAnswer::friction_to_topple. line: amplitudes in units of g.
std::vector<double> friction_to_topple(const Scene& scene, const BoundaryLine& line,
                                       const VerdictRanges& ranges, int threads)
{
    const auto toppling = ranges.with(Verdict::topples);
    if (toppling.empty() || !has_contact_forces(scene.theory) || may_slip(line.point)) {
        return {};
    }
    // At the end itself, whether the block topples, and with it the friction, may be unknown.
    const std::vector<double> ends = mapped(toppling, [](const VerdictRange& range) {
        return range.first + std::min(1e-6 * range.first, (range.last - range.first) / 2);
    });
    std::vector<double> accelerations =
        scanned_accelerations(scene, ranges.begin_of_search, ranges.end_of_search());
    std::erase_if(accelerations, [&](double each) { return each > ends.back(); });
    accelerations.insert(accelerations.end(), ends.begin(), ends.end());
    std::ranges::sort(accelerations);
    // As in the search for the ranges.
    const bool is_sensitive = scene.motion_traits().is_sensitive;
    const int most_in_50_digits = is_sensitive ? 0 : std::numeric_limits<int>::max();
    std::vector<double> friction(accelerations.size());
    constexpr std::size_t at_once = 32; // half of which may need more digits
    in_threads((friction.size() + at_once - 1) / at_once, threads, [&](std::size_t part) {
        const std::size_t first = part * at_once;
        const std::size_t count = std::min(at_once, friction.size() - first);
        const PointRun run(scene, line.points({accelerations.data() + first, count}),
                           widest_kernel(), nullptr, line.point.block.is_symmetric());
        const Outcomes outcomes =
            outcomes_of(run, most_accurate, {.contact = true}, most_in_50_digits);
        for (int i = 0; i < run.size(); ++i) {
            const bool is_settled = is_decided(outcomes[i].region);
            friction[first + std::size_t(i)] = is_settled ? outcomes[i].friction_demand : 0;
        }
    });
    std::vector<double> needed;
    double largest = 0; // NaN as soon as one is unknown
    for (std::size_t i = 0; i < accelerations.size(); ++i) {
        const bool is_covered = std::isnan(largest) || std::islessequal(friction[i], largest);
        largest = is_covered ? largest : friction[i];
        if (needed.size() < ends.size() && accelerations[i] == ends[needed.size()]) {
            needed.push_back(largest);
        }
    }
    return needed;
}

/// r_max of the only block, if it exists.
std::optional<double> r_max_of_only_block(const Problem& problem)
{
    const Coordinates coordinates(problem.scene, problem.grid);
    return problem.grid.has_two_sides()
               ? std::optional(coordinates.of("largest_restitution").first())
               : r_max_of(coordinates.of("slenderness").first());
}

/// The requested restitution, and those of the table, which may contain it.
std::vector<double> restitutions_of(double requested, const std::optional<double>& r_max)
{
    std::vector<double> ratios{requested};
    if (r_max) {
        for (const double share : {0.8, 0.85, 0.9, 0.95, 1.0}) {
            ratios.push_back(share * *r_max);
        }
    }
    return ratios;
}

std::vector<RestitutionAnswer> answers_by_restitution(const Problem& problem, const Point& point,
                                                      const ToppleAnswer& answer,
                                                      const ToppleQuestion& question)
{
    const double requested = point.block.restitution;
    const auto r_max = r_max_of_only_block(problem);
    const std::vector<double> ratios = question.searches && question.other_restitutions
                                           ? restitutions_of(requested, r_max)
                                           : std::vector{requested};
    std::vector<RestitutionAnswer> answers(ratios.size());
    std::vector<std::size_t> distinct{0}; // the requested one, and those that differ from it
    for (std::size_t i = 1; i < ratios.size(); ++i) {
        if (ratios[i] != requested) {
            distinct.push_back(i);
        }
    }
    std::atomic<std::size_t> done = ratios.size() - distinct.size();
    const auto show_progress = [&, is_caller = is_this_thread()] {
        if (question.progress && is_caller()) {
            question.progress(done, ratios.size());
        }
        return false;
    };
    const double end = std::max(question.pga_max, answer.pga);
    in_threads(distinct.size(), question.threads, [&](std::size_t number) {
        const std::size_t i = distinct[number];
        BoundaryLine line = line_of(point, answer.unit);
        line.point.block.restitution = ratios[i];
        if (question.searches) {
            answers[i].ranges = verdict_ranges(problem.scene, line, answer.lifting_pga, end,
                                               answer.pga, show_progress);
        }
        ++done;
    });
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        answers[i].share = r_max ? ratios[i] / *r_max : unknown_value;
        answers[i].ratio = ratios[i];
        if (ratios[i] == requested) {
            answers[i].ranges = answers.front().ranges;
        }
    }
    return answers;
}

/// Smaller if the answer is worse: the verdict, the distance to the nearest toppling acceleration
/// as a ratio, the least toppling one, and that which lifts the block.
std::tuple<int, double, double, double> rank_of(const ToppleAnswer& answer)
{
    const VerdictRanges& ranges = answer.requested().ranges;
    double distance = infinity;
    if (answer.verdict) {
        const auto above = ranges.nearest_above(Verdict::topples, answer.pga);
        const auto below = ranges.nearest_below(Verdict::topples, answer.pga);
        distance = std::min(above ? *above / answer.pga : infinity,
                            below ? answer.pga / *below : infinity);
    }
    const double least = ranges.nearest_above(Verdict::topples, 0).value_or(infinity);
    return {-int(answer.verdict.value_or(Verdict::safe)), distance, least, answer.lifting_pga};
}

/// At least this number of tiles, if there are as many points, each of successive points.
Tiling contiguous_tiling(const Shape& shape, std::int64_t least)
{
    Shape tile = shape;
    std::int64_t tiles = 1;
    for (std::size_t i = 0; i < shape.size() && tiles < least; ++i) {
        tile[i] = std::max<std::int64_t>(1, shape[i] * tiles / least);
        tiles *= (shape[i] + tile[i] - 1) / tile[i];
    }
    return Tiling(shape, tile);
}

} // namespace

Point only_point_of(const Problem& problem)
{
    return Coordinates(problem.scene, problem.grid).points().front();
}

std::optional<double> only_slenderness_of(const Problem& problem)
{
    return problem.grid.has_two_sides() ? std::nullopt
                                        : std::optional(only_point_of(problem).block.slenderness);
}

std::vector<double> accurate_values(Problem problem, Field field, int threads)
{
    problem.numerics = most_accurate;
    problem.fields = {field};
    constexpr std::int64_t tiles_per_thread = 4; // whose durations differ
    const Tiling tiling = contiguous_tiling(problem.grid.shape(), tiles_per_thread * threads);
    std::vector<std::vector<double>> tiles(std::size_t(tiling.size()));
    in_threads(tiles.size(), threads, [&](std::size_t i) {
        const Tile tile = tiling[std::int64_t(i)];
        tiles[i] =
            std::get<std::vector<double>>(compute_tile(problem, tile, widest_kernel()).values[0]);
    });
    std::vector<double> all;
    for (const std::vector<double>& tile : tiles) {
        all.insert(all.end(), tile.begin(), tile.end());
    }
    return all;
}

std::vector<double> directions_of(const Problem& problem)
{
    if (const Column* given = problem.grid.find("direction")) {
        return {given->values.first()};
    }
    const std::vector<Point> points = Coordinates(problem.scene, problem.grid).points();
    const auto is_symmetric = [](const Point& point) { return point.block.is_symmetric(); };
    return std::ranges::all_of(points, is_symmetric) ? std::vector<double>{0}
                                                     : std::vector<double>{0, 180};
}

Verdict verdict_of_peak(double peak)
{
    return std::isnan(peak)   ? Verdict::undecided
           : std::isinf(peak) ? Verdict::topples
                              : Verdict::safe;
}

namespace {

std::optional<SlipAnswer> slip_of(const Problem& problem, const Point& point,
                                  const ToppleQuestion& question)
{
    if (!may_slip(point)) {
        return std::nullopt;
    }
    SlipAnswer slip{.friction = point.friction,
                    .stays_flat = overturn::stays_flat(point),
                    .moving_pga = moving_pga(problem.scene, point),
                    .without = {}};
    if (question.has_strength) {
        slip.slide = accurate_values(problem, Field::slide).front();
        slip.slide_peak = accurate_values(problem, Field::slide_peak).front();
        Problem without = problem;
        std::erase_if(without.grid.numbers,
                      [](const Column& number) { return number.quantity->name == "friction"; });
        slip.without = verdict_of_peak(accurate_values(without, Field::peak).front());
    }
    return slip;
}

} // namespace

ToppleAnswer answer_of(const Problem& problem, const ToppleQuestion& question)
{
    ToppleAnswer answer;
    const Scene& scene = problem.scene;
    const Point point = only_point_of(problem);
    answer.direction = directions_of(problem).front();
    answer.unit = pga_of_unit(scene, point);
    answer.pga = question.pga.value_or(std::abs(point.amplitude) * answer.unit);
    if (question.has_strength) {
        answer.peak = accurate_values(problem, Field::peak).front();
        answer.verdict = verdict_of_peak(answer.peak);
        if (has_contact_forces(scene.theory)) {
            answer.friction_demand = accurate_values(problem, Field::friction_demand).front();
        }
    }
    answer.slip = slip_of(problem, point, question);
    answer.lifting_pga = lifting_pga(scene, point);
    answer.by_restitution = answers_by_restitution(problem, point, answer, question);
    answer.friction_to_topple = friction_to_topple(scene, line_of(point, answer.unit),
                                                   answer.requested().ranges, question.threads);
    return answer;
}

VerdictRanges ranges_along(const Problem& problem, const Quantity& quantity, double first,
                           double last)
{
    const Grid& grid = problem.grid;
    return verdict_ranges(problem.scene, line_along(quantity, grid, Shape(grid.dimensions.size())),
                          first, last);
}

bool is_worse(const ToppleAnswer& one, const ToppleAnswer& other)
{
    return rank_of(one) < rank_of(other);
}

double undecided_share(const ToppleAnswer& answer)
{
    double largest = 0;
    for (const RestitutionAnswer& each : answer.by_restitution) {
        largest = std::max(largest, each.ranges.undecided_share());
    }
    return largest;
}

} // namespace overturn
