// The progress of a run: on a terminal one line, redrawn in place; otherwise a log line at
// intervals.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <unistd.h>

namespace overturn {

/// The state of a run, which may have resumed an earlier one.
struct ProgressState {
    std::int64_t before = 0; ///< done by earlier runs
    std::int64_t done = 0;   ///< by all runs
    std::int64_t all = 0;
    double seconds = 0; ///< since the start of this run [s]
    const char* items = "points";

    /// Items per second of this run; nullopt before the first one.
    std::optional<double> rate() const;

    /// If the rest is computed at this rate [s]; nullopt if there is none.
    std::optional<double> seconds_left() const;
};

/// "1.20 M of 3.00 M points, 40 %, 812 k points/s, 2 s left".
std::string progress_text(const ProgressState& state);

class Progress {
public:
    /// items: the plural noun for what is counted. before: done by earlier runs. terminal: whether
    /// lines of the stream can be redrawn.
    explicit Progress(const char* items, std::int64_t before = 0, std::FILE* stream = stderr,
                      bool terminal = isatty(STDERR_FILENO) == 1);
    /// Terminates a redrawn line.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Prints the progress of all runs, if the interval since the last line has passed.
    void update(std::int64_t done, std::int64_t all);

    const ProgressState& state() const { return state_; }

private:
    ProgressState state_; ///< of the last update
    std::FILE* stream_;
    bool terminal_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double next_; ///< time of the next line [s since the start]
    bool line_is_open_ = false;
};

} // namespace overturn
