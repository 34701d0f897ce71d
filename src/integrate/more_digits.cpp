#include "overturn/integrate/more_digits.hpp"

namespace overturn {

template <class T, Theory theory, class Excitation>
ForcedEnd<T> run_in_more_digits(const Block<T>& block, const Excitation& excitation,
                                const std::function<bool()>& stop_requested, double tolerance,
                                int step_limit)
{
    using Method = std::conditional_t<std::same_as<Excitation, PulseExcitation<T>>,
                                      typename MoreDigits<T>::Method,
                                      typename MoreDigits<T>::MethodForRecords>;
    ForcedStage<Method, theory, Outputs{.impacts = true, .error = true}, T, Excitation> stage(
        block, excitation, T(tolerance));
    constexpr int steps_between_checks = 16;
    const int limit = step_limit + int(excitation.motion.pieces());
    for (int steps = 0; stage.is_active() && steps < limit; ++steps) {
        if (steps % steps_between_checks == 0 && stop_requested && stop_requested()) {
            break;
        }
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

#define OVERTURN_INSTANTIATE(T, theory)                                                            \
    template ForcedEnd<T> run_in_more_digits<T, theory>(                                           \
        const Block<T>&, const PulseExcitation<T>&, const std::function<bool()>&, double, int);    \
    template ForcedEnd<T> run_in_more_digits<T, theory>(                                           \
        const Block<T>&, const RecordExcitation<T, Directions::both>&,                             \
        const std::function<bool()>&, double, int);
OVERTURN_INSTANTIATE(long double, Theory::nonlinear)
OVERTURN_INSTANTIATE(long double, Theory::linear)
OVERTURN_INSTANTIATE(Digits50, Theory::nonlinear)
OVERTURN_INSTANTIATE(Digits50, Theory::linear)

} // namespace overturn
