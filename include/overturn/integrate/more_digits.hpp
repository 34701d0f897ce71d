// The forced stage in more digits than doubles have: what settles a verdict that they cannot, and
// what accuracy is measured against.
#pragma once

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/number/digits50.hpp"

namespace overturn {

/// How a number type with more digits is used. most_steps: whoever needs more is long in bouncing,
/// and given up.
template <class T>
struct MoreDigits;

/// 19 digits, a dozen microseconds per step or less.
template <>
struct MoreDigits<long double> {
    using Method = Taylor<20>;
    static constexpr double tolerance = 1e-17;
    static constexpr int most_steps = 20000;
};

/// 25 digits and more at the end of a pulse, after a hundred steps or so of half a millisecond.
template <>
struct MoreDigits<Digits50> {
    using Method = Taylor<30>;
    static constexpr double tolerance = 1e-30;
    static constexpr int most_steps = 2000;
};

/// run_forced_stage() for one block, which counts impacts and bounds its error, and after
/// `step_limit` steps gives up as capped. T: long double or Digits50. Compiled in src/integrate.
template <class T, Theory theory>
ForcedEnd<T> run_in_more_digits(const Block<T>& block, const Excitation<T>& excitation,
                                double tolerance = MoreDigits<T>::tolerance,
                                int step_limit = MoreDigits<T>::most_steps);

} // namespace overturn
