#include "tile_run.hpp"

#include "exact_end.hpp"
#include "for_scene.hpp"

#include "overturn/mechanics/free_rocking.hpp"
#include "overturn/mechanics/low_bounces.hpp"
#include "overturn/number/digits50.hpp"

#include <algorithm>

namespace overturn {

#define OVERTURN_FOR_EACH_PULSE(X, isa)                                                            \
    X(isa, OneSine)                                                                                \
    X(isa, OneCosine)                                                                              \
    X(isa, SymmetricRicker)                                                                        \
    X(isa, AntisymmetricRicker)                                                                    \
    X(isa, HalfSine)                                                                               \
    X(isa, Rectangular)
#define OVERTURN_DECLARE(isa, pulse)                                                               \
    SweepKernel sweep_kernel_##isa##_##pulse(Integrator, Theory, Recorded);
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

} // namespace

PointEnds Ends::pointers()
{
    const auto unless_empty = [](std::vector<double>& values) {
        return values.empty() ? nullptr : values.data();
    };
    return {tilt.data(),         rate.data(),           side.data(),
            flags.data(),        unless_empty(impacts), unless_empty(error),
            unless_empty(steps), unless_empty(phase),   unless_empty(peak)};
}

TileRun::TileRun(const Scene& scene, const Plane& plane, const Tile& tile, Kernel kernel,
                 DropRequested drop_requested)
    : scene_(scene), plane_(plane),
      tile_(tile), block_{plane.slenderness[tile.slenderness],
                          plane.restitution_ratio(tile.slenderness, tile.restitution)},
      kernel_(kernel), drop_requested_(std::move(drop_requested)),
      frequency_(
          plane.frequency.values(tile.frequency_begin, tile.frequency_begin + tile.frequency_count))
{
    const double threshold = with_theory(scene.theory, [&]<Theory theory>() {
        return uplift_acceleration<theory>(block_.slenderness);
    });
    with_pulse(scene.pulse, [&]<class Pulse>() {
        begin_ = Pulse::begin(scene.window);
        end_ = Pulse::end(scene.window);
        for (std::int64_t row = 0; row < tile.amplitude_count; ++row) {
            const double amplitude = plane.amplitude[tile.amplitude_begin + row];
            acceleration_.push_back(amplitude * threshold);
            const auto phases = uplift_phases<Pulse>(amplitude, scene.window);
            uplifts_.insert(uplifts_.end(), phases.begin(), phases.end());
        }
    });
}

void TileRun::heed_drop() const
{
    if (drop_requested_ && drop_requested_()) {
        throw TileDropped();
    }
}

void TileRun::run(const Numerics& numerics, Ends& ends, InDoubt in_doubt) const
{
    run(numerics, nullptr, ends.size(), ends, in_doubt);
}

void TileRun::run(const Numerics& numerics, const std::vector<int>& chosen, Ends& ends) const
{
    if (!chosen.empty()) {
        run(numerics, chosen.data(), int(chosen.size()), ends, InDoubt::goes_on);
    }
}

void TileRun::run(const Numerics& numerics, const int* chosen, int count, Ends& ends,
                  InDoubt in_doubt) const
{
    const TilePoints points{.slenderness = block_.slenderness,
                            .restitution = block_.restitution,
                            .rows = int(acceleration_.size()),
                            .columns = int(frequency_.size()),
                            .acceleration = acceleration_.data(),
                            .uplifts = uplifts_.data(),
                            .frequency = frequency_.data(),
                            .begin = begin_,
                            .end = end_,
                            .tolerance = numerics.tolerance,
                            .in_doubt = in_doubt,
                            .chosen = chosen,
                            .chosen_count = count,
                            .drop_requested =
                                [](const void* context) {
                                    const auto& requested =
                                        *static_cast<const DropRequested*>(context);
                                    return requested && requested();
                                },
                            .context = &drop_requested_};
    const Recorded recorded = !ends.error.empty()     ? Recorded::error
                              : !ends.peak.empty()    ? Recorded::peak
                              : !ends.impacts.empty() ? Recorded::impacts
                                                      : Recorded::nothing;
    const SweepKernelChoice choice = kernels[std::size_t(kernel_)][std::size_t(scene_.pulse)];
    const SweepKernel sweep = choice(integrator_of(numerics), scene_.theory, recorded);
    sweep(points, ends.pointers());
    heed_drop(); // or some ends may be missing
}

template <class T>
void TileRun::run_exactly(int point, Ends& ends) const
{
    heed_drop();
    const int columns = int(frequency_.size());
    const ExactEnd end = exact_end<T>(
        scene_, {.slenderness = block_.slenderness,
                 .restitution = block_.restitution,
                 .amplitude = plane_.amplitude[tile_.amplitude_begin + point / columns],
                 .frequency = frequency_[std::size_t(point % columns)]});
    ends.tilt[point] = end.tilt;
    ends.rate[point] = end.rate;
    ends.side[point] = end.side;
    ends.flags[point] = end.flags;
    ends.error[point] = end.error;
    const auto put = [&](std::vector<double>& values, double value) {
        if (!values.empty()) {
            values[point] = value;
        }
    };
    put(ends.impacts, end.impacts);
    put(ends.steps, end.steps);
    put(ends.phase, end.phase);
    ends.settled.push_back({point, end.region, end.margin});
}

