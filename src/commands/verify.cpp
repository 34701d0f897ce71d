// Checks the coordinates of a result file against its job, and its tiles against their checksums.
#include "child_process.hpp"
#include "commands.hpp"

#include "overturn/file/spectrum_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace overturn {

namespace {

/// The first numbers of the list, so that the message stays short.
std::string list_text(const std::vector<std::int64_t>& numbers)
{
    constexpr std::size_t most = 20;
    const auto shown = std::min(numbers.size(), most);
    return fmt::format("{}{}",
                       fmt::join(numbers.begin(), numbers.begin() + std::ptrdiff_t(shown), ", "),
                       numbers.size() > most ? ", ..." : "");
}

void check_file(const std::string& path)
{
    const SpectrumSummary summary = summarize(path);
    if (const auto damaged = damaged_coordinates(path); !damaged.empty()) {
        throw FileError(fmt::format("\"{}\" is damaged: its coordinates do not match its job: {}. "
                                    "Remove the file and recompute it.",
                                    path, fmt::join(damaged, ", ")));
    }
    if (const auto damaged = damaged_tiles(path); !damaged.empty()) {
        throw FileError(fmt::format(
            "\"{}\" is damaged: the checksums of {} of {} finished tiles do not match (tile "
            "numbers: {}). Recompute them with overturn {} JOB.toml -o {}, with the job file and "
            "the --set "
            "arguments of the first run.",
            path, damaged.size(), summary.tiles_done, list_text(damaged),
            summary.product == Product::boundary ? "boundary" : "run", path));
    }
    fmt::print("{}: {} of {} {} done; coordinates and checksums match\n", path, summary.tiles_done,
               summary.tiles, summary.tiles == 1 ? "tile is" : "tiles are");
}

} // namespace

int verify(const std::string& path)
{
    return run_in_child(path, [&] { check_file(path); });
}

} // namespace overturn
