// The first rank of a farm: it hands out ranges of tiles, and computes in between.
#pragma once

#include "occasionally.hpp"

#include "overturn/farm/farm.hpp"
#include "overturn/farm/tile_dealer.hpp"

namespace overturn {

/// Rank 0: answers every request that has come, then does one tile of its own, until nothing is
/// left and no worker has anything to do.
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
        Clock::time_point heard = Clock::now();
        bool waits = false; ///< for an answer
        bool idle = false;  ///< and has nothing else to do

        bool is_done() const { return waits && idle; }
    };

    void attend();
    void hear_all();
    void hear(int rank);
    void answer(int rank, const TileRange& range);
    void call_the_roll();
    void dismiss_all();
    RangeLimits limits() const;

    MPI_Comm communicator_;
    TileDealer dealer_;
    const TileWork& tile_work_;
    const std::function<void(std::int64_t)>& on_progress_;
    const StopRequest& stop_;
    std::chrono::seconds patience_;
    std::vector<Worker> workers_; ///< by rank; the first is rank 0 itself, and not asked for
    int still_busy_;              ///< workers that are not done
    Occasionally roll_call_{std::chrono::milliseconds(patience_) / 20};
    Clock::time_point last_roll_call_ = Clock::now();
    RankShare share_;
    std::int64_t done_by_workers_ = 0;
    double seconds_of_workers_ = 0; ///< that they took for them
    DealingShare dealing_;
};

} // namespace overturn
