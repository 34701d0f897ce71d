// bench_peers: the measuring program of `tools/bench peers`. Each call performs one command and
// prints one JSON object. The caller controls the order of calls, searches for the tolerances and
// prints the table.
#include "measured.hpp"
#include "operation_count.hpp"

#include "overturn/sweep/compute_tile.hpp"

#include <boost/version.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gsl/gsl_version.h>
#include <sundials/sundials_config.h>

#include <charconv>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string_view>

namespace overturn::benchmarks {

namespace {

constexpr std::string_view usage =
    "usage: bench_peers about GROUND\n"
    "       bench_peers fma-peak\n"
    "       bench_peers reference GROUND POINTS TOLERANCE CHECK_TOLERANCE FILE\n"
    "       bench_peers measure GROUND POINTS FILE SOLVER TOLERANCE SECONDS\n"
    "       bench_peers operations POINTS METHOD TOLERANCE\n"
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

int about(const std::string& ground)
{
    const Kernel kernel = widest_kernel();
    const int lanes = kernel == Kernel::avx512 ? 8 : kernel == Kernel::avx2 ? 4 : 1;
    const bool recorded = ground != pulse_name;
    std::string solvers;
    for (const Solver& solver : all_solvers(recorded)) {
        solvers += fmt::format("{}\"{}\"", solvers.empty() ? "" : ", ", solver.name);
    }
    std::string samples; // [g]
    if (recorded) {
        const PeerProblem problem = record_problem(ground, 2);
        samples =
            fmt::format("{:.17g}", fmt::join(problem.scene.records.front()->horizontal(), ", "));
    }
    fmt::print("{{\"samples\": [{}], \"solvers\": [{}], \"kernel\": \"{}\", \"lanes\": {}, "
               "\"compiler\": \"{}\", "
               "\"boost\": \"{}.{}.{}\", \"gsl\": \"{}\", \"sundials\": \"{}\"}}\n",
               samples, solvers, name_of(kernel), lanes, OVERTURN_BENCHMARK_COMPILER,
               BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100, GSL_VERSION,
               SUNDIALS_VERSION);
    return 0;
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
                            point.slenderness, point.restitution, point.amplitude, point.frequency,
                            ends[i].angle, ends[i].velocity, int(ends[i].region),
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
    const bool recorded = problem.scene.is_recorded();
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
    for (const Solver& solver : all_solvers(problem.scene.is_recorded())) {
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

/// The operations per point of one of overturn's methods.
int operations(int points, std::string_view method, double tolerance)
{
    for (std::size_t i = 0; i < method_names.size(); ++i) {
        if (method_names[i] != method) {
            continue;
        }
        const PeerProblem problem = paper_block_problem(points);
        const OperationCount count =
            count_operations(problem, {.method = Method(i), .tolerance = tolerance});
        const auto per_point = [&](std::int64_t number) {
            return double(number) / double(problem.points.size());
        };
        fmt::print("{{\"fused\": {:.1f}, \"plain\": {:.1f}, \"divided\": {:.1f}, "
                   "\"ends_that_differ\": {}}}\n",
                   per_point(count.operations.fused), per_point(count.operations.plain),
                   per_point(count.operations.divided), count.ends_that_differ);
        return 0;
    }
    throw UsageError(fmt::format("there is no method \"{}\"", method));
}

int run(const std::vector<std::string>& words)
{
    const std::string command = words.empty() ? "" : words[0];
    if (command == "about" && words.size() == 2) {
        return about(words[1]);
    }
    if (command == "fma-peak" && words.size() == 1) {
        fmt::print("{{\"fma_peak_per_second\": {:.6e}}}\n", fma_peak_per_second());
        return 0;
    }
    if (command == "reference" && words.size() == 6) {
        return reference(problem_of(words[1], number_from<int>(words[2])),
                         number_from<double>(words[3]), number_from<double>(words[4]), words[5]);
    }
    if (command == "measure" && words.size() == 7) {
        return measure(problem_of(words[1], number_from<int>(words[2])), words[3], words[4],
                       number_from<double>(words[5]), number_from<double>(words[6]));
    }
    if (command == "operations" && words.size() == 4) {
        return operations(number_from<int>(words[1]), words[2], number_from<double>(words[3]));
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