template void TileRun::run_exactly<long double>(int, Ends&) const;
template void TileRun::run_exactly<Digits50>(int, Ends&) const;

bool TileRun::settle_low_bounces(int point, Ends& ends) const
{
    const std::size_t columns = frequency_.size();
    const std::size_t row = std::size_t(point) / columns;
    const auto bounds = for_scene(scene_.pulse, scene_.theory, [&]<class Pulse, Theory theory>() {
        Excitation<Pulse, double> excitation{.acceleration = acceleration_[row],
                                             .frequency = frequency_[std::size_t(point) % columns],
                                             .uplifts = {},
                                             .begin = begin_,
                                             .end = end_};
        std::copy_n(uplifts_.begin() + std::ptrdiff_t(row * Pulse::lobes), Pulse::lobes,
                    excitation.uplifts.begin());
        return bound_of_low_bounces<theory>(block_.slenderness, excitation);
    });
    if (!bounds) {
        return false;
    }
    // The margin is that of a block at rest, 1, but for these: no distance to a limit of the rate
    // changes by more than the tilt and the rate do.
    const double largest = with_theory(scene_.theory, [&]<Theory theory>() {
        return separatrix_rate<theory>(0.0, block_.slenderness);
    });
    const double error = (bounds->tilt + bounds->rate) / largest;
    if (!(error < 1)) {
        return false;
    }
    std::uint8_t& flags = ends.flags[std::size_t(point)];
    if (flags & end_flag::capped) {
        flags = 0;
        ends.tilt[std::size_t(point)] = 0;
        ends.rate[std::size_t(point)] = 0;
    }
    ends.error[std::size_t(point)] = error;
    ends.settled.push_back({point, Region::S, 1});
    return true;
}

std::vector<std::uint8_t> TileRun::regions(Ends& ends) const
{
    std::vector<std::uint8_t> codes(ends.flags.size());
    field_kernels(kernel_).regions(scene_.theory, block_, ends.pointers(), ends.size(),
                                   codes.data());
    for (const SettledPoint& settled : ends.settled) {
        codes[settled.point] = std::uint8_t(settled.region);
    }
    for (const int point : ends.unresolved) {
        codes[point] = std::uint8_t(Region::undecided);
    }
    return codes;
}

std::vector<double> TileRun::margins(Ends& ends) const
{
    std::vector<double> values(ends.flags.size());
    field_kernels(kernel_).margins(scene_.theory, block_, ends.pointers(), ends.size(),
                                   values.data());
    for (const SettledPoint& settled : ends.settled) {
        if (!(ends.flags[settled.point] & end_flag::undecided)) {
            values[settled.point] = settled.margin;
        }
    }
    return values;
}

std::vector<double> TileRun::peaks(Ends& ends) const
{
    const std::vector<std::uint8_t> codes = regions(ends);
    std::vector<double> values(codes.size());
    with_theory(scene_.theory, [&]<Theory theory>() {
        for (std::size_t i = 0; i < codes.size(); ++i) {
            const auto region = Region(codes[i]);
            const State<double> end{ends.tilt[i], ends.rate[i], ends.side[i]};
            values[i] = is_safe(region)
                            ? std::max(ends.peak[i], largest_free_tilt<theory>(end, block_)) /
                                  block_.slenderness
                        : is_unsafe(region) ? std::numeric_limits<double>::infinity()
                                            : std::numeric_limits<double>::quiet_NaN();
        }
    });
    return values;
}

double TileRun::first_uplift(std::size_t row) const
{
    const std::size_t lobes = uplifts_.size() / acceleration_.size();
    const auto begin = uplifts_.begin() + std::ptrdiff_t(row * lobes);
    return *std::min_element(begin, begin + std::ptrdiff_t(lobes));
}

std::vector<double> TileRun::fall_times(Ends& ends) const
{
    const std::vector<std::uint8_t> codes = regions(ends);
    std::vector<double> values(codes.size());
    const std::size_t columns = frequency_.size();
    with_theory(scene_.theory, [&]<Theory theory>() {
        for (std::size_t i = 0; i < codes.size(); ++i) {
            const auto region = Region(codes[i]);
            const State<double> end{ends.tilt[i], ends.rate[i], ends.side[i]};
            const double forced =
                (ends.phase[i] - first_uplift(i / columns)) / frequency_[i % columns];
            const bool fell = region == Region::F_plus || region == Region::F_minus;
            values[i] = fell                ? forced
                        : is_unsafe(region) ? forced + free_fall_time<theory>(end, block_)
                        : is_safe(region)   ? std::numeric_limits<double>::infinity()
                                            : std::numeric_limits<double>::quiet_NaN();
        }
    });
    return values;
}

} // namespace overturn
