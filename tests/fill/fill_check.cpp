// fill_check POINTS [SEED [MUTANT]]: fills spectra without an audit, compares them with spectra of
// which every point is integrated, and prints every kind of spectrum with the share of integrated
// points. At least POINTS points are compared: tiles in which weaker rules fail and, if POINTS is
// not 0, the paper's spectra, random spectra, and random spectra where many low bounces precede a
// large motion, both of symmetric blocks and of blocks with two different sides. MUTANT: kappa (the
// rule of the nominal error) or grazes (impacts that could vanish are ignored). Exit code 1 if a
// point is wrong, or if more points than expected were integrated.
#include "overturn/mechanics/block.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/sweep/fill.hpp"
#include "support/given_values.hpp"
#include "support/two_sides.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace overturn {
namespace {

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

/// A spectrum of one block, filled without an audit.
Problem filled_spectrum(const Scene& scene, const Numerics& numerics, std::vector<Given> points,
                        bool with_impacts = false)
{
    Problem problem{.scene = scene,
                    .grid = grid_of(scene, std::move(points)),
                    .numerics = numerics,
                    .product = FilledSpectrum{{}, 0},
                    .fields = {Field::region, Field::evaluated}};
    if (with_impacts) {
        problem.fields.insert(problem.fields.begin(), Field::impacts);
    }
    return problem;
}

bool has_impacts(const Problem& problem)
{
    return problem.fields.front() == Field::impacts;
}

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
    const auto& [scene, grid, numerics, product, fields] = problem;
    const Axis& amplitude = grid.axis_or_number(Role::strength)->values;
    const Tile first{0, Shape(grid.dimensions.size(), 0), Shape(grid.dimensions.size(), 1)};
    const Point point = Coordinates(scene, grid, first).points().front();
    const Block<double>& block = point.block;
    std::printf(
        "  WRONG: %s %s %s %g%s, window %.17g, cycles %g, gamma %.17g, nu %.17g, alpha "
        "%.17g, r %.17g, R %.17g, p %.17g, other side: %.17g, %.17g, %.17g, rate %s, strength "
        "%s, direction %g, %lld points a side%s: row %lld, column %lld: filled %d, integrated %d\n",
        std::string(name_of(scene.pulse()->kind)).c_str(),
        std::string(name_of(scene.theory)).c_str(), std::string(name_of(numerics.method)).c_str(),
        numerics.tolerance, numerics.resolve ? " resolved" : "", scene.pulse()->shape.window,
        scene.pulse()->shape.cycles, scene.pulse()->shape.gamma, scene.pulse()->shape.nu,
        block.slenderness, block.restitution, block.size, block.frequency_parameter,
        block.other.slenderness, block.other.size, block.other.frequency_parameter,
        text_of(grid.axis_or_number(Role::rate)->values).c_str(), text_of(amplitude).c_str(),
        point.amplitude < 0 ? 180.0 : 0.0, static_cast<long long>(amplitude.size()),
        has_impacts(problem) ? ", with impacts" : "", static_cast<long long>(row),
        static_cast<long long>(column), filled, direct);
}

Counts compare(const Problem& problem, const Tile& tile, const FillRule& rule)
{
    const bool with_impacts = has_impacts(problem);
    const FilledTile filled = fill_tile(problem, tile, widest_kernel(), nullptr, rule);
    Problem every_point = problem;
    every_point.product = Spectrum();
    every_point.fields = {Field::region};
    if (with_impacts) {
        every_point.fields.push_back(Field::impacts);
    }
    const TileFields direct = compute_tile(every_point, tile, widest_kernel());
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
            name_point(problem, tile.begin[0] + std::int64_t(i) / tile.count[1],
                       tile.begin[1] + std::int64_t(i) % tile.count[1], filled.region[i],
                       region[i]);
        }
    }
    return counts;
}

