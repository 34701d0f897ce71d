// bench_effects: computes one tile within measured(), so that a profiler can count the instructions
// of that call only. Prints the number of points and the bytes that the call allocated on the heap.
#include "point_run.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/given.hpp"
#include "overturn/sweep/compute_tile.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <memory>
#include <new>
#include <numeric>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>

namespace overturn {

namespace benchmarks {

namespace {

constexpr std::string_view usage =
    "usage: bench_effects sweep METHOD PULSE THEORY KERNEL SIDE TOLERANCE [FIELD...]\n"
    "           sweeps SIDE x SIDE points of the paper's block, with these fields\n"
    "       bench_effects by-hand METHOD SIDE TOLERANCE nothing|region|impacts\n"
    "           runs the kernel without the sweep (one_sine, nonlinear, avx2): alone, with the\n"
    "           regions, or counting impacts\n"
    "       bench_effects each\n"
    "           runs each line of the standard input in a process of its own; prints \"ended\" "
    "after each\n"
    "       bench_effects pulses\n"
    "           lists the names of the pulses\n";

class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

std::size_t bytes_taken = 0;

enum class ByHand { nothing, region, impacts };
constexpr std::array<std::string_view, 3> by_hand_names{"nothing", "region", "impacts"};

struct Work {
    Problem problem;
    Tile tile;
    Kernel kernel = Kernel::avx2;
    std::optional<ByHand> by_hand;
};

/// The paper's block, b = 1 m and h = 5.67 m, with its largest restitution.
Grid grid_of_side(std::int64_t side)
{
    const auto given = [](const char* name, const Axis& values, GivenAs as) {
        return Given{&quantity(name), name, values, as};
    };
    return grid_of({}, {given("slenderness", Axis(AxisList{std::atan(1 / 5.67)}), GivenAs::number),
                        given("restitution_of_maximum", Axis(AxisList{1}), GivenAs::number),
                        given("amplitude", Axis(AxisRange{1.2, 12, side}), GivenAs::axis),
                        given("frequency", Axis(AxisRange{0.5, 8, side}), GivenAs::axis)});
}

/// The minimum work for a scene: its points, the kernel, and the regions if requested.
std::vector<std::uint8_t> sweep_by_hand(const Work& work, ByHand requested)
{
    const auto& [scene, grid, numerics, product, fields] = work.problem;
    const PulseMotion<double> motion =
        pulse_motion<double>(scene.pulse()->kind, scene.pulse()->shape);
    const std::vector<Point> points = Coordinates(scene, grid, work.tile).points();
    const ScaledPulses pulses(motion, scene.theory, points);
    const std::size_t count = points.size();
    std::vector<int> all(count);
    std::iota(all.begin(), all.end(), 0);
    const Outputs outputs{.impacts = requested == ByHand::impacts,
                          .region = requested == ByHand::region};
    const auto outcomes = std::make_unique_for_overwrite<Outcome[]>(count);
    const KernelTask task{.pulse = motion,
                          .record = nullptr,
                          .points = points.data(),
                          .are_symmetric = true,
                          .pulse_of_point = pulses.of_point.data(),
                          .pulses = pulses.pulses.data(),
                          .tolerance = numerics.tolerance,
                          .outputs = outputs,
                          .uncertain_impact = UncertainImpact::go_on,
                          .chosen = all.data(),
                          .chosen_count = int(count),
                          .drop_requested = [](const void*) { return false; },
                          .context = nullptr,
                          .outcomes = outcomes.get()};
    const Integrator integrator =
        numerics.method == Method::rk45 ? Integrator::runge_kutta : Integrator::taylor_20;
    sweep_kernel(work.kernel, integrator, Theory::nonlinear, outputs, Directions::horizontal)(task);
    std::vector<std::uint8_t> regions(outputs.region ? count : 0);
    for (std::size_t i = 0; i < regions.size(); ++i) {
        regions[i] = std::uint8_t(outcomes[i].region);
    }
    return regions;
}

} // namespace

/// The call that the profiler measures.
[[gnu::noinline]] TileFields measured(const Work& work)
{
    if (work.by_hand) {
        TileFields result;
        result.values.emplace_back(sweep_by_hand(work, *work.by_hand));
        return result;
    }
    return compute_tile(work.problem, work.tile, work.kernel);
}

namespace {

template <class Number>
Number number_from(std::string_view text)
{
    Number number{};
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || rest != text.data() + text.size() || !(number > 0)) {
        throw UsageError("\"" + std::string(text) + "\" is not a positive number");
    }
    return number;
}

template <class Kind>
Kind kind_from(std::string_view text, std::span<const std::string_view> names = names_of<Kind>)
{
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) {
        std::string known;
        for (const std::string_view name : names) {
            known += known.empty() ? std::string(name) : ", " + std::string(name);
        }
        throw UsageError("\"" + std::string(text) + "\" is not one of " + known);
    }
    return Kind(found - names.begin());
}

Work work_from(const std::vector<std::string>& words)
{
    const bool by_hand = words.size() == 5 && words[0] == "by-hand";
    if (!by_hand && (words.size() < 7 || words[0] != "sweep")) {
        throw UsageError("invalid arguments");
    }
    Work work;
    auto& [scene, grid, numerics, product, fields] = work.problem;
    numerics.method = kind_from<Method>(words[1]);
    const std::size_t sizes = by_hand ? 2 : 5;
    const int side = number_from<int>(words[sizes]);
    numerics.tolerance = number_from<double>(words[sizes + 1]);
    if (by_hand) {
        work.by_hand = kind_from<ByHand>(words[4], by_hand_names);
    } else {
        scene.motion = Pulse{kind_from<PulseKind>(words[2])};
        scene.theory = kind_from<Theory>(words[3]);
        work.kernel = kind_from<Kernel>(words[4]);
        for (std::size_t i = 7; i < words.size(); ++i) {
            const FieldTraits* field = find_field(words[i]);
            if (field == nullptr) {
                throw UsageError("there is no field " + words[i]);
            }
            fields.push_back({field->name});
        }
    }
    if (!runs_here(work.kernel)) {
        throw UsageError("this processor cannot run the kernel " +
                         std::string(name_of(work.kernel)));
    }
    grid = grid_of_side(side);
    work.tile = Tiling(grid.shape(), {side, side})[0];
    return work;
}

int run(const std::vector<std::string>& words);

/// Runs the code once, outside measured(): Valgrind translates it only here, not in every process.
void warm_up()
{
    for (const char* const method : {"rk45", "taylor"}) {
        for (const char* const theory : {"nonlinear", "linear"}) {
            for (const char* const field : {"region", "impacts", "error", "peak"}) {
                const Work work =
                    work_from({"sweep", method, "one_sine", theory, "avx2", "8", "1e-8", field});
                compute_tile(work.problem, work.tile, work.kernel);
            }
        }
    }
}

/// A process under Valgrind starts once for all lines. Every line finds the state of the start, so
/// that its counts do not depend on the others.
int run_each()
{
    warm_up();
    std::cout << "ready" << std::endl; // the first output allocates its buffer
    for (std::string line; std::getline(std::cin, line);) {
        const pid_t child = fork();
        if (child == 0) {
            std::istringstream words(line);
            return run({std::istream_iterator<std::string>(words), {}});
        }
        int status = 0;
        if (child < 0 || waitpid(child, &status, 0) != child || status != 0) {
            throw std::runtime_error("no result for \"" + line + "\"");
        }
        std::cout << "ended" << std::endl; // and its counts are written
    }
    return 0;
}

int run(const std::vector<std::string>& words)
{
    if (words == std::vector<std::string>{"each"}) {
        return run_each();
    }
    if (words == std::vector<std::string>{"pulses"}) {
        for (const std::string_view name : names_of<PulseKind>) {
            std::cout << name << "\n";
        }
        return 0;
    }
    const Work work = work_from(words);
    const std::size_t before = bytes_taken;
    const TileFields fields = measured(work);
    const std::size_t bytes = bytes_taken - before;
    std::cout << "{\"process\": " << getpid() << ", \"points\": " << work.tile.points()
              << ", \"bytes\": " << bytes << ", \"fields\": " << fields.values.size()
              << ", \"compiler\": \"" << OVERTURN_BENCHMARK_COMPILER << "\"}\n";
    return 0;
}

} // namespace

} // namespace benchmarks

} // namespace overturn

void* operator new(std::size_t size)
{
    overturn::benchmarks::bytes_taken += size;
    if (void* const taken = std::malloc(size)) {
        return taken;
    }
    throw std::bad_alloc();
}

void operator delete(void* taken) noexcept
{
    std::free(taken);
}

void operator delete(void* taken, std::size_t) noexcept
{
    std::free(taken);
}

int main(int count, char** words)
{
    using namespace overturn::benchmarks;
    try {
        return run({words + 1, words + count});
    } catch (const UsageError& error) {
        std::cerr << "bench_effects: " << error.what() << "\n" << usage;
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "bench_effects: " << error.what() << "\n";
        return 70;
    }
}
