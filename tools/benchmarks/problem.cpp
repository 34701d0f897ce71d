#include "peer.hpp"

#include "overturn/record/read_record.hpp"

#include <cmath>

namespace overturn::benchmarks {

namespace {

Problem with_points(Problem problem)
{
    const Plane& plane = problem.plane;
    for (const double amplitude : plane.amplitude.values()) {
        for (const double frequency : plane.frequency.values()) {
            problem.points.push_back(
                {plane.slenderness.first(), plane.restitution_ratio(0, 0),
                 amplitude / amplitude_unit(problem.scene, plane, 0, plane.slenderness.first()),
                 frequency_of_point(problem.scene, plane, 0, frequency)});
        }
    }
    return problem;
}

Plane plane_of(double slenderness)
{
    Plane plane;
    plane.slenderness = Axis(AxisList{slenderness});
    plane.restitution = Axis(AxisList{1});
    plane.restitution_of = RestitutionOf::maximum;
    return plane;
}

} // namespace

Problem paper_block_problem(int count)
{
    Plane plane = plane_of(std::atan(1 / 5.67));
    plane.frequency = Axis(AxisRange{.first = 0.5, .last = 8, .count = count});
    plane.amplitude = Axis(AxisRange{.first = 1.2, .last = 12, .count = count});
    return with_points({.scene = {}, .plane = plane, .error_unit = 1, .points = {}});
}

Problem record_problem(const std::string& path, int count)
{
    constexpr double slenderness = 0.245; // the plane of jobs/synthetic.toml
    Plane plane = plane_of(slenderness);
    plane.frequency = Axis(AxisRange{.first = 0.2, .last = 3, .count = count});
    plane.frequency_is = FrequencyQuantity::size;
    plane.amplitude = Axis(AxisRange{.first = 0.5, .last = 2.5, .count = count});
    plane.amplitude_is = AmplitudeQuantity::scale;
    plane.motions = 1;
    RecordFile file = read_record(path);
    RecordComponent& component = file.components.front();
    if (component.unit != AccelerationUnit::g) {
        throw RecordError(path + ": the accelerations must be in g.");
    }
    Scene scene;
    scene.records = {std::make_shared<const Accelerogram>(
        std::move(component.acceleration), std::vector<double>(), component.time_step)};
    return with_points({.scene = scene, .plane = plane, .error_unit = slenderness, .points = {}});
}

} // namespace overturn::benchmarks
