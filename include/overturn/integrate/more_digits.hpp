// The forced stage in more digits than double: settles verdicts that doubles cannot settle, and is
// the reference for accuracy.
#pragma once

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/mechanics/record_excitation.hpp"
#include "overturn/number/digits50.hpp"
#include "overturn/number/double_double.hpp"

#include <functional>

namespace overturn {

/// How a number type with more digits is used: Digits31, for pulses (under a record, a kernel
/// integrates in 31 digits), or Digits50, with at least 25 digits at the end of a pulse, after
/// about a hundred steps of half a millisecond.
template <class T>
struct MoreDigits {
    static constexpr bool are_50 = std::same_as<T, Digits50>;
    static constexpr double tolerance = are_50 ? 1e-30 : 1e-29;
    /// Points with more steps bounce for a long time and are not computed.
    static constexpr int most_steps = are_50 ? 2000 : 20000;
};

/// Like run_forced_stage(), for one block, with the outputs impacts and error, under a record also
/// the peak. A run that exceeds `step_limit` steps, in addition to one per interval of a record, is
/// capped, as is one that stop_requested() ends; it is called every few milliseconds. T: Digits31,
/// only under a pulse, or Digits50; excitation: PulseExcitation<T>, or RecordExcitation<T,
/// Directions::both>. Instantiated in src/integrate.
template <class T, Theory theory, class Excitation>
ForcedEnd<T> run_in_more_digits(const Block<T>& block, const Excitation& excitation,
                                const std::function<bool()>& stop_requested = nullptr,
                                double tolerance = MoreDigits<T>::tolerance,
                                int step_limit = MoreDigits<T>::most_steps)
{
    constexpr bool is_recorded = Excitation::is_recorded;
    constexpr int order = MoreDigits<T>::are_50 && !is_recorded ? 30 : 20;
    constexpr Outputs outputs{.impacts = true, .error = true, .peak = is_recorded};
    ForcedStage<Taylor<order>, theory, outputs, T, Excitation> stage(block, excitation,
                                                                     T(tolerance));
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

/// `keyword` run_in_more_digits() for this type and excitation, in both theories.
#define OVERTURN_MORE_DIGITS(keyword, T, ...)                                                      \
    keyword ForcedEnd<T> run_in_more_digits<T, Theory::nonlinear>(                                 \
        const Block<T>&, const __VA_ARGS__&, const std::function<bool()>&, double, int);           \
    keyword ForcedEnd<T> run_in_more_digits<T, Theory::linear>(                                    \
        const Block<T>&, const __VA_ARGS__&, const std::function<bool()>&, double, int);
OVERTURN_MORE_DIGITS(extern template, Digits31, PulseExcitation<Digits31>)
OVERTURN_MORE_DIGITS(extern template, Digits50, PulseExcitation<Digits50>)
OVERTURN_MORE_DIGITS(extern template, Digits50, RecordExcitation<Digits50, Directions::both>)

} // namespace overturn
