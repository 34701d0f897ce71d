#include "point_run.hpp"

#include "overturn/integrate/more_digits.hpp"
#include "overturn/mechanics/low_bounces.hpp"
#include "overturn/text/mapped.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace overturn {

namespace {

/// The records of points, in their order; those of equal directions are the same object.
std::vector<Record> records_of(const Scene& scene, const std::vector<Point>& points)
{
    std::map<std::pair<int, double>, Record> known;
    return mapped(points, [&](const Point& point) {
        auto& record = known[{point.record, point.direction}];
        record = record ? record : directed_record(scene, point);
        return record;
    });
}

Digits31 in_31_digits(const Digits50& x)
{
    const double high(x);
    return {high, std::isfinite(high) ? double(x - high) : 0};
}

PerLobe<Digits31> in_31_digits(const PerLobe<Digits50>& exact)
{
    PerLobe<Digits31> result;
    for (const Digits50& number : exact) {
        result.push_back(in_31_digits(number));
    }
    return result;
}

/// The functions that an excitation is made with are not defined in 31 digits.
PulseExcitation<Digits31> in_31_digits(const PulseExcitation<Digits50>& exact)
{
    const PulseMotion<Digits50>& motion = exact.motion;
    return {{motion.pulse,
             motion.form,
             in_31_digits(motion.begin),
             in_31_digits(motion.end),
             in_31_digits(motion.kink),
             in_31_digits(motion.fastest),
             {in_31_digits(motion.sine.scale), in_31_digits(motion.sine.q),
              in_31_digits(motion.sine.sine_of_nu), in_31_digits(motion.sine.cosine_of_nu)},
             in_31_digits(motion.peaks)},
            in_31_digits(exact.acceleration),
            in_31_digits(exact.frequency),
            in_31_digits(exact.uplifts)};
}

/// The outcome of a point that cannot be integrated because gravity vanishes.
constexpr Outcome free_fall = [] {
    Outcome outcome{};
    outcome.flags = status::free_fall;
    outcome.region = Region::undecided;
    outcome.margin = unknown_value;
    outcome.error = infinity;
    return outcome;
}();

} // namespace

ScaledPulses::ScaledPulses(const PulseMotion<double>& motion, Theory theory,
                           const std::vector<Point>& points)
    : of_point(points.size())
{
    const auto are_equal = [](const Point& one, const Point& other) {
        return one.amplitude == other.amplitude &&
               one.block.slenderness == other.block.slenderness &&
               one.block.other.slenderness == other.block.other.slenderness;
    };
    const PerLobe<FlankInPulse<double>> flanks = flanks_of(motion);
    for (std::size_t first = 0; first < points.size();) {
        const auto number = int(pulses.size());
        const Point& point = points[first];
        pulses.push_back(with_theory(theory, [&]<Theory known>() {
            return scaled_pulse<known>(motion, flanks, point.block, point.amplitude);
        }));
        std::size_t next = first;
        for (; next < points.size() && are_equal(points[first], points[next]); ++next) {
            of_point[next] = number;
        }
        first = next;
    }
}

PointRun::PointRun(const Scene& scene, std::vector<Point> points, Kernel kernel,
                   DropRequested drop_requested, bool are_symmetric)
    : PointsOfScene(scene, std::move(points)), kernel_(kernel),
      drop_requested_(std::move(drop_requested)), are_symmetric_(are_symmetric)
{
    if (const Pulse* pulse = scene.pulse()) {
        pulse_ = pulse_motion<double>(pulse->kind, pulse->shape);
        pulses_ = ScaledPulses(pulse_, scene.theory, points_);
    } else {
        records_ = records_of(scene_, points_);
    }
}

