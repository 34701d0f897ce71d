// Compiled once per pulse and instruction set: OVERTURN_PULSE, OVERTURN_NUMBER and
// OVERTURN_KERNEL (the name of the one function seen from outside) come from CMake.
// Beside it, only templates over OVERTURN_NUMBER may be instantiated here: a function in double
// would be shared with the rest of the program, which runs on machines that lack these
// instructions.
#include "sweep_kernel.hpp"

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/number/pack.hpp"

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

/// Stores the lanes of one pack, as many as there are points left.
template <Records records>
void store(const ForcedEnd<T>& end, const PointEnds& to, int first, int points_left)
{
    const auto put = [&](const T& number, double* array) {
        const auto values = lanes_of(number);
        for (int i = 0; i < lanes && i < points_left; ++i) {
            array[first + i] = values[i];
        }
    };
    put(end.state.tilt, to.tilt);
    put(end.state.rate, to.rate);
    put(end.state.side, to.side);
    if constexpr (records.impacts) {
        put(end.impacts, to.impacts);
    }
    const auto flags = lanes_of(
        flagged(end.fell, end_flag::fell) + flagged(end.rested, end_flag::rested) +
        flagged(end.capped, end_flag::capped) + flagged(end.not_finite, end_flag::not_finite));
    for (int i = 0; i < lanes && i < points_left; ++i) {
        to.flags[first + i] = std::uint8_t(flags[i]);
    }
}

/// Packs that take turns, step by step: while one waits for the end of a long chain of operations
/// the processor is at work on the next. Two gain 40 % for Runge-Kutta steps and 4 % for Taylor's;
/// four gain no more.
constexpr int packs_in_turns = 2;

/// The excitation of the points from `first` on, counted row by row; lanes beyond the tile's end
/// repeat its last point.
Excitation<Pulse, T> excitation_from(const TilePoints& points, int first)
{
    double acceleration[lanes];
    double frequency[lanes];
    double uplifts[Pulse::lobes][lanes];
    const int last = points.rows * points.columns - 1;
    for (int i = 0; i < lanes; ++i) {
        const int point = first + i < last ? first + i : last;
        const int row = point / points.columns;
        acceleration[i] = points.acceleration[row];
        frequency[i] = points.frequency[point - row * points.columns];
        for (int lobe = 0; lobe < Pulse::lobes; ++lobe) {
            uplifts[lobe][i] = points.uplifts[row * Pulse::lobes + lobe];
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

template <class Method, Theory theory, Records records>
void sweep(const TilePoints& points, const PointEnds& ends)
{
    const Block<T> block{T(points.slenderness), T(points.restitution)};
    const int count = points.rows * points.columns;
    const auto stage_from = [&](int first) {
        return ForcedStage<Method, Pulse, theory, records, T>(block, excitation_from(points, first),
                                                              points.tolerance);
    };
    for (int first = 0; first < count; first += packs_in_turns * lanes) {
        std::array stages{stage_from(first), stage_from(first + lanes)};
        static_assert(stages.size() == packs_in_turns);
        run_in_turns(stages);
        for (int i = 0; i < packs_in_turns; ++i) {
            const int from = first + i * lanes;
            store<records>(stages[i].end(), ends, from, count - from);
        }
    }
}

template <class Method>
SweepKernel kernel_for(Theory theory, bool count_impacts)
{
    constexpr Records plain{};
    constexpr Records counting{.impacts = true};
    if (theory == Theory::linear) {
        return count_impacts ? sweep<Method, Theory::linear, counting>
                             : sweep<Method, Theory::linear, plain>;
    }
    return count_impacts ? sweep<Method, Theory::nonlinear, counting>
                         : sweep<Method, Theory::nonlinear, plain>;
}

} // namespace

SweepKernel OVERTURN_KERNEL(Integrator integrator, Theory theory, bool count_impacts)
{
    switch (integrator) {
    case Integrator::taylor_14: return kernel_for<Taylor<14>>(theory, count_impacts);
    case Integrator::taylor_20: return kernel_for<Taylor<20>>(theory, count_impacts);
    default: return kernel_for<RungeKutta>(theory, count_impacts);
    }
}

} // namespace overturn
