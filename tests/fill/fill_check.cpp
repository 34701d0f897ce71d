// fill_check POINTS [SEED [MUTANT]]: fills spectra without an audit, compares them with spectra of
// which every point is integrated, and prints every kind of plane with the share of integrated
// points. At least POINTS points are compared: tiles in which weaker rules fail and, if POINTS is
// not 0, the paper's planes, random planes, and random planes where many low bounces precede a
// large motion. MUTANT: kappa (the rule of the nominal error) or grazes (impacts that could vanish
// are ignored). Exit code 1 if a point is wrong, or if more points than expected were integrated.
#include "overturn/mechanics/block.hpp"
#include "overturn/sweep/fill.hpp"
#include "overturn/sweep/sweep_tile.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace overturn {
namespace {

struct Problem {
    Scene scene;
    Numerics numerics;
    Plane plane;
    bool with_impacts = false;
};

struct Counts {
    std::int64_t points = 0;
    std::int64_t integrated = 0;
    std::int64_t wrong = 0;

    void add(const Counts& other)
    {
        points += other.points;
        integrated += other.integrated;
        wrong += other.wrong;
    }
    double share() const { return points > 0 ? double(integrated) / double(points) : 0; }
};

std::string text_of(const Axis& axis)
{
    const auto& range = std::get<AxisRange>(axis.definition());
    char text[100];
    std::snprintf(text, sizeof text, "%.17g to %.17g%s", range.first, range.last,
                  range.spacing == Spacing::log ? " (log)" : "");
    return text;
}

/// Prints what is needed to compute a point again.
void name_point(const Problem& problem, std::int64_t row, std::int64_t column, int filled,
                int direct)
{
    const auto& [scene, numerics, plane, with_impacts] = problem;
    std::printf(
        "  WRONG: %s %s %s %g%s, window %.17g, cycles %g, gamma %.17g, nu %.17g, alpha "
        "%.17g, r %.17g, Omega %s, a %s, %lld points a side%s: row %lld, column %lld: "
        "filled %d, integrated %d\n",
        std::string(name_of(scene.pulse)).c_str(), std::string(name_of(scene.theory)).c_str(),
        std::string(name_of(numerics.method)).c_str(), numerics.tolerance,
        numerics.resolve ? " resolved" : "", scene.shape.window, scene.shape.cycles,
        scene.shape.gamma, scene.shape.nu, plane.slenderness[0], plane.restitution_ratio(0, 0),
        text_of(plane.frequency).c_str(), text_of(plane.amplitude).c_str(),
        static_cast<long long>(plane.amplitude.size()), with_impacts ? ", with impacts" : "",
        static_cast<long long>(row), static_cast<long long>(column), filled, direct);
}

Counts compare(const Problem& problem, const Tile& tile, const FillRule& rule)
{
    const auto& [scene, numerics, plane, with_impacts] = problem;
    const FilledTile filled =
        fill_tile(scene, numerics, plane, tile, with_impacts, widest_kernel(), nullptr, rule);
    std::vector<Field> fields{Field::region};
    if (with_impacts) {
        fields.push_back(Field::impacts);
    }
    Numerics every_point = numerics;
    every_point.fill = false;
    const TileFields direct = sweep_tile(scene, every_point, plane, tile, fields, widest_kernel());
    const auto& region = std::get<std::vector<std::uint8_t>>(direct.values[0]);
    Counts counts;
    for (std::size_t i = 0; i < region.size(); ++i) {
        ++counts.points;
        counts.integrated += filled.evaluated[i];
        const bool wrong =
            filled.region[i] != region[i] ||
            (with_impacts &&
             filled.impacts[i] != std::get<std::vector<std::uint16_t>>(direct.values[1])[i]);
        if (wrong && counts.wrong++ == 0) {
            name_point(problem, tile.begin[2] + std::int64_t(i) / tile.columns(),
                       tile.begin[3] + std::int64_t(i) % tile.columns(), filled.region[i],
                       region[i]);
        }
    }
    return counts;
}

Counts compare(const Problem& problem, const FillRule& rule)
{
    const Tiling tiling = filled_tiling(problem.plane);
    Counts counts;
    for (std::int64_t n = 0; n < tiling.size(); ++n) {
        counts.add(compare(problem, tiling[n], rule));
    }
    return counts;
}

/// A tile in which weaker rules fail: a strip of one row passes between nodes that agree.
struct HardTile {
    Problem problem;
    std::int64_t row, column; ///< the tile that contains this point
};

Counts compare(const HardTile& hard, const FillRule& rule)
{
    const Tiling tiling = filled_tiling(hard.problem.plane);
    for (std::int64_t n = 0; n < tiling.size(); ++n) {
        const Tile tile = tiling[n];
        if (hard.row < tile.begin[2] + tile.count[2] &&
            hard.column < tile.begin[3] + tile.count[3]) {
            return compare(hard.problem, tile, rule);
        }
    }
    return {};
}

Plane plane_of(const AxisRange& frequency, const AxisRange& amplitude)
{
    Plane plane;
    plane.frequency = Axis(frequency);
    plane.amplitude = Axis(amplitude);
    plane.restitution = Axis(AxisList{1});
    plane.restitution_of = RestitutionOf::maximum;
    plane.slenderness = Axis(AxisList{std::atan(1 / 5.67)});
    return plane;
}

std::vector<HardTile> hard_tiles()
{
    Problem sine{.scene = {.pulse = PulseKind::sine, .shape = {.cycles = 2.5}},
                 .numerics = {.method = Method::taylor, .tolerance = 1e-6, .audit = 0},
                 .plane = plane_of({.first = 0.05, .last = 1.8128522632822612, .count = 868},
                                   {.first = 1.001, .last = 1.4804846656126971, .count = 868})};
    sine.plane.slenderness = Axis(AxisList{0.26662054772862431});
    sine.plane.restitution = Axis(AxisList{0.8025885124983132});
    sine.plane.restitution_of = RestitutionOf::absolute;
    Problem cosine{.scene = {.pulse = PulseKind::cosine, .shape = {.cycles = 3}},
                   .numerics = {.audit = 0},
                   .plane = plane_of({.first = 0.05, .last = 1.5294371192114744, .count = 400},
                                     {.first = 1.001, .last = 1.4381634078456134, .count = 400}),
                   .with_impacts = true};
    cosine.plane.slenderness = Axis(AxisList{0.14424994278535325});
    cosine.plane.restitution = Axis(AxisList{0.9776654199149466});
    cosine.plane.restitution_of = RestitutionOf::absolute;
    return {{sine, 133, 616}, {cosine, 66, 316}};
}

/// The planes of the paper's figures: its block under a pulse, the restitution over the largest.
Problem paper_problem(PulseKind pulse, double restitution, std::int64_t side)
{
    Problem problem{.scene = {.pulse = pulse}, .numerics = {}, .plane = {}};
    problem.plane = plane_of({.first = 0.1, .last = 12, .count = side},
                             {.first = 0.1, .last = 16, .count = side});
    problem.plane.restitution = Axis(AxisList{restitution});
    problem.numerics.audit = 0;
    return problem;
}

class RandomProblems {
public:
    explicit RandomProblems(std::uint64_t seed) : generator_(seed) {}

