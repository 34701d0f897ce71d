// Compiled once per method and instruction set: OVERTURN_METHOD, OVERTURN_NUMBER and
// OVERTURN_KERNEL (the name of the one function seen from outside) come from CMake. Beside it, only
// templates over OVERTURN_NUMBER may be instantiated here: a function in double would be shared
// with the rest of the program, which runs on machines that lack these instructions.
#include "sweep_kernel.hpp"

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/number/pack.hpp"

#include <limits>

namespace overturn {

namespace {

using T = OVERTURN_NUMBER;

constexpr int lanes = lanes_v<T>;

/// The flag in the lanes of the mask, 0 elsewhere.
T flagged(const mask_t<T>& mask, std::uint8_t flag)
{
    return select<T>(mask, T(double(flag)), T(0.0));
}

int point_at(const KernelTask& task, int i)
{
    return task.chosen == nullptr ? i : task.chosen[i];
}

/// Stores the lanes of one pack, as many as there are points left.
template <Theory theory, Records records>
[[gnu::noinline]] void store(const ForcedEnd<T>& end, const Block<T>& block, const KernelTask& task,
                             int first, const PointEnds& to)
{
    const int count = task.chosen_count - first < lanes ? task.chosen_count - first : lanes;
    const auto put = [&](const T& number, auto* array) {
        const auto values = lanes_of(number);
        for (int i = 0; i < count; ++i) {
            array[point_at(task, first + i)] = std::remove_pointer_t<decltype(array)>(values[i]);
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
    if constexpr (records.peak) {
        put(end.peak, to.peak);
    }
    if (task.records.impacts) {
        put(end.impacts, to.impacts);
    }
    if (task.records.region) {
        put(region_code_of<theory>(end, block), to.region);
    }
    if (task.records.margin) {
        put(margin_of<theory>(end, block), to.margin);
    }
    if (task.records.steps) {
        put(end.steps, to.steps);
    }
    if (task.records.phase) {
        put(end.phase, to.phase);
    }
}

/// Packs that take turns, step by step: while one waits for the end of a long chain of operations
/// the processor is at work on the next. Two gain 40 % for Runge-Kutta steps and 4 % for Taylor's;
/// four gain no more.
constexpr int packs_in_turns = 2;

/// value(i) of each point i from `first` on. Lanes beyond the last point repeat it.
template <class Value>
T gathered(const KernelTask& task, int first, const Value& value)
{
    double values[lanes];
    for (int i = 0; i < lanes; ++i) {
        const int last = task.chosen_count - 1;
        values[i] = value(point_at(task, first + i < last ? first + i : last));
    }
    return load<T>(values);
}

Block<T> blocks_from(const KernelTask& task, int first)
{
    return {gathered(task, first, [&](int i) { return task.points[i].slenderness; }),
            gathered(task, first, [&](int i) { return task.points[i].restitution; })};
}

/// The ground never lifts the blocks in the lanes beyond the last point; so a pack without points
/// of its own is done at once.
Excitation<T> excitation_from(const KernelTask& task, int first)
{
    const auto push = [&](int i) -> const Push& { return task.pushes[task.push_of_point[i]]; };
    Excitation<T> excitation{
        .motion = task.motion,
        .acceleration = gathered(task, first, [&](int i) { return push(i).acceleration; }),
        .frequency = gathered(task, first, [&](int i) { return task.points[i].frequency; }),
        .uplifts = {}};
    double number[lanes];
    for (int i = 0; i < lanes; ++i) {
        number[i] = first + i;
    }
    const mask_t<T> spare = load<T>(number) >= T(double(task.chosen_count));
    for (int lobe = 0; lobe < most_lobes; ++lobe) {
        const T uplift = gathered(task, first, [&](int i) { return push(i).uplifts[lobe]; });
        excitation.uplifts[lobe] =
            select<T>(spare, T(std::numeric_limits<double>::infinity()), uplift);
    }
    return excitation;
}

/// Steps of a pack between two looks at whether the points are to be dropped: some milliseconds. A
/// pack may take a million.
constexpr int turns_between_looks = 4096;

template <Theory theory, Records records>
void sweep(const KernelTask& task, const PointEnds& ends)
{
    using Stage = ForcedStage<OVERTURN_METHOD, theory, records, T>;
    const auto stage_from = [&](int first) {
        return Stage(blocks_from(task, first), excitation_from(task, first), task.tolerance,
                     task.on_unknown_error);
    };
    int turns = turns_between_looks;
    for (int first = 0; first < task.chosen_count; first += packs_in_turns * lanes) {
        std::array stages{stage_from(first), stage_from(first + lanes)};
        static_assert(stages.size() == packs_in_turns);
        while (run_in_turns(stages, turns)) {
            if (task.drop_requested(task.context)) {
                return;
            }
            turns = turns_between_looks;
        }
        for (int i = 0; i < packs_in_turns; ++i) {
            store<theory, records>(stages[i].end(), stages[i].block(), task, first + i * lanes,
                                   ends);
        }
    }
}

template <Theory theory>
SweepKernel kernel_for(const Records& records)
{
    if (records.error) {
        return sweep<theory, Records{.impacts = true, .error = true}>;
    }
    if (records.peak) {
        return sweep<theory, Records{.impacts = true, .peak = true}>;
    }
    return records.impacts ? sweep<theory, Records{.impacts = true}> : sweep<theory, Records{}>;
}

} // namespace

SweepKernel OVERTURN_KERNEL(Theory theory, const Records& records)
{
    return theory == Theory::linear ? kernel_for<Theory::linear>(records)
                                    : kernel_for<Theory::nonlinear>(records);
}

} // namespace overturn
