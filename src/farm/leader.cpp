#include "leader.hpp"

#include "do_tile.hpp"
#include "wait_for.hpp"
#include "words.hpp"

#include <algorithm>
#include <thread>

namespace overturn {

namespace {

/// While rank 0 computes a tile, workers wait no longer than this for an answer; looking for their
/// words takes a thousandth of it.
constexpr std::chrono::milliseconds between_answers{10};

/// Beyond that it was not the answer that took long: rank 0 was not running, or a line was opened.
constexpr double longest_answer = 1e-4; // [s]

} // namespace

Leader::Leader(const MpiSession& session, const std::vector<std::int64_t>& tiles,
               const TileWork& tile_work, const std::function<void(std::int64_t)>& on_progress,
               const StopRequest& stop, std::chrono::seconds patience)
    : communicator_(session.communicator()), dealer_(tiles, session.size()), tile_work_(tile_work),
      on_progress_(on_progress), stop_(stop), patience_(patience),
      workers_(std::size_t(session.size())), still_busy_(session.size() - 1)
{}

RankShare Leader::lead()
{
    Occasionally attention(between_answers);
    const std::function<bool()> drop_requested = [&] {
        if (attention.is_due()) {
            attend();
        }
        return stop_.overdue();
    };
    while (true) {
        attend();
        const TileRange own = dealer_.deal_one();
        if (!own.empty()) {
            do_tile(own.begin, tile_work_, drop_requested, share_);
        } else if (still_busy_ > 0) {
            std::this_thread::sleep_for(between_looks);
        } else {
            dismiss_all();
            return share_;
        }
    }
}

void Leader::attend()
{
    if (stop_.requested()) {
        dealer_.stop();
    }
    hear_all();
    if (roll_call_.is_due()) {
        call_the_roll();
    }
    on_progress_(share_.tiles + done_by_workers_);
}

// In Open MPI 4.1 a look that finds nothing fetches what has come, and only the next one sees
// it. With single looks, workers on tiles as long as rank 0's waited half of the time.
void Leader::hear_all()
{
    for (int empty_looks = 0; empty_looks < 2; ++empty_looks) {
        MPI_Status status;
        int waiting = 0;
        MPI_Iprobe(MPI_ANY_SOURCE, word_tag, communicator_, &waiting, &status);
        if (waiting) {
            hear(status.MPI_SOURCE);
            empty_looks = -1;
        }
    }
}

void Leader::hear(int rank)
{
    const auto start = Clock::now();
    Word word;
    MPI_Recv(&word, word_length, MPI_INT64_T, rank, word_tag, communicator_, MPI_STATUS_IGNORE);
    Worker& worker = workers_[std::size_t(rank)];
    worker.heard = start;
    done_by_workers_ += word.tiles_done;
    seconds_of_workers_ += 1e-9 * double(word.busy_nanoseconds);
    if (word.stop) {
        dealer_.stop();
    }
    const bool was_done = worker.is_done();
    worker.waits = worker.waits || word.asking;
    worker.idle = word.idle; // of no meaning if it does not wait: an answer is on its way
    still_busy_ += int(was_done) - int(worker.is_done());
    if (word.asking) {
        const TileRange range = dealer_.deal(limits());
        if (!range.empty()) {
            answer(rank, range);
        }
        const std::chrono::duration<double> seconds = Clock::now() - start;
        ++dealing_.requests;
        dealing_.seconds += std::min(seconds.count(), longest_answer);
    }
}

void Leader::answer(int rank, const TileRange& range)
{
    MPI_Send(&range, range_length, MPI_INT64_T, rank, range_tag, communicator_);
    Worker& worker = workers_[std::size_t(rank)];
    still_busy_ += int(worker.is_done());
    worker.waits = false;
}

void Leader::dismiss_all()
{
    for (int rank = 1; rank < int(workers_.size()); ++rank) {
        answer(rank, dismissal);
    }
}

/// From what answers and tiles have taken so far.
RangeLimits Leader::limits() const
{
    const std::int64_t done = share_.tiles + done_by_workers_;
    if (done == 0 || dealing_.requests == 0) {
        return {};
    }
    return range_limits(int(workers_.size()), dealing_.seconds / double(dealing_.requests),
                        (busy_seconds(share_) + seconds_of_workers_) / double(done));
}

/// Misses the workers of which nothing was heard for too long, and lets those that are done show
/// themselves. After a while in which rank 0 itself did not listen, because it was stopped or its
/// disk hung, all get as long again: the same may have happened to them.
void Leader::call_the_roll()
{
    const auto now = Clock::now();
    const bool was_away = now - last_roll_call_ > std::chrono::milliseconds(patience_) / 2;
    last_roll_call_ = now;
    for (int rank = 1; rank < int(workers_.size()); ++rank) {
        Worker& worker = workers_[std::size_t(rank)];
        if (was_away) {
            worker.heard = now;
        } else if (now - worker.heard > patience_) {
            throw SilentRank(rank, patience_);
        }
        if (worker.is_done()) {
            answer(rank, {});
        }
    }
}

} // namespace overturn
