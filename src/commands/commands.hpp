// The subcommands, one file each. They return an exit code, and throw what is wrong.
#pragma once

#include <string>
#include <vector>

namespace overturn {

/// A job file, and the --set arguments laid over it.
struct JobSource {
    std::string path;
    std::vector<std::string> overrides;
};

/// Computes a spectrum or a boundary under MPI, or goes on with one. All ranks call it.
struct RunOptions {
    JobSource job;
    std::string output; ///< path of the result file; empty: the job's name in the working directory
    std::string kernel = "auto";
    bool durable = false;  ///< tiles outlast a loss of power
    int patience = 300;    ///< timeout of a rank that does not respond [s]
    bool boundary = false; ///< where verdicts flip, instead of a spectrum
};
int run(const RunOptions& options);

/// Tells what a job would compute, store and cost. Writes nothing.
int check(const JobSource& source);

/// Measures what accuracy costs in time on a sample of a job's plane, on one core.
struct AccuracyOptions {
    JobSource job;
    std::string output; ///< path of the result file
    int points = 16384; ///< of the sample, at most
    int digits = 512;   ///< of them in 50 digits
};
int accuracy(const AccuracyOptions& options);

/// Follows one point of a job: the forced stage, then the free stage.
struct HistoryOptions {
    JobSource job;
    std::vector<std::string> at; ///< axis=value, each
    std::string output;          ///< path of the result file
    double until = 0;            ///< last time shown [1/p]; 0: until the block rests or lies
    int samples = 2000;
};
int history(const HistoryOptions& options);

/// Tells what a result file holds.
int info(const std::string& path);

/// Reads all values of a result file, and tells which tiles are not as they were written.
int verify(const std::string& path);

} // namespace overturn
