// Every pulse with both theories.
#pragma once

#include "overturn/problem/scene.hpp"

#include <vector>

namespace overturn {

inline std::vector<Scene> every_scene()
{
    std::vector<Scene> scenes;
    for (std::size_t pulse = 0; pulse < names_of<PulseKind>.size(); ++pulse) {
        for (const Theory theory : {Theory::nonlinear, Theory::linear}) {
            scenes.push_back({.motion = Pulse{PulseKind(pulse)}, .theory = theory});
        }
    }
    return scenes;
}

} // namespace overturn
