#include "overturn/integrate/more_digits.hpp"

namespace overturn {

template <class T, Theory theory>
ForcedEnd<T> run_in_more_digits(const Block<T>& block, const Excitation<T>& excitation,
                                double tolerance, int step_limit)
{
    ForcedStage<typename MoreDigits<T>::Method, theory, Records{.impacts = true, .error = true}, T>
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

template ForcedEnd<long double>
run_in_more_digits<long double, Theory::nonlinear>(const Block<long double>&,
                                                   const Excitation<long double>&, double, int);
template ForcedEnd<long double>
run_in_more_digits<long double, Theory::linear>(const Block<long double>&,
                                                const Excitation<long double>&, double, int);
template ForcedEnd<Digits50>
run_in_more_digits<Digits50, Theory::nonlinear>(const Block<Digits50>&, const Excitation<Digits50>&,
                                                double, int);
template ForcedEnd<Digits50>
run_in_more_digits<Digits50, Theory::linear>(const Block<Digits50>&, const Excitation<Digits50>&,
                                             double, int);

} // namespace overturn
