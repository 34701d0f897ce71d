// bench_peers: the measuring program of `tools/bench peers`. Each call performs one command and
// prints one JSON object. The caller controls the order of calls, searches for the tolerances and
// prints the table.
#include "peer.hpp"

#include "overturn/sweep/compute_tile.hpp"

#include <boost/version.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gsl/gsl_version.h>
#include <sundials/sundials_config.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace overturn::benchmarks {

namespace {

constexpr std::string_view usage =
    "usage: bench_peers about GROUND\n"
    "       bench_peers reference GROUND POINTS TOLERANCE CHECK_TOLERANCE FILE\n"
    "       bench_peers measure GROUND POINTS FILE SOLVER TOLERANCE SECONDS\n"
    "GROUND: pulse, or the path of a record\n";

constexpr std::string_view pulse_name = "pulse";

/// Under a record, solvers are compared only at points whose error is small at a tight tolerance.
/// In its units, the margin of a safe block is at most 1.
constexpr Numerics judging{.method = Method::taylor, .tolerance = 1e-12};
constexpr double largest_error_compared = 1e-6;

struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <class Number>
Number number_from(std::string_view text)
{
    Number number{};
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || rest != text.data() + text.size() || !(number >= 0)) {
        throw UsageError(fmt::format("\"{}\" is not a number >= 0", text));
    }
    return number;
}

PeerProblem problem_of(const std::string& ground, int points)
{
    return ground == pulse_name ? paper_block_problem(points) : record_problem(ground, points);
}

/// Overturn's methods for pulses or for records first, then the peers.
std::vector<Solver> all_solvers(bool recorded)
{
    std::vector<Solver> solvers = overturn_solvers(recorded);
    solvers.push_back({"odeint_dopri5", solve_by_odeint_dopri5});
    solvers.push_back(
        {"odeint_dopri5_restepping", solve_by_odeint_dopri5_restepping<Sines::library>});
    solvers.push_back(
        {"odeint_dopri5_restepping_our_sines", solve_by_odeint_dopri5_restepping<Sines::overturn>});
    solvers.push_back({"gsl_rk8pd", solve_by_gsl_rk8pd<Sines::library>});
    solvers.push_back({"gsl_rk8pd_our_sines", solve_by_gsl_rk8pd<Sines::overturn>});
    solvers.push_back({"arkode_dopri5", solve_by_arkode});
    if (!recorded) { // a multistep method is a hundred times slower with a kink at every sample
        solvers.push_back({"cvode_adams", solve_by_cvode_adams});
    }
    return solvers;
}

int about(const std::string& ground)
{
    const bool recorded = ground != pulse_name;
    std::string solvers;
    for (const Solver& solver : all_solvers(recorded)) {
        solvers += fmt::format("{}\"{}\"", solvers.empty() ? "" : ", ", solver.name);
    }
    std::string samples; // [g]
    if (recorded) {
        const PeerProblem problem = record_problem(ground, 2);
        samples =
            fmt::format("{:.17g}", fmt::join(problem.scene.records().front()->horizontal(), ", "));
    }
    fmt::print("{{\"samples\": [{}], \"solvers\": [{}], \"kernel\": \"{}\", \"compiler\": \"{}\", "
               "\"boost\": \"{}.{}.{}\", \"gsl\": \"{}\", \"sundials\": \"{}\"}}\n",
               samples, solvers, name_of(widest_kernel()), OVERTURN_BENCHMARK_COMPILER,
               BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100, GSL_VERSION,
               SUNDIALS_VERSION);
    return 0;
}

/// The end of a point in the reference.
struct ReferenceEnd : PeerEnd<long double> {
    /// Whether solvers are compared at this point: not if its error grows so much that the verdict
    /// is almost a matter of chance.
    bool compared;
};

struct Errors {
    double p99;               ///< of the points compared that are safe in the reference
    double largest;           ///< of the points compared that are safe in the reference
    int safe_points;          ///< number of points compared that are safe in the reference
    int verdicts_that_differ; ///< of all points compared: safe, unsafe or undecided
};

/// The error of a point is max(|d theta|, |d theta'|) at the end of the ground motion over `unit`
/// [rad]; p99 is the smallest error that 99 of 100 points do not exceed. A point at which the
/// solver failed has an infinite error.
template <class S>
Errors errors_of(const std::vector<PeerEnd<S>>& ends, const std::vector<ReferenceEnd>& reference,
                 double unit)
{
    std::vector<double> errors;
    int differ = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const ReferenceEnd& truth = reference[i];
        if (!truth.compared) {
            continue;
        }
        differ += is_safe(ends[i].region) != is_safe(truth.region) ||
                  is_unsafe(ends[i].region) != is_unsafe(truth.region);
        if (is_safe(truth.region)) {
            const double error = double(std::max(std::abs(ends[i].angle - truth.angle),
                                                 std::abs(ends[i].velocity - truth.velocity))) /
                                 unit;
            errors.push_back(error >= 0 ? error : std::numeric_limits<double>::infinity());
        }
    }
    std::sort(errors.begin(), errors.end());
    const double none = std::numeric_limits<double>::quiet_NaN();
    const std::size_t within = errors.empty() ? 0 : (errors.size() * 99 + 99) / 100 - 1;
    return {errors.empty() ? none : errors[within], errors.empty() ? none : errors.back(),
            int(errors.size()), differ};
}

