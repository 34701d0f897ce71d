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
    T acceleration;         ///< at its end [rad]
    T turning_tilt;         ///< the tilt where the rate changes its sign, if it does [rad]
};

template <Number T>
class ErrorGrowth {
    using S = scalar_t<T>;
    using Mask = mask_t<T>;

public:
    /// Of a block at rest nothing is left of former errors; of one in doubt they mean nothing.
    void forget(const Mask& lanes)
    {
        tilt_tilt_ = select<T>(lanes, zero_, tilt_tilt_);
        tilt_rate_ = select<T>(lanes, zero_, tilt_rate_);
        rate_rate_ = select<T>(lanes, zero_, rate_rate_);
    }

    /// P becomes V P V^T. What V is unsure of, and round-off, come on top: where errors shrink
    /// along one direction while they grow along another, P is a small difference of large numbers,
    /// and would lose what is left.
    void pass(const Variation<T>& by, const Mask& lanes)
    {
        using arithmetic::fma;
        const T& tt = by.tilt_by_tilt;
        const T& tr = by.tilt_by_rate;
        const T& rt = by.rate_by_tilt;
        const T& rr = by.rate_by_rate;
        const T tilt_tilt = fma(tt, tilt_tilt_, tr * tilt_rate_);
        const T tilt_rate = fma(tt, tilt_rate_, tr * rate_rate_);
        const T rate_tilt = fma(rt, tilt_tilt_, rr * tilt_rate_);
        const T rate_rate = fma(rt, tilt_rate_, rr * rate_rate_);
        // At most four roundings of twice these sums, and as much off the diagonal.
        const T round_off(8 * std::numeric_limits<S>::epsilon());
        const T lost_tilt = round_off * fma(tt * tt, tilt_tilt_, tr * tr * rate_rate_);
        const T lost_rate = round_off * fma(rt * rt, tilt_tilt_, rr * rr * rate_rate_);
        const T time = by.time * by.time;
        const T unsure = by.unsure * by.unsure * fma(time, rate_rate_, tilt_tilt_);
        tilt_tilt_ =
            select<T>(lanes, fma(tilt_tilt, tt, fma(tilt_rate, tr, fma(time, unsure, lost_tilt))),
                      tilt_tilt_);
        tilt_rate_ = select<T>(lanes, fma(tilt_tilt, rt, tilt_rate * rr), tilt_rate_);
        rate_rate_ = select<T>(lanes, fma(rate_tilt, rt, fma(rate_rate, rr, lost_rate + unsure)),
                               rate_rate_);
    }

    /// Adds the error of a step, at most `tilt` and `rate` in size. Of all ellipses of their kind
    /// the smallest that holds this rectangle has diag(tilt, rate) (tilt + rate), and one that
    /// holds the sum of two is
    ///
    ///     (1 + 1 / w) P + (1 + w) Q     for any w > 0.
    ///
    /// Where errors pile up along one direction, the ratio of sizes (square roots of traces) is the
    /// best w. After thousands of bounces P is long and thin, as those with more energy are ahead
    /// by more and more: a rectangle as small as its width is then not to be weighed by its length,
    /// and the number of steps, as in Cauchy's inequality, is the better w.
    void add(const T& tilt, const T& rate, const Mask& lanes)
    {
        using arithmetic::fma;
        using std::sqrt;
        const T tiny(S(0x1p-500)); // instead of 0 / 0
        const T own = tilt + rate;
        const T size = sqrt(tilt_tilt_ + rate_rate_);
        steps_ = select<T>(lanes, steps_ + T(S(1)), steps_);
        const T weight = greater<T>(lesser<T>(size, own * steps_), tiny); // w (tilt + rate)
        const T grown = (weight + own) / weight;
        tilt_tilt_ = select<T>(lanes, fma(grown, tilt_tilt_, (weight + own) * tilt), tilt_tilt_);
        tilt_rate_ = select<T>(lanes, grown * tilt_rate_, tilt_rate_);
        rate_rate_ = select<T>(lanes, fma(grown, rate_rate_, (weight + own) * rate), rate_rate_);
    }

    /// Adds round-off, which is random, so that its squares simply add up: of tilt and rate each
    /// for itself, and of the time, which shifts both along the motion. [rad, 1/p]
    void add_round_off(const T& tilt, const T& rate, const T& time, const T& speed,
                       const T& acceleration, const Mask& lanes)
    {
        using arithmetic::fma;
        const T along = time * speed;
        const T faster = time * acceleration;
        const auto sum = [&](const T& to, const T& own, const T& shift) -> T {
            return select<T>(lanes, to + fma(own, own, shift), to);
        };
        tilt_tilt_ = sum(tilt_tilt_, tilt, along * along);
        tilt_rate_ = sum(tilt_rate_, zero_, along * faster);
        rate_rate_ = sum(rate_rate_, rate, faster * faster);
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
    T steps_ = T(S(64)); // so that the first ones are weighed by their size
};

} // namespace overturn
