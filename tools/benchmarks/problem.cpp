#include "peer.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/given.hpp"
#include "overturn/record/read_record.hpp"
#include "overturn/text/error.hpp"

#include <cmath>

namespace overturn::benchmarks {

namespace {

Given number(const char* name, double value)
{
    return {&quantity(name), name, Axis(AxisList{value}), GivenAs::number};
}

Given axis(const char* name, const AxisRange& range)
{
    return {&quantity(name), name, Axis(range), GivenAs::axis};
}

/// error_unit: see PeerProblem.
PeerProblem problem_of(const Scene& scene, std::vector<Given> given, double error_unit)
{
    const Grid grid = grid_of(scene, std::move(given));
    return {scene, grid, error_unit, Coordinates(scene, grid).points()};
}

} // namespace

PeerProblem paper_block_problem(int count)
{
    return problem_of({},
                      {number("slenderness", std::atan(1 / 5.67)),
                       number("restitution_of_maximum", 1),
                       axis("amplitude", {.first = 1.2, .last = 12, .count = count}),
                       axis("frequency", {.first = 0.5, .last = 8, .count = count})},
                      1);
}

PeerProblem record_problem(const std::string& path, int count)
{
    constexpr double slenderness = 0.245; // the plane of jobs/synthetic.toml
    RecordFile file = read_record(path);
    RecordComponent& component = file.components.front();
    if (component.unit != AccelerationUnit::g) {
        throw Error(exit_code::job, path + ": the accelerations must be in g.");
    }
    Scene scene;
    scene.motion = Suite{{std::make_shared<const Accelerogram>(
        std::move(component.acceleration), std::vector<double>(), component.time_step)}};
    return problem_of(scene,
                      {number("motion", 1), number("slenderness", slenderness),
                       number("restitution_of_maximum", 1),
                       axis("scale", {.first = 0.5, .last = 2.5, .count = count}),
                       axis("size", {.first = 0.2, .last = 3, .count = count})},
                      slenderness);
}

} // namespace overturn::benchmarks
