// bench_scale ANSWER TILE MOST_RANKS: event-based simulation of runs on up to MOST_RANKS ranks.
// ANSWER and TILE: seconds that rank 0 takes to answer a request, and a rank for a tile. Tiles are
// dispatched by the TileDispatcher of the program; everything else is modelled:
//   - a worker requests one range ahead, and a message takes 2 us;
//   - a tile takes TILE on average, with half of that as its standard deviation;
//   - rank 0 answers requests one by one, and computes a tile when there are none.
// Prints, as JSON, the share of the time of all ranks that is spent on tiles, and the share of
// rank 0 on answers, for range lengths from range_limits(), and for ranges of 1 to 16 tiles.
#include "overturn/farm/tile_dispatcher.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <deque>
#include <numeric>
#include <queue>
#include <random>
#include <vector>

namespace overturn {
namespace {

constexpr double message_seconds = 2e-6;
constexpr double spread = 0.5;

struct Costs {
    double answer; ///< [s]
    double tile;   ///< [s]
};

struct Outcome {
    double efficiency; ///< share of the time of all ranks that is spent on tiles
    double answering;  ///< share of the time of rank 0 that is spent on answers
    double seconds;
};

class Simulation {
public:
    Simulation(const Costs& costs, int ranks, std::int64_t tiles, const RangeLimits& limits)
        : costs_(costs), limits_(limits), dispatcher_(all(tiles), ranks),
          workers_(std::size_t(ranks))
    {}

    Outcome run()
    {
        for (std::size_t worker = 1; worker < workers_.size(); ++worker) {
            events_.push({message_seconds, Kind::requested, worker});
        }
        serve(0);
        while (!events_.empty()) {
            const Event event = events_.top();
            events_.pop();
            handle(event);
        }
        return {busy_ / (double(workers_.size()) * end_), answering_ / end_, end_};
    }

private:
    enum class Kind { requested, answered, computed, rank_0_is_free };
    struct Event {
        double time;
        Kind kind;
        std::size_t worker;
        bool operator<(const Event& other) const { return time > other.time; } // soonest first
    };
    struct Worker {
        std::int64_t ahead = 0;      ///< tiles of the range that has arrived
        std::int64_t dispatched = 0; ///< tiles of the range that is in transit
        bool computes = false;
    };

    static std::vector<std::int64_t> all(std::int64_t tiles)
    {
        std::vector<std::int64_t> numbers;
        numbers.resize(std::size_t(tiles));
        std::iota(numbers.begin(), numbers.end(), 0);
        return numbers;
    }

    void handle(const Event& event)
    {
        Worker& worker = workers_[event.worker];
        switch (event.kind) {
        case Kind::requested: requests_.push_back(event.worker); break;
        case Kind::answered: worker.ahead = worker.dispatched; break;
        case Kind::computed: worker.computes = false; break;
        case Kind::rank_0_is_free: rank_0_is_busy_ = false; break;
        }
        if (event.kind == Kind::requested || event.kind == Kind::rank_0_is_free) {
            serve(event.time);
        } else {
            begin_range(event.worker, event.time);
        }
    }

    void begin_range(std::size_t number, double time)
    {
        Worker& worker = workers_[number];
        if (worker.computes || worker.ahead == 0) {
            return;
        }
        events_.push({time + compute(worker.ahead, time), Kind::computed, number});
        events_.push({time + message_seconds, Kind::requested, number});
        worker.ahead = 0;
        worker.computes = true;
    }

    void serve(double time)
    {
        if (rank_0_is_busy_) {
            return;
        }
        double seconds = 0;
        if (!requests_.empty()) {
            const std::size_t worker = requests_.front();
            requests_.pop_front();
            const TileRange range = dispatcher_.next_range(limits_);
            workers_[worker].dispatched = range.end - range.begin;
            seconds = costs_.answer;
            answering_ += seconds;
            events_.push({time + seconds + message_seconds, Kind::answered, worker});
        } else if (!dispatcher_.next_tile().empty()) {
            seconds = compute(1, time);
        } else {
            return;
        }
        rank_0_is_busy_ = true;
        events_.push({time + seconds, Kind::rank_0_is_free, 0});
    }

    /// The duration of some tiles that begin at `time`.
    double compute(std::int64_t tiles, double time)
    {
        const double mean = double(tiles) * costs_.tile;
        const double deviation = spread / std::sqrt(double(tiles)) * normal_(generator_);
        const double seconds = mean * std::max(1 + deviation, 0.1);
        busy_ += seconds;
        end_ = std::max(end_, time + seconds);
        return seconds;
    }

    Costs costs_;
    RangeLimits limits_;
    TileDispatcher dispatcher_;
    std::vector<Worker> workers_;
    std::deque<std::size_t> requests_;
    std::priority_queue<Event> events_;
    bool rank_0_is_busy_ = false;
    double busy_ = 0;
    double answering_ = 0;
    double end_ = 0;
    std::mt19937_64 generator_{1};
    std::normal_distribution<double> normal_;
};

void print(const Costs& costs, int ranks, std::int64_t tiles_per_rank, bool last)
{
    const auto outcome = [&](const RangeLimits& limits) {
        return Simulation(costs, ranks, ranks * tiles_per_rank, limits).run();
    };
    const Outcome now = outcome(range_limits(ranks, costs.answer, costs.tile));
    const Outcome fixed = outcome({});
    fmt::print("{{\"ranks\": {}, \"tiles_per_rank\": {}, \"efficiency\": {}, \"answering\": {}, "
               "\"seconds\": {}, \"fixed_efficiency\": {}, \"fixed_answering\": {}}}{}\n",
               ranks, tiles_per_rank, now.efficiency, now.answering, now.seconds, fixed.efficiency,
               fixed.answering, last ? "" : ",");
}

} // namespace
} // namespace overturn

int main(int argc, char** argv)
{
    if (argc != 4) {
        fmt::print(stderr, "usage: bench_scale ANSWER TILE MOST_RANKS\n");
        return 2;
    }
    const overturn::Costs costs{std::atof(argv[1]), std::atof(argv[2])};
    const int most_ranks = std::atoi(argv[3]);
    fmt::print("[\n");
    for (int ranks = 10; ranks <= most_ranks; ranks *= 10) {
        for (const std::int64_t tiles_per_rank : {100, 1000}) {
            const bool last = ranks > most_ranks / 10 && tiles_per_rank == 1000;
            overturn::print(costs, ranks, tiles_per_rank, last);
        }
    }
    fmt::print("]\n");
}
