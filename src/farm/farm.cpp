#include "overturn/farm/farm.hpp"

#include "leader.hpp"
#include "wait_for.hpp"
#include "worker.hpp"

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

/// Returns rank 0's two numbers on all ranks.
std::array<std::int64_t, 2> from_rank_0(const MpiSession& session,
                                        std::array<std::int64_t, 2> values)
{
    MPI_Request arriving = MPI_REQUEST_NULL;
    MPI_Ibcast(values.data(), int(values.size()), MPI_INT64_T, 0, session.communicator(),
               &arriving);
    wait_for(arriving);
    return values;
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
    RankShare share;
    if (session.rank() == 0) {
        Leader leader(session, tiles, tile_work, on_progress, stop, patience);
        share = leader.lead();
        report.dealing = leader.dealing();
    } else {
        share = work(session, tile_work, stop, patience);
    }
    report.ranks = gather_on_rank_0(session, share);
    std::int64_t done = 0;
    for (const RankShare& rank : report.ranks) {
        done += rank.tiles;
    }
    const auto [all_done, wanted] = from_rank_0(session, {done, std::int64_t(tiles.size())});
    report.tiles = all_done;
    report.stopped = all_done < wanted;
    return report;
}

} // namespace overturn
