// The map of the code: open a session (farm), read the job (job, record), create or continue the
// file (file), hand out the missing tiles (farm), compute each of them (sweep, with the kernels of
// integrate and mechanics) and write it (file).
#include "commands.hpp"
#include "kernel_choice.hpp"
#include "prepare_output.hpp"
#include "report/print.hpp"
#include "report/progress.hpp"
#include "report/result_remarks.hpp"
#include "report/sidecar.hpp"

#include "overturn/answers/job_lines.hpp"
#include "overturn/farm/farm.hpp"
#include "overturn/farm/node.hpp"
#include "overturn/farm/stop_signals.hpp"
#include "overturn/file/provenance.hpp"
#include "overturn/file/result_writer.hpp"
#include "overturn/file/stored_result.hpp"
#include "overturn/problem/problem_bytes.hpp"
#include "overturn/problem/tile_order.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "overturn/text/quoting.hpp"

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>

namespace overturn {

namespace {

using Clock = std::chrono::system_clock; // the sidecar file contains the date

/// The data that each rank needs to take part in a run.
struct Task {
    const MpiSession& session;
    const Problem problem;
    const std::string path;
    const RunOptions& options;
    const Clock::time_point start;           ///< of the program
    const std::vector<std::int64_t> damaged; ///< finished tiles to recompute; on rank 0
    const Tiling tiling = tiling_of(problem);
    const TilesOfPart own = TilesOfPart(tiling.size(), options.part); ///< the tiles of the file
    const Items items = items_of(problem);
    const Kernel kernel = kernel_called(options.kernel);

