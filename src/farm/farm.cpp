#include "overturn/farm/farm.hpp"

#include "roles.hpp"
#include "wait_for.hpp"

#include <array>
#include <string>

namespace overturn {

namespace {

/// Workers arrive before rank 0; here and in from_rank_0 they wait without occupying a core.
std::vector<RankShare> gather_on_rank_0(const MpiSession& session, const RankShare& share)
{
    std::vector<RankShare> shares(session.rank() == 0 ? std::size_t(session.size()) : 0);
    MPI_Request gathering = MPI_REQUEST_NULL;
    MPI_Igather(&share, int(sizeof share), MPI_BYTE, shares.data(), int(sizeof share), MPI_BYTE, 0,
                session.communicator(), &gathering);
    wait_for(gathering);
    return shares;
}

} // namespace

SilentRank::SilentRank(int silent_rank, std::chrono::seconds duration)
    : std::runtime_error("rank " + std::to_string(silent_rank) + " has not responded"),
      rank(silent_rank), silence(duration)
{}

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
    report.ranks = gather_on_rank_0(session, report.ranks[0]);
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
