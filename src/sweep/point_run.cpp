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

Ends::Ends(std::size_t points, const Records& recorded)
    : records(recorded), tilt(points), rate(points), side(points), flags(points),
      region(records.region ? points : 0), margin(records.margin ? points : 0),
      impacts(records.impacts ? points : 0), error(records.error ? points : 0),
      steps(records.steps ? points : 0), phase(records.phase ? points : 0),
      peak(records.peak ? points : 0), lowest_turn(records.grazes ? points : 0),
      softest_impact(records.grazes ? points : 0), last_impact(records.grazes ? points : 0)
{}

PointEnds Ends::pointers()
{
    return {tilt.data(),           rate.data(),       side.data(),    flags.data(),
            region.data(),         margin.data(),     impacts.data(), error.data(),
            steps.data(),          phase.data(),      peak.data(),    lowest_turn.data(),
            softest_impact.data(), last_impact.data()};
}

void Ends::set_free_fall(int point)
{
    const auto i = std::size_t(point);
    flags[i] = end_flag::free_fall;
    if (records.region) {
        region[i] = std::uint8_t(Region::undecided);
    }
    if (records.margin) {
        margin[i] = unknown;
    }
    if (records.error) {
        error[i] = infinity;
    }
}

std::uint16_t Ends::stored_impacts(std::size_t point, bool recorded) const
{
    return !recorded && (flags[point] & end_flag::rested)
               ? impact_count::bounce_series
               : std::uint16_t(std::min(impacts[point], double(impact_count::largest)));
}

