// Rank 0 coordinates the other ranks, the workers, and all compute tiles. A worker requests its
// next range while it computes the current one, and rank 0 answers at once while tiles are left.
// Once none is left, rank 0 keeps the request. At intervals it answers with an empty range, after
// which the worker repeats its request, which shows that it is alive; the last answer is
// `end_of_work`.
#include "overturn/farm/farm.hpp"

#include "overturn/farm/tile_dispatcher.hpp"
#include "overturn/text/error.hpp"

#include <algorithm>
#include <thread>

namespace overturn {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int worker_message_tag = 1;
constexpr int range_tag = 2;

/// From a worker to rank 0. Without padding: messages are sent as bytes.
struct WorkerMessage {
    std::int64_t requests_range = 0;   ///< 0 or 1
    std::int64_t idle = 0;             ///< 1: it has no tile left to compute
    std::int64_t stop = 0;             ///< 1: it was asked to stop
    std::int64_t tiles_done = 0;       ///< since the last message
    std::int64_t busy_nanoseconds = 0; ///< spent on them
};

/// From rank 0: all tiles are done, or the run is to stop.
constexpr TileRange end_of_work{-1, -1};

/// Limits how often something is done in a loop.
struct IntervalTimer {
    Clock::duration interval;
    Clock::time_point last = Clock::now();

    /// True at most once per interval.
    bool is_due()
    {
        const auto now = Clock::now();
        const bool due = now - last >= interval;
        last = due ? now : last;
        return due;
    }
};

double busy_seconds(const RankShare& share)
{
    return share.compute_seconds + share.write_seconds;
}

/// Computes and writes one tile, and measures both times.
void compute_and_write(std::int64_t number, const TileWork& tile_work,
                       const DropRequested& drop_requested, RankShare& share)
{
    const auto start = Clock::now();
    const bool was_computed = tile_work.compute(number, drop_requested);
    const auto computed = Clock::now();
    share.compute_seconds += std::chrono::duration<double>(computed - start).count();
    if (!was_computed) {
        return;
    }
    tile_work.write(number);
    share.write_seconds += std::chrono::duration<double>(Clock::now() - computed).count();
    ++share.tiles;
}

/// on_host: " on HOST"; empty if the host is unknown.
Error timeout_error(int rank, const std::string& on_host, std::chrono::seconds patience)
{
    return Error(exit_code::stopped,
                 "rank {}{} has not responded for {} s: it is suspended, its disk hangs, or its "
                 "host is unreachable. Finished tiles are kept. Run the same command again to "
                 "resume.",
                 rank, on_host, patience.count());
}

/// A worker sends this many messages within the timeout, so that some of them may be late.
constexpr int messages_in_patience = 10;

/// The messages to and from rank 0. An answer may arrive while the worker computes.
class LinkToRank0 {
public:
    LinkToRank0(MPI_Comm communicator, std::chrono::seconds patience)
        : communicator_(communicator), patience_(patience)
    {}

    void request_range(WorkerMessage message)
    {
        MPI_Irecv(&range_, sizeof range_, MPI_BYTE, 0, range_tag, communicator_, &receiving_);
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
                throw timeout_error(0, "", patience_);
            }
            std::this_thread::sleep_for(polling_interval);
        }
        return range_;
    }
    // MPI sends small messages at once: MPI_Send does not wait until rank 0 receives.
    void send(const WorkerMessage& message) const
    {
        MPI_Send(&message, sizeof message, MPI_BYTE, 0, worker_message_tag, communicator_);
    }

private:
    MPI_Comm communicator_;
    std::chrono::seconds patience_;
    MPI_Request receiving_ = MPI_REQUEST_NULL;
    TileRange range_;
};

/// Requests ranges of tiles and computes them, until rank 0 has sent `end_of_work`. Throws Error if
/// rank 0 is silent.
RankShare run_worker(const MpiSession& session, const TileWork& tile_work, const StopRequest& stop,
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
    LinkToRank0 rank_0(session.communicator(), patience);
    IntervalTimer regular_report{std::chrono::milliseconds(patience) / messages_in_patience};
    // The computation of a tile calls it regularly, so messages are sent there, too.
    const DropRequested drop_requested = [&] {
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
            compute_and_write(number, tile_work, drop_requested, share);
        }
        if (!range.empty() && !rank_0.has_answered()) {
            rank_0.send(report(true));
        }
    }
}

/// While rank 0 computes a tile, workers wait no longer than this for an answer. Probing for their
/// messages takes a thousandth of it.
constexpr std::chrono::milliseconds answer_interval{10};

/// A longer measured time is not the cost of an answer: rank 0 was not running, or MPI opened a
/// connection.
constexpr double longest_answer = 1e-4; // [s]

class Coordinator {
public:
    Coordinator(const MpiSession& session, const std::vector<std::int64_t>& tiles,
                const TileWork& tile_work, const StopRequest& stop, std::chrono::seconds patience)
        : session_(session), dispatcher_(tiles, session.size()), tile_work_(tile_work), stop_(stop),
          patience_(patience), workers_(std::size_t(session.size()))
    {}

