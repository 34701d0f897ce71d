// The progress of a run: on a terminal one line redrawn in place, elsewhere a log line at
// intervals.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>
#include <unistd.h>

namespace overturn {

/// A moment of a run, which may resume an earlier one.
struct Moment {
    std::int64_t before = 0; ///< done by earlier runs
    std::int64_t done = 0;   ///< by all runs
    std::int64_t all = 0;
    double seconds = 0; ///< since this run began [s]
    const char* items = "points";
};

/// "1.20 M of 3.00 M points, 40 %, 812 k points/s, 2 s left".
std::string progress_text(const Moment& moment);

class Progress {
public:
    /// items: what is counted, in the plural. terminal: whether a line of the stream can be
    /// redrawn.
    Progress(std::int64_t before, std::int64_t all, const char* items, std::FILE* stream = stderr,
             bool terminal = isatty(STDERR_FILENO) == 1);
    /// Ends a line that was redrawn.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Shows what all runs have done, if the interval since the last line has passed.
    void update(std::int64_t done);

private:
    Moment moment_; ///< of the last update
    std::FILE* stream_;
    bool terminal_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double next_; ///< when to show the next line [s since the start]
    bool line_is_open_ = false;
};

} // namespace overturn
