// Every pulse with both theories, and a plane of a single point.
#pragma once

#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/scene.hpp"

#include <vector>

namespace overturn {

inline std::vector<Scene> every_scene()
{
    std::vector<Scene> scenes;
    for (std::size_t pulse = 0; pulse < pulse_names.size(); ++pulse) {
        for (const Theory theory : {Theory::nonlinear, Theory::linear}) {
            scenes.push_back({PulseKind(pulse), theory});
        }
    }
    return scenes;
}

/// Point: PlanePoint, or Point<double>.
template <class Point>
Plane plane_of(const Point& point)
{
    Plane plane;
    plane.slenderness = Axis(AxisList{point.slenderness});
    plane.restitution = Axis(AxisList{point.restitution});
    plane.frequency = Axis(AxisList{point.frequency});
    plane.amplitude = Axis(AxisList{point.amplitude});
    return plane;
}

} // namespace overturn
