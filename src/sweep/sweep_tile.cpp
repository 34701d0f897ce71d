#include "overturn/sweep/sweep_tile.hpp"

#include "sweep_kernel.hpp"

#include "overturn/mechanics/pulse.hpp"

#include <algorithm>
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
extern const FieldKernels field_kernels_double;
#ifdef __x86_64__
extern const FieldKernels field_kernels_avx2;
extern const FieldKernels field_kernels_avx512;
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

const FieldKernels& field_kernels(Kernel kernel)
{
#ifdef __x86_64__
    if (kernel != Kernel::one_lane) {
        return kernel == Kernel::avx512 ? field_kernels_avx512 : field_kernels_avx2;
    }
#endif
    return field_kernels_double;
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

/// The arrays behind PointEnds.
struct Ends {
    Ends(std::size_t points, bool with_impacts)
        : tilt(points), rate(points), side(points), flags(points),
          impacts(with_impacts ? points : 0)
    {}

    PointEnds pointers()
    {
        return {tilt.data(), rate.data(), side.data(), flags.data(), impacts.data()};
    }

    std::vector<double> tilt, rate, side;
    std::vector<std::uint8_t> flags;
    std::vector<double> impacts; // empty unless they are counted
};

/// The forced stage of every point of the tile.
template <class Pulse>
void run_kernel(const Scene& scene, const Numerics& numerics, const Plane& plane, const Tile& tile,
                Kernel kernel, Ends& ends)
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
    const SweepKernelChoice choice = kernels[std::size_t(kernel)][std::size_t(scene.pulse)];
    const SweepKernel sweep = choice(integrator_of(numerics), scene.theory, !ends.impacts.empty());
    sweep(points, ends.pointers());
}

/// An angle or a velocity with its sign; not a number where the point is undecided.
std::vector<double> with_sign(const std::vector<double>& values, const Ends& ends)
{
    std::vector<double> result(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double value = ends.side[i] > 0 ? values[i] : 0.0 - values[i]; // 0 - 0 is +0
        result[i] =
            ends.flags[i] & end_flag::undecided ? std::numeric_limits<double>::quiet_NaN() : value;
    }
    return result;
}

std::vector<std::uint16_t> stored_impacts(const Ends& ends)
{
    std::vector<std::uint16_t> result(ends.impacts.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double counted = std::min(ends.impacts[i], double(impact_count::largest));
        result[i] =
            ends.flags[i] & end_flag::rested ? impact_count::bounce_series : std::uint16_t(counted);
    }
    return result;
}

std::vector<std::uint8_t> stored_status(const Ends& ends)
{
    std::vector<std::uint8_t> result(ends.flags.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const auto flag = [&](std::uint8_t in, std::uint8_t out) {
            return ends.flags[i] & in ? out : 0;
        };
        result[i] = std::uint8_t(flag(end_flag::rested, status::came_to_rest) |
                                 flag(end_flag::capped, status::cap_was_hit) |
                                 flag(end_flag::not_finite, status::not_finite));
    }
    return result;
}

FieldValues field_values(Field field, Theory theory, const Block<double>& block, Ends& ends,
                         Kernel kernel)
{
    const int points = int(ends.tilt.size());
    switch (field) {
    case Field::region: {
        std::vector<std::uint8_t> codes(ends.tilt.size());
        field_kernels(kernel).regions(theory, block, ends.pointers(), points, codes.data());
        return codes;
    }
    case Field::angle: return with_sign(ends.tilt, ends);
    case Field::velocity: return with_sign(ends.rate, ends);
    case Field::margin: {
        std::vector<double> values(ends.tilt.size());
        field_kernels(kernel).margins(theory, block, ends.pointers(), points, values.data());
        return values;
    }
    case Field::impacts: return stored_impacts(ends);
    case Field::status: break;
    }
    return stored_status(ends);
}

} // namespace

TileFields sweep_tile(const Scene& scene, const Numerics& numerics, const Plane& plane,
                      const Tile& tile, const std::vector<Field>& fields, Kernel kernel)
{
    const bool count_impacts =
        std::find(fields.begin(), fields.end(), Field::impacts) != fields.end();
    Ends ends(std::size_t(tile.points()), count_impacts);
    with_pulse(scene.pulse, [&]<class Pulse>() {
        run_kernel<Pulse>(scene, numerics, plane, tile, kernel, ends);
    });
    const Block<double> block{plane.slenderness[tile.slenderness],
                              plane.restitution_ratio(tile.slenderness, tile.restitution)};
    TileFields result;
    for (const Field field : fields) {
        result.values.push_back(field_values(field, scene.theory, block, ends, kernel));
    }
    return result;
}

} // namespace overturn
