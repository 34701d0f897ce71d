// Scenes under short recorded motions.
#pragma once

#include "overturn/problem/scene.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace overturn {

/// A record of four samples, of these peaks over g and this time step [s]; upwards: 0: none.
inline std::shared_ptr<const Accelerogram> short_record(double peak, double time_step,
                                                        double upwards = 0)
{
    std::vector<double> vertical;
    if (upwards != 0) {
        vertical = {0, upwards, 0, 0};
    }
    return std::make_shared<const Accelerogram>(std::vector<double>{0, peak, -peak / 2, 0},
                                                std::move(vertical), time_step);
}

/// A record of four samples, whose second component has this peak at another time.
inline std::shared_ptr<const Accelerogram> record_of_two_components(double peak, double time_step)
{
    return std::make_shared<const Accelerogram>(std::vector<double>{0, 0.75, -0.25, 0},
                                                std::vector<double>(), time_step,
                                                std::vector<double>{0, peak / 4, peak, 0});
}

/// Three records, all different in peak and time step.
inline Scene scene_of_three_records()
{
    Scene scene;
    scene.motion =
        Suite{{short_record(0.5, 0.01), short_record(0.25, 0.02), short_record(2, 0.005)}};
    return scene;
}

} // namespace overturn
