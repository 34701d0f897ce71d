#include "commands.hpp"
#include "estimate.hpp"
#include "prepare_output.hpp"
#include "report/job.hpp"
#include "report/json_outputs.hpp"
#include "report/print.hpp"

#include "overturn/answers/job_lines.hpp"
#include "overturn/file/disk_space.hpp"
#include "overturn/file/result_writer.hpp"
#include "overturn/job/job.hpp"
#include "overturn/text/quoting.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>

namespace overturn {

namespace {

void print_size(const Job& job)
{
    const Problem& problem = job.problem;
    const Tiling tiling = tiling_of(problem);
    const Items items = items_of(problem);
    print_row(items.name, fmt::format("{} in {} {}", human_count(double(items.count)),
                                      tiling.size(), noun_of(tiling.size(), "tiles")));
    for (const FieldSize& field : field_sizes(problem)) {
        print_row("field", fmt::format("{}, {}, {} {} per value", name_of(field.field),
                                       human_bytes(field.bytes()), field.bytes_per_value,
                                       noun_of(field.bytes_per_value, "bytes")));
    }
    print_row("file", human_bytes(double(result_bytes(job))));
}

void print_space(const DiskSpace& space, const std::string& folder)
{
    const auto quota = space.quota();
    const std::string quota_text =
        !quota ? "unknown"
        : !std::isfinite(quota->limit)
            ? "none"
            : fmt::format("{}, {} used", human_bytes(quota->limit), human_bytes(quota->used));
    print_row("space",
              printable(fmt::format("{} in {}; quota {}",
                                    space.free ? human_bytes(*space.free) + " free" : "unknown",
                                    folder, quota_text)));
}

void print_time(const Problem& problem, const RunEstimate& estimate)
{
    const std::string ranks =
        estimate.ranks == 1 ? "one rank" : fmt::format("{} ranks", estimate.ranks);
    const std::string parts =
        estimate.creation_speed
            ? fmt::format(": {} to create the file at {}/s, {} to compute",
                          human_duration(estimate.creation_seconds),
                          human_bytes(*estimate.creation_speed),
                          human_duration(estimate.farm.seconds))
            : ", without the creation of the file, since the speed of the disk is unknown";
    print_row("time",
              fmt::format("about {} on {} with kernel {}{}", human_duration(estimate.seconds()),
                          ranks, name_of(estimate.kernel), parts));
    const double hours = estimate.core_hours();
    print_row("cost", fmt::format("{} core-hours, {:.0f} % of them spent on tiles",
                                  hours < 999.5 ? fmt::format("{:.3g}", hours) : human_count(hours),
                                  100 * estimate.tile_share()));
    print_row("memory", fmt::format("about {} per rank, {} on rank 0", human_bytes(estimate.memory),
                                    human_bytes(estimate.memory_of_rank_0)));
    const auto tiles_seconds = [&](const Problem& other) {
        return sample_of(other, estimate.kernel).mean * double(tiling_of(other).size());
    };
    if (const auto share = estimate.sample.integrated_share) {
        Problem direct = problem;
        direct.product = Spectrum();
        std::erase(direct.fields, Field::evaluated);
        print_row("fill", fmt::format("about {:.2g} % of the points are integrated; all of them "
                                      "would take {} on one rank",
                                      100 * *share, human_duration(tiles_seconds(direct))));
    } else if (problem.product.boundaries() == nullptr && reason_not_to_fill(problem).empty()) {
        Problem filled = problem;
        filled.product = FilledSpectrum();
        filled.fields.push_back(Field::evaluated);
        print_row("fill", fmt::format("about {} on one rank with numerics.fill = true",
                                      human_duration(tiles_seconds(filled))));
    }
}

/// A warning if it is known that the file does not fit.
std::vector<std::string> warnings_on_space(double bytes, const DiskSpace& space,
                                           const std::string& folder)
{
    const auto available = space.available();
    std::error_code none;
    if (!std::filesystem::is_directory(folder, none)) {
        return {
            fmt::format("there is no folder \"{}\": create it, or choose another with -o", folder)};
    }
    if (!available || bytes <= *available) {
        return {};
    }
    return {
        fmt::format("the file takes {}, but {} are available in \"{}\"; free some space, choose "
                    "another disk with -o, or reduce the number of points or fields",
                    human_bytes(bytes), human_bytes(*available), folder)};
}

/// A warning if most of what the run costs is spent by ranks that wait.
std::vector<std::string> warnings_on_waiting(const RunEstimate& estimate)
{
    if (estimate.ranks == 1 || estimate.tile_share() > 0.5) {
        return {};
    }
    return {fmt::format(
        "{} ranks would wait for {:.0f} % of the time, most of it while the file is created; "
        "fewer ranks cost less",
        estimate.ranks, 100 * (1 - estimate.tile_share()))};
}

} // namespace

int check(const CheckOptions& options)
{
    const Kernel kernel = widest_kernel(); // throws if this processor supports none
    const auto start = std::chrono::steady_clock::now();
    Job job = read_job(options.run.job.path, options.run.job.overrides);
    if (options.run.boundary) {
        job = boundary_of(std::move(job));
    }
    const double reading =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::string path = std::filesystem::absolute(output_path(options.run)).string();
    std::error_code none; // of links
    const auto file = std::filesystem::weakly_canonical(path, none);
    const std::string folder = (none ? std::filesystem::path(path) : file).parent_path().string();
    const DiskSpace space = space_in(folder);
    std::vector<std::string> warnings = warnings_on(job);
    const auto add = warnings_on_space(double(result_bytes(job)), space, folder);
    warnings.insert(warnings.end(), add.begin(), add.end());
    if (options.json) {
        const RunEstimate estimate =
            estimate_run(job, kernel, options.ranks, reading, folder, space);
        std::ranges::copy(warnings_on_waiting(estimate), std::back_inserter(warnings));
        fmt::print("{}", json_of(job, path, space, estimate, warnings));
        return exit_code::complete;
    }
    print_warnings(warnings);
    print_job(job);
    print_size(job);
    print_space(space, folder);
    std::fflush(stdout);
    const RunEstimate estimate = estimate_run(job, kernel, options.ranks, reading, folder, space);
    print_time(job.problem, estimate);
    print_warnings(warnings_on_waiting(estimate));
    return exit_code::complete;
}

} // namespace overturn
