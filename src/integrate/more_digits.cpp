// Compiled once per pulse: OVERTURN_PULSE comes from CMake.
#include "overturn/integrate/more_digits.hpp"

namespace overturn {

template <class T, class Pulse, Theory theory>
ForcedEnd<T> run_in_more_digits(const Block<T>& block, const Excitation<Pulse, T>& excitation,
                                double tolerance, int step_limit)
{
    ForcedStage<typename MoreDigits<T>::Method, Pulse, theory,
                Records{.impacts = true, .error = true}, T>
        stage(block, excitation, T(tolerance));
    for (int steps = 0; stage.is_active() && steps < step_limit; ++steps) {
        stage.advance();
    }
    ForcedEnd<T> end = stage.end();
    if (stage.is_active()) {
        end.capped = true;
        end.error = std::numeric_limits<T>::infinity();
        end.in_doubt = true;
    }
    return end;
}

#define OVERTURN_INSTANTIATE(number, pulse, theory)                                                \
    template ForcedEnd<number> run_in_more_digits<number, pulse, theory>(                          \
        const Block<number>&, const Excitation<pulse, number>&, double, int);
OVERTURN_INSTANTIATE(long double, OVERTURN_PULSE, Theory::nonlinear)
OVERTURN_INSTANTIATE(long double, OVERTURN_PULSE, Theory::linear)
OVERTURN_INSTANTIATE(Digits50, OVERTURN_PULSE, Theory::nonlinear)
OVERTURN_INSTANTIATE(Digits50, OVERTURN_PULSE, Theory::linear)

} // namespace overturn
