#include "commands.hpp"
#include "guarded_reading.hpp"
#include "report/result_remarks.hpp"

#include "overturn/file/stored_result.hpp"
#include "overturn/text/error.hpp"

#include <fmt/ranges.h>

#include <ranges>

namespace overturn {

int verify(const std::string& path)
{
    const GuardedReading guarded(path);
    const StoredResult stored(path);
    const TilesSummary& tiles = stored.tiles();
    if (const auto damaged = stored.damaged_coordinates(); !damaged.empty()) {
        throw Error(exit_code::output,
                    "\"{}\" is damaged: the values of its coordinates have changed: {}. "
                    "Remove the file and recompute it.",
                    path, fmt::join(damaged, ", "));
    }
    if (const auto damaged = stored.damaged_tiles(); !damaged.empty()) {
        constexpr std::ptrdiff_t most = 20; // so that the message stays short
        throw Error(exit_code::output,
                    "\"{}\" is damaged: the checksums of {} of {} finished tiles do not match "
                    "(tile numbers: {}{}). Recompute them with {}.",
                    path, damaged.size(), tiles.tiles_done,
                    fmt::join(damaged | std::views::take(most), ", "),
                    std::ssize(damaged) > most ? ", ..." : "", command_to_complete(stored));
    }
    fmt::print("{}: {} of {} {} done; coordinates and checksums match\n", path, tiles.tiles_done,
               tiles.tiles, tiles.tiles == 1 ? "tile is" : "tiles are");
    return exit_code::complete;
}

} // namespace overturn
