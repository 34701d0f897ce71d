#include "sliding_history.hpp"

#include "timeline.hpp"

#include "overturn/integrate/sliding_motion.hpp"
#include "overturn/mechanics/energy_criteria.hpp"

#include <cmath>
#include <vector>

namespace overturn {

namespace {

/// Records the motion of a block that slips, in two runs: the first one yields the times.
template <class Excitation>
class SlidingHistoryBuilder {
    using Motion = SlidingMotion<double, Excitation>;

public:
    SlidingHistoryBuilder(const Point& point, const Excitation& excitation, const Outcome& outcome,
                          const HistoryView& view)
        : point_(point), excitation_(excitation), history_(outline(outcome)),
          timeline_(history_,
                    std::isnan(view.until) ? time_worth_showing(history_, stopped_) : view.until,
                    view.samples)
    {}

    History build()
    {
        Motion motion = begin();
        while (!motion.is_over() && !timeline_.is_over(time_of(motion))) {
            const Motion before = motion;
            advance(motion);
            const double end = time_of(motion);
            const auto after = [&](double time) { return sample(motion, time); };
            const bool is_lifted_at_once = before.mode() == SlidingMode::rest && end == 0;
            timeline_.follow(end, [&](double time) {
                HistorySample last = sample(before, time);
                if (is_lifted_at_once) { // the block does not rest under a jump that moves it
                    const ContactSide<double> side =
                        contact_side(point_.block, point_.gyration, point_.block.size);
                    const ContactForce<double> force = force_at_rest(side, 0.0, 0.0);
                    last.friction_demand = force.friction();
                    last.force_along = force.along;
                    last.force_normal = force.normal;
                }
                return last;
            });
            for (const EventKind event : events_between(before, motion)) {
                if (event == EventKind::fall) {
                    timeline_.record_event(event, timeline_.last());
                } else {
                    timeline_.record_event(event, after(end));
                    timeline_.follow(end, after);
                }
            }
        }
        if (history_.shortened) {
            timeline_.record_last();
        }
        if (std::isfinite(history_.time_of_rest)) {
            timeline_.follow(infinity, [&](double time) { return sample(motion, time); });
        }
        return std::move(history_);
    }

private:
    Motion begin() const
    {
        return Motion(point_.block, point_.gyration, point_.friction, excitation_,
                      tolerances_to_confirm[1], Follow::until_rest);
    }

    /// Since the beginning of the ground motion [1/p].
    double time_of(const Motion& motion) const
    {
        const double p = point_.block.frequency_parameter;
        return ((motion.phase() - excitation_.motion.begin) / excitation_.frequency +
                motion.time_after()) *
               p;
    }

    /// All but the samples and events.
    History outline(const Outcome& outcome)
    {
        Motion motion = begin();
        double since = 0; // the last time at which the block came to rest
        while (!motion.is_over()) {
            const bool moved = motion.mode() != SlidingMode::rest;
            motion.advance();
            if (moved) {
                since = time_of(motion);
            }
        }
        stopped_ = time_of(motion);
        const Region region = motion.end().region;
        const bool is_known = region != Region::undecided && outcome.region == region;
        const bool falls = is_unsafe(region);
        History history{};
        history.end_of_pulse = (excitation_.motion.end - excitation_.motion.begin) /
                               excitation_.frequency * point_.block.frequency_parameter;
        history.time_of_rest = !is_known ? unknown_value : falls ? infinity : since;
        history.time_of_fall = !is_known ? unknown_value : falls ? stopped_ : infinity;
        history.region = outcome.region;
        history.margin = outcome.margin;
        history.error = outcome.error;
        history.is_curve_certain = !outcome.has(status::unresolved);
        history.shortened = region == Region::undecided;
        history.slips = true;
        return history;
    }

    /// The state at a time [1/p] of the step that a motion is about to take.
    HistorySample sample(const Motion& motion, double time) const
    {
        const Block<double>& block = point_.block;
        const double p = block.frequency_parameter;
        const auto at = motion.after(std::max(0.0, (time - time_of(motion)) / p));
        const double side = at.state.side;
        const double turning = at.state.rate / p;
        const Block<double> seen = seen_from(side, block);
        const State<double> own{at.state.tilt, at.state.rate / seen.frequency_parameter, side};
        const double phase = excitation_.motion.begin + time / p * excitation_.frequency;
        const bool is_shaken = motion.phase() < excitation_.motion.end;
        return {.time = time,
                .angle = side * at.state.tilt + 0.0, // no -0
                .velocity = side * turning + 0.0,
                .acceleration = side * at.acceleration / (p * p) + 0.0,
                .q = double(conserved_q<Theory::nonlinear>(own, seen)),
                .ground =
                    is_shaken
                        ? horizontal_of(excitation_.ground(std::min(phase, excitation_.motion.end)))
                        : 0,
                .friction_demand = at.force.friction(),
                .mode = motion.mode(),
                .slide = at.position / block.size + 0.0,
                .slide_velocity = at.velocity / (p * block.size) + 0.0,
                .force_along = at.force.along + 0.0,
                .force_normal = at.force.normal};
    }

    /// Takes a step; a block that slips to and fro is at rest for no time in between.
    void advance(Motion& motion) const
    {
        motion.advance();
        if (motion.mode() == SlidingMode::rest && !motion.is_over()) {
            Motion next = motion;
            next.advance();
            if (!next.is_over() && time_of(next) == time_of(motion)) {
                motion = next;
            }
        }
    }

    std::vector<EventKind> events_between(const Motion& before, const Motion& after) const
    {
        if (after.is_over() && is_unsafe(after.end().region)) {
            return {EventKind::fall};
        }
        std::vector<EventKind> events;
        const auto note = [&](bool occurs, EventKind event) {
            if (occurs) {
                events.push_back(event);
            }
        };
        const auto is_on_corner = [](const Motion& motion) {
            return motion.mode() == SlidingMode::rock || motion.mode() == SlidingMode::slide_rock;
        };
        const auto slips = [](const Motion& motion) {
            return motion.mode() == SlidingMode::slide || motion.mode() == SlidingMode::slide_rock;
        };
        const bool rests = after.mode() == SlidingMode::rest;
        const bool turns = before.mode() == after.mode() && after.impacts() == before.impacts() &&
                           after.direction() != before.direction();
        note(before.phase() < excitation_.motion.end && after.phase() >= excitation_.motion.end,
             EventKind::end_of_pulse);
        note(after.impacts() > before.impacts(), EventKind::impact);
        note(rests && before.mode() != after.mode(), EventKind::rest);
        note(is_on_corner(after) && !is_on_corner(before), EventKind::uplift);
        note(slips(after) && (!slips(before) || turns), EventKind::slip);
        note(slips(before) && after.mode() == SlidingMode::rock, EventKind::stick);
        return events;
    }

    Point point_;
    Excitation excitation_;
    double stopped_ = 0; // time at which the motion is over [1/p]
    History history_;
    Timeline timeline_;
};

} // namespace

History sliding_history(const Scene& scene, const Point& point, const Outcome& outcome,
                        const HistoryView& view)
{
    return under_motion<Theory::nonlinear>(scene, point, [&](const auto& excitation) -> History {
        using Excitation = std::remove_cvref_t<decltype(excitation)>;
        return SlidingHistoryBuilder<Excitation>(point, excitation, outcome, view).build();
    });
}

} // namespace overturn
