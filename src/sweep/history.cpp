#include "overturn/sweep/history.hpp"

#include "point_run.hpp"

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/mechanics/contact.hpp"
#include "overturn/mechanics/free_rocking.hpp"
#include "overturn/mechanics/record_excitation.hpp"
#include "overturn/problem/coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace overturn {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The order and tolerance of the integration, as accurate as doubles allow.
constexpr int path_order = 20;
constexpr double path_tolerance = 1e-13;

/// The path from rest to the end of the pulse, or to the fall.
struct ForcedPath {
    std::vector<Event<double>> events; ///< in order
    ForcedEnd<double> end;
};

template <Theory theory, class Excitation>
ForcedPath forced_path(const Block<double>& block, const Excitation& excitation)
{
    constexpr Outputs outputs{.impacts = true, .error = true, .events = true};
    ForcedStage<Taylor<path_order>, theory, outputs, double, Excitation> stage(block, excitation,
                                                                               path_tolerance);
    while (stage.is_active()) {
        stage.advance();
    }
    return {stage.events(), stage.end()};
}

/// The motion between an event, after which the block rocks, and the next one: the series of the
/// step itself.
template <Theory theory>
class MotionAfter {
public:
    template <class Excitation>
    MotionAfter(const Event<double>& event, const Block<double>& block,
                const Excitation& excitation)
        : from_(event.rocking)
    {
        const Block<double> seen = seen_from(from_.side, block);
        const double frequency =
            excitation.frequency / (block.is_symmetric() ? 1 : seen.frequency_parameter);
        unit_ = 1 / std::max(1.0, frequency); // as in TaylorStepper
        phase_per_unit_ = frequency * unit_;
        const auto push = excitation.template series<path_order>(
            from_.side * excitation.acceleration, from_.phase, phase_per_unit_);
        series_ = Equations<theory>::template series<path_order>(seen, from_.tilt,
                                                                 from_.rate * unit_, push, unit_);
    }

    /// The state at a phase, in the unit of the excitation.
    State<double> at(double phase) const
    {
        const double time = (std::max(phase, from_.phase) - from_.phase) / phase_per_unit_;
        return {.tilt = std::max(0.0, value_of_series(series_.tilt, time)),
                .rate = value_of_series(series_.rate, time) / unit_,
                .side = from_.side};
    }

private:
    Rocking<double> from_;
    double unit_;
    double phase_per_unit_;
    RockingSeries<path_order, double> series_;
};

/// Records the state of a block up to the last time shown: at evenly spaced times, and before and
/// after each event.
template <Theory theory, class Excitation>
class HistoryBuilder {
public:
    HistoryBuilder(const Point& point, const Excitation& excitation, const HistoryView& view)
        : block_(point.block), sides_(block_, point.gyration), excitation_(excitation),
          path_(forced_path<theory>(block_, excitation_)),
          block_at_end_(seen_from(path_.end.state.side, block_)), end_of_path_(end_of_path()),
          samples_(view.samples)
    {
        history_.end_of_pulse = time_at(excitation_.motion.end);
        history_.time_of_rest = time_of_rest();
        history_.time_of_fall = time_of_fall();
        until_ = std::isnan(view.until) ? time_worth_showing() : view.until;
    }

    History build()
    {
        history_.region = region_of<theory>(path_.end, block_at_end_);
        history_.margin = margin_of<theory>(path_.end, block_at_end_);
        history_.error = path_.end.error;
        history_.shortened = path_.end.is_stopped();
        record_forced_stage();
        if (is_free() && !is_over(end_of_path_)) {
            history_.shortened = !record_free_stage();
        }
        return std::move(history_);
    }

private:
    // Times are in 1/p of the side plus; those of FreeRocking and of the frequency are in the unit
    // of 1 / Block::frequency_parameter.
    double time_at(double phase) const
    {
        return (phase - excitation_.motion.begin) / excitation_.frequency *
               block_.frequency_parameter;
    }
    double phase_at(double time) const
    {
        return excitation_.motion.begin + time / block_.frequency_parameter * excitation_.frequency;
    }
    double after_path(double time) const
    {
        return end_of_path_ + time * block_.frequency_parameter;
    }

