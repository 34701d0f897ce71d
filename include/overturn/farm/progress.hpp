// How far a run is: one line redrawn in place on a terminal, a log line now and then elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace overturn {

/// A moment of a run. What an earlier run did that is being resumed is `before`.
struct Moment {
    std::int64_t before = 0; ///< done before this run
    std::int64_t done = 0;   ///< with what was before
    std::int64_t all = 0;
    double seconds = 0; ///< since this run began [s]
    const char* items = "points";
};

/// "1.20 M of 3.00 M points, 40 %, 812 k points/s, 2 s left".
std::string progress_text(const Moment& moment);

class Progress {
public:
    /// Writes to the stream; `terminal` says whether a line there can be redrawn. items: what is
    /// counted, in the plural.
    Progress(std::int64_t before, std::int64_t all, std::FILE* stream, bool terminal,
             const char* items = "points");
    /// On standard error.
    Progress(std::int64_t before, std::int64_t all, const char* items);
    /// Ends the line.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Shows what is done, what was before included, if it is time to.
    void update(std::int64_t done);

private:
    void show(const Moment& moment);

    std::int64_t before_;
    std::int64_t all_;
    std::FILE* stream_;
    const char* items_;
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
    double next_; ///< when to show the next line [s since the start]
    bool line_is_open_ = false;
};

} // namespace overturn
