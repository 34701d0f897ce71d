// All theories, and the choice of one of them at run time.
#pragma once

#include "overturn/mechanics/theory/linear.hpp"
#include "overturn/mechanics/theory/nonlinear.hpp"

namespace overturn {

/// Calls `visit.template operator()<theory>()`.
template <class Visitor>
auto with_theory(Theory theory, const Visitor& visit)
{
    switch (theory) {
    case Theory::linear: return visit.template operator()<Theory::linear>();
    case Theory::nonlinear: break;
    }
    return visit.template operator()<Theory::nonlinear>();
}

/// Whether the forces of the contact are defined.
inline bool has_contact_forces(Theory theory)
{
    return with_theory(theory, []<Theory known>() { return Equations<known>::has_contact_forces; });
}

} // namespace overturn
