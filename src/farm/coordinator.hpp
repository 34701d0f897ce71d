// The duties of rank 0 to all nodes.
#pragma once

#include "messages.hpp"
#include "silence.hpp"

#include "overturn/farm/farm.hpp"
#include "overturn/farm/tile_dispatcher.hpp"
#include "overturn/text/mapped.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace overturn {

/// A longer measured time is not the cost of an answer: rank 0 was not running, or MPI opened a
/// connection.
inline constexpr double longest_answer = 1e-4; // [s]

/// Rank 0's view of the nodes. The first node is its own, which reaches it without messages.
class Coordinator : public Link {
public:
    Coordinator(const MpiSession& session, const std::vector<int>& leader_of_rank,
                const std::vector<std::int64_t>& tiles, const TileWork& tile_work,
                const StopRequest& stop, std::chrono::seconds patience)
        : session_(session), dispatcher_(tiles, session.size()), tile_work_(tile_work), stop_(stop),
          patience_(patience), nodes_(nodes_of(leader_of_rank)), silence_(patience, nodes_.size())
    {}

    /// Receives messages and answers every request that has arrived. Throws Error if a leader is
    /// silent.
    void communicate()
    {
        if (stop_.requested()) {
            dispatcher_.stop();
        }
        if (nodes_.size() > 1 && messages_.is_due()) {
            receive_all();
        }
        if (silence_.is_due()) {
            check_silence();
        }
        if (!has_ended_ && std::all_of(nodes_.begin(), nodes_.end(),
                                       [](const NodeView& node) { return node.is_done(); })) {
            has_ended_ = true;
            for (NodeView& node : nodes_) {
                reply(node, {end_of_work});
            }
        }
        tile_work_.on_progress(tiles_done_);
    }

    void send(const NodeMessage& message) override { receive(nodes_.front(), message); }
    std::optional<Answer> answer() override { return std::exchange(own_answer_, {}); }

    const DispatchCost& cost() const { return cost_; }

private:
    struct NodeView {
        int leader = 0;
        int ranks = 0;
        std::int64_t messages = 0;
        NodeMessage last = {};
        std::int64_t requested_ranges = 0; ///< 0: it does not wait for an answer

        bool is_done() const { return requested_ranges > 0 && last.idle; }
    };

    static std::vector<NodeView> nodes_of(const std::vector<int>& leader_of_rank)
    {
        std::map<int, int> ranks;
        for (const int leader : leader_of_rank) {
            ++ranks[leader];
        }
        return mapped(ranks, [](const auto& node) {
            return NodeView{.leader = node.first, .ranks = node.second};
        });
    }

    // In Open MPI 4.1 a probe that finds nothing fetches what has arrived, and only the next probe
    // reports it. With single probes, leaders whose tiles took as long as rank 0's waited half of
    // the time.
    void receive_all()
    {
        for (int empty_probes = 0; empty_probes < 2; ++empty_probes) {
            MPI_Status status;
            int waiting = 0;
            MPI_Iprobe(MPI_ANY_SOURCE, node_message_tag, session_.communicator(), &waiting,
                       &status);
            if (waiting) {
                NodeMessage message;
                MPI_Recv(&message, sizeof message, MPI_BYTE, status.MPI_SOURCE, node_message_tag,
                         session_.communicator(), MPI_STATUS_IGNORE);
                receive(*std::lower_bound(
                            nodes_.begin(), nodes_.end(), status.MPI_SOURCE,
                            [](const NodeView& node, int rank) { return node.leader < rank; }),
                        message);
                empty_probes = -1;
            }
        }
    }

    void receive(NodeView& node, const NodeMessage& message)
    {
        const auto start = Clock::now();
        ++node.messages;
        tiles_done_ += message.tiles_done - node.last.tiles_done;
        busy_nanoseconds_ += message.busy_nanoseconds - node.last.busy_nanoseconds;
        node.last = message;
        if (message.stop) {
            dispatcher_.stop();
        }
        if (message.requested_ranges > 0) {
            node.requested_ranges = message.requested_ranges;
            Answer ranges =
                dispatcher_.next_ranges(node.ranks, limits(), int(message.requested_ranges));
            if (!ranges.empty()) {
                reply(node, std::move(ranges));
            }
            if (!is_own(node)) {
                const std::chrono::duration<double> seconds = Clock::now() - start;
                ++cost_.requests;
                cost_.seconds += std::min(seconds.count(), longest_answer);
            }
        }
    }

    bool is_own(const NodeView& node) const { return &node == &nodes_.front(); }

    void reply(NodeView& node, Answer answer)
    {
        node.requested_ranges = 0;
        if (is_own(node)) {
            own_answer_ = std::move(answer);
            return;
        }
        MPI_Send(answer.data(), int(answer.size() * sizeof(TileRange)), MPI_BYTE, node.leader,
                 answer_tag, session_.communicator());
    }

    /// From the times that answers and tiles have taken so far.
    TileLimits limits() const
    {
        if (tiles_done_ == 0 || cost_.requests == 0) {
            return {};
        }
        return tile_limits(int(nodes_.size()), cost_.seconds / double(cost_.requests),
                           1e-9 * double(busy_nanoseconds_) / double(tiles_done_));
    }

    /// Throws if a leader has sent nothing for too long, and makes those that are done send a
    /// message.
    void check_silence()
    {
        if (const auto silent =
                silence_.silent_rank([this](std::size_t node) { return nodes_[node].messages; })) {
            const int rank = nodes_[*silent].leader;
            throw timeout_error(rank, " on " + session_.hosts()[std::size_t(rank)], patience_);
        }
        for (NodeView& node : nodes_) {
            if (node.is_done()) {
                reply(node, {});
            }
        }
    }

    const MpiSession& session_;
    TileDispatcher dispatcher_;
    const TileWork& tile_work_;
    const StopRequest& stop_;
    std::chrono::seconds patience_;
    std::vector<NodeView> nodes_; ///< ordered by leader
    IntervalTimer messages_{message_interval};
    SilenceCheck silence_;
    std::optional<Answer> own_answer_;
    bool has_ended_ = false;
    std::int64_t tiles_done_ = 0;
    std::int64_t busy_nanoseconds_ = 0;
    DispatchCost cost_;
};

} // namespace overturn