Pushes::Pushes(const GroundMotion<double>& motion, Theory theory, const std::vector<Point>& points)
    : of_point(points.size())
{
    const auto have_one_push = [](const Point& one, const Point& other) {
        return one.amplitude == other.amplitude && one.slenderness == other.slenderness;
    };
    const PerLobe<FlankInPulse<double>> flanks = flanks_of(motion);
    for (std::size_t first = 0; first < points.size();) {
        const double threshold = uplift_threshold(theory, points[first].slenderness);
        const auto number = int(pushes.size());
        const double amplitude = points[first].amplitude;
        pushes.push_back({amplitude * threshold, uplift_phases(motion, flanks, amplitude)});
        std::size_t next = first;
        for (; next < points.size() && have_one_push(points[first], points[next]); ++next) {
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
      pushes_(record_ ? Pushes() : Pushes(motion_, scene.theory, points_))
{}

PointRun PointRun::with_points(std::vector<Point> points) const
{
    PointRun run = *this;
    run.points_ = std::move(points);
    run.pushes_ = Pushes(motion_, scene_.theory, run.points_);
    return run;
}

bool PointRun::falls_freely(int point) const
{
    return record_ && !(points_[std::size_t(point)].amplitude < record_->largest_scale());
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
        excitation_of<theory>(motion, T(at.slenderness), T(at.amplitude), T(at.frequency)));
}

void PointRun::throw_if_dropped() const
{
    if (drop_requested_ && drop_requested_()) {
        throw TileDropped();
    }
}

void PointRun::run(const Numerics& numerics, Ends& ends, OnUnknownError on_unknown_error,
                   const std::vector<int>* chosen) const
{
    std::vector<int> not_falling;
    if (record_ && std::isfinite(record_->largest_scale())) {
        for (int i = 0; i < (chosen != nullptr ? int(chosen->size()) : size()); ++i) {
            const int point = chosen != nullptr ? (*chosen)[std::size_t(i)] : i;
            if (falls_freely(point)) {
                ends.set_free_fall(point);
            } else {
                not_falling.push_back(point);
            }
        }
        chosen = &not_falling;
    }
    const KernelTask task{.pulse = motion_,
                          .record = record_.get(),
                          .points = points_.data(),
                          .push_of_point = pushes_.of_point.data(),
                          .pushes = pushes_.pushes.data(),
                          .tolerance = numerics.tolerance,
                          .records = ends.records,
                          .on_unknown_error = on_unknown_error,
                          .chosen = chosen != nullptr ? chosen->data() : nullptr,
                          .chosen_count = chosen != nullptr ? int(chosen->size()) : size(),
                          .drop_requested =
                              [](const void* context) {
                                  const auto& requested =
                                      *static_cast<const DropRequested*>(context);
                                  return requested && requested();
                              },
                          .context = &drop_requested_};
    const bool upwards = record_ && !record_->upwards().empty();
    sweep_kernel(kernel_, integrator_of(scene_, numerics), scene_.theory, ends.records,
                 upwards)(task, ends.pointers());
    throw_if_dropped(); // if dropped, some ends may be missing
}

template <class T>
void PointRun::run_exactly(int point, Ends& ends) const
{
    throw_if_dropped();
    if (falls_freely(point)) {
        ends.set_free_fall(point);
        return;
    }
    with_theory(scene_.theory, [&]<Theory theory>() {
        const auto i = std::size_t(point);
        const Block<T> block{T(points_[i].slenderness), T(points_[i].restitution)};
        const ForcedEnd<T> end = with_excitation<T, theory>(point, [&](const auto& excitation) {
            return run_in_more_digits<T, theory>(block, excitation, drop_requested_);
        });
        throw_if_dropped();
        const double margin = double(margin_of<theory>(end, block));
        const double rounding = end.is_stopped() ? 0 : std::abs(margin) * 0x1p-53;
        const double error = double(end.error) + rounding;
        const bool in_doubt = !(error < std::abs(margin));
        ends.flags[i] = std::uint8_t(
            (end.fell ? end_flag::fell : 0) | (end.rested ? end_flag::rested : 0) |
            (end.capped ? end_flag::capped : 0) | (end.not_finite ? end_flag::not_finite : 0) |
            (in_doubt ? end_flag::in_doubt : 0));
        const auto put = [&](std::vector<double>& values, double value) {
            if (!values.empty()) {
                values[i] = value;
            }
        };
        put(ends.tilt, double(end.state.tilt));
        put(ends.rate, double(end.state.rate));
        put(ends.side, double(end.state.side));
        put(ends.margin, margin);
        put(ends.error, error);
        put(ends.impacts, double(end.impacts));
        put(ends.steps, double(end.steps));
        put(ends.phase, double(end.phase));
        if (ends.records.region) {
            ends.region[i] = std::uint8_t(region_of<theory>(end, block));
        }
    });
}

template void PointRun::run_exactly<long double>(int, Ends&) const;
template void PointRun::run_exactly<Digits50>(int, Ends&) const;

bool PointRun::settle_low_bounces(int point, Ends& ends) const
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
    if (ends.flags[i] & end_flag::capped) {
        ends.flags[i] = 0;
        ends.tilt[i] = 0;
        ends.rate[i] = 0;
    }
    ends.error[i] = error;
    if (ends.records.region) {
        ends.region[i] = std::uint8_t(Region::S);
    }
    if (ends.records.margin && !(ends.flags[i] & end_flag::undecided)) {
        ends.margin[i] = 1;
    }
    return true;
}

std::vector<double> PointRun::peaks(const Ends& ends) const
{
    std::vector<double> values(ends.tilt.size());
    with_theory(scene_.theory, [&]<Theory theory>() {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto region = Region(ends.region[i]);
            const State<double> end{ends.tilt[i], ends.rate[i], ends.side[i]};
            const Block<double> block{points_[i].slenderness, points_[i].restitution};
            values[i] = is_safe(region)
                            ? std::max(ends.peak[i], largest_free_tilt<theory>(end, block)) /
                                  block.slenderness
                        : is_unsafe(region) ? infinity
                                            : unknown;
        }
    });
    return values;
}

std::vector<double> PointRun::fall_times(const Ends& ends) const
{
    std::vector<double> values(ends.tilt.size());
    with_theory(scene_.theory, [&]<Theory theory>() {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto region = Region(ends.region[i]);
            const State<double> end{ends.tilt[i], ends.rate[i], ends.side[i]};
            const Block<double> block{points_[i].slenderness, points_[i].restitution};
            const double first_uplift =
                with_excitation<double, theory>(int(i), [](const auto& excitation) {
                    return excitation.next_uplift(true, excitation.motion.begin, -infinity);
                });
            const double forced = (ends.phase[i] - first_uplift) / points_[i].frequency;
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
