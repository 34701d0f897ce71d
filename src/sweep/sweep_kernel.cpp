// Compiled once per method and instruction set. CMake defines OVERTURN_METHOD, OVERTURN_NUMBER
// and its header, OVERTURN_RECORDED (whether the ground motion is a record) and OVERTURN_KERNEL,
// the name of the only function with external linkage. Apart from it, only templates over
// OVERTURN_NUMBER may be instantiated here: with packs, a function in double would be shared with
// the rest of the program, whose commands must be able to refuse a processor without these
// instructions. The kernel `double` shares functions: every command calls kernel_called() or
// widest_kernel() before it computes.
#include "sweep_kernel.hpp"

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/number/double_double.hpp"
#include OVERTURN_NUMBER_HEADER

#include <optional>

namespace overturn {

namespace {

using T = OVERTURN_NUMBER;
using S = scalar_t<T>;

constexpr bool has_31_digits = !std::same_as<S, double>;

constexpr int lanes = lanes_v<T>;

/// The flag in the lanes of the mask, 0 elsewhere.
T flagged(const mask_t<T>& mask, std::uint16_t flag)
{
    return select<T>(mask, T(double(flag)), T(0.0));
}

/// Stores the lanes of one pack, except those without a point. outputs: chosen at compile time, see
/// Outputs; task.outputs: at run time.
template <Theory theory, Outputs outputs>
[[gnu::noinline]] void store(const auto& stage, const KernelTask& task, int first)
{
    const ForcedEnd<T> end = stage.end();
    const Block<T>& block = stage.block();
    const int count = task.chosen_count - first < lanes ? task.chosen_count - first : lanes;
    const auto put = [&]<class Value>(const auto& number, Value Outcome::*member) {
        const auto values = lanes_of(number);
        for (int i = 0; i < count; ++i) {
            task.outcomes[task.chosen[first + i]].*member = Value(double(values[i]));
        }
    };
    const auto put_if = [&](bool is_wanted, const T& number, double Outcome::*member) {
        if (is_wanted) {
            put(number, member);
        }
    };
    const Outputs& wanted = task.outputs;
    put(end.state.tilt, &Outcome::tilt);
    put(end.state.rate, &Outcome::rate);
    put(end.state.side, &Outcome::side);
    T flags = flagged(end.fell, outcome_flag::fell) + flagged(end.rested, status::came_to_rest) +
              flagged(end.capped, status::cap_was_hit) +
              flagged(end.not_finite, status::not_finite);
    if constexpr (has_31_digits) {
        // The margin is rounded to double.
        const T margin = abs(margin_of<theory>(end, block));
        const auto is_finite = end.error < T(infinity);
        const T error = select<T>(
            is_finite, select<T>(is_finite, end.error, 0) + margin * T(0x1p-53), end.error);
        flags = flags + flagged(!(error < margin), outcome_flag::in_doubt);
        put(error, &Outcome::error);
    } else if constexpr (outputs.error) {
        flags = flags + flagged(end.in_doubt, outcome_flag::in_doubt);
        put(end.error, &Outcome::error);
    }
    put(flags, &Outcome::flags);
    put_if(wanted.impacts, end.impacts, &Outcome::impacts);
    put_if(wanted.steps, end.steps, &Outcome::steps);
    put_if(wanted.phase, end.phase, &Outcome::phase);
    if constexpr (outputs.peak) {
        put_if(wanted.peak, end.peak, &Outcome::peak);
        put_if(wanted.grazes, end.lowest_turn, &Outcome::lowest_turn);
        put_if(wanted.grazes, end.softest_impact, &Outcome::softest_impact);
        put_if(wanted.grazes, end.last_impact, &Outcome::last_impact);
    }
    if constexpr (outputs.contact) {
        if (wanted.contact) {
            const auto needs = stage.contact_needs(wanted.slide);
            put(needs.demand.friction, &Outcome::friction_demand);
            put(needs.demand.normal, &Outcome::normal);
            if (wanted.slide) {
                put(needs.to_stick, &Outcome::to_stick);
            }
        }
    }
    if (wanted.region) {
        put(region_code_of<theory>(end, block), &Outcome::region);
    }
    if (wanted.margin) {
        put(margin_of<theory>(end, block), &Outcome::margin);
    }
}

/// The number of packs that advance in turn, step by step: while one waits for a long dependency
/// chain, the processor works on the next. Two packs gain 40 % for Runge-Kutta steps and 4 % for
/// Taylor steps; four packs gain no more.
constexpr int packs_in_turns = 2;

/// The points of the lanes of one pack. Lanes beyond the last point repeat it.
struct PackPoints {
    PackPoints(const KernelTask& given, int first) : task(given)
    {
        for (int i = 0; i < lanes; ++i) {
            const int last = task.chosen_count - 1;
            point[i] = task.chosen[first + i < last ? first + i : last];
            spare[i] = first + i > last ? std::numeric_limits<S>::infinity() : S(0);
        }
    }

