#include "prepare_output.hpp"

#include "guarded_reading.hpp"
#include "report/print.hpp"

#include "overturn/farm/stop_signals.hpp"
#include "overturn/file/history_and_accuracy_files.hpp"
#include "overturn/file/result_writer.hpp"
#include "overturn/file/text_outputs.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/quoting.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

namespace overturn {

namespace {

void expect_no_stop(const char* when)
{
    if (StopSignals::requested()) {
        throw stopped_by_signal(when);
    }
}

/// Checks all finished tiles: after a power failure, the checksum of a tile may be on the disk but
/// not its values.
std::vector<std::int64_t> find_damaged_tiles(const StoredResult& stored)
{
    const auto start = std::chrono::steady_clock::now();
    bool announced = false;
    return stored.damaged_tiles([&] {
        if (!announced && std::chrono::steady_clock::now() - start > std::chrono::seconds(2)) {
            print_line(stored.path() + ": verifying finished tiles");
            announced = true;
        }
        expect_no_stop(" before the computation started");
    });
}

} // namespace

std::string output_path(const RunOptions& options)
{
    if (!options.output.empty()) {
        return options.output;
    }
    std::string path = std::filesystem::path(options.job.path).stem().string();
    path += options.boundary ? "_boundary" : "";
    if (const auto& part = options.part) {
        const std::string count = std::to_string(part->count);
        path += fmt::format(".part-{:0{}}-of-{}", part->number, count.size(), count);
    }
    return path + ".h5";
}

void expect_divisible(const Job& job, const std::optional<JobPart>& part)
{
    const std::int64_t tiles = tiling_of(job.problem).size();
    if (part && part->count > tiles) {
        throw Error(
            exit_code::usage,
            "--part {}/{}: the job has {} {}, and a part has at least one. Use fewer parts.",
            part->number, part->count, tiles, noun_of(tiles, "tiles"));
    }
}

std::optional<std::vector<std::int64_t>> prepare_output(const Job& job,
                                                        const std::optional<JobPart>& part,
                                                        const std::string& path,
                                                        const OutputLock& lock)
{
    std::optional<std::vector<std::int64_t>> damaged;
    bool is_complete = false;
    {
        const GuardedReading guarded(path, lock.path());
        if (const auto stored = existing_result(path, job, part)) {
            damaged = find_damaged_tiles(*stored);
            is_complete = damaged->empty() && stored->tiles().tiles_done == stored->tiles().tiles;
        }
    }
    if (is_complete) {
        clear_open_mark(path);
        print_line(path + " is already complete.");
        return std::nullopt;
    }
    expect_place_for_sidecar(path);
    if (!damaged) {
        const auto bytes = double(result_bytes(job, part));
        constexpr double made_at_once = 1e8;
        if (bytes > made_at_once) {
            print_line(fmt::format("{}: creating a file of {}", path, human_bytes(bytes)));
        }
        create_result(path, job, part, [] { expect_no_stop(" before the file was created"); });
        damaged.emplace();
    }
    return damaged;
}

void expect_study_output(const std::string& path, FileKind kind, const OutputLock& lock)
{
    const GuardedReading guarded(path, lock.path());
    expect_room_for(path, kind);
}

} // namespace overturn