    bool is_rank_0() const { return session.rank() == 0; }
    std::int64_t items_in(std::int64_t tiles) const { return items.in(tiles, tiling.size()); }
};

std::string start_line(const Task& task, std::int64_t tiles_before)
{
    std::string what = task.options.part ? words_of(*task.options.part) + ": " : "";
    if (tiles_before == 0) {
        const std::int64_t items = task.items_in(task.own.size());
        what += fmt::format("{} {} in {} {}", human_count(double(items)),
                            noun_of(items, task.items.name), task.own.size(),
                            noun_of(task.own.size(), "tiles"));
    } else {
        what += fmt::format("resuming: {} of {} tiles done", tiles_before, task.own.size());
    }
    if (!task.damaged.empty()) {
        what += fmt::format(", {} damaged {} to recompute", task.damaged.size(),
                            noun_of(task.damaged.size(), "tiles"));
    }
    return fmt::format("{}: {}; {} {}, kernel {}", task.path, what, task.session.size(),
                       noun_of(task.session.size(), "ranks"), name_of(task.kernel));
}

/// The number of points computed, and how the ranks spent the time.
std::string end_line(const Task& task, const FarmReport& report, double seconds)
{
    const auto items = double(task.items_in(report.all.tiles));
    const double percent = 100 / (seconds * task.session.size());
    return fmt::format(
        "computed {} {} in {}, {} {}/s; {:.0f} % of the time in the kernel, {:.0f} % writing",
        human_count(items), noun_of(items, task.items.name), human_duration(seconds),
        human_count(items / seconds), noun_of(items / seconds, task.items.name),
        percent * report.all.compute_seconds, percent * report.all.write_seconds);
}

FarmReport farm_tiles(const Task& task, const Node& node, const std::vector<std::int64_t>& missing,
                      ResultWriter& file, Sidecar& sidecar)
{
    const std::int64_t tiles_before = task.own.size() - std::int64_t(missing.size());
    Progress progress(task.items.name, task.items_in(tiles_before));
    const TileOrder order(task.tiling.size());
    TileFields fields; // of the last tile computed
    const TileWork tile_work{
        .compute =
            [&](std::int64_t place, const DropRequested& drop_requested) {
                try {
                    fields = compute_tile(task.problem, task.tiling[order.tile(place)], task.kernel,
                                          drop_requested);
                    return true;
                } catch (const TileDropped&) {
                    return false;
                }
            },
        .write = [&](std::int64_t place) { file.write(task.tiling[order.tile(place)], fields); },
        .on_progress =
            [&](std::int64_t done) {
                progress.update(task.items_in(tiles_before + done), task.items_in(task.own.size()));
                sidecar.update(progress.state());
            }};
    return farm_out(task.session, node, order.places_of(missing), tile_work,
                    {StopSignals::requested, StopSignals::overdue},
                    std::chrono::seconds(task.options.patience));
}

/// Prints how the run ended, and what a reader of the result must know. On rank 0.
int report_end(const Task& task, const FarmReport& report, double seconds)
{
    const StoredResult stored(task.path);
    const std::int64_t missing = stored.tiles().tiles - stored.tiles().tiles_done;
    if (missing > 0 && !report.stopped) {
        throw Error(exit_code::output,
                    "another program has written to \"{}\"; all tiles were computed, but the file "
                    "lacks {} of {}. Run the same command again to resume.",
                    task.path, missing, stored.tiles().tiles);
    }
    print_line(fmt::format("{}: {}", task.path, end_line(task, report, seconds)));
    if (missing > 0) {
        return print_error(
            stopped_by_signal(fmt::format("; tiles missing: {} of {}", missing, task.own.size())));
    }
    for (const std::string& line : remarks_on(stored)) {
        print_line(fmt::format("{}: {}", task.path, line));
    }
    return exit_code::complete;
}

int run_on_this_rank(const Task& task)
{
    // The path on rank 0, because other ranks may have been started in other working directories.
    const std::string path =
        task.session.from_rank_0(std::filesystem::absolute(task.path).string());
    if (const auto other = rank_with_another_file(path, task.session.communicator())) {
        if (task.is_rank_0()) {
            const std::vector<std::string>& hosts = task.session.hosts();
            print_error(Error(exit_code::output,
                              "\"{}\" is not the same file on rank {} (host {}) as on rank 0 (host "
                              "{}). Choose a folder with -o that all hosts share.",
                              path, *other, hosts[std::size_t(*other)], hosts.front()));
        }
        return exit_code::output;
    }
    Node node(task.session);
    ResultWriter file(path, task.session.communicator(), task.problem, task.options.durable);
    std::vector<std::int64_t> missing;
    Sidecar sidecar(task.path, task.session.hosts(), task.kernel, task.start); // of rank 0
    if (task.is_rank_0()) {
        for (const std::int64_t number : task.damaged) {
            file.reset(task.tiling[number]);
        }
        missing = file.missing_tiles();
        std::erase_if(missing, [&](std::int64_t tile) { return !task.own.contains(tile); });
        const std::int64_t tiles_before = task.own.size() - std::int64_t(missing.size());
        const std::int64_t before = task.items_in(tiles_before);
        sidecar.update({before, before, task.items_in(task.own.size()), 0, task.items.name});
        print_line(start_line(task, tiles_before));
    }
    const FarmReport report = farm_tiles(task, node, missing, file, sidecar);
    node.free();
    file.close();
    int code = exit_code::complete;
    if (task.is_rank_0()) {
        const double seconds = std::chrono::duration<double>(Clock::now() - task.start).count();
        try {
            sidecar.finish(report);
        } catch (const Error& error) { // such as of a full disk; the result is complete without it
            print_warnings({boost::algorithm::trim_right_copy_if(
                std::string(error.what()), boost::algorithm::is_any_of("."))});
        }
        code = report_end(task, report, seconds);
    }
    return task.session.from_rank_0(code);
}

} // namespace

int run(const RunOptions& options)
{
    const auto start = Clock::now();
    const StopSignals signals;
    std::signal(SIGXFSZ, SIG_IGN); // a write beyond the file size limit fails with a message
    std::signal(SIGPIPE, SIG_IGN); // a run continues if the reader of its log ends
    const std::string path = output_path(options);
    std::optional<Job> job;
    std::optional<OutputLock> output_lock;
    std::vector<std::int64_t> damaged;
    bool computes = false;
    int code = exit_code::complete;
    start_hdf5();
    const MpiSession session;
    // An error that rank 0 finds before the computation is printed once, and all ranks return its
    // exit code. A later error on any rank aborts the others.
    if (session.rank() == 0) {
        try {
            kernel_called(options.kernel); // throws if this machine does not support it
            most_ranks_per_node();         // throws if it is not a number
            job = read_job(options.job.path, options.job.overrides);
            if (options.boundary) {
                job = boundary_of(std::move(*job));
            }
            expect_divisible(*job, options.part);
            expect_path_for_mpi(std::filesystem::absolute(path).string());
            output_lock.emplace(path);
            if (const auto found = prepare_output(*job, options.part, path, *output_lock)) {
                print_warnings(warnings_on(*job));
                std::ranges::for_each(notes_on(*job), print_line);
                damaged = *found;
                computes = true;
            }
        } catch (const std::exception& error) {
            code = print_error(error);
        }
    }
    if (!session.from_rank_0(computes)) {
        return session.from_rank_0(code);
    }
    try {
        const std::string bytes = session.from_rank_0(job ? bytes_of(job->problem) : "");
        return run_on_this_rank({session, problem_of(bytes), path, options, start, damaged});
    } catch (const std::exception& error) {
        if (session.size() == 1) {
            throw;
        }
        session.abort(exit_code_of(error), message_of(error));
    }
}

} // namespace overturn
