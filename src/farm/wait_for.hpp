// Waiting without occupying a core. MPI's own waiting spins, which takes the core from ranks that
// compute if there are more ranks than cores.
#pragma once

#include <mpi.h>

#include <chrono>
#include <thread>

namespace overturn {

/// Waiting ranks test for messages at this interval and sleep in between.
inline constexpr std::chrono::microseconds polling_interval{50};

inline void wait_for(MPI_Request& request)
{
    int arrived = 0;
    while (MPI_Test(&request, &arrived, MPI_STATUS_IGNORE), !arrived) {
        std::this_thread::sleep_for(polling_interval);
    }
}

} // namespace overturn
