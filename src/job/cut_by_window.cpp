#include "overturn/job/job.hpp"
#include "overturn/mechanics/ground_motion.hpp"

#include <cmath>

namespace overturn {

double cut_by_window(const Scene& scene)
{
    const GroundMotion<double> motion = ground_motion(scene.pulse, scene.window);
    return has_window(scene.pulse) ? std::abs(motion.values(std::array{motion.end})[0]) : 0;
}

} // namespace overturn
