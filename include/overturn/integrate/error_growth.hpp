// The error of a run so far, bounded by an ellipse: the local errors of all steps, propagated to
// the current state by the linearised motion. Only the size of a local error is known, not its
// sign, so a matrix P is propagated: no combination c . e of the errors e in tilt and rate exceeds
// sqrt(c^T P c).
#pragma once

#include "overturn/mechanics/variation.hpp"

#include <limits>

namespace overturn {

/// Used instead of an infinite error, which would give NaN when multiplied by 0 [rad].
template <class S>
inline const S unknown_error = S(0x1p+200);

/// The local errors of a step, and the quantities that propagate errors over it.
template <Number T>
struct StepErrors {
    using E = estimate_t<T>;
    Variation<E> variation; ///< of the end with respect to the beginning
    E tilt;                 ///< bound of the local error of the tilt [rad]
    E rate;                 ///< bound of the local error of the rate [rad]
    E acceleration;         ///< at the end [rad]
    T turning_tilt;         ///< the tilt where the rate changes its sign, see turning_tilt() [rad]
};

/// Independent round-off errors of a step.
template <Number T>
struct RoundOff {
    T tilt; ///< [rad]
    T rate; ///< [rad]
    T time; ///< [1/p]
};

template <Number T>
class ErrorGrowth {
    using S = scalar_t<T>;
    using Mask = mask_t<T>;

public:
    /// Resets the errors: earlier errors do not affect a block at rest, and are meaningless once it
    /// is uncertain whether an event happened.
    void forget(const Mask& lanes) { set(lanes, 0, 0, 0); }

    /// Replaces P by V P V^T and adds the error of V and round-off: if errors shrink in one
    /// direction and grow in another, P is a small difference of large numbers and would be lost to
    /// cancellation.
    void pass(const Variation<T>& by, const Mask& lanes)
    {
        const T& tt = by.tilt_by_tilt;
        const T& tr = by.tilt_by_rate;
        const T& rt = by.rate_by_tilt;
        const T& rr = by.rate_by_rate;
        const T tilt_tilt = fma(tt, tilt_tilt_, tr * tilt_rate_);
        const T tilt_rate = fma(tt, tilt_rate_, tr * rate_rate_);
        const T rate_tilt = fma(rt, tilt_tilt_, rr * tilt_rate_);
        const T rate_rate = fma(rt, tilt_rate_, rr * rate_rate_);
        // At most four roundings of twice these sums, and the same for the off-diagonal entry.
        const T round_off(8 * std::numeric_limits<S>::epsilon());
        const T lost_tilt = round_off * fma(tt * tt, tilt_tilt_, tr * tr * rate_rate_);
        const T lost_rate = round_off * fma(rt * rt, tilt_tilt_, rr * rr * rate_rate_);
        const T time = by.time * by.time;
        const T unsure = by.unsure * by.unsure * fma(time, rate_rate_, tilt_tilt_);
        set(lanes, fma(tilt_tilt, tt, fma(tilt_rate, tr, fma(time, unsure, lost_tilt))),
            fma(tilt_tilt, rt, tilt_rate * rr),
            fma(rate_tilt, rt, fma(rate_rate, rr, lost_rate + unsure)));
    }

    /// Adds the error of a step, at most `tilt` and `rate` in size. The smallest axis-parallel
    /// ellipse that contains this rectangle has the matrix diag(tilt, rate) (tilt + rate), and the
    /// sum of two ellipses is contained in
    ///
    ///     (1 + 1 / w) P + (1 + w) Q     for any w > 0.
    ///
    /// If errors accumulate in one direction, the ratio of sizes (square roots of traces) is the
    /// best w. After thousands of bounces, P is long and thin, because bounces with more energy get
    /// further and further ahead. The length of P is then the wrong weight for a rectangle as small
    /// as its width, and the number of steps, as in Cauchy's inequality, is the better w.
    void add(const T& tilt, const T& rate, const Mask& lanes)
    {
        const T tiny(0x1p-500); // avoids 0 / 0
        const T own = tilt + rate;
        const T size = sqrt(tilt_tilt_ + rate_rate_);
        steps_ = select<T>(lanes, steps_ + 1, steps_);
        const T weight = greater<T>(lesser<T>(size, own * steps_), tiny); // w (tilt + rate)
        const T grown = (weight + own) / weight;
        set(lanes, fma(grown, tilt_tilt_, (weight + own) * tilt), grown * tilt_rate_,
            fma(grown, rate_rate_, (weight + own) * rate));
    }

    /// Adds round-off, whose squares add up because it is random. speed, acceleration: of the
    /// motion, along which the error of the time shifts tilt and rate.
    void add_round_off(const RoundOff<T>& error, const T& speed, const T& acceleration,
                       const Mask& lanes)
    {
        const T along = error.time * speed;
        const T faster = error.time * acceleration;
        set(lanes, tilt_tilt_ + fma(error.tilt, error.tilt, along * along),
            tilt_rate_ + along * faster, rate_rate_ + fma(error.rate, error.rate, faster * faster));
    }

    /// The error bound of by_tilt * tilt + by_rate * rate.
    T bound(const T& by_tilt, const T& by_rate) const
    {
        const T a = by_tilt * by_tilt * tilt_tilt_;
        const T b = by_rate * by_rate * rate_rate_;
        const T mixed = by_tilt * by_rate * tilt_rate_;
        // Variations are accurate to about a percent, which remains where the terms cancel.
        const T sum = fma(T(0x1p-12), a + b, (a + b) + (mixed + mixed));
        return sqrt(select<T>(sum < 0, 0, sum)); // NaN stays NaN
    }

private:
    void set(const Mask& lanes, const T& tilt_tilt, const T& tilt_rate, const T& rate_rate)
    {
        tilt_tilt_ = select<T>(lanes, tilt_tilt, tilt_tilt_);
        tilt_rate_ = select<T>(lanes, tilt_rate, tilt_rate_);
        rate_rate_ = select<T>(lanes, rate_rate, rate_rate_);
    }

    T tilt_tilt_ = T(0);
    T tilt_rate_ = T(0);
    T rate_rate_ = T(0);
    T steps_ = T(64); // so that the first steps are weighted by their size
};

} // namespace overturn
