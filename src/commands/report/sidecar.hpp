// The sidecar of a result file, OUT.h5.json: what differs from run to run, and the progress while a
// run lasts, for programs that watch it.
#pragma once

#include "progress.hpp"

#include "overturn/farm/farm.hpp"
#include "overturn/file/stored_result.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/text/names.hpp"

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace overturn {

enum class RunState { running, stopped, finished, unknown };

template <>
inline constexpr std::array<std::string_view, 4> names_of<RunState>{"running", "stopped",
                                                                    "finished", "unknown"};

/// The sidecar of a run. On rank 0.
class Sidecar {
public:
    /// path: of the result file. hosts: of the ranks. start: of the program.
    Sidecar(std::string path, std::vector<std::string> hosts, Kernel kernel,
            std::chrono::system_clock::time_point start);

    /// Replaces the file, at the first call and then at most every 10 s. If that fails, the run
    /// goes on, and finish() reports the reason.
    void update(const ProgressState& progress);

    /// Replaces the file by that of a run that has ended. Throws Error, which is no error of the
    /// run.
    void finish(const FarmReport& report) const;

private:
    std::string text(RunState state, const FarmReport* report) const;

    std::string path_;
    std::vector<std::string> hosts_;
    Kernel kernel_;
    std::chrono::system_clock::time_point start_;
    ProgressState progress_; ///< of the last call of update()
    double next_ = 0;        ///< time of the next update [s since the start of the computation]
};

/// What a sidecar says of the last run.
struct LastRun {
    RunState state = RunState::unknown; ///< when it was written
    double age = 0;                     ///< since then [s]
    double elapsed = 0;                 ///< from the start of the run to then [s]
    std::int64_t ranks = 0;
    ProgressState progress; ///< then
};

/// nullopt if the result file of this path has no sidecar, or only one without progress.
std::optional<LastRun> last_run_of(const std::string& path);

/// How far a spectrum or a boundary is, from its file and the last run.
struct FileProgress {
    RunState state;
    ProgressState progress;             ///< by the tiles in the file, now if a run writes it
    std::optional<double> elapsed;      ///< since the start of the last run, or to its end [s]
    std::optional<double> seconds_left; ///< nullopt if no run writes it
};
FileProgress progress_of(const StoredResult& stored, const std::optional<LastRun>& run);

} // namespace overturn
