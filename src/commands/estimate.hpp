// The estimated cost of a run, from a sample of its tiles.
#pragma once

#include "overturn/farm/simulated_farm.hpp"
#include "overturn/file/disk_space.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/kernel.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// The values of a field in the result file.
struct FieldSize {
    Field field;
    std::size_t bytes_per_value;
    double values;

    double bytes() const { return double(bytes_per_value) * values; }
};
std::vector<FieldSize> field_sizes(const Problem& problem);

/// The times of some tiles, which are spread over the result.
struct TileSample {
    std::int64_t tiles = 0;
    double mean = 0;                        ///< time to compute a tile [s]
    double spread = 0;                      ///< standard deviation of the times over their mean [1]
    std::optional<double> integrated_share; ///< of the points of a filled spectrum [1]
};

/// Computes tiles in the order of a run: all, or until their mean is known to a few percent, or for
/// a few seconds.
TileSample sample_of(const Problem& problem, Kernel kernel);

/// What a run takes, from the start of the program to its end.
struct RunEstimate {
    Kernel kernel;
    int ranks;
    std::int64_t tiles;
    TileSample sample;
    double start_seconds;                 ///< of the program and of MPI; to read the job
    std::optional<double> creation_speed; ///< of the file [bytes/s]
    double creation_seconds;              ///< of the file; 0 if its speed is unknown
    SimulatedFarm farm;                   ///< from the first to the last tile
    double memory;                        ///< of a rank other than 0 [bytes]
    double memory_of_rank_0;              ///< [bytes]

    double seconds() const { return start_seconds + creation_seconds + farm.seconds; }
    double core_hours() const { return ranks * seconds() / 3600; }

    /// The share of the core-hours in which tiles are computed and written [1].
    double tile_share() const { return farm.efficiency * farm.seconds / seconds(); }
};

/// reading_seconds: that it took to read the job. folder: of the file, in which nothing is left; it
/// has this space.
RunEstimate estimate_run(const Job& job, Kernel kernel, int ranks, double reading_seconds,
                         const std::string& folder, const DiskSpace& space);

} // namespace overturn
