#include "prepare_output.hpp"

#include "apart.hpp"
#include "exit_code.hpp"
#include "say.hpp"

#include "overturn/farm/human_units.hpp"
#include "overturn/farm/stop_signals.hpp"
#include "overturn/file/provenance.hpp"
#include "overturn/file/spectrum_file.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>
#include <sstream>

namespace overturn {

namespace {

using Clock = std::chrono::steady_clock;

/// A file of this size is made in a second or less [bytes].
constexpr long double quickly_made = 1e8L;

Prepared stopped_before(const char* what)
{
    say_stopped(fmt::format(" before {}", what));
    return {.verdict = exit_code::stopped, .damaged = {}};
}

/// False if it is asked to stop meanwhile. Throws FileError if the file, which may have been
/// damaged or made for that, does harm to whoever reads it.
bool is_readable(const std::string& path)
{
    const Answer answer = ask_overturn({"info", "--", path}, StopSignals::requested);
    if (answer.exit_code != exit_code::complete && answer.exit_code != exit_code::stopped) {
        throw FileError(answer.complaint + " Choose another name with -o.");
    }
    return answer.exit_code == exit_code::complete;
}

/// Reads all that is done: a machine that lost its power may have kept the mark and lost the
/// values. Nothing if it is asked to stop meanwhile.
std::optional<std::vector<std::int64_t>> find_damaged_tiles(const std::string& path)
{
    const auto start = Clock::now();
    bool told = false;
    const Answer answer = ask_overturn({"verify", "--numbers", "--", path}, [&] {
        if (!told && Clock::now() - start > std::chrono::seconds(2)) {
            say(path + ": looking whether what is done is as it was written");
            told = true;
        }
        return StopSignals::requested();
    });
    if (answer.exit_code == exit_code::stopped) {
        return std::nullopt;
    }
    std::vector<std::int64_t> damaged;
    std::istringstream lines(answer.output);
    for (std::int64_t number = 0; lines >> number;) {
        damaged.push_back(number);
    }
    if (answer.exit_code != exit_code::complete && damaged.empty()) {
        throw FileError(answer.complaint);
    }
    return damaged;
}

/// In a process of its own if it takes long: neither HDF5 nor a disk that is to take gigabytes at
/// once can be interrupted. False if it is asked to stop meanwhile.
bool make_file(const Job& job, const RunOptions& options, const std::string& path)
{
    const Tiling tiling = tiling_of(job);
    const long double bytes = spectrum_file_bytes(job, tiling);
    if (bytes <= quickly_made) {
        create_spectrum_file(path, job, tiling);
        return true;
    }
    say(fmt::format("{}: making a file of {}", path, human_bytes(double(bytes))));
    std::vector<std::string> arguments{job.product == Product::boundary ? "boundary" : "run",
                                       "--make-only", "--output=" + path};
    for (const std::string& setting : options.job.overrides) {
        arguments.push_back("--set=" + setting);
    }
    arguments.insert(arguments.end(), {"--", "/dev/stdin"}); // a job may come from a pipe
    const Answer answer = ask_overturn(arguments, StopSignals::requested, job.given);
    if (answer.exit_code == exit_code::complete) {
        return true;
    }
    remove_half_made_file(path);
    if (answer.exit_code != exit_code::stopped) {
        throw FileError(answer.complaint);
    }
    return false;
}

} // namespace

Job read_job_of(const RunOptions& options)
{
    Job job = read_job(options.job.path, options.job.overrides);
    return options.boundary ? boundary_of(std::move(job)) : job;
}

Prepared prepare_output(const Job& job, const RunOptions& options, const std::string& path)
{
    std::error_code said_by_examine;
    if (std::filesystem::exists(path, said_by_examine) && !is_readable(path)) {
        return stopped_before("anything was computed");
    }
    const Existing existing = examine(path, job, tiling_of(job));
    if (existing == Existing::nothing) {
        demand_place_for_sidecar(path);
        return make_file(job, options, path) ? Prepared{} : stopped_before("the file was made");
    }
    const auto damaged = find_damaged_tiles(path);
    if (!damaged) {
        return stopped_before("anything was computed");
    }
    Prepared prepared{.verdict = go_on, .damaged = *damaged};
    if (existing == Existing::complete && prepared.damaged.empty()) {
        say(path + " is complete already.");
        prepared.verdict = exit_code::complete;
    } else {
        demand_place_for_sidecar(path);
    }
    return prepared;
}

int make_output(const RunOptions& options)
{
    end_with_parent();
    std::signal(SIGXFSZ, SIG_IGN); // beyond the limit of file sizes a write fails, with a message
    const Job job = read_job_of(options);
    std::error_code said_when_it_is_made;
    if (std::filesystem::exists(options.output, said_when_it_is_made)) {
        throw FileError(fmt::format("\"{}\" exists.", options.output));
    }
    create_spectrum_file(options.output, job, tiling_of(job));
    return exit_code::complete;
}

} // namespace overturn
