#include "commands.hpp"
#include "report/job.hpp"
#include "report/print.hpp"

#include "overturn/file/result_writer.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/text/quoting.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace overturn {

namespace {

constexpr double sampling_time = 0.3; // [s]

/// Points of a sample: neighbours along frequency, which fill the lanes of a kernel.
constexpr std::int64_t sample_length = 16;

/// The i-th index of an axis. Many i cover up to five axes evenly: the fractions are those of a
/// Kronecker sequence with powers of 1/g, where g^6 = g + 1.
std::int64_t spread_index(std::int64_t i, int axis, std::int64_t size)
{
    constexpr double g = 1.1347241384015194;
    double whole = 0;
    const double fraction = std::modf(0.5 + double(i) * std::pow(g, -(axis + 1)), &whole);
    return std::min(std::int64_t(fraction * double(size)), size - 1);
}

Tile sample_tile(const Grid& grid, std::int64_t i)
{
    const Shape shape = grid.shape();
    Tile tile{.begin = Shape(shape.size()), .count = Shape(shape.size(), 1)};
    if (!shape.empty()) {
        tile.count.back() = std::min(sample_length, shape.back());
    }
    for (std::size_t axis = 0; axis < shape.size(); ++axis) {
        tile.begin[axis] = spread_index(i, int(axis), shape[axis] - tile.count[axis] + 1);
    }
    return tile;
}

/// Estimated time [s] to compute this many points or tiles on one rank, from samples:
/// compute_sample(i) computes sample i and returns how many it contains.
template <class ComputeSample>
double estimated_seconds(std::int64_t items, const ComputeSample& compute_sample)
{
    using Clock = std::chrono::steady_clock;
    compute_sample(0); // untimed: the caches are cold

    std::int64_t computed = 0;
    double seconds = 0;
    const auto start = Clock::now();
    for (std::int64_t i = 0; computed < items && seconds < sampling_time; ++i) {
        computed += compute_sample(i);
        seconds = std::chrono::duration<double>(Clock::now() - start).count();
    }
    return seconds * (double(items) / double(computed));
}

double direct_seconds(const Problem& problem, Kernel kernel)
{
    Problem direct = problem;
    direct.product = Spectrum();
    std::erase(direct.fields, Field::evaluated);
    return estimated_seconds(direct.grid.points(), [&](std::int64_t i) {
        const Tile tile = sample_tile(direct.grid, i);
        compute_tile(direct, tile, kernel);
        return tile.points();
    });
}

/// The time to fill a spectrum, and the share of its points that are integrated.
struct FillEstimate {
    double seconds;
    double share;
};

FillEstimate fill_estimate(const Problem& problem, Kernel kernel)
{
    const Tiling tiling = tiling_of(problem);
    std::int64_t points = 0;
    std::int64_t integrated = 0;
    const double seconds = estimated_seconds(tiling.size(), [&](std::int64_t i) {
        const Tile tile = tiling[spread_index(i, 0, tiling.size())];
        const TileFields fields = compute_tile(problem, tile, kernel);
        const auto& evaluated = std::get<std::vector<std::uint8_t>>(fields.values.back());
        points += tile.points();
        integrated += std::count(evaluated.begin(), evaluated.end(), point_origin::integrated);
        return std::int64_t(1);
    });
    return {seconds, double(integrated) / double(points)};
}

void print_time(const Problem& problem, Kernel kernel)
{
    const double direct = direct_seconds(problem, kernel);
    const auto print = [&](double seconds) {
        print_row("time", fmt::format("about {} on one rank with kernel {}; n ranks on n cores "
                                      "need 1/n of it",
                                      human_duration(seconds), name_of(kernel)));
    };
    if (problem.product.audit()) {
        const FillEstimate fill = fill_estimate(problem, kernel);
        print(fill.seconds);
        print_row("fill", fmt::format("about {:.2g} % of the points are integrated; all of them "
                                      "would take {}",
                                      100 * fill.share, human_duration(direct)));
        return;
    }
    print(direct);
    if (reason_not_to_fill(problem).empty()) {
        Problem filled = problem;
        filled.product = FilledSpectrum();
        filled.fields.push_back(Field::evaluated);
        print_row("fill", fmt::format("about {} with numerics.fill = true",
                                      human_duration(fill_estimate(filled, kernel).seconds)));
    }
}

void print_size(const Job& job)
{
    const Problem& problem = job.problem;
    const Tiling tiling = tiling_of(problem);
    const auto points = double(problem.grid.points());
    print_row("points", fmt::format("{} in {} {}", human_count(points), tiling.size(),
                                    noun_of(tiling.size(), "tiles")));
    for (const Field field : problem.fields) {
        print_row("field", fmt::format("{}, {}", name_of(field),
                                       human_bytes(points * double(bytes_per_point(field)))));
    }
    print_row("file", human_bytes(double(result_bytes(job))));
}

} // namespace

int check(const JobSource& source)
{
    const Kernel kernel = widest_kernel(); // throws if this processor supports none
    const Job job = read_job(source.path, source.overrides);
    print_warnings(warnings_on(job));
    print_job(job);
    print_size(job);
    print_time(job.problem, kernel);
    return exit_code::complete;
}

} // namespace overturn
