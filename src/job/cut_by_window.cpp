#include "overturn/job/job.hpp"
#include "overturn/mechanics/pulse.hpp"

#include <cmath>

namespace overturn {

double cut_by_window(const Scene& scene)
{
    switch (scene.pulse) {
    case PulseKind::symmetric_ricker:
        return std::abs(SymmetricRicker::value(SymmetricRicker::end(scene.window)));
    case PulseKind::antisymmetric_ricker:
        return std::abs(AntisymmetricRicker::value(AntisymmetricRicker::end(scene.window)));
    default: return 0;
    }
}

} // namespace overturn
