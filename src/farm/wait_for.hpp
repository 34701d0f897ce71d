// Waiting without taking a core: MPI's own waiting spins, which takes it from ranks that compute
// when there are more ranks than cores.
#pragma once

#include <mpi.h>

#include <chrono>
#include <thread>

namespace overturn {

/// Waiting ranks look for messages this often and sleep in between.
inline constexpr std::chrono::microseconds between_looks{50};

inline void wait_for(MPI_Request& request)
{
    int arrived = 0;
    while (MPI_Test(&request, &arrived, MPI_STATUS_IGNORE), !arrived) {
        std::this_thread::sleep_for(between_looks);
    }
}

} // namespace overturn