    /// Whether there is a free stage.
    bool is_free() const { return !(path_.end.fell || path_.end.is_stopped()); }

    double end_of_path() const
    {
        return time_at(is_free() || path_.events.empty() ? excitation_.motion.end
                                                         : path_.events.back().rocking.phase);
    }

    double time_of_rest() const
    {
        if (!is_free()) {
            return path_.end.fell ? infinity : unknown;
        }
        if (path_.events.empty() || path_.events.back().kind == EventKind::rest) {
            return path_.events.empty() ? 0 : time_at(path_.events.back().rocking.phase);
        }
        return after_path(overturn::time_of_rest<theory>(path_.end.state, block_at_end_));
    }

    double time_of_fall() const
    {
        if (!is_free()) {
            return path_.end.fell ? end_of_path_ : unknown;
        }
        return after_path(
            time_to_lie_flat<theory, MoreExact<double>>(path_.end.state, block_at_end_));
    }

    double time_worth_showing() const
    {
        if (std::isnan(history_.time_of_rest)) {
            return end_of_path_;
        }
        return std::min({history_.time_of_fall, std::max(history_.time_of_rest, end_of_path_),
                         end_of_path_ + free_time_shown});
    }

    /// ground: of the excitation, or 0.0 after it.
    template <class Ground>
    HistorySample sample(double time, const State<double>& state, const Ground& ground) const
    {
        const Block<double> seen = seen_from(state.side, block_);
        const double ratio = seen.frequency_parameter / block_.frequency_parameter;
        const Ground push = state.side * ground;
        const double pull = Equations<theory>::acceleration(seen, state.tilt, push);
        const MovingBlock<double, Ground> moving{state.tilt, state.rate, push, push};
        return {.time = time,
                .angle = state.side * state.tilt + 0.0, // no -0
                .velocity = state.side * state.rate * ratio + 0.0,
                .acceleration = state.side * pull * (ratio * ratio),
                .q = double(conserved_q<theory>(state, seen)),
                .ground = horizontal_of(ground),
                .friction_demand = friction_of(
                    force_while_rocking(sides_.seen_from(state.side), seen.slenderness, moving))};
    }

    template <class Ground>
    HistorySample resting(double time, const Ground& ground) const
    {
        HistorySample result = sample(time, {0, 0, 1}, ground);
        result.acceleration = 0;
        result.friction_demand = friction_of(force_at_rest(sides_.plus, ground, ground));
        return result;
    }

    static double friction_of(const ContactForce<double>& force)
    {
        return Equations<theory>::has_contact_forces ? force.friction() : unknown;
    }

    bool is_over(double time) const { return time > until_; }

    /// Records the motion until `end`; at(time) returns a sample.
    template <class At>
    void follow(double end, const At& at)
    {
        for (; next_ < samples_; ++next_) {
            const double time = until_ * next_ / std::max(1, samples_ - 1);
            if (time >= end) {
                break;
            }
            history_.samples.push_back(at(time));
        }
        if (end < infinity) {
            last_ = at(end);
        }
    }

    /// Records an event at the last time passed to follow().
    void record_event(EventKind event, const HistorySample& after)
    {
        if (!is_over(last_.time)) {
            history_.samples.push_back(last_);
            history_.samples.push_back(after);
            history_.events.push_back({event, last_, after});
        }
    }