    /// Answers every request that has arrived, then computes one tile, until no tile is left and
    /// all workers are done. Returns its own share and the cost of dispatching. Throws Error if a
    /// worker is silent.
    FarmReport run()
    {
        IntervalTimer communication{answer_interval};
        // The computation of a tile calls it regularly, so messages are handled there, too.
        const DropRequested drop_requested = [&] {
            if (communication.is_due()) {
                communicate();
            }
            return stop_.overdue();
        };
        while (true) {
            communicate();
            const TileRange own = dispatcher_.next_tile();
            if (!own.empty()) {
                compute_and_write(own.begin, tile_work_, drop_requested, share_);
            } else if (!std::all_of(workers_.begin() + 1, workers_.end(),
                                    [](const Worker& worker) { return worker.is_done(); })) {
                std::this_thread::sleep_for(polling_interval);
            } else {
                for (int rank = 1; rank < int(workers_.size()); ++rank) {
                    answer(rank, end_of_work);
                }
                return {.ranks = {share_}, .dispatch = dispatch_};
            }
        }
    }

private:
    struct Worker {
        Clock::time_point last_message = Clock::now();
        bool waits = false; ///< for an answer to its request
        bool idle = false;  ///< has no tile left to compute

        bool is_done() const { return waits && idle; }
    };

    void communicate()
    {
        if (stop_.requested()) {
            dispatcher_.stop();
        }
        receive_all();
        if (timeout_check_.is_due()) {
            check_timeouts();
        }
        tile_work_.on_progress(share_.tiles + done_by_workers_);
    }

    // In Open MPI 4.1 a probe that finds nothing fetches what has arrived, and only the next probe
    // reports it. With single probes, workers whose tiles took as long as rank 0's waited half of
    // the time.
    void receive_all()
    {
        for (int empty_probes = 0; empty_probes < 2; ++empty_probes) {
            MPI_Status status;
            int waiting = 0;
            MPI_Iprobe(MPI_ANY_SOURCE, worker_message_tag, session_.communicator(), &waiting,
                       &status);
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
        MPI_Recv(&message, sizeof message, MPI_BYTE, rank, worker_message_tag,
                 session_.communicator(), MPI_STATUS_IGNORE);
        Worker& worker = workers_[std::size_t(rank)];
        worker.last_message = start;
        done_by_workers_ += message.tiles_done;
        busy_seconds_of_workers_ += 1e-9 * double(message.busy_nanoseconds);
        if (message.stop) {
            dispatcher_.stop();
        }
        worker.waits = worker.waits || message.requests_range;
        worker.idle = message.idle; // counts only while it waits: otherwise an answer is on its way
        if (message.requests_range) {
            const TileRange range = dispatcher_.next_range(limits());
            if (!range.empty()) {
                answer(rank, range);
            }
            const std::chrono::duration<double> seconds = Clock::now() - start;
            ++dispatch_.requests;
            dispatch_.seconds += std::min(seconds.count(), longest_answer);
        }
    }

    void answer(int rank, const TileRange& range)
    {
        MPI_Send(&range, sizeof range, MPI_BYTE, rank, range_tag, session_.communicator());
        workers_[std::size_t(rank)].waits = false;
    }

    /// From the times that answers and tiles have taken so far.
    RangeLimits limits() const
    {
        const std::int64_t done = share_.tiles + done_by_workers_;
        if (done == 0 || dispatch_.requests == 0) {
            return {};
        }
        return range_limits(int(workers_.size()), dispatch_.seconds / double(dispatch_.requests),
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
                throw timeout_error(rank, " on " + session_.hosts()[std::size_t(rank)], patience_);
            }
            if (worker.is_done()) {
                answer(rank, {});
            }
        }
    }

    const MpiSession& session_;
    TileDispatcher dispatcher_;
    const TileWork& tile_work_;
    const StopRequest& stop_;
    std::chrono::seconds patience_;
    std::vector<Worker> workers_; ///< by rank; the first, rank 0 itself, is unused
    IntervalTimer timeout_check_{std::chrono::milliseconds(patience_) / 20};
    Clock::time_point last_timeout_check_ = Clock::now();
    RankShare share_;
    std::int64_t done_by_workers_ = 0;
    double busy_seconds_of_workers_ = 0;
    DispatchCost dispatch_;
};

} // namespace

FarmReport farm_out(const MpiSession& session, const std::vector<std::int64_t>& tiles,
                    const TileWork& tile_work, const StopRequest& stop,
                    std::chrono::seconds patience)
{
    FarmReport report;
    if (session.rank() == 0) {
        report = Coordinator(session, tiles, tile_work, stop, patience).run();
    } else {
        report.ranks = {run_worker(session, tile_work, stop, patience)};
    }
    report.ranks = session.gather_on_rank_0(report.ranks[0]);
    for (const RankShare& rank : report.ranks) {
        report.all.tiles += rank.tiles;
        report.all.compute_seconds += rank.compute_seconds;
        report.all.write_seconds += rank.write_seconds;
    }
    report.all = session.from_rank_0(report.all);
    report.stopped = session.from_rank_0(report.all.tiles < std::int64_t(tiles.size()));
    return report;
}

} // namespace overturn
