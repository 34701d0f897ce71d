#include "overturn/sweep/sweep_tile.hpp"

#include "sweep_kernel.hpp"

#include "overturn/mechanics/pulse.hpp"
#include "overturn/mechanics/region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace overturn {

#define OVERTURN_FOR_EACH_PULSE(X, isa)                                                            \
    X(isa, OneSine)                                                                                \
    X(isa, OneCosine)                                                                              \
    X(isa, SymmetricRicker)                                                                        \
    X(isa, AntisymmetricRicker)                                                                    \
    X(isa, HalfSine)                                                                               \
    X(isa, Rectangular)
#define OVERTURN_DECLARE(isa, pulse)                                                               \
    SweepKernel sweep_kernel_##isa##_##pulse(Integrator, Theory, bool);
#define OVERTURN_LIST(isa, pulse) sweep_kernel_##isa##_##pulse,

OVERTURN_FOR_EACH_PULSE(OVERTURN_DECLARE, double)
#ifdef __x86_64__
OVERTURN_FOR_EACH_PULSE(OVERTURN_DECLARE, avx2)
OVERTURN_FOR_EACH_PULSE(OVERTURN_DECLARE, avx512)
#endif

namespace {

/// In the order of Kernel and PulseKind.
constexpr SweepKernelChoice kernels[][pulse_names.size()] = {
    {OVERTURN_FOR_EACH_PULSE(OVERTURN_LIST, double)},
#ifdef __x86_64__
    {OVERTURN_FOR_EACH_PULSE(OVERTURN_LIST, avx2)},
    {OVERTURN_FOR_EACH_PULSE(OVERTURN_LIST, avx512)},
#endif
};

/// Where the orders cost the same: on the paper's one-sine spectrum 14 is a fifth cheaper than 20
/// at 1e-5, and a third dearer at 1e-11; no third order gains more than a twentieth anywhere.
constexpr double loosest_tolerance_of_order_20 = 3e-8;

Integrator integrator_of(const Numerics& numerics)
{
    if (numerics.method == Method::rk45) {
        return Integrator::runge_kutta;
    }
    return numerics.tolerance > loosest_tolerance_of_order_20 ? Integrator::taylor_14
                                                              : Integrator::taylor_20;
}

/// Calls visit.template operator()<Pulse>() for the pulse of this kind.
template <class Visitor>
auto with_pulse(PulseKind kind, const Visitor& visit)
{
    switch (kind) {
    case PulseKind::one_cosine: return visit.template operator()<OneCosine>();
    case PulseKind::symmetric_ricker: return visit.template operator()<SymmetricRicker>();
    case PulseKind::antisymmetric_ricker: return visit.template operator()<AntisymmetricRicker>();
    case PulseKind::half_sine: return visit.template operator()<HalfSine>();
    case PulseKind::rectangular: return visit.template operator()<Rectangular>();
    case PulseKind::one_sine: break;
    }
    return visit.template operator()<OneSine>();
}

template <class Visitor>
auto with_theory(Theory theory, const Visitor& visit)
{
    return theory == Theory::linear ? visit.template operator()<Theory::linear>()
                                    : visit.template operator()<Theory::nonlinear>();
}

/// The forced stage of every point of the tile.
template <class Pulse>
std::vector<PointEnd> run_kernel(const Scene& scene, const Numerics& numerics, const Plane& plane,
                                 const Tile& tile, bool count_impacts, Kernel kernel)
{
    const double slenderness = plane.slenderness[tile.slenderness];
    const double threshold = with_theory(
        scene.theory, [&]<Theory theory>() { return uplift_acceleration<theory>(slenderness); });
    const std::vector<double> frequency =
        plane.frequency.values(tile.frequency_begin, tile.frequency_begin + tile.frequency_count);
    std::vector<double> acceleration;
    std::vector<double> uplifts;
    for (std::int64_t row = 0; row < tile.amplitude_count; ++row) {
        const double amplitude = plane.amplitude[tile.amplitude_begin + row];
        acceleration.push_back(amplitude * threshold);
        const auto phases = uplift_phases<Pulse>(amplitude, scene.window);
        uplifts.insert(uplifts.end(), phases.begin(), phases.end());
    }
    const TilePoints points{.slenderness = slenderness,
                            .restitution =
                                plane.restitution_ratio(tile.slenderness, tile.restitution),
                            .rows = int(tile.amplitude_count),
                            .columns = int(tile.frequency_count),
                            .acceleration = acceleration.data(),
                            .uplifts = uplifts.data(),
                            .frequency = frequency.data(),
                            .begin = Pulse::begin(scene.window),
                            .end = Pulse::end(scene.window),
                            .tolerance = numerics.tolerance};
    std::vector<PointEnd> ends(std::size_t(tile.points()));
    const SweepKernelChoice choice = kernels[std::size_t(kernel)][std::size_t(scene.pulse)];
    choice(integrator_of(numerics), scene.theory, count_impacts)(points, ends.data());
    return ends;
}

bool is_undecided(const PointEnd& end)
{
    return end.capped || end.not_finite;
}

template <Theory theory>
Region region_of(const PointEnd& end, const Block<double>& block)
{
    if (is_undecided(end)) {
        return Region::undecided;
    }
    if (end.fell) {
        return end.plus ? Region::F_plus : Region::F_minus;
    }
    return region_after_pulse<theory>(State<double>{end.tilt, end.rate, end.plus ? 1.0 : -1.0},
                                      block);
}

template <Theory theory>
double margin_of(const PointEnd& end, const Block<double>& block)
{
    return end.fell ? margin_of_fall<theory>(end.rate, block)
                    : margin_after_pulse<theory>(State<double>{end.tilt, end.rate, 1.0}, block);
}

std::uint16_t impacts_of(const PointEnd& end)
{
    if (end.rested) {
        return impact_count::bounce_series;
    }
    return std::uint16_t(std::min(end.impacts, double(impact_count::largest)));
}

std::uint8_t status_of(const PointEnd& end)
{
    return std::uint8_t((end.rested ? status::came_to_rest : 0) |
                        (end.capped ? status::cap_was_hit : 0) |
                        (end.not_finite ? status::not_finite : 0));
}

/// The value of a number in a point whose outcome may be undecided.
double decided(const PointEnd& end, double value)
{
    return is_undecided(end) ? std::numeric_limits<double>::quiet_NaN() : value;
}

template <class Value, class Function>
FieldValues values_of(const std::vector<PointEnd>& ends, const Function& function)
{
    std::vector<Value> values(ends.size());
    std::transform(ends.begin(), ends.end(), values.begin(), function);
    return values;
}

template <Theory theory>
FieldValues field_values(Field field, const std::vector<PointEnd>& ends, const Block<double>& block)
{
    const auto signed_by_side = [](const PointEnd& end, double value) {
        return decided(end, end.plus ? value : 0.0 - value); // 0 - 0 is +0
    };
    switch (field) {
    case Field::region:
        return values_of<std::uint8_t>(
            ends, [&](const PointEnd& end) { return std::uint8_t(region_of<theory>(end, block)); });
    case Field::angle:
        return values_of<double>(
            ends, [&](const PointEnd& end) { return signed_by_side(end, end.tilt); });
    case Field::velocity:
        return values_of<double>(
            ends, [&](const PointEnd& end) { return signed_by_side(end, end.rate); });
    case Field::margin:
        return values_of<double>(
            ends, [&](const PointEnd& end) { return decided(end, margin_of<theory>(end, block)); });
    case Field::impacts: return values_of<std::uint16_t>(ends, impacts_of);
    case Field::status: break;
    }
    return values_of<std::uint8_t>(ends, status_of);
}

} // namespace

TileFields sweep_tile(const Scene& scene, const Numerics& numerics, const Plane& plane,
                      const Tile& tile, const std::vector<Field>& fields, Kernel kernel)
{
    const bool count_impacts =
        std::find(fields.begin(), fields.end(), Field::impacts) != fields.end();
    const std::vector<PointEnd> ends = with_pulse(scene.pulse, [&]<class Pulse>() {
        return run_kernel<Pulse>(scene, numerics, plane, tile, count_impacts, kernel);
    });
    const Block<double> block{plane.slenderness[tile.slenderness],
                              plane.restitution_ratio(tile.slenderness, tile.restitution)};
    TileFields result;
    for (const Field field : fields) {
        result.values.push_back(with_theory(scene.theory, [&]<Theory theory>() {
            return field_values<theory>(field, ends, block);
        }));
    }
    return result;
}

} // namespace overturn