    void record_forced_stage()
    {
        std::optional<MotionAfter<theory>> motion; // nullopt: at rest
        const auto at = [&](double time) {
            const double phase = std::min(phase_at(time), excitation_.motion.end);
            const auto ground = excitation_.ground(phase);
            return motion ? sample(time, motion->at(phase), ground) : resting(time, ground);
        };
        for (const Event<double>& event : path_.events) {
            const double time = time_at(event.rocking.phase);
            const bool is_at_onset = event.rocking.phase == excitation_.motion.begin;
            follow(time, [&](double before) {
                HistorySample last = at(before);
                if (is_at_onset) { // the block does not rest under a jump that lifts it
                    last.friction_demand = resting(before, 0.0).friction_demand;
                }
                return last;
            });
            motion.reset();
            if (event.kind != EventKind::rest) {
                motion.emplace(event, block_, excitation_);
            }
            if (event.kind != EventKind::step) {
                record_event(event.kind, at(time));
            }
        }
        follow(end_of_path_, at);
        if (path_.end.fell) {
            record_event(EventKind::fall, last_);
        } else if (is_free()) {
            record_event(EventKind::end_of_pulse, motion
                                                      ? sample(end_of_path_, path_.end.state, 0.0)
                                                      : resting(end_of_path_, 0.0));
        }
    }

    /// Returns whether all impacts could be recorded.
    bool record_free_stage()
    {
        FreeRocking<theory, double> rocking(path_.end.state, block_at_end_);
        // The remainder of a series that is shorter than this is not visible.
        const double last_impact = history_.time_of_rest - 1e-3 * (until_ / samples_);
        while (after_path(rocking.begin()) < last_impact) {
            if (rocking.impacts() == most_impacts_shown) {
                return false;
            }
            const double impact = after_path(rocking.impact_time());
            const double fall = after_path(rocking.fall_time());
            const RockingArc<theory, double>& arc = rocking.arc();
            const auto at = [&](double time) {
                const State<double> striking{0, -arc.impact_speed(), arc.side()};
                const double since = (time - end_of_path_) / block_.frequency_parameter;
                return sample(time, time == impact ? striking : rocking.at(since), 0.0);
            };
            follow(std::min(impact, fall), at);
            if (is_over(std::min(impact, fall))) {
                return true;
            }
            if (fall < impact) {
                record_event(EventKind::fall, last_);
                return true;
            }
            rocking.strike();
            record_event(EventKind::impact, sample(impact, arc.at(0), 0.0));
        }
        const auto at_rest = [&](double time) { return resting(time, 0.0); };
        if (history_.time_of_rest > end_of_path_) {
            follow(history_.time_of_rest, at_rest);
            record_event(EventKind::rest, last_);
        }
        follow(infinity, at_rest);
        return true;
    }

    Block<double> block_;
    ContactSides<double> sides_;
    Excitation excitation_;
    ForcedPath path_;
    Block<double> block_at_end_; // as seen from the side on which it rocks at the end of the path
    double end_of_path_;         // time [1/p]
    double until_;
    int samples_;
    int next_ = 0;         // sample
    HistorySample last_{}; // at the end of follow()
    History history_{};
};

} // namespace

History history_of(const Scene& scene, const Point& point, const HistoryView& view)
{
    History history = with_theory(scene.theory, [&]<Theory theory>() {
        const auto build = [&](const auto& excitation) {
            return HistoryBuilder<theory, std::remove_cvref_t<decltype(excitation)>>(
                       point, excitation, view)
                .build();
        };
        if (const Pulse* pulse = scene.pulse()) {
            return build(pulse_excitation<theory>(pulse_motion<double>(pulse->kind, pulse->shape),
                                                  point.block, point.amplitude, point.frequency));
        }
        const Record record = directed_record(scene, point);
        return build(
            record_excitation<theory>(*record, point.block, point.amplitude, point.frequency));
    });
    history.is_curve_certain = history.error < std::abs(history.margin);
    if (!history.is_curve_certain) {
        const PointRun run(scene, {point}, widest_kernel());
        history.region = outcomes_of(run, most_accurate, {.region = true})[0].region;
        history.margin = unknown;
        history.error = infinity;
        history.time_of_rest = unknown;
        history.time_of_fall = unknown;
    }
    return history;
}

} // namespace overturn
