#include "overturn/sweep/history.hpp"

#include "for_scene.hpp"

#include "overturn/integrate/forced_path.hpp"
#include "overturn/mechanics/free_rocking.hpp"

#include <algorithm>
#include <cmath>

namespace overturn {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Writes down where a block is, up to the last time that is shown: at evenly spread times, and
/// before and after each event.
class Recorder {
public:
    Recorder(double until, int samples) : until_(until), samples_(samples) {}

    bool is_over(double time) const { return time > until_; }

    /// The block moves on until `end`; at(time) tells its sample.
    template <class At>
    void follow(double end, const At& at)
    {
        for (; next_ < samples_; ++next_) {
            const double due = until_ * next_ / std::max(1, samples_ - 1);
            if (due >= end) {
                break;
            }
            history_.samples.push_back(at(due));
        }
        if (end < infinity) {
            last_ = at(end);
        }
    }

    /// Something happens where it was followed to.
    void happens(Event event, const HistorySample& after)
    {
        if (!is_over(last_.time)) {
            history_.samples.push_back(last_);
            history_.samples.push_back(after);
            history_.events.push_back({event, last_, after});
        }
    }
    void ends_with(Event event) { happens(event, last_); }

    History& history() { return history_; }

private:
    double until_;
    int samples_;
    int next_ = 0;
    HistorySample last_{};
    History history_{};
};

template <class Pulse, Theory theory>
class Narrator {
public:
    Narrator(const Scene& scene, const PlanePoint& point)
        : block_{point.slenderness, point.restitution},
          excitation_{.acceleration =
                          point.amplitude * uplift_acceleration<theory>(point.slenderness),
                      .frequency = point.frequency,
                      .uplifts = uplift_phases<Pulse>(point.amplitude, scene.window),
                      .begin = Pulse::begin(scene.window),
                      .end = Pulse::end(scene.window)},
          path_(forced_path<Pulse, theory>(block_, excitation_)), end_of_path_(end_of_path()),
          time_of_rest_(time_of_rest()), time_of_fall_(time_of_fall())
    {}

    History tell(const HistoryView& view) const
    {
        const double until = std::isnan(view.until) ? time_worth_showing() : view.until;
        Recorder recorder(until, view.samples);
        tell_forced_stage(recorder);
        bool shortened = path_.end.capped || path_.end.not_finite;
        if (is_free() && !recorder.is_over(end_of_path_)) {
            shortened = !tell_free_stage(recorder, until / view.samples);
        }
        History& history = recorder.history();
        history.end_of_pulse = time_at(excitation_.end);
        history.time_of_rest = time_of_rest_;
        history.time_of_fall = time_of_fall_;
        history.region = region();
        history.margin = margin();
        history.error = path_.end.error;
        history.shortened = shortened;
        return std::move(history);
    }

private:
    double time_at(double phase) const
    {
        return (phase - excitation_.begin) / excitation_.frequency;
    }

    /// Whether there is a free stage.
    bool is_free() const { return !(path_.end.fell || path_.end.capped || path_.end.not_finite); }

    double end_of_path() const
    {
        return time_at(is_free() || path_.milestones.empty()
                           ? excitation_.end
                           : path_.milestones.back().rocking.phase);
    }

    double time_of_rest() const
    {
        if (!is_free()) {
            return path_.end.fell ? infinity : unknown;
        }
        if (path_.milestones.empty() || path_.milestones.back().what == Happening::rest) {
            return path_.milestones.empty() ? 0 : time_at(path_.milestones.back().rocking.phase);
        }
        return end_of_path_ + overturn::time_of_rest<theory>(path_.end.state, block_);
    }

    double time_of_fall() const
    {
        if (!is_free()) {
            return path_.end.fell ? end_of_path_ : unknown;
        }
        FreeRocking<theory, double> rocking = free_rocking();
        if (std::isfinite(rocking.impact_time())) {
            rocking.strike(); // the last one after which it may fall
        }
        return end_of_path_ + rocking.fall_time();
    }

    double time_worth_showing() const
    {
        if (std::isnan(time_of_rest_)) {
            return end_of_path_;
        }
        return std::min(
            {time_of_fall_, std::max(time_of_rest_, end_of_path_), end_of_path_ + free_time_shown});
    }

    FreeRocking<theory, double> free_rocking() const
    {
        return {path_.end.state, block_.slenderness, {block_.restitution}};
    }

    Region region() const
    {
        const State<double>& end = path_.end.state;
        if (path_.end.capped || path_.end.not_finite) {
            return Region::undecided;
        }
        return path_.end.fell ? (end.side > 0 ? Region::F_plus : Region::F_minus)
                              : region_after_pulse<theory>(end, block_);
    }

