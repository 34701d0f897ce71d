// The map of the code: open a session, read the job, open the file, hand out the missing tiles,
// compute and write each of them.
#include "audit_text.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "human_units.hpp"
#include "job_of_rank_0.hpp"
#include "kernel_choice.hpp"
#include "output_lines.hpp"
#include "prepare_output.hpp"
#include "progress.hpp"
#include "record_lines.hpp"

#include "overturn/farm/farm.hpp"
#include "overturn/farm/mpi_session.hpp"
#include "overturn/farm/stop_signals.hpp"
#include "overturn/file/provenance.hpp"
#include "overturn/file/sole_writer.hpp"
#include "overturn/file/spectrum_file.hpp"
#include "overturn/file/spectrum_summary.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/boundary.hpp"
#include "overturn/sweep/sweep_tile.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>

namespace overturn {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::system_clock; // the sidecar file contains the date

constexpr int proceed = -1; ///< tiles are missing; not an exit code

/// The data that each rank needs to take part in a run.
struct Task {
    const MpiSession& session;
    const Job& job;
    const Tiling tiling;
    const std::string path;
    const RunOptions& options;
    const Kernel kernel;
    const Clock::time_point start;           ///< of the program
    const std::vector<std::int64_t> damaged; ///< tiles of the existing file; on rank 0

