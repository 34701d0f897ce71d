#include "overturn/farm/farm.hpp"

#include "roles.hpp"

#include <array>

namespace overturn {

FarmReport farm_out(const MpiSession& session, const std::vector<std::int64_t>& tiles,
                    const TileWork& tile_work, const std::function<void(std::int64_t)>& on_progress,
                    const StopRequest& stop, std::chrono::seconds patience)
{
    FarmReport report;
    if (session.rank() == 0) {
        report = lead(session, tiles, tile_work, on_progress, stop, patience);
    } else {
        report.ranks = {work(session, tile_work, stop, patience)};
    }
    report.ranks = session.gather_on_rank_0(report.ranks[0]);
    std::int64_t done = 0;
    for (const RankShare& rank : report.ranks) {
        done += rank.tiles;
    }
    const auto [all_done, wanted] =
        session.from_rank_0(std::array{done, std::int64_t(tiles.size())});
    report.tiles = all_done;
    report.stopped = all_done < wanted;
    return report;
}

} // namespace overturn
