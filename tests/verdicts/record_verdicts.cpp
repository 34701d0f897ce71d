// record_verdicts POINTS [SEED]: resolved verdicts and error bounds on POINTS random points under
// random records, with and without vertical motion, in both theories, compared with a reference:
// the tightest run in doubles, and 50 digits if its margin is below 1e-9. A quarter of the points
// is close to a boundary between safe and unsafe. Exit code 1 if a verdict is wrong, or bounds are
// exceeded too often.
#include "verdicts/truth.hpp"

#include "support/random_record.hpp"
#include "support/two_sides.hpp"

#include <cmath>
#include <cstdio>
#include <memory>

namespace overturn {
namespace {

constexpr int points_of_scene = 64;

struct Counts {
    std::int64_t points = 0;
    std::int64_t unresolved = 0;
    std::int64_t wrong = 0;
    std::int64_t in_50_digits = 0; ///< of the resolved run
    std::int64_t bounds = 0;       ///< finite ones that were compared
    std::int64_t exceeded = 0;
    std::int64_t unbounded = 0;
    std::int64_t undecided = 0; ///< with one of the tolerances of the bounds
};

class RandomScenes {
public:
    explicit RandomScenes(std::uint64_t seed) : generator_(seed) {}

    /// A block under a record of 8 to 400 samples and 2 to 15 units of time 1/p, times factors
    /// that lift it.
    PointRun next()
    {
        const Theory theory = uniform() < 0.5 ? Theory::linear : Theory::nonlinear;
        const auto directions = uniform() < 0.5 ? Directions::both : Directions::horizontal;
        const int samples = int(std::exp(std::log(8.0) + std::log(50.0) * uniform()));
        RecordPoint of_record = random_record_point(generator_, samples, directions);
        Scene scene{.theory = theory};
        scene.motion = Suite{{std::make_shared<const Accelerogram>(of_record.record)}};

        Point point{of_record.block, 0, of_record.frequency};
        if (uniform() < 0.5) {
            const Body body = random_body(generator_);
            point.block = body.block(std::min(1.0, body.largest_restitution()));
            point.frequency *= point.block.frequency_parameter;
        }
        point.block.restitution = uniform() < 0.05 ? 1 : 0.3 + 0.7 * uniform();
        const double most =
            std::min(6 * Equations<Theory::nonlinear>::uplift_acceleration(point.block) /
                         of_record.record.peak(),
                     0.9 * of_record.record.free_fall_scale());
        std::vector<Point> points(points_of_scene, point);
        for (Point& each : points) {
            each.amplitude = most * (0.1 + 0.9 * uniform());
        }
        const PointRun run(scene, points, widest_kernel());
        if (uniform() < 0.5) {
            gather_at_boundary(run, points);
        }
        return {scene, points, widest_kernel()};
    }

private:
    /// Moves half of the points to within 1e-1 to 1e-14 of a boundary, if two of them differ.
    void gather_at_boundary(const PointRun& run, std::vector<Point>& points)
    {
        const auto is_safe_at = [&](const Point& point) {
            const PointRun single(run.scene(), {point}, widest_kernel());
            return is_safe(
                outcomes_of(single, {Method::taylor, 1e-10}, {.region = true})[0].region);
        };
        Point low = points.front();
        Point high = points.back();
        const bool safe = is_safe_at(low);
        if (safe == is_safe_at(high)) {
            return;
        }
        for (int i = 0; i < 50; ++i) {
            Point middle = low;
            middle.amplitude = (low.amplitude + high.amplitude) / 2;
            (is_safe_at(middle) == safe ? low : high) = middle;
        }
        for (std::size_t i = 0; i < points.size(); i += 2) {
            const double near = std::pow(10, -1 - 13 * uniform());
            points[i].amplitude = low.amplitude * (1 + (uniform() < 0.5 ? -near : near));
        }
    }

    double uniform() { return std::uniform_real_distribution<double>(0, 1)(generator_); }

    std::mt19937_64 generator_;
};

void name_point(const char* what, const PointRun& run, int i, double found, const Outcomes& truth)
{
    const Point& point = run.point(i);
    std::printf(
        "  %s: %s, %lld samples, alpha %.17g, other %.17g, r %.17g, frequency %.17g, factor "
        "%.17g: margin %.6g, true %.6g, bound of that %.3g\n",
        what, std::string(name_of(run.scene().theory)).c_str(),
        static_cast<long long>(run.scene().records()[0]->samples()), point.block.slenderness,
        point.block.other.slenderness, point.block.restitution, point.frequency, point.amplitude,
        found, truth[i].margin, truth[i].error);
}

void check_verdicts(const PointRun& run, const Outcomes& truth, Counts& counts)
{
    const Outcomes resolved =
        outcomes_of(run, {Method::taylor, loosest, true}, {.region = true, .margin = true});
    counts.in_50_digits += resolved.in_50_digits;
    for (int i = 0; i < resolved.size(); ++i) {
        ++counts.points;
        const bool known = truth[i].error < std::abs(truth[i].margin);
        if (resolved[i].flags & status::unresolved) {
            ++counts.unresolved;
            name_point("unresolved", run, i, resolved[i].margin, truth);
        } else if (known && is_safe(resolved[i].region) != (truth[i].margin > 0)) {
            ++counts.wrong;
            name_point("WRONG", run, i, resolved[i].margin, truth);
        }
    }
}

void check_bounds(const PointRun& run, const Outcomes& truth, double tolerance, Counts& counts)
{
    const Outcomes found =
        outcomes_of(run, {Method::taylor, tolerance}, {.error = true, .margin = true});
    for (int i = 0; i < found.size(); ++i) {
        counts.undecided += found[i].has(outcome_flag::without_end);
        if (!std::isfinite(truth[i].margin) || !std::isfinite(truth[i].error) ||
            !std::isfinite(found[i].margin)) {
            continue;
        }
        const bool agree = !((found[i].flags ^ truth[i].flags) & outcome_flag::fell);
        const double error = agree ? std::abs(found[i].margin - truth[i].margin)
                                   : std::numeric_limits<double>::infinity();
        if (!std::isfinite(found[i].error)) {
            ++counts.unbounded;
            continue;
        }
        ++counts.bounds;
        if (error > found[i].error + truth[i].error) {
            ++counts.exceeded;
            name_point("bound exceeded", run, i, found[i].margin, truth);
        }
    }
}

bool study(std::int64_t points, std::uint64_t seed)
{
    RandomScenes scenes(seed);
    Counts counts;
    while (counts.points < points) {
        const PointRun run = scenes.next();
        const Outcomes truth = truth_of(run);
        check_verdicts(run, truth, counts);
        for (const double tolerance : {1e-4, 1e-9, 1e-12}) {
            check_bounds(run, truth, tolerance, counts);
        }
    }
    const auto number = [](std::int64_t count) { return static_cast<long long>(count); };
    std::printf(
        "seed %llu, records, resolved: %lld points, %lld wrong, %lld unresolved, %lld in 50 "
        "digits\n%lld bounds of errors, %lld exceeded; %lld points without a bound, %lld "
        "undecided\n",
        static_cast<unsigned long long>(seed), number(counts.points), number(counts.wrong),
        number(counts.unresolved), number(counts.in_50_digits), number(counts.bounds),
        number(counts.exceeded), number(counts.unbounded), number(counts.undecided));
    return counts.wrong == 0 && are_few(counts.exceeded, counts.bounds);
}

} // namespace
} // namespace overturn

int main(int argc, char** argv)
{
    return overturn::study_main(argc, argv, "record_verdicts POINTS [SEED]", overturn::study);
}
