// What the ranks of a farm say to each other. A worker asks for a range while it still computes the
// one before. Rank 0 answers at once while tiles are left. Then it keeps the request, answers it
// now and then with an empty range, at which the worker asks again and so shows that it is there,
// and in the end with the dismissal.
#pragma once

#include "overturn/farm/tile_dealer.hpp"

#include <mpi.h>

#include <cstdint>

namespace overturn {

inline constexpr int word_tag = 1;
inline constexpr int range_tag = 2;

/// From a worker to rank 0.
struct Word {
    std::int64_t asking = 0;           ///< 1: it wants a range
    std::int64_t idle = 0;             ///< 1: it has nothing else to do
    std::int64_t stop = 0;             ///< 1: it was asked to stop
    std::int64_t tiles_done = 0;       ///< since the last word
    std::int64_t busy_nanoseconds = 0; ///< with them
};
inline constexpr int word_length = 5;
inline constexpr int range_length = 2;
static_assert(sizeof(Word) == word_length * sizeof(std::int64_t));
static_assert(sizeof(TileRange) == range_length * sizeof(std::int64_t));

/// From rank 0: every tile is done, or left because of a stop.
inline constexpr TileRange dismissal{-1, -1};

inline bool is_dismissal(const TileRange& range)
{
    return range.begin < 0;
}

} // namespace overturn
