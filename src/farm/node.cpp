#include "overturn/farm/node.hpp"

#include "overturn/text/error.hpp"
#include "overturn/text/parse_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>

namespace overturn {

int most_ranks_per_node()
{
    constexpr int unlimited = std::numeric_limits<int>::max();
    const char* const text = std::getenv("OVERTURN_RANKS_PER_NODE");
    if (text == nullptr || *text == 0) {
        return unlimited;
    }
    const ParsedNumber number = parse_number(text);
    if (!is_whole(number, text) || !std::isgreaterequal(number.value, 1) ||
        number.value != std::floor(number.value)) {
        throw Error(
            exit_code::usage,
            "the environment variable OVERTURN_RANKS_PER_NODE is \"{}\". It must be a whole "
            "number from 1: the most ranks that share a pool of tiles.",
            text);
    }
    return int(std::min<double>(number.value, unlimited));
}

Node::Node(const MpiSession& session)
{
    // Ranks sleep until rank 0 sends this; the functions of MPI below do not.
    const int most = session.from_rank_0(session.rank() == 0 ? most_ranks_per_node() : 0);
    MPI_Comm host = MPI_COMM_NULL;
    MPI_Comm_split_type(session.communicator(), MPI_COMM_TYPE_SHARED, session.rank(), MPI_INFO_NULL,
                        &host);
    int place = 0;
    MPI_Comm_rank(host, &place);
    MPI_Comm_split(host, place / most, session.rank(), &communicator_);
    MPI_Comm_free(&host);
    MPI_Comm_rank(communicator_, &rank_);
    MPI_Comm_size(communicator_, &size_);

    static_assert(sizeof(NodeState) % alignof(RankState) == 0);
    const std::size_t bytes = sizeof(NodeState) + std::size_t(size_) * sizeof(RankState);
    void* memory = nullptr;
    MPI_Win_allocate_shared(is_leader() ? MPI_Aint(bytes) : 0, 1, MPI_INFO_NULL, communicator_,
                            static_cast<void*>(&memory), &window_);
    MPI_Aint size = 0;
    int unit = 0;
    constexpr int rank_of_leader = 0;
    MPI_Win_shared_query(window_, rank_of_leader, &size, &unit, static_cast<void*>(&memory));
    state_ = static_cast<NodeState*>(memory);
    ranks_ = reinterpret_cast<RankState*>(state_ + 1);
    if (is_leader()) {
        std::construct_at(state_);
        std::uninitialized_default_construct_n(ranks_, size_);
    }
    MPI_Barrier(communicator_);
    own().rank = session.rank();
    MPI_Barrier(communicator_);
    leaders_ = session.gather_on_rank_0(leader().rank);
}

void Node::free()
{
    MPI_Win_free(&window_);
    MPI_Comm_free(&communicator_);
}

} // namespace overturn
