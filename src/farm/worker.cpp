#include "roles.hpp"
#include "wait_for.hpp"

#include <thread>

namespace overturn {

namespace {

using Clock = std::chrono::steady_clock;

/// A worker sends this many messages within the timeout, so that some of them may be late.
constexpr int messages_in_patience = 10;

/// The messages to and from rank 0. An answer may arrive while the worker computes.
class Rank0 {
public:
    Rank0(MPI_Comm communicator, std::chrono::seconds patience)
        : communicator_(communicator), patience_(patience)
    {}

    void request_range(WorkerMessage message)
    {
        MPI_Irecv(&range_, range_length, MPI_INT64_T, 0, range_tag, communicator_, &receiving_);
        message.requests_range = 1;
        send(message);
    }
    bool has_answered()
    {
        int arrived = 0;
        MPI_Test(&receiving_, &arrived, MPI_STATUS_IGNORE);
        return arrived != 0;
    }
    /// Waits for it. Time in which this rank itself was suspended does not count.
    TileRange answer()
    {
        auto start = Clock::now();
        auto last_test = start;
        while (!has_answered()) {
            const auto now = Clock::now();
            if (now - last_test > std::chrono::milliseconds(patience_) / 4) {
                start = now;
            }
            last_test = now;
            if (now - start > patience_) {
                throw SilentRank(0, patience_);
            }
            std::this_thread::sleep_for(polling_interval);
        }
        return range_;
    }
    // MPI sends small messages at once: MPI_Send does not wait until rank 0 receives.
    void send(const WorkerMessage& message) const
    {
        MPI_Send(&message, worker_message_length, MPI_INT64_T, 0, worker_message_tag,
                 communicator_);
    }

private:
    MPI_Comm communicator_;
    std::chrono::seconds patience_;
    MPI_Request receiving_ = MPI_REQUEST_NULL;
    TileRange range_;
};

} // namespace

RankShare work(const MpiSession& session, const TileWork& tile_work, const StopRequest& stop,
               std::chrono::seconds patience)
{
    RankShare share;
    RankShare reported;
    const auto report = [&](bool idle) {
        const double seconds = busy_seconds(share) - busy_seconds(reported);
        const WorkerMessage message{.idle = idle,
                                    .stop = stop.requested(),
                                    .tiles_done = share.tiles - reported.tiles,
                                    .busy_nanoseconds = std::int64_t(1e9 * seconds)};
        reported = share;
        return message;
    };
    Rank0 rank_0(session.communicator(), patience);
    Occasionally regular_report(std::chrono::milliseconds(patience) / messages_in_patience);
    const std::function<bool()> drop_requested = [&] {
        if (regular_report.is_due()) {
            rank_0.send(report(false));
        }
        return stop.overdue();
    };
    rank_0.request_range(report(true));
    while (true) {
        const TileRange range = rank_0.answer();
        if (range == end_of_work) {
            return share;
        }
        rank_0.request_range(report(range.empty())); // one range ahead
        for (auto number = range.begin; number < range.end && !stop.requested(); ++number) {
            do_tile(number, tile_work, drop_requested, share);
        }
        if (!range.empty() && !rank_0.has_answered()) {
            rank_0.send(report(true));
        }
    }
}

} // namespace overturn
