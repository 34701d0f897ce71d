#include "prepare_output.hpp"

#include "child_process.hpp"
#include "exit_code.hpp"
#include "human_units.hpp"
#include "output_lines.hpp"

#include "overturn/farm/stop_signals.hpp"
#include "overturn/file/provenance.hpp"
#include "overturn/file/spectrum_file.hpp"
#include "overturn/file/spectrum_summary.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

namespace overturn {

namespace {

constexpr const char* before_anything = " before the computation started";

void expect_no_stop(const char* when)
{
    if (StopSignals::requested()) {
        throw Stopped(when);
    }
}

void make_file(const Job& job, const std::string& path)
{
    const Tiling tiling = tiling_of(job);
    const long double bytes = spectrum_file_bytes(job, tiling);
    constexpr long double made_at_once = 1e8L;
    if (bytes > made_at_once) {
        say(fmt::format("{}: creating a file of {}", path, human_bytes(double(bytes))));
    }
    create_spectrum_file(path, job, tiling, [] { expect_no_stop(" before the file was created"); });
}

/// Checks all finished tiles: after a power failure, the checksum of a tile may be on the disk but
/// not its values.
std::vector<std::int64_t> find_damaged_tiles(const std::string& path)
{
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    bool announced = false;
    return damaged_tiles(path, [&] {
        if (!announced && Clock::now() - start > std::chrono::seconds(2)) {
            say(path + ": verifying finished tiles");
            announced = true;
        }
        expect_no_stop(before_anything);
    });
}

} // namespace

int examine_in_child(const Job& job, const std::string& path)
{
    std::error_code reported_by_examine;
    if (!std::filesystem::exists(path, reported_by_examine)) {
        return exit_code::complete;
    }
    const int code = run_in_child(
        path, [&] { examine(path, job, tiling_of(job)); }, StopSignals::requested);
    if (code == exit_code::stopped) {
        throw Stopped(before_anything);
    }
    return code;
}

std::optional<std::vector<std::int64_t>> prepare_output(const Job& job, const std::string& path)
{
    const Existing existing = examine(path, job, tiling_of(job));
    std::vector<std::int64_t> damaged;
    if (existing != Existing::nothing) {
        damaged = find_damaged_tiles(path);
    }
    if (existing == Existing::complete && damaged.empty()) {
        clear_open_mark(path);
        say(path + " is already complete.");
        return std::nullopt;
    }
    demand_place_for_sidecar(path);
    if (existing == Existing::nothing) {
        make_file(job, path);
    }
    return damaged;
}

} // namespace overturn
