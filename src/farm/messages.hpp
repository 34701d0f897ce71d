// The messages between the leaders of nodes and rank 0.
#pragma once

#include "overturn/farm/tile_pool.hpp"

#include <mpi.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace overturn {

inline constexpr int node_message_tag = 1;
inline constexpr int answer_tag = 2;

/// From the leader of a node to rank 0. Without padding: messages are sent as bytes.
struct NodeMessage {
    std::int64_t requested_ranges = 0; ///< at most so many, however long; 0: none are requested
    std::int64_t idle = 0;             ///< 1: its ranks have no tile left to compute
    std::int64_t stop = 0;             ///< 1: one of them was asked to stop
    std::int64_t tiles_done = 0;       ///< by all of them, since the beginning
    std::int64_t busy_nanoseconds = 0; ///< spent on them
};

/// From rank 0: what the node is given, or only `end_of_work`.
using Answer = std::vector<TileRange>;

/// All tiles are done, or the run is to stop.
inline constexpr TileRange end_of_work{-1, -1};

/// How the leader of a node reaches rank 0.
class Link {
public:
    virtual ~Link() = default;
    virtual void send(const NodeMessage& message) = 0;
    /// The answer to the last request, once it is there.
    virtual std::optional<Answer> answer() = 0;
};

class LinkByMpi : public Link {
public:
    explicit LinkByMpi(MPI_Comm communicator) : communicator_(communicator) {}

    // MPI sends small messages at once: MPI_Send does not wait until rank 0 receives.
    void send(const NodeMessage& message) override
    {
        if (message.requested_ranges > 0) {
            MPI_Irecv(ranges_.data(), int(sizeof ranges_), MPI_BYTE, 0, answer_tag, communicator_,
                      &receiving_);
        }
        MPI_Send(&message, sizeof message, MPI_BYTE, 0, node_message_tag, communicator_);
    }

    std::optional<Answer> answer() override
    {
        int arrived = 0;
        MPI_Status status;
        if (receiving_ == MPI_REQUEST_NULL ||
            (MPI_Test(&receiving_, &arrived, &status), arrived == 0)) {
            return {};
        }
        int bytes = 0;
        MPI_Get_count(&status, MPI_BYTE, &bytes);
        return Answer(ranges_.begin(), ranges_.begin() + bytes / int(sizeof(TileRange)));
    }

private:
    MPI_Comm communicator_;
    MPI_Request receiving_ = MPI_REQUEST_NULL;
    std::array<TileRange, TilePool::most_ranges> ranges_;
};

} // namespace overturn
