// Whether a result file is as it was written.
#include "child_process.hpp"
#include "commands.hpp"

#include "overturn/file/spectrum_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace overturn {

namespace {

/// The first of them, so that a file that is all wrong takes a line.
std::string list_text(const std::vector<std::int64_t>& numbers)
{
    constexpr std::size_t most = 20;
    const auto shown = std::min(numbers.size(), most);
    return fmt::format("{}{}",
                       fmt::join(numbers.begin(), numbers.begin() + std::ptrdiff_t(shown), ", "),
                       numbers.size() > most ? ", ..." : "");
}

void print_whether_it_is_whole(const std::string& path)
{
    const SpectrumSummary summary = summarize(path);
    if (const auto damaged = damaged_coordinates(path); !damaged.empty()) {
        throw FileError(fmt::format("\"{}\" is damaged: of its coordinates {} are not its job's. "
                                    "Remove it, and compute it again.",
                                    path, fmt::join(damaged, ", ")));
    }
    if (const auto damaged = damaged_tiles(path); !damaged.empty()) {
        throw FileError(fmt::format(
            "\"{}\" is damaged: {} of {} tiles are not as they were written, by number {}. To "
            "compute them again: overturn {} JOB.toml -o {}, with the job file and the --set "
            "arguments of the first run.",
            path, damaged.size(), summary.tiles_done, list_text(damaged),
            summary.product == Product::boundary ? "boundary" : "run", path));
    }
    fmt::print("{}: {} of {} {} as {} written\n", path, summary.tiles_done, summary.tiles,
               summary.tiles == 1 ? "tile is done, and is" : "tiles are done, and all of them are",
               summary.tiles == 1 ? "it was" : "they were");
}

} // namespace

int verify(const std::string& path)
{
    return run_in_child(path, [&] { print_whether_it_is_whole(path); });
}

} // namespace overturn
