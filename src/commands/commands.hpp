// The subcommands, one file each. They return an exit code, and throw an exception on error.
#pragma once

#include "overturn/answers/assess.hpp"
#include "overturn/answers/topple.hpp"
#include "overturn/problem/job_part.hpp"

#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// A job file, and the --set arguments that override its keys.
struct JobSource {
    std::string path;
    std::vector<std::string> overrides;
};

/// Computes or resumes a spectrum or a boundary. Collective.
struct RunOptions {
    JobSource job;
    std::string output; ///< path of the result file; empty: named after the job, working directory
    std::string kernel = "auto";
    bool durable = false;  ///< tiles survive a power failure
    int patience = 300;    ///< timeout of a silent rank [s]
    bool boundary = false; ///< a boundary instead of a spectrum
    std::optional<JobPart> part;
};
int run(const RunOptions& options);

/// Joins the files of all parts of a job to that of one run.
struct MergeOptions {
    std::vector<std::string> parts; ///< paths
    std::string output;             ///< path of the result file
};
int merge(const MergeOptions& options);

/// Prints what a job would compute and store, and what its run would take. Writes nothing.
struct CheckOptions {
    RunOptions run;
    int ranks = 1;
    bool json = false;
};
int check(const CheckOptions& options);

/// Measures error and computing time on a sample of a job's plane, on one core.
struct AccuracyOptions {
    JobSource job;
    std::string output; ///< path of the result file
    int points = 16384; ///< maximum number of sample points
    int digits = 512;   ///< approximate number computed in 50 digits
};
int accuracy(const AccuracyOptions& options);

/// Computes the motion of one block: the forced stage, then the free stage.
struct HistoryOptions {
    JobSource job;
    std::vector<std::string> at; ///< each is axis=value
    std::string output;          ///< path of the result file
    double until = 0;            ///< last time [1/p]; 0: until the block comes to rest or overturns
    int samples = 2000;
};
int history(const HistoryOptions& options);

/// Answers whether one block topples under one motion, and at which peak accelerations.
struct ToppleOptions : ToppleRequest {
    bool json = false;
    std::string history; ///< path of a file of the motion; empty: none
};
int topple(const ToppleOptions& options);

/// Answers for a list of objects which of them topple, and at which strengths.
struct AssessOptions : AssessRequest {
    bool json = false;
    std::string csv; ///< path of a table; empty: none
};
int assess(const AssessOptions& options);

/// Prints what a bug report should contain: program, libraries, processor, Python, and the file
/// system of the folder, that of the result files.
int doctor(const std::string& folder);

/// Prints the keys of job files: those of a table, or of this name, or all.
struct KeysOptions {
    std::string name;
    bool as_markdown = false; ///< rows of a table
};
int keys(const KeysOptions& options);

/// Prints a summary of a result file, its progress if a run writes it, and how to resume it if it
/// is unfinished.
struct InfoOptions {
    std::string path;
    bool json = false;
};
int info(const InfoOptions& options);

/// Checks the coordinates and all tiles of a result file, and reports what is damaged.
int verify(const std::string& path);

} // namespace overturn
