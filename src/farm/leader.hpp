// Rank 0 of a farm: it hands out ranges of tiles, and computes tiles in between.
#pragma once

#include "occasionally.hpp"

#include "overturn/farm/farm.hpp"
#include "overturn/farm/tile_dealer.hpp"

namespace overturn {

/// Answers every request that has arrived, then computes one tile, until no tile is left and all
/// workers are done.
class Leader {
public:
    Leader(const MpiSession& session, const std::vector<std::int64_t>& tiles,
           const TileWork& tile_work, const std::function<void(std::int64_t)>& on_progress,
           const StopRequest& stop, std::chrono::seconds patience);

    /// Throws SilentRank.
    RankShare lead();

    const DealingShare& dealing() const { return dealing_; }

private:
    using Clock = std::chrono::steady_clock;

    struct Worker {
        Clock::time_point last_message = Clock::now();
        bool waits = false; ///< for an answer to its request
        bool idle = false;  ///< has no tile left to compute

        bool is_done() const { return waits && idle; }
    };

    void communicate();
    void receive_all();
    void receive_from(int rank);
    void answer(int rank, const TileRange& range);
    void check_timeouts();
    void end_work();
    RangeLimits limits() const;

    MPI_Comm communicator_;
    TileDealer dealer_;
    const TileWork& tile_work_;
    const std::function<void(std::int64_t)>& on_progress_;
    const StopRequest& stop_;
    std::chrono::seconds patience_;
    std::vector<Worker> workers_; ///< by rank; the first, rank 0 itself, is unused
    int busy_workers_;            ///< those that are not done
    Occasionally timeout_check_{std::chrono::milliseconds(patience_) / 20};
    Clock::time_point last_timeout_check_ = Clock::now();
    RankShare share_;
    std::int64_t done_by_workers_ = 0;
    double busy_seconds_of_workers_ = 0;
    DealingShare dealing_;
};

} // namespace overturn
