#include "roles.hpp"
#include "wait_for.hpp"

#include <algorithm>
#include <thread>

namespace overturn {

namespace {

/// While rank 0 computes a tile, workers wait no longer than this for an answer. Probing for their
/// messages takes a thousandth of it.
constexpr std::chrono::milliseconds answer_interval{10};

/// A longer measured time is not the cost of an answer: rank 0 was not running, or MPI opened a
/// connection.
constexpr double longest_answer = 1e-4; // [s]

class Leader {
public:
    Leader(const MpiSession& session, const std::vector<std::int64_t>& tiles,
           const TileWork& tile_work, const std::function<void(std::int64_t)>& on_progress,
           const StopRequest& stop, std::chrono::seconds patience)
        : communicator_(session.communicator()), dealer_(tiles, session.size()),
          tile_work_(tile_work), on_progress_(on_progress), stop_(stop), patience_(patience),
          workers_(std::size_t(session.size())), busy_workers_(session.size() - 1)
    {}

    FarmReport lead()
    {
        Occasionally communication(answer_interval);
        const std::function<bool()> drop_requested = [&] {
            if (communication.is_due()) {
                communicate();
            }
            return stop_.overdue();
        };
        while (true) {
            communicate();
            const TileRange own = dealer_.deal_one();
            if (!own.empty()) {
                do_tile(own.begin, tile_work_, drop_requested, share_);
            } else if (busy_workers_ > 0) {
                std::this_thread::sleep_for(polling_interval);
            } else {
                for (int rank = 1; rank < int(workers_.size()); ++rank) {
                    answer(rank, end_of_work);
                }
                return {.ranks = {share_}, .dealing = dealing_};
            }
        }
    }

private:
    using Clock = std::chrono::steady_clock;

    struct Worker {
        Clock::time_point last_message = Clock::now();
        bool waits = false; ///< for an answer to its request
        bool idle = false;  ///< has no tile left to compute

        bool is_done() const { return waits && idle; }
    };

    void communicate()
    {
        if (stop_.requested()) {
            dealer_.stop();
        }
        receive_all();
        if (timeout_check_.is_due()) {
            check_timeouts();
        }
        on_progress_(share_.tiles + done_by_workers_);
    }

    // In Open MPI 4.1 a probe that finds nothing fetches what has arrived, and only the next probe
    // reports it. With single probes, workers whose tiles took as long as rank 0's waited half of
    // the time.
    void receive_all()
    {
        for (int empty_probes = 0; empty_probes < 2; ++empty_probes) {
            MPI_Status status;
            int waiting = 0;
            MPI_Iprobe(MPI_ANY_SOURCE, worker_message_tag, communicator_, &waiting, &status);
            if (waiting) {
                receive_from(status.MPI_SOURCE);
                empty_probes = -1;
            }
        }
    }

    void receive_from(int rank)
    {
        const auto start = Clock::now();
        WorkerMessage message;
        MPI_Recv(&message, worker_message_length, MPI_INT64_T, rank, worker_message_tag,
                 communicator_, MPI_STATUS_IGNORE);
        Worker& worker = workers_[std::size_t(rank)];
        worker.last_message = start;
        done_by_workers_ += message.tiles_done;
        busy_seconds_of_workers_ += 1e-9 * double(message.busy_nanoseconds);
        if (message.stop) {
            dealer_.stop();
        }
        const bool was_done = worker.is_done();
        worker.waits = worker.waits || message.requests_range;
        worker.idle = message.idle; // counts only while it waits: otherwise an answer is on its way
        busy_workers_ += int(was_done) - int(worker.is_done());
        if (message.requests_range) {
            const TileRange range = dealer_.deal(limits());
            if (!range.empty()) {
                answer(rank, range);
            }
            const std::chrono::duration<double> seconds = Clock::now() - start;
            ++dealing_.requests;
            dealing_.seconds += std::min(seconds.count(), longest_answer);
        }
    }

    void answer(int rank, const TileRange& range)
    {
        MPI_Send(&range, range_length, MPI_INT64_T, rank, range_tag, communicator_);
        Worker& worker = workers_[std::size_t(rank)];
        busy_workers_ += int(worker.is_done());
        worker.waits = false;
    }

    /// From the times that answers and tiles have taken so far.
    RangeLimits limits() const
    {
        const std::int64_t done = share_.tiles + done_by_workers_;
        if (done == 0 || dealing_.requests == 0) {
            return {};
        }
        return range_limits(int(workers_.size()), dealing_.seconds / double(dealing_.requests),
                            (busy_seconds(share_) + busy_seconds_of_workers_) / double(done));
    }

    /// Throws if a worker has sent nothing for too long, and makes those that are done send a
    /// message. If rank 0 itself was suspended, or its disk hung, the time starts again for all
    /// workers: the same may have happened to them.
    void check_timeouts()
    {
        const auto now = Clock::now();
        const bool was_suspended =
            now - last_timeout_check_ > std::chrono::milliseconds(patience_) / 2;
        last_timeout_check_ = now;
        for (int rank = 1; rank < int(workers_.size()); ++rank) {
            Worker& worker = workers_[std::size_t(rank)];
            if (was_suspended) {
                worker.last_message = now;
            } else if (now - worker.last_message > patience_) {
                throw SilentRank(rank, patience_);
            }
            if (worker.is_done()) {
                answer(rank, {});
            }
        }
    }

    MPI_Comm communicator_;
    TileDealer dealer_;
    const TileWork& tile_work_;
    const std::function<void(std::int64_t)>& on_progress_;
    const StopRequest& stop_;
    std::chrono::seconds patience_;
    std::vector<Worker> workers_; ///< by rank; the first, rank 0 itself, is unused
    int busy_workers_;            ///< those that are not done
    Occasionally timeout_check_{std::chrono::milliseconds(patience_) / 20};
    Clock::time_point last_timeout_check_ = Clock::now();
    RankShare share_;
    std::int64_t done_by_workers_ = 0;
    double busy_seconds_of_workers_ = 0;
    DealingShare dealing_;
};

} // namespace

FarmReport lead(const MpiSession& session, const std::vector<std::int64_t>& tiles,
                const TileWork& tile_work, const std::function<void(std::int64_t)>& on_progress,
                const StopRequest& stop, std::chrono::seconds patience)
{
    return Leader(session, tiles, tile_work, on_progress, stop, patience).lead();
}

} // namespace overturn