    /// corner: low frequencies and amplitudes just above 1.
    Problem next(bool corner)
    {
        Problem problem;
        problem.scene.pulse = PulseKind(std::size_t(uniform() * double(pulses.size())));
        problem.scene.theory = uniform() < 0.7 ? Theory::nonlinear : Theory::linear;
        problem.scene.shape = {.window = between(0.5, 2),
                               .cycles = std::round(uniform() * 5 + 1) / 2,
                               .gamma = between(1, 3),
                               .nu = between(-pi<double>(), pi<double>())};
        problem.numerics.method = uniform() < 0.5 ? Method::rk45 : Method::taylor;
        problem.numerics.tolerance =
            problem.numerics.method == Method::rk45 ? 1e-9 : (uniform() < 0.5 ? 1e-9 : 1e-6);
        problem.numerics.resolve = uniform() < 0.1;
        problem.numerics.audit = 0;
        problem.with_impacts = uniform() < 0.2;
        const Spacing spacing = uniform() < 0.3 ? Spacing::log : Spacing::linear;
        const auto side = std::int64_t(std::exp(between(std::log(256), std::log(1500))));
        const auto axis = [&](double first, double last) {
            return AxisRange{.first = first, .last = last, .count = side, .spacing = spacing};
        };
        problem.plane = corner
                            ? plane_of(axis(0.05, between(0.5, 2)), axis(1.001, between(1.05, 1.5)))
                            : plane_of(axis(log_between(0.05, 2), between(4, 15)),
                                       axis(between(0.1, 1.2), between(4, 20)));
        const double slenderness = between(0.05, 0.5);
        problem.plane.slenderness = Axis(AxisList{slenderness});
        problem.plane.restitution_of = RestitutionOf::absolute;
        const double largest = largest_restitution(slenderness);
        problem.plane.restitution =
            Axis(AxisList{uniform() < 0.3 ? largest : between(0.5 * largest, 1)});
        return problem;
    }

private:
    double uniform() { return std::uniform_real_distribution<double>(0, 1)(generator_); }
    double between(double low, double high) { return low + (high - low) * uniform(); }
    double log_between(double low, double high)
    {
        return std::exp(between(std::log(low), std::log(high)));
    }