    bool leads() const { return session.rank() == 0; }
    /// Points of a spectrum, or lines of a boundary.
    std::int64_t items() const
    {
        const bool lines = job.product == Product::boundary;
        return job.plane.points() / (lines ? most_crossings(job.scene) : 1);
    }
    std::int64_t items(std::int64_t tiles) const
    {
        return std::int64_t(double(items()) * (double(tiles) / double(tiling.size())));
    }
    const char* item_name() const { return job.product == Product::boundary ? "lines" : "points"; }
};

std::string output_path(const RunOptions& options)
{
    if (!options.output.empty()) {
        return options.output;
    }
    return fs::path(options.job.path).stem().string() + (options.boundary ? "_boundary.h5" : ".h5");
}

Job read_job_of(const RunOptions& options)
{
    Job job = read_job(options.job.path, options.job.overrides);
    return options.boundary ? boundary_of(std::move(job)) : job;
}

std::string start_line(const Task& task, std::int64_t tiles_before)
{
    std::string what =
        tiles_before == 0
            ? fmt::format("{} {} in {} {}", human_count(double(task.items())),
                          noun_of(double(task.items()), task.item_name()), task.tiling.size(),
                          noun_of(double(task.tiling.size()), "tiles"))
            : fmt::format("resuming: {} of {} tiles done", tiles_before, task.tiling.size());
    if (!task.damaged.empty()) {
        what += fmt::format(", {} damaged {} to recompute", task.damaged.size(),
                            noun_of(double(task.damaged.size()), "tiles"));
    }
    return fmt::format("{}: {}; {} {}, kernel {}", task.path, what, task.session.size(),
                       noun_of(task.session.size(), "ranks"), name_of(task.kernel));
}

/// The number of points computed, and how the ranks spent the time.
std::string end_line(const Task& task, const FarmReport& report, double seconds)
{
    const auto items = double(task.items(report.tiles));
    double computing = 0;
    double writing = 0;
    for (const RankShare& rank : report.ranks) {
        computing += rank.compute_seconds;
        writing += rank.write_seconds;
    }
    const double percent = 100 / (seconds * task.session.size());
    return fmt::format(
        "computed {} {} in {}, {} {}/s; {:.0f} % of the time in the kernel, {:.0f} % "
        "writing",
        human_count(items), noun_of(items, task.item_name()), human_duration(seconds),
        human_count(items / seconds), task.item_name(), percent * computing, percent * writing);
}

FarmReport compute_tiles(const Task& task, const std::vector<std::int64_t>& missing,
                         SpectrumFile& file)
{
    const Job& job = task.job;
    const std::int64_t tiles_before = task.tiling.size() - std::int64_t(missing.size());
    Progress progress(task.items(tiles_before), task.items(), task.item_name());
    const std::vector<double> scan = job.scan.values();
    TileFields fields;
    const TileWork tile_work{
        .compute =
            [&](std::int64_t number, const DropRequested& drop_requested) {
                const Tile tile = task.tiling[number];
                try {
                    fields = job.product == Product::boundary
                                 ? boundary_tile(job.scene, job.plane, scan, tile, task.kernel,
                                                 drop_requested)
                                 : sweep_tile(job.scene, job.numerics, job.plane, tile, job.fields,
                                              task.kernel, drop_requested);
                } catch (const TileDropped&) {
                    return false;
                }
                return true;
            },
        .write = [&](std::int64_t number) { file.write(task.tiling[number], fields); }};
    return farm_out(
        task.session, missing, tile_work,
        [&](std::int64_t done) { progress.update(task.items(tiles_before + done)); },
        {StopSignals::requested, StopSignals::overdue},
        std::chrono::seconds(task.options.patience));
}

/// On rank 0.
void write_run_info(const Task& task, const std::vector<std::string>& hosts,
                    const FarmReport& report, double seconds)
{
    RunInfo run;
    run.start = task.start;
    run.wall_seconds = seconds;
    run.kernel = name_of(task.kernel);
    run.requests = report.dealing.requests;
    run.dealing_seconds = report.dealing.seconds;
    for (std::size_t rank = 0; rank < hosts.size(); ++rank) {
        const RankShare& share = report.ranks[rank];
        run.ranks.push_back({hosts[rank], share.tiles, share.compute_seconds, share.write_seconds});
    }
    write_sidecar(task.path, run);
}

/// Stops all ranks, with a message, if one of them is silent.
FarmReport compute_or_name_the_silent_rank(const Task& task, const std::vector<std::string>& hosts,
                                           const std::vector<std::int64_t>& missing,
                                           SpectrumFile& file)
{
    try {
        return compute_tiles(task, missing, file);
    } catch (const SilentRank& silent) {
        const std::string host = // rank 0 knows the hosts
            hosts.empty() ? "" : fmt::format(" on {}", hosts[std::size_t(silent.rank)]);
        task.session.abort(
            exit_code::stopped,
            fmt::format("rank {}{} has not responded for {} s: it is suspended, its disk hangs, or "
                        "its host is unreachable. Finished tiles are kept. Run the same command "
                        "again to resume.",
                        silent.rank, host, silent.silence.count()));
    }
}

/// The number of tiles in the file that are not marked as done; 0 if it is complete. On rank 0.
std::int64_t count_missing_tiles(const Task& task, const FarmReport& report)
{
    const SpectrumSummary stored = summarize(task.path);
    const std::int64_t missing = stored.tiles - stored.tiles_done;
    if (missing > 0 && !report.stopped) {
        throw FileError(fmt::format("another program has written to \"{}\"; all tiles were "
                                    "computed, but the file lacks {} of {}. Run the same command "
                                    "again to resume.",
                                    task.path, missing, stored.tiles));
    }
    return missing;
}

int compute_missing_tiles(const Task& task)
{
    const std::vector<std::string> hosts = task.session.host_names();
    // The path on rank 0, because other ranks may have been started in other working directories.
    const std::string path = task.session.from_rank_0(fs::absolute(task.path).string());
    if (const auto other = rank_with_another_file(path, task.session.communicator())) {
        if (task.leads()) {
            complain(FileError(
                fmt::format("\"{}\" is not the same file on rank {} (host {}) as on rank 0 (host "
                            "{}). Choose a folder with -o that all hosts share.",
                            path, *other, hosts[std::size_t(*other)], hosts.front())));
        }
        return exit_code::output;
    }
    SpectrumFile file(path, task.session.communicator(), task.job,
                      task.options.durable ? Durability::on_disk : Durability::written);
    std::vector<std::int64_t> missing;
    std::int64_t still_damaged = 0;
    if (task.leads()) {
        for (const std::int64_t number : task.damaged) {
            if (StopSignals::requested()) {
                ++still_damaged;
            } else {
                file.forget(task.tiling[number]);
            }
        }
        for (const std::string& line : lines_of_equal_records(task.job)) {
            say(line);
        }
        for (const std::string& line : free_fall_lines(task.job)) {
            say(line);
        }
        missing = file.missing_tiles();
        say(start_line(task, task.tiling.size() - std::int64_t(missing.size())));
    }
    const FarmReport report = compute_or_name_the_silent_rank(task, hosts, missing, file);
    file.close();

    int code = exit_code::complete;
    if (task.leads()) {
        const double seconds = std::chrono::duration<double>(Clock::now() - task.start).count();
        write_run_info(task, hosts, report, seconds);
        const std::int64_t still_missing = count_missing_tiles(task, report) + still_damaged;
        say(fmt::format("{}: {}", task.path, end_line(task, report, seconds)));
        if (still_missing > 0) {
            code = complain(Stopped(
                fmt::format("; tiles missing: {} of {}", still_missing, task.tiling.size())));
        } else if (task.job.product == Product::boundary) {
            if (const std::string lines = lines_text(count_lines(task.path)); !lines.empty()) {
                say(fmt::format("{}: {}", task.path, lines));
            }
        } else if (const auto audit = summarize(task.path).audit) {
            say(fmt::format("{}: {}", task.path, audit_text(*audit)));
        }
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
    std::optional<SoleWriter> sole_writer;
    std::optional<std::vector<std::int64_t>> damaged;
    int code = exit_code::complete;

    // An error that rank 0 finds before the computation is printed once, and all ranks return its
    // exit code. A later error on any rank aborts the others.
    const auto complain_if_it_fails = [&](const auto& action) {
        try {
            action();
        } catch (const std::exception& error) {
            code = complain(error);
        }
    };
    if (launched_rank() == 0) {
        complain_if_it_fails([&] {
            kernel_called(options.kernel); // throws if this machine does not support it
            job = read_job_of(options);
            demand_path_for_mpi(fs::absolute(path).string());
            code = examine_in_child(*job, path);
        });
    }
    start_hdf5();
    const MpiSession session;
    if (session.rank() == 0 && code == exit_code::complete) {
        complain_if_it_fails([&] {
            if (!job) { // launched_rank() is wrong under this launcher
                job = read_job_of(options);
            }
            sole_writer.emplace(path);
            damaged = prepare_output(*job, path);
            if (damaged) {
                warn_of_implausible_values(*job);
            }
        });
    }
    code = session.from_rank_0(damaged ? proceed : code);
    if (code != proceed) {
        return code;
    }
    try {
        job = job_of_rank_0(session, std::move(job), options.boundary);
        return compute_missing_tiles({session, *job, tiling_of(*job), path, options,
                                      kernel_called(options.kernel), start,
                                      damaged.value_or(std::vector<std::int64_t>())});
    } catch (const std::exception& error) {
        if (session.size() == 1) {
            throw;
        }
        session.abort(exit_code_of(error), message_of(error));
    }
}

} // namespace overturn
