#include "overturn/farm/farm.hpp"
#include "overturn/farm/node.hpp"
#include "overturn/text/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <thread>
#include <vector>

namespace overturn {
namespace {

const auto never = [] { return false; };
const StopRequest no_stop{never, never};
const auto no_progress = [](std::int64_t) {};

/// Every `stride`-th number from 0 on rank 0; empty on other ranks, as the farm requires.
std::vector<std::int64_t> tiles_on_rank_0(const MpiSession& session, std::int64_t count,
                                          std::int64_t stride = 1)
{
    std::vector<std::int64_t> tiles;
    for (std::int64_t i = 0; i < count && session.rank() == 0; ++i) {
        tiles.push_back(stride * i);
    }
    return tiles;
}

FarmReport run_farm(const MpiSession& session, const std::vector<std::int64_t>& tiles,
                    const TileWork& tile_work, const StopRequest& stop)
{
    constexpr std::chrono::seconds patience{60};
    Node node(session);
    FarmReport report = farm_out(session, node, tiles, tile_work, stop, patience);
    node.free();
    return report;
}

/// Runs the farm without writing anything.
FarmReport compute_all(const MpiSession& session, const std::vector<std::int64_t>& tiles,
                       const std::function<void(std::int64_t)>& compute,
                       const std::function<bool()>& stop_requested = never,
                       const std::function<void(std::int64_t)>& on_progress = no_progress)
{
    const auto compute_whole = [&](std::int64_t number, const std::function<bool()>&) {
        compute(number);
        return true;
    };
    return run_farm(session, tiles, {compute_whole, [](std::int64_t) {}, on_progress},
                    {stop_requested, never});
}

/// How often each tile number in [0, numbers) was computed by all ranks; returned on all ranks.
std::vector<int> over_all_ranks(const MpiSession& session, std::vector<int> times)
{
    MPI_Allreduce(MPI_IN_PLACE, times.data(), int(times.size()), MPI_INT, MPI_SUM,
                  session.communicator());
    return times;
}

void work_for(std::chrono::microseconds duration)
{
    std::this_thread::sleep_for(duration); // other ranks of a small machine may compute meanwhile
}

/// The parameter: OVERTURN_RANKS_PER_NODE; 0: not set.
class Farm : public testing::TestWithParam<int> {
protected:
    Farm()
    {
        if (GetParam() > 0) {
            setenv("OVERTURN_RANKS_PER_NODE", std::to_string(GetParam()).c_str(), 1);
        }
    }
    ~Farm() override { unsetenv("OVERTURN_RANKS_PER_NODE"); }

