#include "peer.hpp"

#include <cmath>

namespace overturn::benchmarks {

Problem paper_block_problem(int count)
{
    const double slenderness = std::atan(1 / 5.67);
    Plane plane;
    plane.frequency = Axis(AxisRange{.first = 0.5, .last = 8, .count = count});
    plane.amplitude = Axis(AxisRange{.first = 1.2, .last = 12, .count = count});
    plane.slenderness = Axis(AxisList{slenderness});
    plane.restitution = Axis(AxisList{1});
    plane.restitution_of = RestitutionOf::maximum;
    Problem problem{plane, {}};
    for (const double amplitude : plane.amplitude.values()) {
        for (const double frequency : plane.frequency.values()) {
            problem.points.push_back(
                {slenderness, plane.restitution_ratio(0, 0), amplitude, frequency});
        }
    }
    return problem;
}

} // namespace overturn::benchmarks
