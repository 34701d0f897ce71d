#include "point_run.hpp"

#include "overturn/integrate/more_digits.hpp"
#include "overturn/mechanics/free_rocking.hpp"
#include "overturn/mechanics/low_bounces.hpp"
#include "overturn/problem/fields.hpp"

#include <algorithm>

namespace overturn {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

} // namespace

Outcomes::Outcomes(std::size_t points, const Outputs& wanted)
    : outputs(wanted), tilt(points), rate(points), side(points), flags(points),
      region(outputs.region ? points : 0), margin(outputs.margin ? points : 0),
      impacts(outputs.impacts ? points : 0), error(outputs.error ? points : 0),
      steps(outputs.steps ? points : 0), phase(outputs.phase ? points : 0),
      peak(outputs.peak ? points : 0), lowest_turn(outputs.grazes ? points : 0),
      softest_impact(outputs.grazes ? points : 0), last_impact(outputs.grazes ? points : 0)
{}

OutcomePointers Outcomes::pointers()
{
    return {tilt.data(),           rate.data(),       side.data(),    flags.data(),
            region.data(),         margin.data(),     impacts.data(), error.data(),
            steps.data(),          phase.data(),      peak.data(),    lowest_turn.data(),
            softest_impact.data(), last_impact.data()};
}

void Outcomes::set_free_fall(int point)
{
    const auto i = std::size_t(point);
    flags[i] = outcome_flag::free_fall;
    if (outputs.region) {
        region[i] = std::uint8_t(Region::undecided);
    }
    if (outputs.margin) {
        margin[i] = unknown;
    }
    if (outputs.error) {
        error[i] = infinity;
    }
}

std::uint16_t Outcomes::stored_impacts(std::size_t point, bool recorded) const
{
    return !recorded && (flags[point] & outcome_flag::rested)
               ? impact_count::bounce_series
               : std::uint16_t(std::min(impacts[point], double(impact_count::largest)));
}

ScaledPulses::ScaledPulses(const GroundMotion<double>& motion, Theory theory,
                           const std::vector<Point>& points)
    : of_point(points.size())
{
    const auto are_equal = [](const Point& one, const Point& other) {
        return one.amplitude == other.amplitude && one.slenderness == other.slenderness;
    };
    const PerLobe<FlankInPulse<double>> flanks = flanks_of(motion);
    for (std::size_t first = 0; first < points.size();) {
        const double threshold = uplift_threshold(theory, points[first].slenderness);
        const auto number = int(pulses.size());
        const double amplitude = points[first].amplitude;
        pulses.push_back({amplitude * threshold, uplift_phases(motion, flanks, amplitude)});
        std::size_t next = first;
        for (; next < points.size() && are_equal(points[first], points[next]); ++next) {
            of_point[next] = number;
        }
        first = next;
    }
}

PointRun::PointRun(const Scene& scene, std::vector<Point> points, Kernel kernel,
                   DropRequested drop_requested, std::int64_t motion)
    : scene_(scene), record_(scene.is_recorded() ? scene.records[std::size_t(motion)] : nullptr),
      motion_(ground_motion<double>(scene.pulse, scene.shape)), kernel_(kernel),
      drop_requested_(std::move(drop_requested)), points_(std::move(points)),
      pulses_(record_ ? ScaledPulses() : ScaledPulses(motion_, scene.theory, points_))
{}

PointRun PointRun::with_points(std::vector<Point> points) const
{
    PointRun run = *this;
    run.points_ = std::move(points);
    run.pulses_ = ScaledPulses(motion_, scene_.theory, run.points_);
    return run;
}

bool PointRun::falls_freely(int point) const
{
    return record_ && !(points_[std::size_t(point)].amplitude < record_->free_fall_scale());
}

template <class T, Theory theory, class Visitor>
auto PointRun::with_excitation(int point, const Visitor& visit) const
{
    const Point& at = points_[std::size_t(point)];
    if (record_) {
        return visit(record_excitation<theory>(*record_, T(at.slenderness), T(at.amplitude),
                                               T(at.frequency)));
    }
    const auto motion = [&] {
        if constexpr (std::same_as<T, double>) {
            return motion_;
        } else {
            return ground_motion<T>(scene_.pulse, scene_.shape);
        }
    }();
    return visit(
        pulse_excitation<theory>(motion, T(at.slenderness), T(at.amplitude), T(at.frequency)));
}

void PointRun::throw_if_dropped() const
{
    if (drop_requested_ && drop_requested_()) {
        throw TileDropped();
    }
}

void PointRun::run(const Numerics& numerics, Outcomes& outcomes, UncertainImpact uncertain_impact,
                   const std::vector<int>* chosen) const
{
    std::vector<int> not_falling;
    if (record_ && std::isfinite(record_->free_fall_scale())) {
        for (int i = 0; i < (chosen != nullptr ? int(chosen->size()) : size()); ++i) {
            const int point = chosen != nullptr ? (*chosen)[std::size_t(i)] : i;
            if (falls_freely(point)) {
                outcomes.set_free_fall(point);
            } else {
                not_falling.push_back(point);
            }
        }
        chosen = &not_falling;
    }
    const KernelTask task{.pulse = motion_,
                          .record = record_.get(),
                          .points = points_.data(),
                          .pulse_of_point = pulses_.of_point.data(),
                          .pulses = pulses_.pulses.data(),
                          .tolerance = numerics.tolerance,
                          .outputs = outcomes.outputs,
                          .uncertain_impact = uncertain_impact,
                          .chosen = chosen != nullptr ? chosen->data() : nullptr,
                          .chosen_count = chosen != nullptr ? int(chosen->size()) : size(),
                          .drop_requested =
                              [](const void* context) {
                                  const auto& requested =
                                      *static_cast<const DropRequested*>(context);
                                  return requested && requested();
                              },
                          .context = &drop_requested_};
    const Directions directions =
        record_ && !record_->upwards().empty() ? Directions::both : Directions::horizontal;
    sweep_kernel(kernel_, integrator_of(scene_, numerics), scene_.theory, outcomes.outputs,
                 directions)(task, outcomes.pointers());
    throw_if_dropped(); // if dropped, some outcomes may be missing
}