    static int nodes(const MpiSession& session)
    {
        return GetParam() == 0 ? 1 : (session.size() + GetParam() - 1) / GetParam();
    }
};

INSTANTIATE_TEST_SUITE_P(RanksPerNode, Farm, testing::Values(0, 1, 2));

TEST_P(Farm, ComputesEachTileOnce)
{
    const MpiSession session;
    for (const int count : {0, 1, 2, 3, 4, 7, 50, 1000}) {
        std::vector<int> times(std::size_t(count), 0);
        const FarmReport report =
            compute_all(session, tiles_on_rank_0(session, count),
                        [&](std::int64_t number) { ++times[std::size_t(number)]; });
        EXPECT_EQ(over_all_ranks(session, times), std::vector<int>(std::size_t(count), 1));
        EXPECT_EQ(report.all.tiles, count);
        EXPECT_FALSE(report.stopped);
    }
}

TEST_P(Farm, ComputesOnlyTheTilesOfTheList)
{
    const MpiSession session;
    std::vector<int> times(300, 0);
    compute_all(session, tiles_on_rank_0(session, 100, 3),
                [&](std::int64_t number) { ++times[std::size_t(number)]; });
    times = over_all_ranks(session, times);
    for (std::size_t number = 0; number < times.size(); ++number) {
        EXPECT_EQ(times[number], number % 3 == 0 ? 1 : 0) << number;
    }
}

TEST_P(Farm, ReportsTheShareOfEachRank)
{
    const MpiSession session;
    std::int64_t own = 0;
    const TileWork tile_work{.compute =
                                 [](std::int64_t, const std::function<bool()>&) {
                                     work_for(std::chrono::milliseconds(2));
                                     return true;
                                 },
                             .write =
                                 [&](std::int64_t) {
                                     work_for(std::chrono::milliseconds(1));
                                     ++own;
                                 },
                             .on_progress = no_progress};
    const FarmReport report = run_farm(session, tiles_on_rank_0(session, 60), tile_work, no_stop);

    std::vector<std::int64_t> counted(std::size_t(session.size()));
    MPI_Allgather(&own, 1, MPI_INT64_T, counted.data(), 1, MPI_INT64_T, session.communicator());
    if (session.rank() != 0) {
        EXPECT_TRUE(report.ranks.empty());
        return;
    }
    ASSERT_EQ(report.ranks.size(), counted.size());
    for (std::size_t rank = 0; rank < counted.size(); ++rank) {
        EXPECT_EQ(report.ranks[rank].tiles, counted[rank]);
        EXPECT_GE(report.ranks[rank].compute_seconds, 0.002 * double(counted[rank]));
        EXPECT_GE(report.ranks[rank].write_seconds, 0.001 * double(counted[rank]));
    }
    // Every other node requests its first tiles, and more ahead of each.
    EXPECT_GE(report.dispatch.requests, 2 * (nodes(session) - 1));
    EXPECT_EQ(report.dispatch.seconds > 0, nodes(session) > 1);
}

TEST_P(Farm, ProgressIncreasesToTheNumberOfTiles)
{
    const MpiSession session;
    std::vector<std::int64_t> seen{0};
    compute_all(
        session, tiles_on_rank_0(session, 200),
        [&](std::int64_t) { work_for(std::chrono::microseconds(100)); }, never,
        [&](std::int64_t done) { seen.push_back(done); });
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_EQ(seen.back(), session.rank() == 0 ? 200 : 0);
}

TEST_P(Farm, SharesUnequalTilesEvenly)
{
    const MpiSession session;
    // The first tenth of the tiles takes two thirds of the time.
    const auto cost = [](std::int64_t number) {
        return std::chrono::microseconds(number < 20 ? 19000 : 1000);
    };
    const FarmReport report = compute_all(session, tiles_on_rank_0(session, 200),
                                          [&](std::int64_t number) { work_for(cost(number)); });
    double most = 0;
    for (const RankShare& rank : report.ranks) {
        most = std::max(most, rank.compute_seconds);
    }
    // Equal parts of the list would give the first rank all the long tiles: 1.6 fair shares of the
    // 580 ms on two ranks, 2.4 on three, 3.6 on five. With tiles dispatched on request, the busiest
    // rank has 1.1 on an idle machine; on a busy one its time may be half as long again.
    if (session.rank() == 0 && session.size() > 1) {
        EXPECT_LT(most, 20 * 0.019 + 0.001 * (200.0 / session.size() - 20));
    }
}

TEST_P(Farm, AStopOnAnyRankLeavesTheRestUncomputed)
{
    const MpiSession session;
    for (int stopping_rank = 0; stopping_rank < session.size(); ++stopping_rank) {
        constexpr int count = 2000;
        std::vector<int> times(count, 0);
        int own = 0;
        const FarmReport report = compute_all(
            session, tiles_on_rank_0(session, count),
            [&](std::int64_t number) {
                work_for(std::chrono::microseconds(100));
                ++times[std::size_t(number)];
                ++own;
            },
            [&] { return session.rank() == stopping_rank && own >= 5; });
        times = over_all_ranks(session, times);
        const auto done = std::count(times.begin(), times.end(), 1);
        EXPECT_TRUE(report.stopped);
        EXPECT_EQ(report.all.tiles, done);
        EXPECT_EQ(*std::max_element(times.begin(), times.end()), 1);
        // Other nodes finish the tiles that they were given, in progress and ahead, each a 16th of
        // a fair share.
        EXPECT_LT(done, count / 2);
        if (session.rank() == stopping_rank) {
            EXPECT_EQ(own, 5);
        }
    }
}

TEST_P(Farm, AStopBeforeTheFirstTileComputesNothing)
{
    const MpiSession session;
    int own = 0;
    const FarmReport report = compute_all(
        session, tiles_on_rank_0(session, 100), [&](std::int64_t) { ++own; }, [] { return true; });
    EXPECT_EQ(own, 0);
    EXPECT_EQ(report.all.tiles, 0);
    EXPECT_TRUE(report.stopped);
}

TEST_P(Farm, ATileAbandonedAtAStopIsNeitherWrittenNorCounted)
{
    const MpiSession session;
    const int stopping_rank = session.size() - 1;
    int begun = 0;
    std::int64_t written = 0;
    const auto stop = [&] { return session.rank() == stopping_rank && begun >= 3; };
    const TileWork tile_work{.compute =
                                 [&](std::int64_t, const DropRequested& drop_requested) {
                                     work_for(std::chrono::milliseconds(1));
                                     ++begun;
                                     return !drop_requested();
                                 },
                             .write = [&](std::int64_t) { ++written; },
                             .on_progress = no_progress};
    const FarmReport report =
        run_farm(session, tiles_on_rank_0(session, 500), tile_work, {stop, stop});
    if (session.rank() == stopping_rank) {
        EXPECT_EQ(written, 2);
    }
    MPI_Allreduce(MPI_IN_PLACE, &written, 1, MPI_INT64_T, MPI_SUM, session.communicator());
    EXPECT_EQ(report.all.tiles, written);
    EXPECT_TRUE(report.stopped);
}

TEST_P(Farm, OtherRanksContinueWhileRank0ComputesALongTile)
{
    const MpiSession session;
    constexpr std::int64_t count = 100;
    // Of its node alone, rank 0 has tiles that no other rank takes.
    const std::int64_t others = GetParam() == 1 ? count / 2 : count - 1;
    std::int64_t done = 0;
    // The first tile of rank 0 lasts until the others have done theirs.
    const TileWork tile_work{.compute =
                                 [&](std::int64_t, const DropRequested& drop_requested) {
                                     while (session.rank() == 0 && session.size() > 1 &&
                                            done < others) {
                                         drop_requested();
                                     }
                                     return true;
                                 },
                             .write = [](std::int64_t) {},
                             .on_progress = [&](std::int64_t now_done) { done = now_done; }};
    const FarmReport report =
        run_farm(session, tiles_on_rank_0(session, count), tile_work, no_stop);
    EXPECT_EQ(report.all.tiles, count);
    if (session.rank() == 0 && session.size() > 1) {
        EXPECT_LE(report.ranks[0].tiles, count - others);
    }
}

TEST_P(Farm, AStopAfterTheLastTileIsIgnored)
{
    const MpiSession session;
    const FarmReport report = compute_all(
        session, tiles_on_rank_0(session, 0), [](std::int64_t) {}, [] { return true; });
    EXPECT_FALSE(report.stopped);
}

TEST(Node, HasTheRanksOfTheHostOrAsManyAsTheEnvironmentAllows)
{
    const MpiSession session;
    for (const int most : {0, 1, 2, 1000}) {
        if (most > 0) {
            setenv("OVERTURN_RANKS_PER_NODE", std::to_string(most).c_str(), 1);
        }
        Node node(session);
        unsetenv("OVERTURN_RANKS_PER_NODE");
        const int first = most == 0 ? 0 : session.rank() / most * most;
        const int end = most == 0 ? session.size() : std::min(first + most, session.size());
        EXPECT_EQ(node.leader().rank, first);
        EXPECT_EQ(node.is_leader(), session.rank() == first);
        ASSERT_EQ(int(node.ranks().size()), end - first);
        for (int rank = first; rank < end; ++rank) {
            EXPECT_EQ(node.ranks()[std::size_t(rank - first)].rank, rank);
        }
        EXPECT_EQ(&node.own(), &node.ranks()[std::size_t(session.rank() - first)]);
        node.free();
    }
}

TEST(Node, RefusesAWrongNumberOfRanks)
{
    for (const char* const wrong : {"0", "-1", "1.5", "two", "2 ", "1e999", "nan"}) {
        setenv("OVERTURN_RANKS_PER_NODE", wrong, 1);
        EXPECT_THROW(most_ranks_per_node(), Error) << wrong;
    }
    for (const char* const unlimited : {"", "99999999999"}) {
        setenv("OVERTURN_RANKS_PER_NODE", unlimited, 1);
        EXPECT_EQ(most_ranks_per_node(), std::numeric_limits<int>::max());
    }
    unsetenv("OVERTURN_RANKS_PER_NODE");
}

TEST(MpiSession, GivesAllRanksTheValueOfRank0)
{
    const MpiSession session;
    EXPECT_EQ(session.from_rank_0(session.rank() == 0 ? 74 : 0), 74);
}

TEST(MpiSession, KnowsTheHostOfEachRankOnRank0)
{
    const MpiSession session;
    const auto& hosts = session.hosts();
    ASSERT_EQ(hosts.size(), session.rank() == 0 ? std::size_t(session.size()) : 0);
    for (const std::string& host : hosts) {
        EXPECT_EQ(host, hosts.front()); // the ranks of a test share one machine
        EXPECT_FALSE(host.empty());
    }
}

} // namespace
} // namespace overturn
