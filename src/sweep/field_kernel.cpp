// Compiled once per instruction set; see sweep_kernel.cpp for what may stand here.
#include "sweep_kernel.hpp"

#include "overturn/mechanics/region.hpp"
#include "overturn/number/pack.hpp"

#include <limits>

namespace overturn {

namespace {

using T = OVERTURN_NUMBER;
constexpr int lanes = lanes_v<T>;

/// The ends of one pack of points; lanes beyond the last point repeat it.
struct PackOfEnds {
    PackOfEnds(const PointEnds& ends, int first, int points)
    {
        double tilt[lanes];
        double rate[lanes];
        double side[lanes];
        double is_fallen[lanes];
        double is_undecided[lanes];
        for (int i = 0; i < lanes; ++i) {
            const int point = first + i < points ? first + i : points - 1;
            tilt[i] = ends.tilt[point];
            rate[i] = ends.rate[point];
            side[i] = ends.side[point];
            is_fallen[i] = ends.flags[point] & end_flag::fell;
            is_undecided[i] = ends.flags[point] & end_flag::undecided;
        }
        state = {load<T>(tilt), load<T>(rate), load<T>(side)};
        fell = load<T>(is_fallen) > T(0.0);
        undecided = load<T>(is_undecided) > T(0.0);
    }

    State<T> state;
    mask_t<T> fell;
    mask_t<T> undecided;
};

/// value(ends) for all points, as `Value`s.
template <class Value, class Function>
void for_all(const PointEnds& ends, int points, Value* to, const Function& value)
{
    for (int first = 0; first < points; first += lanes) {
        const auto values = lanes_of(value(PackOfEnds(ends, first, points)));
        for (int i = 0; i < lanes && first + i < points; ++i) {
            to[first + i] = Value(values[i]);
        }
    }
}

template <Theory theory>
void regions(const Block<T>& block, const PointEnds& ends, int points, std::uint8_t* to)
{
    const auto code = [](Region region) { return T(double(region)); };
    for_all(ends, points, to, [&](const PackOfEnds& end) -> T {
        const T fallen =
            select<T>(end.state.side > T(0.0), code(Region::F_plus), code(Region::F_minus));
        const T decided =
            select<T>(end.fell, fallen, region_code_after_pulse<theory>(end.state, block));
        return select<T>(end.undecided, code(Region::undecided), decided);
    });
}

template <Theory theory>
void margins(const Block<T>& block, const PointEnds& ends, int points, double* to)
{
    for_all(ends, points, to, [&](const PackOfEnds& end) -> T {
        const T decided = select<T>(end.fell, margin_of_fall<theory>(end.state.rate, block),
                                    margin_after_pulse<theory>(end.state, block));
        return select<T>(end.undecided, T(std::numeric_limits<double>::quiet_NaN()), decided);
    });
}

Block<T> in_lanes(const Block<double>& block)
{
    return {T(block.slenderness), T(block.restitution)};
}

} // namespace

extern const FieldKernels OVERTURN_KERNEL;
const FieldKernels OVERTURN_KERNEL{
    .regions =
        [](Theory theory, const Block<double>& block, const PointEnds& ends, int points,
           std::uint8_t* to) {
            theory == Theory::linear
                ? regions<Theory::linear>(in_lanes(block), ends, points, to)
                : regions<Theory::nonlinear>(in_lanes(block), ends, points, to);
        },
    .margins =
        [](Theory theory, const Block<double>& block, const PointEnds& ends, int points,
           double* to) {
            theory == Theory::linear
                ? margins<Theory::linear>(in_lanes(block), ends, points, to)
                : margins<Theory::nonlinear>(in_lanes(block), ends, points, to);
        }};

} // namespace overturn