template <class T>
void PointRun::run_in_more_digits(int point, Outcomes& outcomes) const
{
    throw_if_dropped();
    if (falls_freely(point)) {
        outcomes.set_free_fall(point);
        return;
    }
    with_theory(scene_.theory, [&]<Theory theory>() {
        const auto i = std::size_t(point);
        const Block<T> block{T(points_[i].slenderness), T(points_[i].restitution)};
        const ForcedEnd<T> end = with_excitation<T, theory>(point, [&](const auto& excitation) {
            return overturn::run_in_more_digits<T, theory>(block, excitation, drop_requested_);
        });
        throw_if_dropped();
        const double margin = double(margin_of<theory>(end, block));
        const double rounding = end.is_stopped() ? 0 : std::abs(margin) * 0x1p-53;
        const double error = double(end.error) + rounding;
        const bool in_doubt = !(error < std::abs(margin));
        outcomes.flags[i] = std::uint8_t((end.fell ? outcome_flag::fell : 0) |
                                         (end.rested ? outcome_flag::rested : 0) |
                                         (end.capped ? outcome_flag::capped : 0) |
                                         (end.not_finite ? outcome_flag::not_finite : 0) |
                                         (in_doubt ? outcome_flag::in_doubt : 0));
        const auto put = [&](std::vector<double>& values, double value) {
            if (!values.empty()) {
                values[i] = value;
            }
        };
        put(outcomes.tilt, double(end.state.tilt));
        put(outcomes.rate, double(end.state.rate));
        put(outcomes.side, double(end.state.side));
        put(outcomes.margin, margin);
        put(outcomes.error, error);
        put(outcomes.impacts, double(end.impacts));
        put(outcomes.steps, double(end.steps));
        put(outcomes.phase, double(end.phase));
        if (outcomes.outputs.region) {
            outcomes.region[i] = std::uint8_t(region_of<theory>(end, block));
        }
    });
}

template void PointRun::run_in_more_digits<long double>(int, Outcomes&) const;
template void PointRun::run_in_more_digits<Digits50>(int, Outcomes&) const;

bool PointRun::settle_low_bounces(int point, Outcomes& outcomes) const
{
    const auto i = std::size_t(point);
    const Point& block = points_[i];
    // The margin is that of a block at rest, 1, up to this error: the distances to the limits of
    // the rate change by no more than the tilt plus the rate.
    const double error = with_theory(scene_.theory, [&]<Theory theory>() {
        const auto bounds = with_excitation<double, theory>(point, [&](const auto& excitation) {
            return bound_of_low_bounces<theory>(block.slenderness, excitation);
        });
        return bounds
                   ? (bounds->tilt + bounds->rate) / separatrix_rate<theory>(0.0, block.slenderness)
                   : 1.0;
    });
    if (!(error < 1)) {
        return false;
    }
    if (outcomes.flags[i] & outcome_flag::capped) {
        outcomes.flags[i] = 0;
        outcomes.tilt[i] = 0;
        outcomes.rate[i] = 0;
    }
    outcomes.error[i] = error;
    if (outcomes.outputs.region) {
        outcomes.region[i] = std::uint8_t(Region::S);
    }
    if (outcomes.outputs.margin && !(outcomes.flags[i] & outcome_flag::undecided)) {
        outcomes.margin[i] = 1;
    }
    return true;
}

std::vector<double> PointRun::peaks(const Outcomes& outcomes) const
{
    std::vector<double> values(outcomes.tilt.size());
    with_theory(scene_.theory, [&]<Theory theory>() {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto region = Region(outcomes.region[i]);
            const State<double> end{outcomes.tilt[i], outcomes.rate[i], outcomes.side[i]};
            const Block<double> block{points_[i].slenderness, points_[i].restitution};
            values[i] = is_safe(region)
                            ? std::max(outcomes.peak[i], largest_free_tilt<theory>(end, block)) /
                                  block.slenderness
                        : is_unsafe(region) ? infinity
                                            : unknown;
        }
    });
    return values;
}

std::vector<double> PointRun::fall_times(const Outcomes& outcomes) const
{
    std::vector<double> values(outcomes.tilt.size());
    with_theory(scene_.theory, [&]<Theory theory>() {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto region = Region(outcomes.region[i]);
            const State<double> end{outcomes.tilt[i], outcomes.rate[i], outcomes.side[i]};
            const Block<double> block{points_[i].slenderness, points_[i].restitution};
            const double first_uplift =
                with_excitation<double, theory>(int(i), [](const auto& excitation) {
                    return excitation.next_uplift(true, excitation.motion.begin, -infinity);
                });
            const double forced = (outcomes.phase[i] - first_uplift) / points_[i].frequency;
            const bool fell = region == Region::F_plus || region == Region::F_minus;
            values[i] = fell                ? forced
                        : is_unsafe(region) ? forced + free_fall_time<theory>(end, block)
                        : is_safe(region)   ? infinity
                                            : unknown;
        }
    });
    return values;
}

} // namespace overturn
