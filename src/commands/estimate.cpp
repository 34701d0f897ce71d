#include "estimate.hpp"

#include "overturn/file/result_writer.hpp"
#include "overturn/problem/tile_order.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/text/mapped.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <sys/resource.h>
#include <variant>

namespace overturn {

namespace {

/// The time of a processor that this program has used [s]: unlike that of a clock, it does not grow
/// if other programs share the processor, as on a login node.
double processor_seconds()
{
    return double(std::clock()) / CLOCKS_PER_SEC;
}

constexpr double least_sampling = 0.3; // [s]
constexpr double most_sampling = 3;    // [s]
constexpr double wanted_error = 0.05;  // standard error of the mean over the mean

/// Mean and variance of times, by the recurrence of Welford.
struct Times {
    std::int64_t count = 0;
    double mean = 0;
    double squares = 0; ///< the sum of squared differences from the mean

    void add(double seconds)
    {
        ++count;
        const double difference = seconds - mean;
        mean += difference / double(count);
        squares += difference * (seconds - mean);
    }
    double deviation() const { return count > 1 ? std::sqrt(squares / double(count - 1)) : 0; }
    /// Of the mean of `all` values of which these are known.
    double standard_error(std::int64_t all) const
    {
        const double unknown = 1 - double(count) / double(all);
        return deviation() * std::sqrt(unknown / double(count));
    }
};

} // namespace

std::vector<FieldSize> field_sizes(const Problem& problem)
{
    const auto all = double(count_points(stored_shape(problem)));
    const auto lines = double(items_of(problem).count); // of a boundary
    return mapped(problem.fields, [&](Field field) {
        const bool is_of_line = traits_of(field).of == FieldOf::line;
        return FieldSize{field, bytes_per_point(field), is_of_line ? lines : all};
    });
}

TileSample sample_of(const Problem& problem, Kernel kernel)
{
    const Tiling tiling = tiling_of(problem);
    const TileOrder order(tiling.size());
    Times times;
    std::int64_t points = 0;
    std::int64_t integrated = 0;
    const auto compute = [&](std::int64_t place) {
        const Tile tile = tiling[order.tile(place)];
        const double start = processor_seconds();
        const TileFields fields = compute_tile(problem, tile, kernel);
        const double seconds = processor_seconds() - start;
        if (problem.product.audit()) {
            const auto& evaluated = std::get<std::vector<std::uint8_t>>(fields.values.back());
            points += tile.points();
            integrated += std::ranges::count(evaluated, point_origin::integrated);
        }
        return seconds;
    };
    const double start = processor_seconds();
    const auto is_known = [&] {
        const double seconds = processor_seconds() - start;
        return seconds > most_sampling ||
               (seconds > least_sampling &&
                times.standard_error(tiling.size()) < wanted_error * times.mean);
    };
    compute(0); // untimed: the caches are cold
    for (std::int64_t place = 0; place < tiling.size() && !is_known(); ++place) {
        times.add(compute(place));
    }
    return {.tiles = times.count,
            .mean = times.mean,
            .spread = times.deviation() / times.mean,
            .integrated_share =
                points > 0 ? std::optional(double(integrated) / double(points)) : std::nullopt};
}

namespace {

/// Measured with Open MPI 4.1 on one host, from the start of the command to its end [s].
constexpr double seconds_alone = 0.03;
constexpr double seconds_under_mpirun = 0.2;

constexpr double answer_seconds = 2e-6; // 0.5 to 1.7 us were measured on one host
constexpr double take_seconds = 1e-7;
constexpr int assumed_ranks_of_host = 128;

/// The time to write a tile [s]: for each field and the checksum a call, and a copy in memory.
double write_seconds(const Problem& problem)
{
    constexpr double call = 5e-6;
    constexpr double bytes_per_second = 5e9;
    double bytes = 0;
    for (const Field field : problem.fields) {
        bytes += double(bytes_per_point(field));
    }
    return call * double(problem.fields.size() + 1) +
           bytes * double(tiling_of(problem).points_of_tile()) / bytes_per_second;
}

/// The largest amount of memory that this process has had [bytes]. It has read the job and computed
/// tiles, as each rank does.
double own_memory()
{
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return 1024 * double(usage.ru_maxrss);
}

/// What a rank needs beyond that [bytes], measured with Open MPI 4.1 and HDF5 1.10 on 1 to 64 ranks
/// of one host, and 1 to 10^6 tiles of one and two fields.
double memory_of_libraries(const Problem& problem, int ranks, std::int64_t tiles)
{
    constexpr double mpi = 12e6;
    constexpr double per_rank_of_host = 9e4;
    constexpr double per_chunk = 265;
    constexpr double most_of_chunks = 18e6; // the size of the cache of HDF5, see file_access()
    const double chunks = double(tiles) * double(problem.fields.size());
    return mpi + per_rank_of_host * std::min(ranks, assumed_ranks_of_host) +
           std::min(per_chunk * chunks, most_of_chunks);
}

/// What rank 0 needs in addition [bytes]: two lists of missing tiles, of which one may have twice
/// the capacity, and the checksums; the hosts, and what is known of each rank.
double memory_of_lists(int ranks, std::int64_t tiles)
{
    return 32 * double(tiles) + 512 * double(ranks);
}

} // namespace

RunEstimate estimate_run(const Job& job, Kernel kernel, int ranks, double reading_seconds,
                         const std::string& folder, const DiskSpace& space)
{
    const auto bytes = double(result_bytes(job));
    // Other programs must not find the disk full.
    const double most_written = std::min({bytes, 1e8, space.available().value_or(0) / 16});
    const std::int64_t tiles = tiling_of(job.problem).size();
    RunEstimate estimate{};
    estimate.kernel = kernel;
    estimate.ranks = ranks;
    estimate.tiles = tiles;
    estimate.sample = sample_of(job.problem, kernel);
    estimate.memory = own_memory() + memory_of_libraries(job.problem, ranks, tiles);
    estimate.memory_of_rank_0 = estimate.memory + memory_of_lists(ranks, tiles);
    estimate.start_seconds = reading_seconds + (ranks == 1 ? seconds_alone : seconds_under_mpirun);
    estimate.creation_speed = speed_of_creation_in(folder, most_written);
    estimate.creation_seconds = estimate.creation_speed ? bytes / *estimate.creation_speed : 0;
    const FarmCosts costs{.answer = answer_seconds,
                          .take = take_seconds,
                          .tile = estimate.sample.mean + write_seconds(job.problem),
                          .spread = estimate.sample.spread};
    estimate.farm = simulate_farm(costs, ranks, assumed_ranks_of_host, tiles);
    // The sum of the simulated times deviates from that of the tiles: by 10 % if these differ much.
    estimate.farm.seconds = costs.tile * double(tiles) / (ranks * estimate.farm.efficiency);
    return estimate;
}

} // namespace overturn
