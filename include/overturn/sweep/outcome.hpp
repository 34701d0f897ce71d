// What the forced stage of a point yields, from which the values of its fields follow.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/region.hpp"
#include "overturn/problem/fields.hpp"
#include "overturn/problem/point.hpp"
#include "overturn/problem/scene.hpp"

#include <algorithm>
#include <cstdint>

namespace overturn {

/// The bits of Outcome::flags besides those of the field `status`, and sets of bits.
namespace outcome_flag {
inline constexpr std::uint16_t fell = 256;
inline constexpr std::uint16_t in_doubt = 512; ///< only if the error is an output, see ForcedEnd
/// The stored ones. resolve() sets `unresolved`; a point in `free_fall` is not integrated.
inline constexpr std::uint8_t of_status =
    status::came_to_rest | status::cap_was_hit | status::not_finite | status::unresolved |
    status::free_fall | status::lifts_off | status::slipped | status::jammed;
/// The integration was stopped, or did not begin: the state is meaningless.
inline constexpr std::uint8_t without_end =
    status::cap_was_hit | status::not_finite | status::free_fall;
} // namespace outcome_flag

/// The outcome of the forced stage of a point. A kernel writes the values of the second group only
/// if they are outputs.
struct Outcome {
    double tilt;         ///< |theta| [rad]
    double rate;         ///< d|theta| / d tau [rad]
    double side;         ///< +1 or -1: the sign of theta
    std::uint16_t flags; ///< of the field `status`, and outcome_flag

    Region region;
    double margin;          ///< [1]
    double error;           ///< of the margin
    double impacts;         ///< count
    double steps;           ///< tried
    double phase;           ///< end of the motion, or phase of the fall [rad or samples]
    double peak;            ///< the largest |theta| [rad]
    double lowest_turn;     ///< see ForcedEnd [rad]
    double softest_impact;  ///< see ForcedEnd [rad]
    double last_impact;     ///< see ForcedEnd [rad]
    double friction_demand; ///< see ContactDemand::friction [1]
    double normal;          ///< see ContactDemand [1]
    double to_stick;        ///< friction: see ContactObserver::slip_demand() [1]

    // Of a block that slipped; with Outputs::slide of any with a friction coefficient.
    double slide;      ///< of the base, in the unit of Block::size, positive towards plus
    double slide_peak; ///< its largest absolute value
    double uplift;     ///< phase of the first uplift [rad or samples]
    double fall_after; ///< time from `phase` to |theta| = pi/2 [1/p]

    State<double> end() const { return {tilt, rate, side}; }
    bool has(std::uint16_t any_of_flags) const { return (flags & any_of_flags) != 0; }

    /// The value of the field `impacts`. lifts_again: see MotionTraits.
    std::uint16_t stored_impacts(bool lifts_again) const
    {
        return !lifts_again && has(status::came_to_rest)
                   ? impact_count::bounce_series
                   : std::uint16_t(std::min(impacts, double(impact_count::largest)));
    }

    /// A magnitude at the end with the sign of theta; NaN if the integration did not reach the end.
    double with_sign(double magnitude) const
    {
        return has(outcome_flag::without_end) ? unknown_value
               : side > 0                     ? magnitude
                                              : 0.0 - magnitude; // not -0
    }
};

/// Points of a scene, of which few fields need the first uplift.
class PointsOfScene {
public:
    PointsOfScene(const Scene& scene, std::vector<Point> points)
        : scene_(scene), points_(std::move(points))
    {}

    const Scene& scene() const { return scene_; }
    int size() const { return int(points_.size()); }
    const Point& point(int i) const { return points_[std::size_t(i)]; }

    /// The phase of the first uplift of a point [rad or samples].
    virtual double first_uplift(int point) const = 0;

protected:
    ~PointsOfScene() = default;

    Scene scene_;
    std::vector<Point> points_;
};

/// The end of the ground motion at a point.
struct EndOfPoint {
    const PointsOfScene& points;
    int number;
    const Point& point;
    const Outcome& outcome;

    const Scene& scene() const { return points.scene(); }
    double first_uplift() const { return points.first_uplift(number); }

    /// The block as seen from the side on which it ended.
    Block<double> block() const { return seen_from(outcome.side, point.block); }
};

/// The ends of all points.
struct EndsOfPoints {
    const PointsOfScene& points;
    const Outcome* outcomes;

    int size() const { return points.size(); }
    EndOfPoint operator[](int i) const { return {points, i, points.point(i), outcomes[i]}; }
};

} // namespace overturn