    template <class Value>
    T gathered(const Value& value) const
    {
        S values[lanes];
        for (int i = 0; i < lanes; ++i) {
            values[i] = S(value(point[i]));
        }
        return load<T>(values);
    }

    Block<T> blocks() const
    {
        if (task.are_symmetric) {
            return {gathered([&](int i) { return task.points[i].block.slenderness; }),
                    gathered([&](int i) { return task.points[i].block.restitution; })};
        }
        return [&]<std::size_t... lane>(std::index_sequence<lane...>) {
            return combined(
                [](const std::same_as<double> auto&... members) {
                    const S values[]{S(members)...};
                    return load<T>(values);
                },
                task.points[point[lane]].block...);
        }(std::make_index_sequence<std::size_t(lanes)>());
    }

    /// The ground never lifts the blocks in spare lanes, so a pack without points ends immediately.
    template <Theory theory, Directions directions>
    RecordExcitation<T, directions> record_excitation(const Block<T>& blocks) const
    {
        return overturn::record_excitation<theory, directions>(
            *task.record, blocks,
            select<T>(load<T>(spare) == T(0.0),
                      gathered([&](int i) { return task.points[i].amplitude; }), T(0.0)),
            gathered([&](int i) { return task.points[i].frequency; }));
    }

    /// N: T, as a parameter because kernels for records do not compile this.
    template <Number N>
    PulseExcitation<N> pulse_excitation() const
    {
        const auto pulse_of = [&](int i) -> const ScaledPulse<double>& {
            return task.pulses[task.pulse_of_point[i]];
        };
        const ScaledPulse<double>& first = pulse_of(point[0]);
        const bool share_pulse = &first == &pulse_of(point[lanes - 1]); // then all lanes do
        const auto of_pulse = [&](const auto& value) -> N {
            return share_pulse ? N(value(first))
                               : gathered([&](int i) { return value(pulse_of(i)); });
        };
        PulseExcitation<N> excitation{
            .motion = task.pulse,
            .acceleration =
                of_pulse([](const ScaledPulse<double>& pulse) { return pulse.acceleration; }),
            .frequency = gathered([&](int i) { return task.points[i].frequency; }),
            .uplifts = {}};
        const N never_in_spare = load<N>(spare);
        for (int lobe = 0; lobe < first.uplifts.count; ++lobe) {
            const N uplift = of_pulse(
                [&](const ScaledPulse<double>& pulse) { return pulse.uplifts.values[lobe]; });
            excitation.uplifts.push_back(uplift + never_in_spare);
        }
        return excitation;
    }

