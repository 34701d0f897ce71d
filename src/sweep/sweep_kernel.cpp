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

T as_lanes(const mask_t<T>& mask)
{
    return select<T>(mask, T(1.0), T(0.0));
}

/// Stores the lanes of one pack; the last pack of a row may have fewer points than lanes.
void store(const ForcedEnd<T>& end, PointEnd* to, int count)
{
    const auto tilt = lanes_of(end.state.tilt);
    const auto rate = lanes_of(end.state.rate);
    const auto side = lanes_of(end.state.side);
    const auto impacts = lanes_of(end.impacts);
    const auto fell = lanes_of(as_lanes(end.fell));
    const auto rested = lanes_of(as_lanes(end.rested));
    const auto capped = lanes_of(as_lanes(end.capped));
    const auto not_finite = lanes_of(as_lanes(end.not_finite));
    for (int i = 0; i < count; ++i) {
        to[i] = {.tilt = tilt[i],
                 .rate = rate[i],
                 .impacts = impacts[i],
                 .plus = side[i] > 0,
                 .fell = fell[i] > 0,
                 .rested = rested[i] > 0,
                 .capped = capped[i] > 0,
                 .not_finite = not_finite[i] > 0};
    }
}

template <Theory theory, Records records>
void sweep(const TilePoints& points, PointEnd* ends)
{
    constexpr int lanes = lanes_v<T>;
    const Block<T> block{T(points.slenderness), T(points.restitution)};
    for (int row = 0; row < points.rows; ++row) {
        Excitation<Pulse, T> excitation{.acceleration = T(points.acceleration[row]),
                                        .frequency = T(0.0),
                                        .uplifts = {},
                                        .begin = points.begin,
                                        .end = points.end};
        for (int i = 0; i < Pulse::lobes; ++i) {
            excitation.uplifts[i] = T(points.uplifts[row * Pulse::lobes + i]);
        }
        for (int column = 0; column < points.columns; column += lanes) {
            const int count = points.columns - column < lanes ? points.columns - column : lanes;
            double frequency[lanes];
            for (int i = 0; i < lanes; ++i) {
                // Lanes beyond the row's end repeat its last point.
                frequency[i] = points.frequency[column + (i < count ? i : count - 1)];
            }
            excitation.frequency = load<T>(frequency);
            const auto end =
                run_forced_stage<Pulse, theory, records>(block, excitation, points.tolerance);
            store(end, ends + row * points.columns + column, count);
        }
    }
}

} // namespace

SweepKernel OVERTURN_KERNEL(Theory theory, bool count_impacts)
{
    constexpr Records plain{};
    constexpr Records counting{.impacts = true};
    if (theory == Theory::linear) {
        return count_impacts ? sweep<Theory::linear, counting> : sweep<Theory::linear, plain>;
    }
    return count_impacts ? sweep<Theory::nonlinear, counting> : sweep<Theory::nonlinear, plain>;
}

} // namespace overturn