    double margin() const
    {
        if (path_.end.capped || path_.end.not_finite) {
            return std::numeric_limits<double>::quiet_NaN();
        }
        return path_.end.fell ? margin_of_fall<theory>(path_.end.state.rate, block_)
                              : margin_after_pulse<theory>(path_.end.state, block_);
    }

    HistorySample sample(double time, const State<double>& state, double ground) const
    {
        const double pull =
            rocking_acceleration<theory>(state.tilt, block_.slenderness, state.side * ground);
        return {.time = time,
                .angle = state.side * state.tilt + 0.0, // no -0
                .velocity = state.side * state.rate + 0.0,
                .acceleration = state.side * pull,
                .q = double(conserved_q<theory>(state, block_.slenderness)),
                .ground = ground};
    }

    HistorySample resting(double time, double ground) const
    {
        HistorySample result = sample(time, {0, 0, 1}, ground);
        result.acceleration = 0;
        return result;
    }

    void tell_forced_stage(Recorder& recorder) const
    {
        const Milestone<double>* latest = nullptr; // at rest
        const auto at = [&](double time) {
            const double phase =
                std::min(excitation_.begin + time * excitation_.frequency, excitation_.end);
            const double ground = excitation_.ground(phase);
            if (latest == nullptr) {
                return resting(time, ground);
            }
            const double later = std::max(phase, latest->rocking.phase);
            return sample(time, state_after<Pulse, theory>(*latest, block_, excitation_, later),
                          ground);
        };
        for (const Milestone<double>& milestone : path_.milestones) {
            const double time = time_at(milestone.rocking.phase);
            recorder.follow(time, at);
            latest = milestone.what == Happening::rest ? nullptr : &milestone;
            switch (milestone.what) {
            case Happening::uplift: recorder.happens(Event::uplift, at(time)); break;
            case Happening::impact: recorder.happens(Event::impact, at(time)); break;
            case Happening::rest: recorder.happens(Event::rest, at(time)); break;
            case Happening::step: break;
            }
        }
        recorder.follow(end_of_path_, at);
        if (path_.end.fell) {
            recorder.ends_with(Event::fall);
        } else if (is_free()) {
            const bool rests = latest == nullptr;
            recorder.happens(Event::end_of_pulse, rests ? resting(end_of_path_, 0)
                                                        : sample(end_of_path_, path_.end.state, 0));
        }
    }

    /// Returns whether all impacts could be followed.
    bool tell_free_stage(Recorder& recorder, double spacing) const
    {
        FreeRocking<theory, double> rocking = free_rocking();
        // What is left of a series that is shorter than this cannot be seen.
        const double last_impact = time_of_rest_ - 1e-3 * spacing;
        while (end_of_path_ + rocking.begin() < last_impact) {
            if (rocking.impacts() == most_impacts_shown) {
                return false;
            }
            const double impact = end_of_path_ + rocking.impact_time();
            const double fall = end_of_path_ + rocking.fall_time();
            const RockingArc<theory, double>& arc = rocking.arc();
            const auto at = [&](double time) {
                const double since = std::max(0.0, time - end_of_path_ - rocking.begin());
                const State<double> striking{0, -arc.impact_speed(), arc.side()};
                return sample(time, time == impact ? striking : arc.at(since), 0);
            };
            recorder.follow(std::min(impact, fall), at);
            if (recorder.is_over(std::min(impact, fall))) {
                return true;
            }
            if (fall < impact) {
                recorder.ends_with(Event::fall);
                return true;
            }
            rocking.strike();
            recorder.happens(Event::impact, sample(impact, arc.at(0), 0));
        }
        const auto at_rest = [&](double time) { return resting(time, 0); };
        if (time_of_rest_ > end_of_path_) {
            recorder.follow(time_of_rest_, at_rest);
            recorder.ends_with(Event::rest);
        }
        recorder.follow(infinity, at_rest);
        return true;
    }

    Block<double> block_;
    Excitation<Pulse, double> excitation_;
    ForcedPath path_;
    double end_of_path_; // of what is integrated [1/p]
    double time_of_rest_;
    double time_of_fall_;
};

} // namespace

History history_of(const Scene& scene, const PlanePoint& point, const HistoryView& view)
{
    return for_scene(scene.pulse, scene.theory, [&]<class Pulse, Theory theory>() {
        return Narrator<Pulse, theory>(scene, point).tell(view);
    });
}

} // namespace overturn