Counts compare(const Problem& problem, const FillRule& rule)
{
    const Tiling tiling = tiling_of(problem);
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
    const Tiling tiling = tiling_of(hard.problem);
    for (std::int64_t n = 0; n < tiling.size(); ++n) {
        const Tile tile = tiling[n];
        if (hard.row < tile.begin[0] + tile.count[0] &&
            hard.column < tile.begin[1] + tile.count[1]) {
            return compare(hard.problem, tile, rule);
        }
    }
    return {};
}

std::vector<HardTile> hard_tiles()
{
    const Problem sine = filled_spectrum(
        {.motion = Pulse{PulseKind::sine, {.cycles = 2.5}}},
        {.method = Method::taylor, .tolerance = 1e-6},
        {number("slenderness", 0.26662054772862431), number("restitution", 0.8025885124983132),
         axis("amplitude", AxisRange{1.001, 1.4804846656126971, 868}),
         axis("frequency", AxisRange{0.05, 1.8128522632822612, 868})});
    const Problem cosine = filled_spectrum(
        {.motion = Pulse{PulseKind::cosine, {.cycles = 3}}}, {},
        {number("slenderness", 0.14424994278535325), number("restitution", 0.9776654199149466),
         axis("amplitude", AxisRange{1.001, 1.4381634078456134, 400}),
         axis("frequency", AxisRange{0.05, 1.5294371192114744, 400})},
        true);
    const Problem long_sine = filled_spectrum(
        {.motion = Pulse{PulseKind::sine, {.cycles = 2.5}}},
        {.method = Method::taylor, .tolerance = 1e-6},
        {number("slenderness", 0.074652571386679634), number("restitution", 0.98338163828903169),
         axis("amplitude", AxisRange{0.51442284163307428, 5.9931804499549077, 870, Spacing::log}),
         axis("frequency", AxisRange{0.48942030814698767, 7.2780824029224114, 870, Spacing::log})},
        true);
    return {{sine, 133, 616}, {cosine, 66, 316}, {long_sine, 258, 352}};
}

/// The spectra of the paper's figures: its block under a pulse, the restitution over the largest.
Problem paper_problem(PulseKind pulse, double restitution, std::int64_t side)
{
    return filled_spectrum(
        {.motion = Pulse{pulse}}, {},
        {number("slenderness", std::atan(1 / 5.67)), number("restitution_of_maximum", restitution),
         axis("amplitude", AxisRange{0.1, 16, side}), axis("frequency", AxisRange{0.1, 12, side})});
}

class RandomProblems {
public:
    explicit RandomProblems(std::uint64_t seed) : generator_(seed) {}

    /// corner: low frequencies and amplitudes just above 1.
    Problem next(bool corner, bool has_two_sides)
    {
        Scene scene;
        const auto kind = PulseKind(std::size_t(uniform() * double(pulses.size())));
        scene.theory = uniform() < 0.7 ? Theory::nonlinear : Theory::linear;
        scene.motion = Pulse{kind,
                             {.window = between(0.5, 2),
                              .cycles = std::round(uniform() * 5 + 1) / 2,
                              .gamma = between(1, 3),
                              .nu = between(-pi<double>(), pi<double>())}};
        Numerics numerics;
        numerics.method = uniform() < 0.5 ? Method::rk45 : Method::taylor;
        numerics.tolerance =
            numerics.method == Method::rk45 ? 1e-9 : (uniform() < 0.5 ? 1e-9 : 1e-6);
        numerics.resolve = uniform() < 0.1;
        const bool with_impacts = uniform() < 0.2;
        const Spacing spacing = uniform() < 0.3 ? Spacing::log : Spacing::linear;
        const auto side = std::int64_t(std::exp(between(std::log(256), std::log(1500))));
        const double last_amplitude = corner ? between(1.05, 1.5) : between(4, 20);
        const double first_amplitude = corner ? 1.001 : between(0.1, 1.2);
        const double last_frequency = corner ? between(0.5, 2) : between(4, 15);
        const double first_frequency = corner ? 0.05 : log_between(0.05, 2);
        const AxisRange amplitude{first_amplitude, last_amplitude, side, spacing};
        const AxisRange frequency{first_frequency, last_frequency, side, spacing};
        return filled_spectrum(scene, numerics,
                               has_two_sides ? two_sides(scene.theory, amplitude, frequency)
                                             : symmetric(amplitude, frequency),
                               with_impacts);
    }

private:
    double restitution_of(double largest)
    {
        return uniform() < 0.3 ? largest : between(0.5 * largest, 1);
    }

