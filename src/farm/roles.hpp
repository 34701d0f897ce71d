// The roles of the ranks in a farm, and their messages: rank 0 leads, all others work, and both
// compute tiles. A worker requests its next range while it computes the current one, and rank 0
// answers at once while tiles are left. Once none is left, rank 0 keeps the request. At
// intervals it answers with an empty range, after which the worker repeats its request, which shows
// that it is alive; the last answer is `end_of_work`.
#pragma once

#include "overturn/farm/farm.hpp"
#include "overturn/farm/tile_dealer.hpp"

namespace overturn {

inline constexpr int worker_message_tag = 1;
inline constexpr int range_tag = 2;

/// From a worker to rank 0.
struct WorkerMessage {
    std::int64_t requests_range = 0;   ///< 0 or 1
    std::int64_t idle = 0;             ///< 1: it has no tile left to compute
    std::int64_t stop = 0;             ///< 1: it was asked to stop
    std::int64_t tiles_done = 0;       ///< since the last message
    std::int64_t busy_nanoseconds = 0; ///< spent on them
};
inline constexpr int worker_message_length = 5;
inline constexpr int range_length = 2;
static_assert(sizeof(WorkerMessage) == worker_message_length * sizeof(std::int64_t));
static_assert(sizeof(TileRange) == range_length * sizeof(std::int64_t));

/// From rank 0: all tiles are done, or the run is to stop.
inline constexpr TileRange end_of_work{-1, -1};

/// For rank 0: answers every request that has arrived, then computes one tile, until no tile is
/// left and all workers are done. Returns its own share and the cost of dealing. Throws SilentRank.
FarmReport lead(const MpiSession& session, const std::vector<std::int64_t>& tiles,
                const TileWork& tile_work,
                const std::function<void(std::int64_t done)>& on_progress, const StopRequest& stop,
                std::chrono::seconds patience);

/// For the other ranks: requests ranges of tiles and computes them, until rank 0 has sent
/// `end_of_work`. Throws SilentRank.
RankShare work(const MpiSession& session, const TileWork& tile_work, const StopRequest& stop,
               std::chrono::seconds patience);

/// Limits how often something is done in a loop.
class Occasionally {
    using Clock = std::chrono::steady_clock;

public:
    explicit Occasionally(Clock::duration interval) : interval_(interval) {}

    /// True at most once per interval.
    bool is_due()
    {
        const auto now = Clock::now();
        const bool due = now - last_ >= interval_;
        last_ = due ? now : last_;
        return due;
    }

private:
    Clock::duration interval_;
    Clock::time_point last_ = Clock::now();
};

inline double busy_seconds(const RankShare& share)
{
    return share.compute_seconds + share.write_seconds;
}

/// Computes and writes one tile, and measures both times.
inline void do_tile(std::int64_t number, const TileWork& tile_work,
                    const std::function<bool()>& drop_requested, RankShare& share)
{
    using Clock = std::chrono::steady_clock;
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

} // namespace overturn
