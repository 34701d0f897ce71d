#include "overturn/farm/farm.hpp"

#include "overturn/farm/tile_dealer.hpp"

#include <array>
#include <chrono>
#include <thread>

namespace overturn {

namespace {

using Clock = std::chrono::steady_clock;
using StopRequested = std::function<bool()>;

constexpr int request_tag = 1;
constexpr int range_tag = 2;

/// From a worker to rank 0. Unless it leaves, the worker wants a range.
struct Request {
    std::int64_t tiles_done = 0; ///< since its last request
    std::int64_t stop = 0;       ///< 1: it was asked to stop
    std::int64_t leaving = 0;    ///< 1: its last word
};
constexpr int request_words = 3;
constexpr int range_words = 2;
static_assert(sizeof(Request) == request_words * sizeof(std::int64_t));
static_assert(sizeof(TileRange) == range_words * sizeof(std::int64_t));

/// Waiting ranks look for messages this often and sleep in between: MPI's own waiting spins, and
/// takes a core from ranks that compute when there are more ranks than cores.
constexpr std::chrono::microseconds between_looks{50};

void wait_for(MPI_Request& request)
{
    int arrived = 0;
    while (MPI_Test(&request, &arrived, MPI_STATUS_IGNORE), !arrived) {
        std::this_thread::sleep_for(between_looks);
    }
}

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

void do_tile(std::int64_t number, const TileWork& tile_work, RankShare& share)
{
    const auto start = Clock::now();
    tile_work.compute(number);
    const auto computed = Clock::now();
    tile_work.write(number);
    share.compute_seconds += std::chrono::duration<double>(computed - start).count();
    share.write_seconds += seconds_since(computed);
    ++share.tiles;
}

/// A worker's line to rank 0. Asking does not wait; the answer may come while the rank computes.
class Asker {
public:
    explicit Asker(MPI_Comm communicator) : communicator_(communicator) {}

    void ask(const Request& request)
    {
        MPI_Irecv(&range_, range_words, MPI_INT64_T, 0, range_tag, communicator_, &receiving_);
        send(request);
    }
    TileRange answer()
    {
        wait_for(receiving_);
        return range_;
    }
    void leave(Request request)
    {
        request.leaving = 1;
        send(request);
    }

private:
    // Small messages leave at once: MPI_Send does not wait for rank 0 to look.
    void send(const Request& request) const
    {
        MPI_Send(&request, request_words, MPI_INT64_T, 0, request_tag, communicator_);
    }

    MPI_Comm communicator_;
    MPI_Request receiving_ = MPI_REQUEST_NULL;
    TileRange range_;
};

RankShare work(const MpiSession& session, const TileWork& tile_work,
               const StopRequested& stop_requested)
{
    RankShare share;
    std::int64_t told = 0;
    const auto news = [&] {
        const Request request{.tiles_done = share.tiles - told, .stop = stop_requested()};
        told = share.tiles;
        return request;
    };
    Asker rank_0(session.communicator());
    rank_0.ask(news());
    while (true) {
        const TileRange range = rank_0.answer();
        if (range.empty()) {
            break;
        }
        rank_0.ask(news()); // one range ahead
        for (std::int64_t number = range.begin; number < range.end && !stop_requested(); ++number) {
            do_tile(number, tile_work, share);
        }
    }
    rank_0.leave(news());
    return share;
}

/// Rank 0: answers every request that has come, then does one tile of its own, until nothing is
/// left and every worker has said its last word.
RankShare lead(const MpiSession& session, TileDealer dealer, const TileWork& tile_work,
               const std::function<void(std::int64_t)>& on_progress,
               const StopRequested& stop_requested, DealingShare& dealing)
{
    const MPI_Comm communicator = session.communicator();
    RankShare share;
    int workers = session.size() - 1;
    std::int64_t done_by_workers = 0;

    const auto answer = [&](int worker) {
        const auto start = Clock::now();
        Request request;
        MPI_Recv(&request, request_words, MPI_INT64_T, worker, request_tag, communicator,
                 MPI_STATUS_IGNORE);
        done_by_workers += request.tiles_done;
        if (request.stop) {
            dealer.stop();
        }
        if (request.leaving) {
            --workers;
            return;
        }
        const TileRange range = dealer.deal();
        MPI_Send(&range, range_words, MPI_INT64_T, worker, range_tag, communicator);
        ++dealing.requests;
        dealing.seconds += seconds_since(start);
    };
    // In Open MPI 4.1 a look that finds nothing fetches what has come, and only the next one sees
    // it. With single looks, workers on tiles as long as rank 0's waited half of the time.
    const auto answer_all = [&] {
        for (int empty_looks = 0; empty_looks < 2; ++empty_looks) {
            MPI_Status status;
            int waiting = 0;
            MPI_Iprobe(MPI_ANY_SOURCE, request_tag, communicator, &waiting, &status);
            if (waiting) {
                answer(status.MPI_SOURCE);
                empty_looks = -1;
            }
        }
    };

    while (true) {
        if (stop_requested()) {
            dealer.stop();
        }
        answer_all();
        const TileRange own = dealer.deal_one();
        if (!own.empty()) {
            do_tile(own.begin, tile_work, share);
        } else if (workers > 0) {
            std::this_thread::sleep_for(between_looks);
        }
        on_progress(share.tiles + done_by_workers);
        if (own.empty() && workers == 0) {
            return share;
        }
    }
}

/// Workers come here first and wait without taking a core, here and in from_rank_0.
std::vector<RankShare> gather_on_rank_0(const MpiSession& session, const RankShare& share)
{
    std::vector<RankShare> shares(session.rank() == 0 ? std::size_t(session.size()) : 0);
    MPI_Request gathering = MPI_REQUEST_NULL;
    MPI_Igather(&share, int(sizeof share), MPI_BYTE, shares.data(), int(sizeof share), MPI_BYTE, 0,
                session.communicator(), &gathering);
    wait_for(gathering);
    return shares;
}

/// Rank 0's two numbers, on all ranks.
std::array<std::int64_t, 2> from_rank_0(const MpiSession& session,
                                        std::array<std::int64_t, 2> values)
{
    MPI_Request arriving = MPI_REQUEST_NULL;
    MPI_Ibcast(values.data(), int(values.size()), MPI_INT64_T, 0, session.communicator(),
               &arriving);
    wait_for(arriving);
    return values;
}

} // namespace

FarmReport farm_out(const MpiSession& session, const std::vector<std::int64_t>& tiles,
                    const TileWork& tile_work, const std::function<void(std::int64_t)>& on_progress,
                    const StopRequested& stop_requested)
{
    FarmReport report;
    const RankShare share = session.rank() == 0
                                ? lead(session, TileDealer(tiles, session.size()), tile_work,
                                       on_progress, stop_requested, report.dealing)
                                : work(session, tile_work, stop_requested);
    report.ranks = gather_on_rank_0(session, share);
    std::int64_t done = 0;
    for (const RankShare& rank : report.ranks) {
        done += rank.tiles;
    }
    const auto [all_done, wanted] = from_rank_0(session, {done, std::int64_t(tiles.size())});
    report.tiles = all_done;
    report.stopped = all_done < wanted;
    return report;
}

} // namespace overturn
