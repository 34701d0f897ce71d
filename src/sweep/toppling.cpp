#include "overturn/sweep/toppling.hpp"

#include "overturn/mechanics/sliding.hpp"
#include "overturn/mechanics/theory/theories.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/text/mapped.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

namespace overturn {

namespace {

/// See ToppleAnswer::friction_to_topple. unit: the peak acceleration of the strength 1.
std::vector<double> friction_to_topple(const Problem& of_one_point, const VerdictRanges& ranges,
                                       double unit)
{
    const Scene& scene = of_one_point.scene;
    const auto toppling = ranges.with(Verdict::topples);
    if (toppling.empty() || !has_contact_forces(scene.theory) || of_one_point.grid.may_slip()) {
        return {};
    }
    // At the end itself, whether the block topples, and with it the friction, may be unknown.
    const std::vector<double> ends = mapped(toppling, [](const VerdictRange& range) {
        return range.first + std::min(1e-6 * range.first, (range.last - range.first) / 2);
    });
    std::vector<double> accelerations = ends;
    if (const double highest = accelerations.back(); ranges.lifting < highest) {
        const std::vector<double> scan = scanned_accelerations(scene, ranges.lifting, highest);
        accelerations.insert(accelerations.end(), scan.begin(), scan.end());
    }
    std::ranges::sort(accelerations);
    const auto [begin, end] = std::ranges::unique(accelerations);
    accelerations.erase(begin, end);
    const std::string strength(scene.motion_traits().answer_strength);
    const std::vector<double> strengths = mapped(accelerations, [&](double acceleration) {
        return strength == "pga" ? acceleration : acceleration / unit;
    });
    Problem problem = of_one_point;
    // A pattern that matches one file is a dimension, of one motion.
    for (Dimension& dimension : std::exchange(problem.grid.dimensions, {})) {
        std::ranges::move(dimension.columns, std::back_inserter(problem.grid.numbers));
    }
    std::erase_if(problem.grid.numbers,
                  [](const Column& number) { return number.quantity->role == Role::strength; });
    problem.grid.dimensions = {{strength, {{&quantity(strength), Axis(AxisList(strengths))}}}};
    const std::vector<double> friction = accurate_values(problem, Field::friction_demand);
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
    const double of_direction = std::signbit(point.amplitude) ? -1 : 1; // mirrored
    const double requested = point.block.restitution;
    const auto r_max = r_max_of_only_block(problem);
    const std::vector<double> ratios = restitutions_of(requested, r_max);
    std::vector<RestitutionAnswer> answers;
    const auto show_progress = [&] {
        if (question.progress) {
            question.progress(answers.size(), ratios.size());
        }
        return false;
    };
    const double end = std::max(question.pga_max, answer.pga);
    for (const double ratio : ratios) {
        if (!answers.empty() && ratio == requested) {
            answers.push_back(answers.front());
            continue;
        }
        BoundaryLine line{.point = point, .unit = of_direction * answer.unit};
        line.point.block.restitution = ratio;
        answers.push_back({r_max ? ratio / *r_max : std::numeric_limits<double>::quiet_NaN(), ratio,
                           verdict_ranges(problem.scene, line, answer.lifting_pga, end, answer.pga,
                                          show_progress)});
    }
    return answers;
}

/// Smaller if the answer is worse: the verdict, the distance to the nearest toppling acceleration
/// as a ratio, the least toppling one, and that which lifts the block.
std::tuple<int, double, double, double> rank_of(const ToppleAnswer& answer)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const VerdictRanges& ranges = answer.requested().ranges;
    const int of_verdict = answer.verdict == Verdict::topples     ? 0
                           : answer.verdict == Verdict::undecided ? 1
                                                                  : 2;
    double distance = infinity;
    if (answer.verdict) {
        const auto above = ranges.nearest_above(Verdict::topples, answer.pga);
        const auto below = ranges.nearest_below(Verdict::topples, answer.pga);
        distance = std::min(above ? *above / answer.pga : infinity,
                            below ? answer.pga / *below : infinity);
    }
    const double least = ranges.nearest_above(Verdict::topples, 0).value_or(infinity);
    return {of_verdict, distance, least, answer.lifting_pga};
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

std::vector<double> accurate_values(Problem problem, Field field)
{
    problem.numerics = most_accurate;
    problem.fields = {field};
    const Tiling tiling = tiling_of(problem);
    std::vector<double> all;
    for (std::int64_t tile = 0; tile < tiling.size(); ++tile) {
        const TileFields fields = compute_tile(problem, tiling[tile], widest_kernel());
        const auto& values = std::get<std::vector<double>>(fields.values[0]);
        all.insert(all.end(), values.begin(), values.end());
    }
    return all;
}

std::vector<double> directions_of(const Problem& problem)
{
    if (const Column* given = problem.grid.find("direction")) {
        return {given->values.first()};
    }
    return only_point_of(problem).block.is_symmetric() ? std::vector<double>{0}
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
    if (!std::isfinite(point.friction)) {
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
    answer.friction_to_topple = friction_to_topple(problem, answer.requested().ranges, answer.unit);
    return answer;
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
