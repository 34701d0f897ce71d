// Compiled once per pulse and instruction set: OVERTURN_PULSE, OVERTURN_NUMBER and
// OVERTURN_KERNEL (the name of the one function seen from outside) come from CMake.
// Beside it, only templates over OVERTURN_NUMBER may be instantiated here: a function in double
// would be shared with the rest of the program, which runs on machines that lack these
// instructions.
#include "sweep_kernel.hpp"

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/number/pack.hpp"

#include <limits>

namespace overturn {

namespace {

using T = OVERTURN_NUMBER;
using Pulse = OVERTURN_PULSE;

constexpr int lanes = lanes_v<T>;

/// The flag in the lanes of the mask, 0 elsewhere.
T flagged(const mask_t<T>& mask, std::uint8_t flag)
{
    return select<T>(mask, T(double(flag)), T(0.0));
}

int point_at(const TilePoints& points, int i)
{
    return points.chosen == nullptr ? i : points.chosen[i];
}

/// Stores the lanes of one pack, as many as there are points left.
template <Records records>
void store(const ForcedEnd<T>& end, const TilePoints& points, int first, const PointEnds& to)
{
    const int count = points.chosen_count - first < lanes ? points.chosen_count - first : lanes;
    const auto put = [&](const T& number, auto* array) {
        const auto values = lanes_of(number);
        for (int i = 0; i < count; ++i) {
            array[point_at(points, first + i)] = std::remove_pointer_t<decltype(array)>(values[i]);
        }
    };
    put(end.state.tilt, to.tilt);
    put(end.state.rate, to.rate);
    put(end.state.side, to.side);
    T flags = flagged(end.fell, end_flag::fell) + flagged(end.rested, end_flag::rested) +
              flagged(end.capped, end_flag::capped) + flagged(end.not_finite, end_flag::not_finite);
    if constexpr (records.error) {
        flags = flags + flagged(end.in_doubt, end_flag::in_doubt);
        put(end.error, to.error);
    }
    put(flags, to.flags);
    if constexpr (records.impacts) {
        if (to.impacts != nullptr) {
            put(end.impacts, to.impacts);
        }
    }
    if constexpr (records.peak) {
        put(end.peak, to.peak);
    }
    if (to.steps != nullptr) {
        put(end.steps, to.steps);
    }
    if (to.phase != nullptr) {
        put(end.phase, to.phase);
    }
}

/// Packs that take turns, step by step: while one waits for the end of a long chain of operations
/// the processor is at work on the next. Two gain 40 % for Runge-Kutta steps and 4 % for Taylor's;
/// four gain no more.
constexpr int packs_in_turns = 2;

/// The excitation of the points from `first` on. Lanes beyond the last point repeat it, except that
/// the ground never lifts their blocks; so a pack without points of its own is done at once.
Excitation<Pulse, T> excitation_from(const TilePoints& points, int first)
{
    double acceleration[lanes];
    double frequency[lanes];
    double uplifts[Pulse::lobes][lanes];
    const int last = points.chosen_count - 1;
    for (int i = 0; i < lanes; ++i) {
        const bool spare = first + i > last;
        const int point = point_at(points, spare ? last : first + i);
        const int row = point / points.columns;
        acceleration[i] = points.acceleration[row];
        frequency[i] = points.frequency[point - row * points.columns];
        for (int lobe = 0; lobe < Pulse::lobes; ++lobe) {
            uplifts[lobe][i] = spare ? std::numeric_limits<double>::infinity()
                                     : points.uplifts[row * Pulse::lobes + lobe];
        }
    }
    Excitation<Pulse, T> excitation{.acceleration = load<T>(acceleration),
                                    .frequency = load<T>(frequency),
                                    .uplifts = {},
                                    .begin = points.begin,
                                    .end = points.end};
    for (int lobe = 0; lobe < Pulse::lobes; ++lobe) {
        excitation.uplifts[lobe] = load<T>(uplifts[lobe]);
    }
    return excitation;
}

/// Steps of a pack between two looks at whether the tile is to be dropped: some milliseconds. A
/// pack may take a million.
constexpr int turns_between_looks = 4096;

template <class Method, Theory theory, Records records>
void sweep(const TilePoints& points, const PointEnds& ends)
{
    const Block<T> block{T(points.slenderness), T(points.restitution)};
    const auto stage_from = [&](int first) {
        return ForcedStage<Method, Pulse, theory, records, T>(block, excitation_from(points, first),
                                                              points.tolerance, points.in_doubt);
    };
    int turns = turns_between_looks;
    for (int first = 0; first < points.chosen_count; first += packs_in_turns * lanes) {
        std::array stages{stage_from(first), stage_from(first + lanes)};
        static_assert(stages.size() == packs_in_turns);
        while (run_in_turns(stages, turns)) {
            if (points.drop_requested(points.context)) {
                return;
            }
            turns = turns_between_looks;
        }
        for (int i = 0; i < packs_in_turns; ++i) {
            store<records>(stages[i].end(), points, first + i * lanes, ends);
        }
    }
}

template <class Method, Theory theory>
SweepKernel kernel_for(Recorded recorded)
{
    switch (recorded) {
    case Recorded::impacts: return sweep<Method, theory, Records{.impacts = true}>;
    case Recorded::error: return sweep<Method, theory, Records{.impacts = true, .error = true}>;
    case Recorded::peak: return sweep<Method, theory, Records{.impacts = true, .peak = true}>;
    default: return sweep<Method, theory, Records{}>;
    }
}

template <class Method>
SweepKernel kernel_for(Theory theory, Recorded recorded)
{
    return theory == Theory::linear ? kernel_for<Method, Theory::linear>(recorded)
                                    : kernel_for<Method, Theory::nonlinear>(recorded);
}

} // namespace

SweepKernel OVERTURN_KERNEL(Integrator integrator, Theory theory, Recorded recorded)
{
    switch (integrator) {
    case Integrator::taylor_14: return kernel_for<Taylor<14>>(theory, recorded);
    case Integrator::taylor_20: return kernel_for<Taylor<20>>(theory, recorded);
    default: return kernel_for<RungeKutta>(theory, recorded);
    }
}

} // namespace overturn
