// The forced stage in more digits than double: settles verdicts that doubles cannot settle, and is
// the reference for accuracy.
#pragma once

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/number/digits50.hpp"

namespace overturn {

/// How a number type with more digits is used. most_steps: points with more steps bounce for a long
/// time and are not computed.
template <class T>
struct MoreDigits;

/// 19 digits, at most a dozen microseconds per step.
template <>
struct MoreDigits<long double> {
    using Method = Taylor<20>;
    static constexpr double tolerance = 1e-17;
    static constexpr int most_steps = 20000;
};

/// At least 25 digits at the end of a pulse, after about a hundred steps of half a millisecond.
template <>
struct MoreDigits<Digits50> {
    using Method = Taylor<30>;
    static constexpr double tolerance = 1e-30;
    static constexpr int most_steps = 2000;
};

/// Like run_forced_stage(), for one block, with impacts and error recorded. A run that exceeds
/// `step_limit` steps is capped. T: long double or Digits50. Compiled in src/integrate.
template <class T, Theory theory>
ForcedEnd<T> run_in_more_digits(const Block<T>& block, const Excitation<T>& excitation,
                                double tolerance = MoreDigits<T>::tolerance,
                                int step_limit = MoreDigits<T>::most_steps);

} // namespace overturn
