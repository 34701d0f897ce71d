#include "worker.hpp"

#include "do_tile.hpp"
#include "occasionally.hpp"
#include "wait_for.hpp"
#include "words.hpp"

#include <thread>

namespace overturn {

namespace {

using Clock = std::chrono::steady_clock;

/// A worker gives so many signs of life within the time after which it is missed: some may be late.
constexpr int signs_in_patience = 10;

/// A worker's line to rank 0. Asking does not wait; the answer may come while the rank computes.
class LineToRank0 {
public:
    LineToRank0(MPI_Comm communicator, std::chrono::seconds patience)
        : communicator_(communicator), patience_(patience)
    {}

    void ask(Word word)
    {
        MPI_Irecv(&range_, range_length, MPI_INT64_T, 0, range_tag, communicator_, &receiving_);
        word.asking = 1;
        say(word);
    }
    bool has_answer()
    {
        int arrived = 0;
        MPI_Test(&receiving_, &arrived, MPI_STATUS_IGNORE);
        return arrived != 0;
    }
    /// Time in which this rank itself was stopped does not count.
    TileRange answer()
    {
        auto start = Clock::now();
        auto last_look = start;
        while (!has_answer()) {
            const auto now = Clock::now();
            if (now - last_look > std::chrono::milliseconds(patience_) / 4) {
                start = now;
            }
            last_look = now;
            if (now - start > patience_) {
                throw SilentRank(0, patience_);
            }
            std::this_thread::sleep_for(between_looks);
        }
        return range_;
    }
    // Small messages leave at once: MPI_Send does not wait for rank 0 to look.
    void say(const Word& word) const
    {
        MPI_Send(&word, word_length, MPI_INT64_T, 0, word_tag, communicator_);
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
    RankShare told;
    const auto news = [&](bool idle) {
        const double seconds = busy_seconds(share) - busy_seconds(told);
        const Word word{.idle = idle,
                        .stop = stop.requested(),
                        .tiles_done = share.tiles - told.tiles,
                        .busy_nanoseconds = std::int64_t(1e9 * seconds)};
        told = share;
        return word;
    };
    LineToRank0 rank_0(session.communicator(), patience);
    Occasionally sign_of_life(std::chrono::milliseconds(patience) / signs_in_patience);
    const std::function<bool()> drop_requested = [&] {
        if (sign_of_life.is_due()) {
            rank_0.say(news(false));
        }
        return stop.overdue();
    };
    rank_0.ask(news(true));
    while (true) {
        const TileRange range = rank_0.answer();
        if (is_dismissal(range)) {
            return share;
        }
        rank_0.ask(news(range.empty())); // one range ahead
        for (auto number = range.begin; number < range.end && !stop.requested(); ++number) {
            do_tile(number, tile_work, drop_requested, share);
        }
        if (!range.empty() && !rank_0.has_answer()) {
            rank_0.say(news(true));
        }
    }
}

} // namespace overturn
