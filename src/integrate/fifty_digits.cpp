// Compiled once per pulse: OVERTURN_PULSE comes from CMake.
#include "overturn/integrate/fifty_digits.hpp"

namespace overturn {

template <class Pulse, Theory theory>
ForcedEnd<Digits50> run_in_fifty_digits(const Block<Digits50>& block,
                                        const Excitation<Pulse, Digits50>& excitation,
                                        double tolerance, int step_limit)
{
    ForcedStage<Taylor<30>, Pulse, theory, Records{.impacts = true, .error = true}, Digits50> stage(
        block, excitation, Digits50(tolerance));
    for (int steps = 0; stage.is_active() && steps < step_limit; ++steps) {
        stage.advance();
    }
    ForcedEnd<Digits50> end = stage.end();
    if (stage.is_active()) {
        end.capped = true;
        end.error = std::numeric_limits<Digits50>::infinity();
    }
    return end;
}

#define OVERTURN_INSTANTIATE(pulse, theory)                                                        \
    template ForcedEnd<Digits50> run_in_fifty_digits<pulse, theory>(                               \
        const Block<Digits50>&, const Excitation<pulse, Digits50>&, double, int);
OVERTURN_INSTANTIATE(OVERTURN_PULSE, Theory::nonlinear)
OVERTURN_INSTANTIATE(OVERTURN_PULSE, Theory::linear)

} // namespace overturn
