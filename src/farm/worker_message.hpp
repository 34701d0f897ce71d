// The messages between the ranks of a farm. A worker requests its next range while it computes the
// current one, and rank 0 answers at once while tiles are left. Then rank 0 keeps the request. At
// intervals it answers with an empty range, after which the worker repeats its request, which shows
// that it is alive; the last answer is `end_of_work`.
#pragma once

#include "overturn/farm/tile_dealer.hpp"

#include <mpi.h>

#include <cstdint>

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

/// From rank 0: every tile is done, or left because of a stop.
inline constexpr TileRange end_of_work{-1, -1};

inline bool is_end_of_work(const TileRange& range)
{
    return range.begin < 0;
}

} // namespace overturn
