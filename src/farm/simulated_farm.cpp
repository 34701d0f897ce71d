#include "overturn/farm/simulated_farm.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <queue>
#include <random>
#include <vector>

namespace overturn {

namespace {

constexpr double message_seconds = 2e-6;

class Simulation {
public:
    Simulation(const FarmCosts& costs, int ranks, std::int64_t tiles, const RangeLimits& limits)
        : costs_(costs), limits_(limits), dispatcher_(all(tiles), ranks),
          workers_(std::size_t(ranks))
    {}

    SimulatedFarm run()
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
        return {.seconds = end_,
                .efficiency = busy_ / (double(workers_.size()) * end_),
                .answering = answering_ / end_};
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
        const double shape = double(tiles) / (costs_.spread * costs_.spread);
        const double seconds =
            std::isfinite(shape) ? mean / shape * std::gamma_distribution<double>(shape)(generator_)
                                 : mean;
        busy_ += seconds;
        end_ = std::max(end_, time + seconds);
        return seconds;
    }

    FarmCosts costs_;
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
};

} // namespace

SimulatedFarm simulate_farm(const FarmCosts& costs, int ranks, std::int64_t tiles,
                            const RangeLimits& limits)
{
    return Simulation(costs, ranks, tiles, limits).run();
}

SimulatedFarm simulate_farm(const FarmCosts& costs, int ranks, std::int64_t tiles)
{
    const auto most = std::clamp<std::int64_t>(std::int64_t(256) * ranks, 4'000'000, 32'000'000);
    const std::int64_t in_one = (tiles + most - 1) / most;
    const FarmCosts of_one{.answer = costs.answer,
                           .tile = costs.tile * double(in_one),
                           .spread = costs.spread / std::sqrt(double(in_one))};
    return simulate_farm(of_one, ranks, (tiles + in_one - 1) / in_one,
                         range_limits(ranks, of_one.answer, of_one.tile));
}

} // namespace overturn
