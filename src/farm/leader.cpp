#include "leader.hpp"

#include "do_tile.hpp"
#include "words.hpp"

#include <thread>

namespace overturn {

namespace {

/// While rank 0 computes a tile, workers wait no longer than this for an answer; looking for their
/// words takes a thousandth of it.
constexpr std::chrono::milliseconds between_answers{10};

} // namespace

Leader::Leader(const MpiSession& session, const std::vector<std::int64_t>& tiles,
               const TileWork& tile_work, const std::function<void(std::int64_t)>& on_progress,
               const StopRequest& stop, std::chrono::seconds patience)
    : communicator_(session.communicator()), dealer_(tiles, session.size()), tile_work_(tile_work),
      on_progress_(on_progress), stop_(stop), patience_(patience),
      workers_(std::size_t(session.size())), still_here_(session.size() - 1)
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
        } else if (still_here_ > 0) {
            std::this_thread::sleep_for(between_looks);
        } else {
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
    if (word.kind == Word::leaving) {
        worker.is_here = false;
        --still_here_;
    } else if (word.kind == Word::asking) {
        const TileRange range = dealer_.deal(limits());
        MPI_Send(&range, range_length, MPI_INT64_T, rank, range_tag, communicator_);
        ++dealing_.requests;
        dealing_.seconds += std::chrono::duration<double>(Clock::now() - start).count();
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

/// Misses the workers of which nothing was heard for too long. After a while in which rank 0
/// itself did not listen, because it was stopped or its disk hung, they get as long again: the
/// same may have happened to them.
void Leader::call_the_roll()
{
    const auto now = Clock::now();
    const bool was_away = now - last_roll_call_ > std::chrono::milliseconds(patience_) / 2;
    last_roll_call_ = now;
    for (std::size_t rank = 1; rank < workers_.size(); ++rank) {
        Worker& worker = workers_[rank];
        if (was_away) {
            worker.heard = now;
        } else if (worker.is_here && now - worker.heard > patience_) {
            throw SilentRank(int(rank), patience_);
        }
    }
}

} // namespace overturn
