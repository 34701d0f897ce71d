// What the ranks of a node do besides computing tiles.
#pragma once

#include "messages.hpp"
#include "silence.hpp"

#include "overturn/farm/farm.hpp"
#include "overturn/farm/node.hpp"

namespace overturn {

/// The duties of a rank that does not lead its node. Throws Error if the leader is silent.
class Member {
public:
    Member(const MpiSession& session, const Node& node, std::chrono::seconds patience)
        : session_(session), node_(node), patience_(patience), silence_(patience, 1)
    {}

    void attend()
    {
        if (silence_.is_due() && silence_.silent_rank([this](std::size_t) {
                return node_.leader().signs_of_life.load();
            })) {
            throw timeout_error(node_.leader().rank, " on " + session_.host(), patience_);
        }
    }

private:
    const MpiSession& session_;
    const Node& node_;
    std::chrono::seconds patience_;
    SilenceCheck silence_;
};

/// The duties of the leader of a node: it fills the pool, and reports to rank 0. Throws Error if
/// rank 0 or a rank of the node is silent.
class Leader {
public:
    /// report_interval: a message is sent at least so often.
    Leader(const MpiSession& session, const Node& node, Link& link, std::chrono::seconds patience,
           Clock::duration report_interval)
        : session_(session), node_(node), link_(link), patience_(patience),
          report_{report_interval}, silence_(patience, node.ranks().size())
    {}

    void attend()
    {
        NodeState& state = node_.state();
        if (const auto answer = link_.answer()) {
            accept(*answer);
        }
        if (state.stop) {
            state.pool.clear();
        }
        const int room = state.pool.room();
        const NodeMessage report = message();
        if (!waits_ && !state.ended && room > 0 && state.pool.tiles() <= tiles_of_last_answer_) {
            request(report, room);
        } else if (report.idle > reported_.idle || report_.is_due()) {
            send(report);
        }
        if (silence_.is_due()) {
            check_silence();
        }
    }

private:
    void accept(const Answer& answer)
    {
        waits_ = false;
        ++signs_of_rank_0_;
        tiles_of_last_answer_ = 0;
        if (answer == Answer{end_of_work}) {
            node_.state().ended = true;
            return;
        }
        for (const TileRange& range : answer) {
            node_.state().pool.put(range);
            tiles_of_last_answer_ += range.length();
        }
    }

    NodeMessage message() const
    {
        // The pool first: a rank that has emptied it since has said that it takes tiles.
        bool idle = node_.state().pool.tiles() == 0;
        NodeMessage sum{.stop = node_.state().stop};
        for (const RankState& rank : node_.ranks()) {
            idle = idle && !rank.takes_or_computes;
            sum.tiles_done += rank.tiles_done;
            sum.busy_nanoseconds += rank.busy_nanoseconds;
        }
        sum.idle = idle;
        return sum;
    }

    void request(NodeMessage report, int room)
    {
        waits_ = true;
        report.requested_ranges = room;
        send(report);
    }

    void send(const NodeMessage& report)
    {
        reported_ = report;
        link_.send(report);
    }

    /// In the place of its own signs are those of rank 0, which owes none unless a request waits.
    void check_silence()
    {
        signs_of_rank_0_ += waits_ ? 0 : 1;
        const auto signs = [this](std::size_t i) {
            return i == 0 ? signs_of_rank_0_ : node_.ranks()[i].signs_of_life.load();
        };
        const auto silent = silence_.silent_rank(signs);
        if (silent && *silent == 0) {
            throw timeout_error(0, "", patience_);
        }
        if (silent) {
            throw timeout_error(node_.ranks()[*silent].rank, " on " + session_.host(), patience_);
        }
    }

    const MpiSession& session_;
    const Node& node_;
    Link& link_;
    std::chrono::seconds patience_;
    IntervalTimer report_;
    SilenceCheck silence_;
    NodeMessage reported_;
    bool waits_ = false; ///< for an answer
    std::int64_t signs_of_rank_0_ = 0;
    std::int64_t tiles_of_last_answer_ = 0;
};

} // namespace overturn
