// bench_sliding: the measuring program of `tools/bench sliding`. Boxes of 0.6 m x 1.8 m with one
// coefficient of friction, under a one-sine pulse of 0.5 s with a PGA of 0.3 to 2.5 g, by overturn
// as in the program or by the peer. Prints one JSON object.
#include "odeint_sliding.hpp"

#include "overturn/integrate/sliding_motion.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/given.hpp"
#include "overturn/sweep/compute_tile.hpp"

#include <fmt/core.h>

#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace overturn::benchmarks {

namespace {

constexpr double b = 0.3, h = 0.9, period = 0.5; // [m], [s]

struct End {
    SlidingVerdict verdict;
    double slide; ///< [m]
    bool slipped = true;
};

Problem problem_of(double friction, int points)
{
    const auto given = [](const char* name, const Axis& values, GivenAs as) {
        return Given{&quantity(name), name, values, as};
    };
    const auto number = [&](const char* name, double value) {
        return given(name, Axis(AxisList{value}), GivenAs::number);
    };
    Problem problem{.fields = {Field::region, Field::slide}};
    problem.grid =
        grid_of(problem.scene,
                {number("half_width", b), number("half_height", h), number("friction", friction),
                 number("restitution_of_maximum", 1), number("pulse_period", period),
                 given("pga", Axis(AxisRange{0.3, 2.5, points}), GivenAs::axis)});
    return problem;
}

SlidingVerdict verdict_of(Region region)
{
    return is_safe(region)     ? SlidingVerdict::stands
           : is_unsafe(region) ? SlidingVerdict::topples
                               : SlidingVerdict::undecided;
}

std::vector<End> solve_by_overturn(const Problem& problem)
{
    std::vector<End> ends;
    const Tiling tiling = tiling_of(problem);
    for (std::int64_t number = 0; number < tiling.size(); ++number) {
        const TileFields found = compute_tile(problem, tiling[number], widest_kernel());
        const auto& regions = std::get<std::vector<std::uint8_t>>(found.values[0]);
        const auto& slides = std::get<std::vector<double>>(found.values[1]);
        for (std::size_t i = 0; i < regions.size(); ++i) {
            ends.push_back({verdict_of(Region(regions[i])), slides[i] * std::hypot(b, h)});
        }
    }
    return ends;
}

std::vector<End> solve_by_odeint(const Problem& problem, double tolerance)
{
    std::vector<End> ends;
    const double friction = problem.grid.find("friction")->values.first();
    for (const double pga : problem.grid.find("pga")->values.values()) {
        const SlidingPeer peer({b, h, friction, problem.scene.gravity, pga, period}, tolerance);
        ends.push_back({peer.verdict(), peer.slide()});
    }
    return ends;
}

/// By overturn in long double, at the tolerance with which verdicts are confirmed.
std::vector<End> solve_reference(const Problem& problem)
{
    using S = long double;
    std::vector<End> ends;
    for (const Point& point : Coordinates(problem.scene, problem.grid).points()) {
        const Block<S> block = block_in<S>(point.block);
        const auto excitation = pulse_excitation<Theory::nonlinear>(
            pulse_motion<S>(PulseKind::one_sine), block, S(point.amplitude), S(point.frequency));
        const auto end = run_sliding<S>(block, S(point.gyration), S(point.friction), excitation,
                                        S(tolerances_to_confirm.back()));
        ends.push_back({verdict_of(end.region), double(end.slide) * std::hypot(b, h), end.slipped});
    }
    return ends;
}

/// One run to measure the errors, then as many as fit into `seconds` of processor time.
template <class SolveAll>
void measure(const std::vector<End>& truth, const SolveAll& solve, double seconds)
{
    const std::vector<End> ends = solve();
    std::vector<double> errors;
    int wrong = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        wrong += ends[i].verdict != truth[i].verdict;
        if (truth[i].verdict == SlidingVerdict::stands && truth[i].slipped) {
            const double error = std::abs(ends[i].slide - truth[i].slide);
            errors.push_back(ends[i].verdict == SlidingVerdict::stands && error >= 0
                                 ? error
                                 : std::numeric_limits<double>::max());
        }
    }
    std::ranges::sort(errors);
    int runs = 0;
    double elapsed = 0;
    const std::clock_t begin = std::clock();
    for (; elapsed < seconds; ++runs) {
        solve();
        elapsed = double(std::clock() - begin) / CLOCKS_PER_SEC;
    }
    fmt::print("{{\"points\": {}, \"compared\": {}, \"wrong_verdicts\": {}, \"p90\": {:.6e}, "
               "\"us_per_point\": {:.6g}}}\n",
               ends.size(), errors.size(), wrong, errors[errors.size() * 9 / 10],
               1e6 * elapsed / (std::max(runs, 1) * double(ends.size())));
}

} // namespace

} // namespace overturn::benchmarks

int main(int count, char** words)
{
    using namespace overturn::benchmarks;
    if (count != 6) {
        fmt::print(stderr,
                   "usage: bench_sliding overturn|odeint FRICTION POINTS TOLERANCE SECONDS\n");
        return 2;
    }
    overturn::keep_freed_memory(); // as in the program
    overturn::Problem problem = problem_of(std::atof(words[2]), std::atoi(words[3]));
    const double tolerance = std::atof(words[4]);
    problem.numerics.tolerance = tolerance;
    const bool is_ours = std::string_view(words[1]) == "overturn";
    const auto solve = [&] {
        return is_ours ? solve_by_overturn(problem) : solve_by_odeint(problem, tolerance);
    };
    measure(solve_reference(problem), solve, std::atof(words[5]));
    return 0;
}
