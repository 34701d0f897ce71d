// bench_effects: sweeps one tile, so that a profiler can count the instructions of that call alone:
// all inside measured(). Prints the points, and the bytes that the call took from the heap.
#include "sweep_kernel.hpp"

#include "overturn/mechanics/pulse.hpp"
#include "overturn/sweep/sweep_tile.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

namespace overturn {

#ifdef __x86_64__
SweepKernel sweep_kernel_avx2_OneSine(Integrator, Theory, Recorded);
extern const FieldKernels field_kernels_avx2;
#endif

namespace benchmarks {

namespace {

constexpr std::string_view usage =
    "usage: bench_effects sweep METHOD PULSE THEORY KERNEL SIDE TOLERANCE [FIELD...]\n"
    "           SIDE x SIDE points of the paper's block, with these fields\n"
    "       bench_effects by-hand METHOD SIDE TOLERANCE nothing|region|impacts\n"
    "           the same under one_sine, nonlinear, avx2, past the sweep: its kernel alone; with\n"
    "           the regions after it; or the kernel that counts impacts\n";

class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

std::size_t bytes_taken = 0;

enum class ByHand { nothing, region, impacts };
constexpr std::array<std::string_view, 3> by_hand_names{"nothing", "region", "impacts"};

struct Work {
    Scene scene;
    Numerics numerics;
    Plane plane;
    Tile tile;
    std::vector<Field> fields;
    Kernel kernel = Kernel::avx2;
    std::optional<ByHand> by_hand;
};

/// The paper's block, b = 1 m and h = 5.67 m, with its largest restitution.
Plane plane_of(std::int64_t side)
{
    Plane plane;
    plane.frequency = Axis(AxisRange{.first = 0.5, .last = 8, .count = side});
    plane.amplitude = Axis(AxisRange{.first = 1.2, .last = 12, .count = side});
    plane.slenderness = Axis(AxisList{std::atan(1 / 5.67)});
    plane.restitution = Axis(AxisList{1});
    plane.restitution_of = RestitutionOf::maximum;
    return plane;
}

/// What a scene cannot do without: the kernel, and the regions if they are asked for.
std::vector<std::uint8_t> sweep_by_hand(const Work& work, ByHand asked)
{
    const double slenderness = work.plane.slenderness[0];
    const double restitution = work.plane.restitution_ratio(0, 0);
    const double threshold = uplift_acceleration<Theory::nonlinear>(slenderness);
    const std::vector<double> frequency = work.plane.frequency.values();
    std::vector<double> acceleration;
    std::vector<double> uplifts;
    for (const double amplitude : work.plane.amplitude.values()) {
        acceleration.push_back(amplitude * threshold);
        const auto phases = uplift_phases<OneSine>(amplitude, work.scene.window);
        uplifts.insert(uplifts.end(), phases.begin(), phases.end());
    }
    const TilePoints points{.slenderness = slenderness,
                            .restitution = restitution,
                            .rows = int(acceleration.size()),
                            .columns = int(frequency.size()),
                            .acceleration = acceleration.data(),
                            .uplifts = uplifts.data(),
                            .frequency = frequency.data(),
                            .begin = OneSine::begin(work.scene.window),
                            .end = OneSine::end(work.scene.window),
                            .tolerance = work.numerics.tolerance,
                            .in_doubt = InDoubt::goes_on,
                            .chosen = nullptr,
                            .chosen_count = int(work.tile.points()),
                            .drop_requested = [](const void*) { return false; },
                            .context = nullptr};
    const std::size_t count = std::size_t(work.tile.points());
    std::vector<double> tilt(count);
    std::vector<double> rate(count);
    std::vector<double> side(count);
    std::vector<std::uint8_t> flags(count);
    std::vector<double> impacts(asked == ByHand::impacts ? count : 0);
    const PointEnds ends{.tilt = tilt.data(),
                         .rate = rate.data(),
                         .side = side.data(),
                         .flags = flags.data(),
                         .impacts = impacts.empty() ? nullptr : impacts.data(),
                         .error = nullptr,
                         .steps = nullptr,
                         .phase = nullptr,
                         .peak = nullptr};
#ifdef __x86_64__
    const Integrator integrator =
        work.numerics.method == Method::rk45 ? Integrator::runge_kutta : Integrator::taylor_20;
    const Recorded recorded = asked == ByHand::impacts ? Recorded::impacts : Recorded::nothing;
    sweep_kernel_avx2_OneSine(integrator, Theory::nonlinear, recorded)(points, ends);
    if (asked == ByHand::region) {
        std::vector<std::uint8_t> regions(count);
        field_kernels_avx2.regions(Theory::nonlinear, {slenderness, restitution}, ends, int(count),
                                   regions.data());
        return regions;
    }
#endif
    return {};
}

} // namespace

/// What the profiler counts.
[[gnu::noinline]] TileFields measured(const Work& work)
{
    if (work.by_hand) {
        TileFields result;
        result.values.emplace_back(sweep_by_hand(work, *work.by_hand));
        return result;
    }
    return sweep_tile(work.scene, work.numerics, work.plane, work.tile, work.fields, work.kernel);
}

namespace {

template <class Number>
Number number_from(std::string_view text)
{
    Number number{};
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || rest != text.data() + text.size() || !(number > 0)) {
        throw UsageError("\"" + std::string(text) + "\" is no positive number");
    }
    return number;
}

template <class Kind, std::size_t count>
Kind kind_from(std::string_view text, const std::array<std::string_view, count>& names)
{
    const auto* const found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) {
        std::string known;
        for (const std::string_view name : names) {
            known += known.empty() ? std::string(name) : ", " + std::string(name);
        }
        throw UsageError("\"" + std::string(text) + "\" is none of " + known);
    }
    return Kind(found - names.begin());
}

Work work_from(const std::vector<std::string>& words)
{
    const bool by_hand = words.size() == 5 && words[0] == "by-hand";
    if (!by_hand && (words.size() < 7 || words[0] != "sweep")) {
        throw UsageError("no such call");
    }
    Work work;
    work.numerics.method = kind_from<Method>(words[1], method_names);
    const std::size_t sizes = by_hand ? 2 : 5;
    const int side = number_from<int>(words[sizes]);
    work.numerics.tolerance = number_from<double>(words[sizes + 1]);
    if (by_hand) {
        work.by_hand = kind_from<ByHand>(words[4], by_hand_names);
    } else {
        work.scene.pulse = kind_from<PulseKind>(words[2], pulse_names);
        work.scene.theory = kind_from<Theory>(words[3], theory_names);
        work.kernel = kind_from<Kernel>(words[4], kernel_names);
        for (std::size_t i = 7; i < words.size(); ++i) {
            work.fields.push_back(kind_from<Field>(words[i], field_names));
        }
    }
    if (!runs_here(work.kernel)) {
        throw UsageError("this processor cannot run the kernel " +
                         std::string(name_of(work.kernel)));
    }
    work.plane = plane_of(side);
    work.tile = Tiling(work.plane, side, side)[0];
    return work;
}

int run(const std::vector<std::string>& words)
{
    const Work work = work_from(words);
    const std::size_t before = bytes_taken;
    const TileFields fields = measured(work);
    const std::size_t bytes = bytes_taken - before;
    std::cout << "{\"points\": " << work.tile.points() << ", \"bytes\": " << bytes
              << ", \"fields\": " << fields.values.size() << ", \"compiler\": \""
              << OVERTURN_BENCHMARK_COMPILER << "\"}\n";
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
