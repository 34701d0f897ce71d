#include "commands.hpp"
#include "guarded_reading.hpp"
#include "report/result_remarks.hpp"

#include "overturn/file/stored_result.hpp"
#include "overturn/text/error.hpp"

#include <fmt/format.h>

namespace overturn {

int verify(const std::string& path)
{
    const GuardedReading guarded(path);
    const StoredResult stored(path);
    const TilesSummary& tiles = stored.tiles();
    expect_undamaged(stored);
    fmt::print("{}: {}{} of {} {} done; coordinates and checksums match\n", path,
               tiles.part ? words_of(*tiles.part) + ": " : "", tiles.tiles_done, tiles.tiles,
               tiles.tiles == 1 ? "tile is" : "tiles are");
    return exit_code::complete;
}

} // namespace overturn
