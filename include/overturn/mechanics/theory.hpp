// The two theories of the block: Eq. 47 and its linearisation for slender blocks.
#pragma once

namespace overturn {

enum class Theory { nonlinear, linear };

/// Calls `visit.template operator()<theory>()`.
template <class Visitor>
auto with_theory(Theory theory, const Visitor& visit)
{
    return theory == Theory::linear ? visit.template operator()<Theory::linear>()
                                    : visit.template operator()<Theory::nonlinear>();
}

} // namespace overturn
