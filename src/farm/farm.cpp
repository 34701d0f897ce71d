// Rank 0 coordinates the nodes, and all ranks compute tiles, which they take from the pool of their
// node. Its leader requests tiles as soon as the pool holds no more than the last answer contained,
// so that the ranks need not wait, and rank 0 answers at once while tiles are left. Once none is
// left, rank 0 keeps the request. At intervals it answers with no ranges, after which the leader
// repeats its request, which shows that it is alive; the last answer is the end of the work. Rank 0
// leads its own node in the same way, without messages of MPI.
#include "overturn/farm/farm.hpp"

#include "coordinator.hpp"
#include "duties.hpp"

#include <optional>
#include <thread>

namespace overturn {

namespace {

/// Computes and writes one tile, and measures both times.
void compute_and_write(std::int64_t number, const TileWork& tile_work,
                       const DropRequested& drop_requested, RankShare& share)
{
    const auto start = Clock::now();
    const bool was_computed = tile_work.compute(number, drop_requested);
    const auto computed = Clock::now();
    share.compute_seconds += std::chrono::duration<double>(computed - start).count();
    if (!was_computed) {
        return;
    }
    tile_work.write(number);
    share.write_seconds += std::chrono::duration<double>(Clock::now() - computed).count();
    ++share.tiles;
}

/// Takes tiles from the pool of the node, until the leader has ended the work. attend_to_others:
/// the duties of the rank to other ranks.
RankShare compute_tiles(const Node& node, const TileWork& tile_work, const StopRequest& stop,
                        const std::function<void()>& attend_to_others)
{
    RankShare share;
    NodeState& state = node.state();
    RankState& own = node.own();
    const auto attend = [&] {
        ++own.signs_of_life;
        if (stop.requested()) {
            state.stop = true;
        }
        attend_to_others();
    };
    IntervalTimer attention{attention_interval};
    // The computation of a tile calls it regularly.
    const DropRequested drop_requested = [&] {
        if (attention.is_due()) {
            attend();
        }
        return stop.overdue();
    };
    while (true) {
        attend();
        if (state.ended) {
            return share;
        }
        own.takes_or_computes = true;
        const auto number = state.stop ? std::nullopt : state.pool.take();
        if (number) {
            compute_and_write(*number, tile_work, drop_requested, share);
            own.tiles_done = share.tiles;
            own.busy_nanoseconds =
                std::int64_t(1e9 * (share.compute_seconds + share.write_seconds));
        }
        own.takes_or_computes = false;
        if (!number) {
            std::this_thread::sleep_for(polling_interval);
        }
    }
}

} // namespace

FarmReport farm_out(const MpiSession& session, const Node& node,
                    const std::vector<std::int64_t>& tiles, const TileWork& tile_work,
                    const StopRequest& stop, std::chrono::seconds patience)
{
    FarmReport report;
    if (session.rank() == 0) {
        Coordinator coordinator(session, node.leaders(), tiles, tile_work, stop, patience);
        Leader leader(session, node, coordinator, patience, message_interval);
        report.ranks = {compute_tiles(node, tile_work, stop, [&] {
            coordinator.communicate();
            leader.attend();
        })};
        report.dispatch = coordinator.cost();
    } else if (node.is_leader()) {
        // Several messages within the timeout, so that some may be late.
        constexpr int messages = 10;
        LinkByMpi link(session.communicator());
        Leader leader(session, node, link, patience,
                      std::chrono::milliseconds(patience) / messages);
        report.ranks = {compute_tiles(node, tile_work, stop, [&] { leader.attend(); })};
    } else {
        Member member(session, node, patience);
        report.ranks = {compute_tiles(node, tile_work, stop, [&] { member.attend(); })};
    }
    report.ranks = session.gather_on_rank_0(report.ranks[0]);
    for (const RankShare& rank : report.ranks) {
        report.all.tiles += rank.tiles;
        report.all.compute_seconds += rank.compute_seconds;
        report.all.write_seconds += rank.write_seconds;
    }
    report.all = session.from_rank_0(report.all);
    report.stopped = session.from_rank_0(report.all.tiles < std::int64_t(tiles.size()));
    return report;
}

} // namespace overturn
