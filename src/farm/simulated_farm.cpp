#include "overturn/farm/simulated_farm.hpp"

#include "intervals.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <random>
#include <utility>
#include <vector>

namespace overturn {

namespace {

constexpr double message_seconds = 2e-6;
constexpr double largest_delay =
    std::chrono::duration<double>(attention_interval + message_interval).count(); // [s]

/// Durations of tiles with this mean and coefficient of variation.
std::gamma_distribution<double> durations(const FarmCosts& costs)
{
    const double square = costs.spread * costs.spread;
    return costs.spread > 0 ? std::gamma_distribution<double>(1 / square, costs.tile * square)
                            : std::gamma_distribution<double>();
}

class Simulation {
public:
    Simulation(const FarmCosts& costs, int ranks, int ranks_per_node, std::int64_t tiles,
               const TileLimits& limits)
        : costs_(costs), ranks_(ranks), limits_(limits), left_(tiles), duration_(durations(costs))
    {
        for (int first = 0; first < ranks; first += ranks_per_node) {
            const int ranks_of_node = std::min(ranks_per_node, ranks - first);
            nodes_.push_back({.ranks = ranks_of_node,
                              .free_at = Times(std::greater<>(),
                                               std::vector<double>(std::size_t(ranks_of_node)))});
        }
    }

    SimulatedFarm run()
    {
        for (std::size_t node = 0; node < nodes_.size(); ++node) {
            events_.push({message_seconds, node, 0});
        }
        while (!events_.empty()) {
            const Event event = events_.top();
            events_.pop();
            if (event.tiles > 0) {
                receive(event);
            } else {
                serve(event);
            }
        }
        return {
            .seconds = end_, .efficiency = busy_ / (ranks_ * end_), .answering = answering_ / end_};
    }

private:
    /// A request that rank 0 receives, or an answer with tiles that a node receives.
    struct Event {
        double time;
        std::size_t node;
        std::int64_t tiles;                                                    ///< 0: a request
        bool operator<(const Event& other) const { return time > other.time; } // soonest first
    };
    using Times = std::priority_queue<double, std::vector<double>, std::greater<>>;
    struct Node {
        int ranks;
        Times free_at; ///< of its ranks
        std::int64_t pool = 0;
        double pool_is_free_at = 0;
    };

    void serve(const Event& request)
    {
        const std::int64_t tiles =
            tiles_for_node(left_, nodes_[request.node].ranks, ranks_, limits_);
        left_ -= tiles;
        rank_0_is_free_at_ = std::max(rank_0_is_free_at_, request.time) + costs_.answer;
        answering_ += costs_.answer;
        answering_in_tile_ += costs_.answer;
        if (tiles > 0) {
            events_.push({rank_0_is_free_at_ + message_seconds, request.node, tiles});
        } else {
            compute(request.node, std::numeric_limits<double>::infinity());
        }
    }

    void receive(const Event& answer)
    {
        Node& node = nodes_[answer.node];
        compute(answer.node, answer.time);
        node.pool += answer.tiles;
        node.pool_is_free_at = std::max(node.pool_is_free_at, answer.time);
        double time = answer.time;
        while (node.pool > answer.tiles) {
            time = take(answer.node);
        }
        const double late = uniform_(generator_) * largest_delay;
        events_.push({time + late + message_seconds, answer.node, 0});
    }

    /// The tiles that the ranks of a node take before a time.
    void compute(std::size_t number, double until)
    {
        const Node& node = nodes_[number];
        while (node.pool > 0 && node.free_at.top() < until) {
            take(number);
        }
    }

    /// The first rank that is free takes a tile. Returns when.
    double take(std::size_t number)
    {
        Node& node = nodes_[number];
        const double start = std::max(node.free_at.top(), node.pool_is_free_at);
        double seconds = costs_.spread > 0 ? duration_(generator_) : costs_.tile;
        busy_ += seconds;
        end_ = std::max(end_, start + costs_.take + seconds);
        if (number == 0) { // rank 0 is one of its ranks
            seconds += std::exchange(answering_in_tile_, 0.0);
        }
        --node.pool;
        node.pool_is_free_at = start + costs_.take;
        node.free_at.pop();
        node.free_at.push(start + costs_.take + seconds);
        return start;
    }

    FarmCosts costs_;
    int ranks_;
    TileLimits limits_;
    std::int64_t left_;
    std::vector<Node> nodes_;
    std::priority_queue<Event> events_;
    double rank_0_is_free_at_ = 0;
    double answering_in_tile_ = 0; ///< of rank 0, not yet added to the time of a tile
    double busy_ = 0;
    double answering_ = 0;
    double end_ = 0;
    std::mt19937_64 generator_{1};
    std::uniform_real_distribution<double> uniform_;
    std::gamma_distribution<double> duration_; ///< not used without spread
};

} // namespace

SimulatedFarm simulate_farm(const FarmCosts& costs, int ranks, int ranks_per_node,
                            std::int64_t tiles, const TileLimits& limits)
{
    return Simulation(costs, ranks, ranks_per_node, tiles, limits).run();
}

SimulatedFarm simulate_farm(const FarmCosts& costs, int ranks, int ranks_per_node,
                            std::int64_t tiles)
{
    const auto most = std::clamp<std::int64_t>(std::int64_t(256) * ranks, 4'000'000, 32'000'000);
    const std::int64_t in_one = (tiles + most - 1) / most;
    const FarmCosts of_one{.answer = costs.answer,
                           .take = costs.take * double(in_one),
                           .tile = costs.tile * double(in_one),
                           .spread = costs.spread / std::sqrt(double(in_one))};
    const int nodes = (ranks + ranks_per_node - 1) / ranks_per_node;
    return simulate_farm(of_one, ranks, ranks_per_node, (tiles + in_one - 1) / in_one,
                         tile_limits(nodes, of_one.answer, of_one.tile));
}

} // namespace overturn
