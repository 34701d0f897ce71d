#include "coordinates.hpp"

#include "layout.hpp"

#include <numbers>

namespace overturn {

namespace {

constexpr double exact = 0;
constexpr double of_one_function = 4; // the error of each library is at most two
constexpr double of_several = 100;    // largest_restitution amplifies those of its sine

Coordinate coordinate_of(const Dimension& dimension)
{
    const auto& [name, axis_of_job, long_name, units] = dimension;
    const Axis& axis = *axis_of_job;
    const auto* range = std::get_if<AxisRange>(&axis.definition());
    const bool is_log = range != nullptr && range->spacing == Spacing::log;
    const double roundings = is_log ? of_one_function : exact;
    return {{name, {name}, {hsize_t(axis.size())}, axis.values(), long_name, units}, roundings};
}

Coordinate restitution_ratio(const Plane& plane)
{
    std::vector<double> values;
    for (std::int64_t i = 0; i < plane.slenderness.size(); ++i) {
        for (std::int64_t j = 0; j < plane.restitution.size(); ++j) {
            values.push_back(plane.restitution_ratio(i, j));
        }
    }
    return {{"restitution_ratio",
             {"slenderness", "restitution"},
             {hsize_t(plane.slenderness.size()), hsize_t(plane.restitution.size())},
             std::move(values),
             "energy ratio at an impact, r",
             "1"},
            plane.restitution_of == RestitutionOf::absolute ? exact : of_several};
}

/// For a job whose block is given in metres.
Coordinate pulse_period(const Plane& plane)
{
    const double p = frequency_parameter(*plane.block);
    std::vector<double> periods;
    for (const double frequency : plane.frequency.values()) {
        periods.push_back(2 * std::numbers::pi / (frequency * p));
    }
    return {{"pulse_period",
             {"frequency"},
             {periods.size()},
             periods,
             "period of the pulse, 2 pi / omega_p, with g = 9.81 m/s2",
             "s"},
            of_several};
}

/// For a job whose block is given in metres.
Coordinate peak_ground_acceleration(const Job& job)
{
    const double threshold = uplift_threshold(job.scene.theory, job.plane.slenderness.first());
    std::vector<double> accelerations;
    for (const double amplitude : job.plane.amplitude.values()) {
        accelerations.push_back(amplitude * threshold);
    }
    return {{"peak_ground_acceleration",
             {"amplitude"},
             {accelerations.size()},
             accelerations,
             "peak ground acceleration, over g",
             "1"},
            of_several};
}

} // namespace

std::vector<Dimension> dimensions_of(const Job& job)
{
    const Plane& plane = job.plane;
    const Dimension rows = job.product == Product::boundary
                               ? Dimension{"crossing", &plane.amplitude,
                                           "flips of the verdict along the amplitude, from 0", "1"}
                               : Dimension{"amplitude", &plane.amplitude,
                                           job.scene.theory == Theory::linear
                                               ? "peak ground acceleration, over g alpha"
                                               : "peak ground acceleration, over g tan(alpha)",
                                           "1"};
    return {{"slenderness", &plane.slenderness, "slenderness of the block, arctan(b/h)", "rad"},
            {"restitution", &plane.restitution,
             plane.restitution_of == RestitutionOf::maximum
                 ? "energy ratio at an impact, over its maximum for the block"
                 : "energy ratio at an impact",
             "1"},
            rows,
            {"frequency", &plane.frequency,
             "angular frequency of the pulse, over the block's frequency parameter p", "1"}};
}

std::vector<Coordinate> coordinates_of(const Job& job)
{
    const Plane& plane = job.plane;
    std::vector<Coordinate> all;
    for (const Dimension& dimension : dimensions_of(job)) {
        all.push_back(coordinate_of(dimension));
    }
    if (plane.block) { // its slenderness is an arctangent
        all.front().roundings = of_one_function;
    }
    if (job.product == Product::boundary) {
        all.push_back(
            coordinate_of({layout::scan, &job.scan,
                           "amplitudes that were computed first to find the flips", "1"}));
    }
    all.push_back(restitution_ratio(plane));
    if (plane.block) {
        all.push_back(pulse_period(plane));
        if (job.product == Product::spectrum) { // a boundary has crossings instead of amplitudes
            all.push_back(peak_ground_acceleration(job));
        }
    }
    return all;
}

} // namespace overturn