std::vector<int> PointRun::all() const
{
    std::vector<int> all(points_.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
}

bool PointRun::falls_freely(int point) const
{
    const Accelerogram* record = record_of(point);
    return record != nullptr &&
           !(std::abs(this->point(point).amplitude) < record->free_fall_scale());
}

template <class T, Theory theory, class Visitor>
auto PointRun::with_excitation(int point, const Visitor& visit) const
{
    const Point& at = this->point(point);
    const Block<T> block = block_in<T>(at.block);
    if constexpr (!std::same_as<T, Digits31>) { // only for pulses
        if (const Accelerogram* record = record_of(point)) {
            return visit(
                record_excitation<theory>(*record, block, T(at.amplitude), T(at.frequency)));
        }
    }
    if constexpr (std::same_as<T, double>) {
        const ScaledPulse<double>& pulse = pulse_of(point);
        return visit(
            PulseExcitation<double>{pulse_, pulse.acceleration, at.frequency, pulse.uplifts});
    } else {
        using Exact = std::conditional_t<std::same_as<T, Digits31>, Digits50, T>;
        const Pulse& pulse = *scene_.pulse();
        const auto exact = pulse_excitation<theory>(pulse_motion<Exact>(pulse.kind, pulse.shape),
                                                    block_in<Exact>(at.block), Exact(at.amplitude),
                                                    Exact(at.frequency));
        if constexpr (std::same_as<T, Digits31>) {
            return visit(in_31_digits(exact));
        } else {
            return visit(exact);
        }
    }
}

bool PointRun::has_friction() const
{
    return !points_.empty() && may_slip(points_.front());
}

bool PointRun::differ_in_frequency_alone(int one, int other) const
{
    const Point& first = point(one);
    const Point& second = point(other);
    return record_of(one) == record_of(other) && first.amplitude == second.amplitude &&
           first.friction == second.friction && first.gyration == second.gyration &&
           side_of(first.block) == side_of(second.block) && first.block.other == second.block.other;
}

namespace {

/// What a slipping block adds to an outcome.
template <class T>
Outcome outcome_of(const SlidingEnd<T>& end, const Block<T>& given, Outcome outcome)
{
    const bool is_decided = end.region != Region::undecided;
    const Block<T> block = seen_from(end.state.side, given);
    const auto flag = [](bool holds, std::uint16_t bit) { return holds ? bit : 0; };
    outcome.tilt = is_decided ? double(end.state.tilt) : unknown_value;
    outcome.rate = is_decided ? double(end.state.rate) : unknown_value;
    outcome.side = double(end.state.side);
    outcome.flags =
        std::uint16_t(flag(end.fell, outcome_flag::fell) | flag(end.slipped, status::slipped) |
                      flag(end.jammed, status::jammed) | flag(end.lifted_off, status::lifts_off) |
                      flag(end.capped, status::cap_was_hit));
    outcome.region = end.region;
    outcome.margin = !is_decided || end.slips_after ? unknown_value
                     : end.fell ? double(margin_of_fall<Theory::nonlinear>(end.state.rate, block))
                                : double(margin_after_pulse<Theory::nonlinear>(end.state, block));
    outcome.error = is_decided ? unknown_value : infinity;
    outcome.impacts = end.impacts;
    outcome.steps = end.steps;
    outcome.phase = double(end.phase);
    outcome.peak = is_decided ? double(end.peak) : unknown_value;
    outcome.slide = is_decided ? double(end.slide) : unknown_value;
    outcome.slide_peak = is_decided ? double(end.slide_peak) : unknown_value;
    outcome.uplift = double(end.uplift);
    outcome.fall_after = double(end.time_of_fall);
    return outcome;
}

} // namespace

template <class T>
SlidingEnd<T> PointRun::run_with_friction(int point, double frequency, T tolerance,
                                          Follow follow) const
{
    throw_if_dropped();
    const Point& at = this->point(point);
    return with_excitation<T, Theory::nonlinear>(point, [&](auto excitation) {
        excitation.frequency = T(frequency);
        return run_sliding<T>(block_in<T>(at.block), T(at.gyration), T(at.friction), excitation,
                              tolerance, follow);
    });
}

void PointRun::let_slip_in_50_digits(int point, Outcomes& outcomes) const
{
    if (falls_freely(point)) {
        outcomes[point] = free_fall;
        return;
    }
    const Point& at = this->point(point);
    const auto run = [&](Follow follow) {
        return run_with_friction(point, at.frequency, Digits50(sliding_tolerance_in_50_digits),
                                 follow);
    };
    // A block that only slips when it has last passed alpha does not slip.
    const SlidingEnd<Digits50> decided = run(Follow::until_decided);
    outcomes[point] = outcome_of(decided.slipped ? run(Follow::until_stuck) : decided,
                                 block_in<Digits50>(at.block), at_rest);
}

PointRun::Slip PointRun::slip_of(int point, double frequency, const Numerics& numerics,
                                 const Outputs& outputs) const
{
    const Follow follow = outputs.peak || outputs.phase || outputs.slide ? Follow::until_stuck
                                                                         : Follow::until_decided;
    const auto run = [&]<class T>(T tolerance) {
        return run_with_friction(point, frequency, tolerance, follow);
    };
    Slip slip{.end =
                  run(numerics.resolve ? tolerances_to_confirm[0]
                                       : std::min(numerics.tolerance, loosest_sliding_tolerance))};
    if (numerics.resolve || outputs.error) {
        // The error is the difference from a run without the roundings of double.
        const auto most_exact = run(static_cast<long double>(tolerances_to_confirm[2]));
        const auto margin_of = [&]<class T>(const SlidingEnd<T>& end) {
            return outcome_of(end, block_in<T>(this->point(point).block), {}).margin;
        };
        const double margin = margin_of(slip.end);
        const double difference = std::abs(margin_of(most_exact) - margin);
        const double rounding = 0x1p-50 * std::fmax(1.0, std::abs(margin)); // 2^-50 if NaN
        slip.is_settled = most_exact.region == slip.end.region;
        slip.error =
            slip.is_settled && std::isfinite(difference) ? 2 * difference + rounding : infinity;
    }
    if (numerics.resolve) {
        slip.is_settled =
            slip.is_settled && run(tolerances_to_confirm[1]).region == slip.end.region;
    }
    return slip;
}

void PointRun::let_slip(const Numerics& numerics, const Outputs& outputs, Outcomes& outcomes) const
{
    Slip slip;
    int point_of_slip = -1; // if it stays flat
    for (int i = 0; i < size(); ++i) {
        Outcome& outcome = outcomes[i];
        const Point& at = point(i);
        outcome.slide = outcome.slide_peak = outcome.has(status::free_fall) ? unknown_value : 0;
        // A strength of exactly the friction, such as both 0.3, is scaled with roundings.
        const double sticks_up_to = at.friction * (1 + 4 * std::numeric_limits<double>::epsilon());
        if (outcome.has(status::free_fall) || std::islessequal(outcome.to_stick, sticks_up_to)) {
            continue;
        }
        // A block that stays flat has no time of its own: its slide is in proportion to the square
        // of that of the ground motion, on which nothing else depends.
        double per_slide = 1;
        if (!stays_flat(at)) {
            slip = slip_of(i, at.frequency, numerics, outputs);
            point_of_slip = -1;
        } else {
            const double frequency = at.block.frequency_parameter;
            if (point_of_slip < 0 || !differ_in_frequency_alone(point_of_slip, i)) {
                slip = slip_of(i, frequency, numerics, outputs);
                point_of_slip = i;
            }
            per_slide = (frequency / at.frequency) * (frequency / at.frequency);
        }
        outcome = outcome_of(slip.end, at.block, outcome);
        outcome.slide *= per_slide;
        outcome.slide_peak *= per_slide;
        if (outputs.error && std::isfinite(outcome.margin)) {
            outcome.error = slip.error;
        }
        if (numerics.resolve && !slip.is_settled) {
            give_up(outcome);
        }
    }
}

void PointRun::throw_if_dropped() const
{
    if (drop_requested_ && drop_requested_()) {
        throw TileDropped();
    }
}

void PointRun::run(const Numerics& numerics, Outcomes& outcomes, const std::vector<int>& chosen,
                   UncertainImpact uncertain_impact) const
{
    run_by(scene_.integrator(numerics), numerics.tolerance, outcomes, chosen, uncertain_impact);
}

void PointRun::run_in_31_digits(Outcomes& outcomes, const std::vector<int>& chosen) const
{
    if (const auto kernel = scene_.motion_traits().in_31_digits) {
        run_by(*kernel, MoreDigits<Digits31>::tolerance, outcomes, chosen, UncertainImpact::go_on);
        return;
    }
    for (const int point : chosen) {
        run_in_more_digits<Digits31>(point, outcomes);
    }
}

void PointRun::run_by(Integrator integrator, double tolerance, Outcomes& outcomes,
                      const std::vector<int>& chosen, UncertainImpact uncertain_impact) const
{
    const auto is_dropped = [](const void* requested) {
        const auto& drop_requested = *static_cast<const DropRequested*>(requested);
        return drop_requested && drop_requested();
    };
    const auto run_under = [&](const Accelerogram* record, const std::vector<int>& points) {
        const KernelTask task{.pulse = pulse_,
                              .record = record,
                              .points = points_.data(),
                              .are_symmetric = are_symmetric_,
                              .pulse_of_point = pulses_.of_point.data(),
                              .pulses = pulses_.pulses.data(),
                              .tolerance = tolerance,
                              .outputs = outcomes.outputs,
                              .uncertain_impact = uncertain_impact,
                              .chosen = points.data(),
                              .chosen_count = int(points.size()),
                              .drop_requested = is_dropped,
                              .context = &drop_requested_,
                              .outcomes = outcomes.of_points.get()};
        const Directions directions = record == nullptr           ? Directions::horizontal
                                      : !record->phases().empty() ? Directions::both
                                      : record->upwards().empty() ? Directions::horizontal
                                                                  : Directions::both_recorded;
        sweep_kernel(kernel_, integrator, scene_.theory, outcomes.outputs, directions)(task);
        throw_if_dropped(); // if dropped, some outcomes may be missing
    };
    if (records_.empty()) {
        run_under(nullptr, chosen);
        return;
    }
    std::map<const Accelerogram*, std::vector<int>> points_of;
    for (const int point : chosen) {
        if (falls_freely(point)) {
            outcomes[point] = free_fall;
        } else {
            points_of[record_of(point)].push_back(point);
        }
    }
    for (const auto& [record, points] : points_of) {
        run_under(record, points);
    }
}

template <class T>
void PointRun::run_in_more_digits(int point, Outcomes& outcomes) const
{
    throw_if_dropped();
    if (falls_freely(point)) {
        outcomes[point] = free_fall;
        return;
    }
    with_theory(scene_.theory, [&]<Theory theory>() {
        const Point& at = this->point(point);
        const Block<T> given = block_in<T>(at.block);
        const ForcedEnd<T> end = with_excitation<T, theory>(point, [&](const auto& excitation) {
            return overturn::run_in_more_digits<T, theory>(given, excitation, drop_requested_);
        });
        throw_if_dropped();
        const Block<T> block = seen_from(end.state.side, given);
        const double margin = double(margin_of<theory>(end, block));
        const double rounding = end.is_stopped() ? 0 : std::abs(margin) * 0x1p-53;
        const double error = double(end.error) + rounding;
        const bool in_doubt = end.is_stopped() || !(error < std::abs(margin));
        const auto flag = [](bool holds, std::uint16_t bit) { return holds ? bit : 0; };
        const int flags =
            flag(end.fell, outcome_flag::fell) | flag(end.rested, status::came_to_rest) |
            flag(end.capped, status::cap_was_hit) | flag(end.not_finite, status::not_finite) |
            flag(in_doubt, outcome_flag::in_doubt);
        Outcome& outcome = outcomes[point];
        outcome.tilt = double(end.state.tilt);
        outcome.rate = double(end.state.rate);
        outcome.side = double(end.state.side);
        outcome.flags = std::uint16_t(flags);
        outcome.region = region_of<theory>(end, block);
        outcome.margin = margin;
        outcome.error = error;
        outcome.impacts = double(end.impacts);
        outcome.steps = double(end.steps);
        outcome.phase = double(end.phase);
        if (scene_.motion_traits().is_sensitive) {
            outcome.peak = double(end.peak);
        }
    });
}

template void PointRun::run_in_more_digits<Digits31>(int, Outcomes&) const;
template void PointRun::run_in_more_digits<Digits50>(int, Outcomes&) const;

namespace {

struct MarginAndError {
    double margin;
    double error;
};

/// The margin of a block at rest, and by how much that of a block with these bounds may differ.
template <Theory theory>
MarginAndError margin_of_low_bounces(const Block<double>& block, const LowBounces& bounds)
{
    const auto margin_of = [&](double side, double tilt, double rate) {
        return margin_after_pulse<theory>(State<double>{tilt, rate, side}, seen_from(side, block));
    };
    if (block.is_symmetric()) {
        // The distances to the limits of the rate change by no more than the tilt plus the rate.
        return {1, (bounds.tilt + bounds.rate) / Equations<theory>::separatrix_rate(block, 0.0)};
    }
    const auto [least, most] = std::minmax({margin_of(1, 0, 0), margin_of(-1, 0, 0)});
    double smallest = least;
    for (const double side : {1.0, -1.0}) {
        for (const double rate : {bounds.rate, -bounds.rate}) {
            smallest = std::min(smallest, margin_of(side, bounds.tilt, rate));
        }
    }
    return {least, std::max(least - smallest, most - least)};
}

} // namespace

bool PointRun::settle_low_bounces(int point, Outcome& outcome) const
{
    const Block<double>& block = this->point(point).block;
    // The margin is that of a block at rest, up to this error.
    const auto [margin, error] = with_theory(scene_.theory, [&]<Theory theory>() {
        const auto bounds = with_excitation<double, theory>(point, [&](const auto& excitation) {
            return bound_of_low_bounces<theory>(block, excitation);
        });
        return bounds ? margin_of_low_bounces<theory>(block, *bounds) : MarginAndError{1, 1};
    });
    if (!(error < margin)) {
        return false;
    }
    if (outcome.has(status::cap_was_hit)) {
        outcome.flags = 0;
        outcome.tilt = 0;
        outcome.rate = 0;
    }
    outcome.error = error;
    outcome.region = Region::S;
    if (!outcome.has(outcome_flag::without_end)) {
        outcome.margin = margin;
    }
    return true;
}

double PointRun::first_uplift(int point) const
{
    return with_theory(scene_.theory, [&]<Theory theory>() {
        return with_excitation<double, theory>(point, [](const auto& excitation) {
            return excitation.next_uplift(true, excitation.motion.begin, -infinity);
        });
    });
}

} // namespace overturn
