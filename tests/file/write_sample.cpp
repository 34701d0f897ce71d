// write_sample OUT.h5 [TILES [kill]]: writes the sample spectrum on all ranks, or resumes an
// unfinished one. Each rank stops after TILES tiles; with `kill` it ends there by
// SIGKILL.
#include "file/sample_job.hpp"

#include "overturn/file/result_writer.hpp"
#include "overturn/text/error.hpp"

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <limits>

namespace overturn {
namespace {

/// A job with a list that is too long for an attribute.
Job job_with_long_text()
{
    Job job = sample_job();
    std::string list = "values = [0";
    for (int i = 1; i < 10000; ++i) {
        list += ", " + std::to_string(i);
    }
    job.given += list + "]\n";
    job.resolved += list + "]\n";
    return job;
}

struct Stop {
    std::int64_t after_tiles = std::numeric_limits<std::int64_t>::max();
    bool by_kill = false;
};

void write_sample(const std::string& path, Stop stop)
{
    int rank = 0;
    int ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    const Job job = job_with_long_text();
    const Tiling tiling = tiling_of(job.problem);
    if (rank == 0 && !existing_result(path, job)) {
        create_result(path, job);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    ResultWriter file(path, MPI_COMM_WORLD, job.problem);
    // All ranks read the list of missing tiles before the first of them writes.
    const std::vector<std::int64_t> missing = file.missing_tiles();
    MPI_Barrier(MPI_COMM_WORLD);
    std::int64_t written = 0;
    for (const std::int64_t number : missing) {
        if (number % ranks == rank && written < stop.after_tiles) {
            file.write(tiling[number], sample_values(job, tiling[number]));
            ++written;
        }
    }
    if (stop.by_kill) {
        std::raise(SIGKILL);
    }
    file.close();
}

} // namespace
} // namespace overturn

int main(int argc, char** argv)
{
    MPI_Init(&argc, &argv);
    overturn::Stop stop;
    if (argc > 2) {
        stop.after_tiles = std::atoll(argv[2]);
        stop.by_kill = argc > 3;
    }
    try {
        overturn::write_sample(argc > 1 ? argv[1] : "sample.h5", stop);
    } catch (const overturn::Error& error) {
        std::cerr << error.what() << std::endl;
        MPI_Abort(MPI_COMM_WORLD, 74);
    }
    MPI_Finalize();
    return 0;
}
