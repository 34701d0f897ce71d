// The forced stage in more digits than double: settles verdicts that doubles cannot settle, and is
// the reference for accuracy.
#pragma once

#include "overturn/integrate/forced_stage.hpp"
#include "overturn/mechanics/record_excitation.hpp"
#include "overturn/number/digits50.hpp"

#include <functional>

namespace overturn {

/// How a number type with more digits is used. most_steps: points with more steps bounce for a long
/// time and are not computed.
template <class T>
struct MoreDigits;

/// 19 digits, at most a dozen microseconds per step.
template <>
struct MoreDigits<long double> {
    using Method = Taylor<20>;
    using MethodForRecords = Taylor<14>; // the intervals of records are short
    static constexpr double tolerance = 1e-17;
    static constexpr int most_steps = 20000;
};

/// At least 25 digits at the end of a pulse, after about a hundred steps of half a millisecond.
template <>
struct MoreDigits<Digits50> {
    using Method = Taylor<30>;
    using MethodForRecords = Taylor<20>;
    static constexpr double tolerance = 1e-30;
    static constexpr int most_steps = 2000;
};

/// Like run_forced_stage(), for one block, with the outputs impacts and error. A run that exceeds
/// `step_limit` steps, in addition to one per interval of a record, is capped, as is one that
/// stop_requested() ends; it is called every few milliseconds. T: long double or Digits50;
/// PulseExcitation<T>, or RecordExcitation<T, Directions::both>. Compiled in src/integrate.
template <class T, Theory theory, class Excitation>
ForcedEnd<T> run_in_more_digits(const Block<T>& block, const Excitation& excitation,
                                const std::function<bool()>& stop_requested = nullptr,
                                double tolerance = MoreDigits<T>::tolerance,
                                int step_limit = MoreDigits<T>::most_steps);

} // namespace overturn
