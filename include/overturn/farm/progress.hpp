// How far a run is: one line redrawn in place on a terminal, a log line now and then elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace overturn {

/// A moment of a run. Points of an earlier run that is being resumed are `before`.
struct Moment {
    std::int64_t before = 0; ///< points done before this run
    std::int64_t done = 0;   ///< points done, those before included
    std::int64_t all = 0;    ///< points of the plane
    double seconds = 0;      ///< since this run began [s]
};

/// "1.20 M of 3.00 M points, 40 %, 812 k points/s, 2 s left".
std::string progress_text(const Moment& moment);

class Progress {
public:
    /// Writes to the stream; `terminal` says whether a line there can be redrawn.
    Progress(std::int64_t points_before, std::int64_t points_in_all, std::FILE* stream,
             bool terminal);
    /// On standard error.
    Progress(std::int64_t points_before, std::int64_t points_in_all);
    /// Ends the line.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Shows the points done, those before included, if it is time to.
    void update(std::int64_t points_done);

private:
    void show(const Moment& moment);

    std::int64_t before_;
    std::int64_t all_;
    std::FILE* stream_;
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
    double next_; ///< when to show the next line [s since the start]
    bool line_is_open_ = false;
};

} // namespace overturn
