// From what a scene names to the types that compute it.
#pragma once

#include "overturn/mechanics/pulse.hpp"
#include "overturn/sweep/scene.hpp"

namespace overturn {

/// Calls visit.template operator()<Pulse>() for the pulse of this kind.
template <class Visitor>
auto with_pulse(PulseKind kind, const Visitor& visit)
{
    switch (kind) {
    case PulseKind::one_cosine: return visit.template operator()<OneCosine>();
    case PulseKind::symmetric_ricker: return visit.template operator()<SymmetricRicker>();
    case PulseKind::antisymmetric_ricker: return visit.template operator()<AntisymmetricRicker>();
    case PulseKind::half_sine: return visit.template operator()<HalfSine>();
    case PulseKind::rectangular: return visit.template operator()<Rectangular>();
    case PulseKind::one_sine: break;
    }
    return visit.template operator()<OneSine>();
}

/// Calls visit.template operator()<theory>().
template <class Visitor>
auto with_theory(Theory theory, const Visitor& visit)
{
    return theory == Theory::linear ? visit.template operator()<Theory::linear>()
                                    : visit.template operator()<Theory::nonlinear>();
}

/// Calls visit.template operator()<Pulse, theory>() for a scene.
template <class Visitor>
auto for_scene(PulseKind kind, Theory theory, const Visitor& visit)
{
    return with_pulse(kind, [&]<class Pulse>() {
        return with_theory(
            theory, [&]<Theory known>() { return visit.template operator()<Pulse, known>(); });
    });
}

} // namespace overturn
