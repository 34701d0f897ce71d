#include "worker.hpp"

#include "do_tile.hpp"
#include "occasionally.hpp"
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

    void ask(const Word& word)
    {
        MPI_Irecv(&range_, range_length, MPI_INT64_T, 0, range_tag, communicator_, &receiving_);
        say(word);
    }
    TileRange answer()
    {
        const auto start = Clock::now();
        int arrived = 0;
        while (MPI_Test(&receiving_, &arrived, MPI_STATUS_IGNORE), !arrived) {
            if (Clock::now() - start > patience_) {
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
    const auto news = [&](Word::Kind kind) {
        const double seconds = busy_seconds(share) - busy_seconds(told);
        const Word word{.kind = kind,
                        .tiles_done = share.tiles - told.tiles,
                        .busy_nanoseconds = std::int64_t(1e9 * seconds),
                        .stop = stop.requested()};
        told = share;
        return word;
    };
    LineToRank0 rank_0(session.communicator(), patience);
    Occasionally sign_of_life(std::chrono::milliseconds(patience) / signs_in_patience);
    const std::function<bool()> drop_requested = [&] {
        if (sign_of_life.is_due()) {
            rank_0.say(news(Word::alive));
        }
        return stop.overdue();
    };
    rank_0.ask(news(Word::asking));
    while (true) {
        const TileRange range = rank_0.answer();
        if (range.empty()) {
            break;
        }
        rank_0.ask(news(Word::asking)); // one range ahead
        for (auto number = range.begin; number < range.end && !stop.requested(); ++number) {
            do_tile(number, tile_work, drop_requested, share);
        }
    }
    rank_0.say(news(Word::leaving));
    return share;
}

} // namespace overturn
