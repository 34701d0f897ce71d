// The ranks of a run that share memory, which are those of one host. Each has its state there, and
// takes tiles from a pool that the first of them, the leader, fills.
#pragma once

#include "overturn/farm/mpi_session.hpp"
#include "overturn/farm/tile_pool.hpp"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace overturn {

/// Written by the rank, read by the leader; the signs of life of the leader are read by all.
struct RankState {
    int rank = 0; ///< in the session
    std::atomic<std::int64_t> signs_of_life{0};
    std::atomic<std::int64_t> tiles_done{0};
    std::atomic<std::int64_t> busy_nanoseconds{0}; ///< spent on them
    std::atomic<bool> takes_or_computes{false};
};

/// In the memory of the leader.
struct NodeState {
    TilePool pool;
    std::atomic<bool> stop{false};  ///< a rank was asked to stop: no rank takes tiles any more
    std::atomic<bool> ended{false}; ///< all tiles of the run are done, or it is to stop
};

/// The most ranks of a node: the value of the environment variable OVERTURN_RANKS_PER_NODE, which
/// divides the ranks of a host into several nodes. Throws Error if that is not a number from 1.
int most_ranks_per_node();

class Node {
public:
    /// With most_ranks_per_node() of rank 0. Collective over all ranks, which wait for each other.
    explicit Node(const MpiSession& session);

    /// Frees the memory. Collective over the ranks of the node; without it, the end of MPI does so.
    void free();

    bool is_leader() const { return rank_ == 0; }
    const RankState& leader() const { return ranks_[0]; }

    /// The leader of each rank's node, on rank 0; empty elsewhere.
    const std::vector<int>& leaders() const { return leaders_; }

    NodeState& state() const { return *state_; }
    std::span<RankState> ranks() const { return {ranks_, std::size_t(size_)}; }
    RankState& own() const { return ranks_[rank_]; }

private:
    int rank_ = 0; ///< in the node
    int size_ = 1;
    MPI_Comm communicator_ = MPI_COMM_NULL;
    MPI_Win window_ = MPI_WIN_NULL;
    NodeState* state_ = nullptr;
    RankState* ranks_ = nullptr;
    std::vector<int> leaders_;
};

} // namespace overturn