    Quantities symmetric(const AxisRange& amplitude, const AxisRange& frequency)
    {
        const double slenderness = between(0.05, 0.5);
        const double restitution = restitution_of(largest_restitution(slenderness));
        return {number("slenderness", slenderness), number("restitution", restitution),
                axis("amplitude", amplitude), axis("frequency", frequency)};
    }

    /// amplitude over the smaller uplift acceleration, frequency over the p of the side plus.
    Quantities two_sides(Theory theory, const AxisRange& amplitude, const AxisRange& frequency)
    {
        const Body body = random_body(generator_);
        const double restitution = restitution_of(body.largest_restitution());
        const Block<double> block = body.block(restitution);
        const double uplift =
            uplift_threshold(theory, std::min(block.slenderness, block.other.slenderness));
        const auto times = [](const AxisRange& range, double unit) {
            return AxisRange{range.first * unit, range.last * unit, range.count, range.spacing};
        };
        return {number("slenderness_plus", block.slenderness),
                number("slenderness_minus", block.other.slenderness),
                number("size_plus", block.size),
                number("size_minus", block.other.size),
                number("radius_of_gyration", body.gyration),
                number("restitution", restitution),
                number("direction", uniform() < 0.5 ? 0 : 180),
                axis("pga", times(amplitude, uplift)),
                axis("pulse_frequency",
                     times(frequency, block.frequency_parameter / (2 * pi<double>())))};
    }

    double uniform() { return std::uniform_real_distribution<double>(0, 1)(generator_); }
    double between(double low, double high) { return low + (high - low) * uniform(); }
    double log_between(double low, double high)
    {
        return std::exp(between(std::log(low), std::log(high)));
    }

    std::mt19937_64 generator_;
};

/// Prints the counts of one kind of spectra; they are right if no point is wrong and at most this
/// share was integrated.
bool report(const std::string& spectra, const Counts& counts, double most)
{
    const bool right = counts.wrong == 0 && counts.share() <= most;
    std::printf("%-48s %12lld points, %6.2f %% integrated (at most %g %%), %lld wrong%s\n",
                spectra.c_str(), static_cast<long long>(counts.points), 100 * counts.share(),
                100 * most, static_cast<long long>(counts.wrong), right ? "" : ": FAILED");
    std::fflush(stdout);
    return right;
}

bool check(std::int64_t points, std::uint64_t seed, const FillRule& rule)
{
    // The share falls with the side as the length of the boundaries over the area.
    const std::int64_t side = points > 100'000'000 ? 4096 : 256;
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
    right = report("spectra of the paper", paper, most) && right;
    RandomProblems random(seed);
    struct Kind {
        std::string name;
        bool corner, has_two_sides;
        double most;
        Counts counts{};
    };
    std::vector<Kind> kinds{{"random spectra", false, false, 0.3},
                            {"low frequency and amplitude", true, false, 1},
                            {"two sides: random spectra", false, true, 0.3},
                            {"two sides: low frequency and amplitude", true, true, 1}};
    std::int64_t compared = paper.points;
    while (compared < points) {
        for (Kind& kind : kinds) {
            const Counts counts = compare(random.next(kind.corner, kind.has_two_sides), rule);
            kind.counts.add(counts);
            compared += counts.points;
        }
    }
    for (const Kind& kind : kinds) {
        right =
            report(kind.name + ", seed " + std::to_string(seed), kind.counts, kind.most) && right;
    }
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