    const KernelTask& task;
    int point[lanes];
    S spare[lanes]; ///< infinite in spare lanes
};

/// The contact of the blocks, if it is observed.
template <Theory theory, Outputs outputs>
std::optional<ContactSides<estimate_t<T>>> contact_of([[maybe_unused]] const PackPoints& points,
                                                      [[maybe_unused]] const Block<T>& blocks)
{
    if constexpr (outputs.contact) {
        if (points.task.outputs.contact) {
            const T gyration =
                points.gathered([&](int i) { return points.task.points[i].gyration; });
            return ContactSides<estimate_t<T>>(estimate_of(blocks), estimate_of(gyration));
        }
    }
    return std::nullopt;
}

/// Steps of a pack between two calls of drop_requested(): a few milliseconds. A pack may take a
/// million steps.
constexpr int turns_between_checks = 4096;

template <Theory theory, Outputs outputs, Directions directions = Directions::horizontal>
void sweep(const KernelTask& task)
{
    if (task.chosen_count == 0) {
        return;
    }
    const auto excitation_of = [](const PackPoints& points, const Block<T>& blocks) {
        if constexpr (OVERTURN_RECORDED) {
            return points.record_excitation<theory, directions>(blocks);
        } else {
            return points.pulse_excitation<T>();
        }
    };
    using Excitation =
        decltype(excitation_of(std::declval<PackPoints>(), std::declval<Block<T>>()));
    struct Pack {
        std::optional<ForcedStage<OVERTURN_METHOD, theory, outputs, T, Excitation>> stage;
        int first; ///< the index of its first point
    };
    std::array<Pack, packs_in_turns> packs;
    int next = 0;
    // Inlined, so that what depends on the tolerance alone is computed once. After the last point,
    // all lanes are spare.
    const auto fill = [&](Pack & pack) __attribute__((always_inline))
    {
        const PackPoints points(task, next);
        const Block<T> blocks = points.blocks();
        pack.stage.emplace(blocks, excitation_of(points, blocks), S(task.tolerance),
                           task.uncertain_impact, contact_of<theory, outputs>(points, blocks));
        pack.first = next;
        next += lanes;
    };
    for (Pack& pack : packs) {
        fill(pack);
    }
    int turns = 0;
    for (int with_points = packs_in_turns; with_points > 0;) {
        with_points = 0;
        for (Pack& pack : packs) {
            while (!pack.stage->is_active() && pack.first < task.chosen_count) {
                store<theory, outputs>(*pack.stage, task, pack.first);
                fill(pack);
            }
            with_points += pack.stage->is_active();
        }
        // A loop of its own, so that the compiler computes its constants before it.
        for (int active = with_points; active > 0 && active == with_points;) {
            active = 0;
            for (Pack& pack : packs) {
                if (pack.stage->is_active()) {
                    pack.stage->advance();
                    ++active;
                }
            }
            if (++turns % turns_between_checks == 0 && task.drop_requested(task.context)) {
                return;
            }
        }
    }
}

template <Theory theory, Directions directions>
SweepKernel kernel_for(const Outputs& outputs)
{
    // Under a record, the motion may be so sensitive that another integration has another peak.
    constexpr Outputs with_errors{.impacts = true, .error = true, .peak = OVERTURN_RECORDED};
    constexpr bool has_contact = Equations<theory>::has_contact_forces;
    constexpr Outputs all{.impacts = true, .error = true, .peak = true, .contact = has_contact};
    if constexpr (directions == Directions::both) {
        return sweep<theory, all, directions>;
    } else {
        if (outputs.contact || (outputs.error && outputs.peak)) {
            return sweep<theory, all, directions>;
        }
        if (outputs.error) {
            return sweep<theory, with_errors, directions>;
        }
        if (outputs.peak) {
            return sweep<theory, Outputs{.impacts = true, .peak = true}, directions>;
        }
        // Counting impacts costs little beside a step under a record.
        if (OVERTURN_RECORDED || outputs.impacts) {
            return sweep<theory, Outputs{.impacts = true}, directions>;
        }
        // Under a record this is not reached, and compiles no further kernel.
        return sweep<theory, Outputs{.impacts = bool(OVERTURN_RECORDED)}, directions>;
    }
}

template <Theory theory>
SweepKernel kernel_for(const Outputs& outputs, Directions directions)
{
    // Pulses that have a formula need no further kernels. In 31 digits, one for any motion is
    // almost as fast as the others.
    if constexpr (!OVERTURN_RECORDED) {
        return kernel_for<theory, Directions::horizontal>(outputs);
    } else if constexpr (has_31_digits) {
        return kernel_for<theory, Directions::both>(outputs);
    } else {
        return directions == Directions::both ? kernel_for<theory, Directions::both>(outputs)
               : directions == Directions::horizontal
                   ? kernel_for<theory, Directions::horizontal>(outputs)
                   : kernel_for<theory, Directions::both_recorded>(outputs);
    }
}

} // namespace

SweepKernel OVERTURN_KERNEL(Theory theory, const Outputs& outputs, Directions directions)
{
    return with_theory(theory,
                       [&]<Theory known>() { return kernel_for<known>(outputs, directions); });
}

} // namespace overturn
