#include "overturn/sweep/history.hpp"

#include "point_run.hpp"
#include "sliding_history.hpp"
#include "timeline.hpp"

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

/// Records the motion of a block that does not slip.
template <Theory theory, class Excitation>
class HistoryBuilder {
public:
    HistoryBuilder(const Point& point, const Excitation& excitation, const HistoryView& view)
        : block_(point.block), sides_(block_, point.gyration), excitation_(excitation),
          path_(forced_path<theory>(block_, excitation_)),
          block_at_end_(seen_from(path_.end.state.side, block_)), end_of_path_(end_of_path()),
          history_(outline()),
          timeline_(history_,
                    std::isnan(view.until) ? time_worth_showing(history_, end_of_path_)
                                           : view.until,
                    view.samples)
    {}

    History build()
    {
        record_forced_stage();
        if (is_free() && !timeline_.is_over(end_of_path_)) {
            history_.shortened = !record_free_stage();
        }
        return std::move(history_);
    }

private:
    /// All but the samples and events.
    History outline() const
    {
        History history{};
        history.end_of_pulse = time_at(excitation_.motion.end);
        history.time_of_rest = time_of_rest();
        history.time_of_fall = time_of_fall();
        history.region = region_of<theory>(path_.end, block_at_end_);
        history.margin = margin_of<theory>(path_.end, block_at_end_);
        history.error = path_.end.error;
        history.shortened = path_.end.is_stopped();
        return history;
    }

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
            return path_.end.fell ? infinity : unknown_value;
        }
        if (path_.events.empty() || path_.events.back().kind == EventKind::rest) {
            return path_.events.empty() ? 0 : time_at(path_.events.back().rocking.phase);
        }
        return after_path(overturn::time_of_rest<theory>(path_.end.state, block_at_end_));
    }

    double time_of_fall() const
    {
        if (!is_free()) {
            return path_.end.fell ? end_of_path_ : unknown_value;
        }
        return after_path(
            time_to_lie_flat<theory, MoreExact<double>>(path_.end.state, block_at_end_));
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
        HistorySample result{.time = time,
                             .angle = state.side * state.tilt + 0.0, // no -0
                             .velocity = state.side * state.rate * ratio + 0.0,
                             .acceleration = state.side * pull * (ratio * ratio),
                             .q = double(conserved_q<theory>(state, seen)),
                             .ground = horizontal_of(ground),
                             .friction_demand = unknown_value};
        press(result, SlidingMode::rock, state.side,
              force_while_rocking(sides_.seen_from(state.side), seen.slenderness, moving));
        return result;
    }

    template <class Ground>
    HistorySample resting(double time, const Ground& ground) const
    {
        HistorySample result = sample(time, {0, 0, 1}, ground);
        result.acceleration = 0;
        rest_under(ground, result);
        return result;
    }

    template <class Ground>
    void rest_under(const Ground& ground, HistorySample& result) const
    {
        press(result, SlidingMode::rest, 1, force_at_rest(sides_.plus, ground, ground));
    }

    /// force: as seen from this side.
    static void press(HistorySample& result, SlidingMode mode, double side,
                      const ContactForce<double>& force)
    {
        const bool is_known = Equations<theory>::has_contact_forces;
        result.mode = mode;
        result.friction_demand = is_known ? force.friction() : unknown_value;
        result.force_along = is_known ? side * force.along : unknown_value;
        result.force_normal = is_known ? force.normal : unknown_value;
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
            timeline_.follow(time, [&](double before) {
                HistorySample last = at(before);
                if (is_at_onset) { // the block does not rest under a jump that lifts it
                    rest_under(0.0, last);
                }
                return last;
            });
            motion.reset();
            if (event.kind != EventKind::rest) {
                motion.emplace(event, block_, excitation_);
            }
            if (event.kind != EventKind::step) {
                timeline_.record_event(event.kind, at(time));
            }
        }
        timeline_.follow(end_of_path_, at);
        if (path_.end.fell) {
            timeline_.record_event(EventKind::fall, timeline_.last());
        } else if (is_free()) {
            timeline_.record_event(EventKind::end_of_pulse,
                                   motion ? sample(end_of_path_, path_.end.state, 0.0)
                                          : resting(end_of_path_, 0.0));
        }
    }

    /// Returns whether all impacts could be recorded.
    bool record_free_stage()
    {
        FreeRocking<theory, double> rocking(path_.end.state, block_at_end_);
        // The remainder of a series that is shorter than this is not visible.
        const double last_impact = history_.time_of_rest - 1e-3 * timeline_.spacing();
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
            timeline_.follow(std::min(impact, fall), at);
            if (timeline_.is_over(std::min(impact, fall))) {
                return true;
            }
            if (fall < impact) {
                timeline_.record_event(EventKind::fall, timeline_.last());
                return true;
            }
            rocking.strike();
            timeline_.record_event(EventKind::impact, sample(impact, arc.at(0), 0.0));
        }
        const auto at_rest = [&](double time) { return resting(time, 0.0); };
        if (history_.time_of_rest > end_of_path_) {
            timeline_.follow(history_.time_of_rest, at_rest);
            timeline_.record_event(EventKind::rest, timeline_.last());
        }
        timeline_.follow(infinity, at_rest);
        return true;
    }

    Block<double> block_;
    ContactSides<double> sides_;
    Excitation excitation_;
    ForcedPath path_;
    Block<double> block_at_end_; // as seen from the side on which it rocks at the end of the path
    double end_of_path_;         // time [1/p]
    History history_;
    Timeline timeline_;
};

/// The history of a block that does not slip.
History history_without_slip(const Scene& scene, const Point& point, const HistoryView& view)
{
    return with_theory(scene.theory, [&]<Theory theory>() {
        return under_motion<theory>(scene, point, [&](const auto& excitation) {
            return HistoryBuilder<theory, std::remove_cvref_t<decltype(excitation)>>(
                       point, excitation, view)
                .build();
        });
    });
}

} // namespace

History history_of(const Scene& scene, const Point& point, const HistoryView& view)
{
    const PointRun run(scene, {point}, widest_kernel());
    const auto settled = [&](const Outputs& outputs) {
        return outcomes_of(run, most_accurate, outputs)[0];
    };
    if (run.has_friction()) {
        const Outcome outcome =
            settled({.error = true, .region = true, .margin = true, .slide = true});
        if (outcome.has(status::slipped | status::jammed)) {
            return sliding_history(scene, point, outcome, view);
        }
    }
    History history = history_without_slip(scene, point, view);
    history.is_curve_certain = history.error < std::abs(history.margin);
    if (!history.is_curve_certain) {
        history.region = settled({.region = true}).region;
        history.margin = unknown_value;
        history.error = infinity;
        history.time_of_rest = unknown_value;
        history.time_of_fall = unknown_value;
    }
    return history;
}

} // namespace overturn
