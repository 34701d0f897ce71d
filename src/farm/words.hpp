// What the ranks of a farm say to each other.
#pragma once

#include "overturn/farm/tile_dealer.hpp"

#include <mpi.h>

#include <chrono>
#include <cstdint>

namespace overturn {

inline constexpr int word_tag = 1;
inline constexpr int range_tag = 2;

/// From a worker to rank 0.
struct Word {
    enum Kind : std::int64_t { asking, alive, leaving };

    Kind kind = asking;                ///< who asks wants a range; who leaves is not heard again
    std::int64_t tiles_done = 0;       ///< since the last word
    std::int64_t busy_nanoseconds = 0; ///< with them
    std::int64_t stop = 0;             ///< 1: the worker was asked to stop
};
inline constexpr int word_length = 4;
inline constexpr int range_length = 2;
static_assert(sizeof(Word) == word_length * sizeof(std::int64_t));
static_assert(sizeof(TileRange) == range_length * sizeof(std::int64_t));

/// Waiting ranks look for messages this often and sleep in between: MPI's own waiting spins, and
/// takes a core from ranks that compute when there are more ranks than cores.
inline constexpr std::chrono::microseconds between_looks{50};

} // namespace overturn
