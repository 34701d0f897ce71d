// The error of a run so far, as an ellipse that holds it: the local errors of all steps, each
// passed on by the linearised motion to where the block is now. A local error is known in size, not
// in sign, so what is carried along is a matrix P, and no combination c . e of the errors e in
// tilt and rate exceeds sqrt(c^T P c).
#pragma once

#include "overturn/mechanics/variation.hpp"

#include <limits>

namespace overturn {

/// Instead of an infinite error, which would multiply zeros. [rad]
template <class S>
inline const S unknown_error = S(0x1p+200);

/// What a step tells of its own errors.
template <Number T>
struct StepErrors {
    Variation<T> variation; ///< of its end with its beginning
    T tilt;                 ///< at most left out by its formula [rad]
    T rate;                 ///< [rad]
    T turning_tilt;         ///< the tilt where the rate changes its sign, if it does [rad]
};

template <Number T>
class ErrorGrowth {
    using S = scalar_t<T>;
    using Mask = mask_t<T>;

public:
    /// A block at rest is where it is: nothing is left of former errors.
    void forget(const Mask& lanes)
    {
        tilt_tilt_ = select<T>(lanes, zero_, tilt_tilt_);
        tilt_rate_ = select<T>(lanes, zero_, tilt_rate_);
        rate_rate_ = select<T>(lanes, zero_, rate_rate_);
    }

    /// P becomes V P V^T.
    void pass(const Variation<T>& by, const Mask& lanes)
    {
        using arithmetic::fma;
        const auto& [tt, tr, rt, rr] = by;
        const T tilt_tilt = fma(tt, tilt_tilt_, tr * tilt_rate_);
        const T tilt_rate = fma(tt, tilt_rate_, tr * rate_rate_);
        const T rate_tilt = fma(rt, tilt_tilt_, rr * tilt_rate_);
        const T rate_rate = fma(rt, tilt_rate_, rr * rate_rate_);
        tilt_tilt_ = select<T>(lanes, fma(tilt_tilt, tt, tilt_rate * tr), tilt_tilt_);
        tilt_rate_ = select<T>(lanes, fma(tilt_tilt, rt, tilt_rate * rr), tilt_rate_);
        rate_rate_ = select<T>(lanes, fma(rate_tilt, rt, rate_rate * rr), rate_rate_);
    }

    /// Adds the error of a step, at most `tilt` and `rate` in size. Of all ellipses of their kind
    /// the smallest that holds this rectangle has diag(tilt, rate) (tilt + rate), and the smallest
    /// that holds the sum of two, of sizes a and b, (a + b) (P / a + Q / b); a size is the square
    /// root of a trace. Round-off [rad] is random, and its squares simply add up.
    void add(const T& tilt, const T& rate, const T& tilt_round_off, const T& rate_round_off,
             const Mask& lanes)
    {
        using arithmetic::fma;
        using std::sqrt;
        const T tiny(S(0x1p-500)); // instead of 0 / 0
        const T before = greater<T>(sqrt(tilt_tilt_ + rate_rate_), tiny);
        const T size = before + (tilt + rate);
        const T grown = size / before;
        const auto sum = [&](const T& to, const T& error, const T& round_off) -> T {
            const T added = fma(size, error, round_off * round_off);
            return select<T>(lanes, fma(grown, to, added), to);
        };
        tilt_tilt_ = sum(tilt_tilt_, tilt, tilt_round_off);
        tilt_rate_ = select<T>(lanes, grown * tilt_rate_, tilt_rate_);
        rate_rate_ = sum(rate_rate_, rate, rate_round_off);
    }

    /// The largest error of by_tilt * tilt + by_rate * rate.
    T bound(const T& by_tilt, const T& by_rate) const
    {
        using arithmetic::fma;
        using std::sqrt;
        const T a = by_tilt * by_tilt * tilt_tilt_;
        const T b = by_rate * by_rate * rate_rate_;
        const T mixed = by_tilt * by_rate * tilt_rate_;
        // Variations are good to a percent or so, which is left where the terms cancel.
        const T sum = fma(T(S(0x1p-12)), a + b, (a + b) + (mixed + mixed));
        return sqrt(select<T>(sum < zero_, zero_, sum)); // not a number stays one
    }

private:
    T zero_ = T(S(0));
    T tilt_tilt_ = zero_;
    T tilt_rate_ = zero_;
    T rate_rate_ = zero_;
};

} // namespace overturn