    std::mt19937_64 generator_;
};

/// Prints the counts of one kind of planes; they are right if no point is wrong and at most this
/// share was integrated.
bool report(const std::string& planes, const Counts& counts, double most)
{
    const bool right = counts.wrong == 0 && counts.share() <= most;
    std::printf("%-40s %12lld points, %6.2f %% integrated (at most %g %%), %lld wrong%s\n",
                planes.c_str(), static_cast<long long>(counts.points), 100 * counts.share(),
                100 * most, static_cast<long long>(counts.wrong), right ? "" : ": FAILED");
    std::fflush(stdout);
    return right;
}

bool check(std::int64_t points, std::uint64_t seed, const FillRule& rule)
{
    // The share falls with the side as the length of the boundaries over the area.
    const std::int64_t side = points > 100'000'000 ? 4096 : 512;
    const double most = 0.03 * 4096 / double(side);
    bool right = true;
    Counts hard;
    for (const HardTile& tile : hard_tiles()) {
        hard.add(compare(tile, rule));
    }
    right = report("tiles in which weaker rules fail", hard, 0.9) && right;
    Counts paper;
    for (std::size_t pulse = 0; pulse < 6 && points > 0; ++pulse) {
        for (const double restitution : {1.0, 0.7}) {
            paper.add(compare(paper_problem(PulseKind(pulse), restitution, side), rule));
        }
    }
    right = report("planes of the paper", paper, most) && right;
    RandomProblems random(seed);
    Counts kinds[2];
    while (paper.points + kinds[0].points + kinds[1].points < points) {
        for (const bool corner : {false, true}) {
            kinds[corner].add(compare(random.next(corner), rule));
        }
    }
    right = report("random planes, seed " + std::to_string(seed), kinds[0], 0.3) && right;
    right = report("low frequency and amplitude", kinds[1], 1) && right;
    std::printf(right ? "every filled point is right\n" : "FAILED\n");
    return right;
}

} // namespace
} // namespace overturn

int main(int argc, char** argv)
{
    if (argc < 2) {
        std::fprintf(stderr, "usage: fill_check POINTS [SEED [kappa|grazes]]\n");
        return 2;
    }
    const std::string mutant = argc > 3 ? argv[3] : "";
    overturn::FillRule rule;
    if (mutant == "kappa") {
        rule.kappa = 0.25;
    }
    rule.grazes = mutant != "grazes";
    const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
    return overturn::check(std::strtoll(argv[1], nullptr, 10), seed, rule) ? 0 : 1;
}