using Ends = std::vector<ReferenceEnd>;

/// Writes one line per point, in the order of the problem, for later measurements.
void write_reference(const std::string& path, const PeerProblem& problem, const Ends& ends)
{
    std::ofstream file(path);
    file << "slenderness restitution amplitude frequency angle velocity region compared\n";
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const Point& point = problem.points[i];
        file << fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.21Lg} {:.21Lg} {} {}\n",
                            point.block.slenderness, point.block.restitution, point.amplitude,
                            point.frequency, ends[i].angle, ends[i].velocity, int(ends[i].region),
                            int(ends[i].compared));
    }
    if (!file.flush()) {
        throw std::runtime_error("cannot write " + path);
    }
}

Ends read_reference(const std::string& path, std::size_t points)
{
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    Ends ends;
    long double skipped = 0;
    int region = 0;
    ReferenceEnd end{};
    while (file >> skipped >> skipped >> skipped >> skipped >> end.angle >> end.velocity >>
           region >> end.compared) {
        end.region = Region(region);
        ends.push_back(end);
    }
    if (ends.size() != points) {
        throw std::runtime_error(
            fmt::format("{} contains {} points instead of {}", path, ends.size(), points));
    }
    return ends;
}

int reference(const PeerProblem& problem, double tolerance, double check_tolerance,
              const std::string& path)
{
    const bool recorded = problem.scene.is_under(Under::record);
    const std::vector<PointEffort> efforts = efforts_of_overturn(problem, judging);
    Ends ends;
    double steps = 0;
    std::int64_t compared = 0;
    for (const PeerEnd<long double>& end : solve_reference(problem, tolerance)) {
        const PointEffort& effort = efforts[ends.size()];
        ends.push_back({end, !recorded || effort.error < largest_error_compared});
        steps += effort.steps;
        compared += ends.back().compared;
    }
    const Errors check =
        errors_of(solve_reference(problem, check_tolerance), ends, problem.error_unit);
    write_reference(path, problem, ends);
    fmt::print(
        "{{\"points\": {}, \"compared_points\": {}, \"safe_points\": {}, "
        "\"p99_difference\": {:.3e}, \"largest_difference\": {:.3e}, "
        "\"verdicts_that_differ\": {}, \"error_unit\": {}, \"steps_of_overturn\": {:.1f}}}\n",
        ends.size(), compared, check.safe_points, check.p99, check.largest,
        check.verdicts_that_differ, problem.error_unit, steps / double(ends.size()));
    return 0;
}

/// Error and time of one solver: one run to measure the error and to warm up, then as many runs as
/// fit into `seconds`. Measures processor time, which depends less on other programs.
int measure(const PeerProblem& problem, const std::string& path, std::string_view name,
            double tolerance, double seconds)
{
    const Ends truth = read_reference(path, problem.points.size());
    for (const Solver& solver : all_solvers(problem.scene.is_under(Under::record))) {
        if (solver.name != name) {
            continue;
        }
        const Errors errors =
            errors_of(solver.solve(problem, tolerance), truth, problem.error_unit);
        int runs = 0;
        double elapsed = 0;
        const std::clock_t begin = std::clock();
        while (elapsed < seconds) {
            solver.solve(problem, tolerance);
            elapsed = double(std::clock() - begin) / CLOCKS_PER_SEC;
            ++runs;
        }
        const double per_point =
            runs > 0 ? 1e6 * elapsed / (double(runs) * double(problem.points.size())) : 0;
        fmt::print("{{\"p99\": {}, \"largest\": {}, \"verdicts_that_differ\": {}, "
                   "\"us_per_point\": {:.6g}}}\n",
                   std::isfinite(errors.p99) ? fmt::format("{:.6e}", errors.p99) : "null",
                   std::isfinite(errors.largest) ? fmt::format("{:.6e}", errors.largest) : "null",
                   errors.verdicts_that_differ, per_point);
        return 0;
    }
    throw UsageError(fmt::format("there is no solver \"{}\"; `about` lists them", name));
}

int run(const std::vector<std::string>& words)
{
    const std::string command = words.empty() ? "" : words[0];
    if (command == "about" && words.size() == 2) {
        return about(words[1]);
    }
    if (command == "reference" && words.size() == 6) {
        return reference(problem_of(words[1], number_from<int>(words[2])),
                         number_from<double>(words[3]), number_from<double>(words[4]), words[5]);
    }
    if (command == "measure" && words.size() == 7) {
        return measure(problem_of(words[1], number_from<int>(words[2])), words[3], words[4],
                       number_from<double>(words[5]), number_from<double>(words[6]));
    }
    throw UsageError("invalid arguments");
}

} // namespace

} // namespace overturn::benchmarks

int main(int count, char** words)
{
    using namespace overturn::benchmarks;
    overturn::keep_freed_memory(); // as in the program
    try {
        return run({words + 1, words + count});
    } catch (const UsageError& error) {
        std::cerr << "bench_peers: " << error.what() << "\n" << usage;
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "bench_peers: " << error.what() << "\n";
        return 70;
    }
}
