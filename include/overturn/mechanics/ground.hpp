// What the ground does to a block at one time, or over a smooth piece of the ground motion: a
// horizontal acceleration over g, or that and a vertical one, which changes the gravity that the
// block feels. The horizontal one alone is a plain number, or a Ramp over a piece of a record.
#pragma once

#include "overturn/number/number.hpp"

namespace overturn {

/// A straight line: start + slope t.
template <Number T>
struct Ramp {
    T start;
    T slope;

    T at(const T& t) const { return fma(slope, t, start); }

    /// The slope over another time, of which `per_time` is the rate of t.
    T slope_over(const T& per_time) const { return slope * per_time; }
};

/// Part: a number or a Ramp. Multiplying it by a side mirrors the horizontal acceleration only.
template <class Part>
struct Ground {
    Part horizontal; ///< acceleration over g [1]
    Part gravity;    ///< 1 + the upwards acceleration over g [1]

    friend Ground operator*(const Part& side, const Ground& ground)
    {
        return {side * ground.horizontal, ground.gravity};
    }

    /// Of ramps, as those of a Ramp.
    template <Number T>
    Ground<T> at(const T& t) const
    {
        return {horizontal.at(t), gravity.at(t)};
    }
    template <Number T>
    Ground<T> slope_over(const T& per_time) const
    {
        return {horizontal.slope_over(per_time), gravity.slope_over(per_time)};
    }
};

template <Number T>
Ramp<estimate_t<T>> estimate_of(const Ramp<T>& ramp)
{
    return {estimate_of(ramp.start), estimate_of(ramp.slope)};
}
template <class Part>
auto estimate_of(const Ground<Part>& ground)
{
    using Estimate = std::remove_cvref_t<decltype(estimate_of(ground.gravity))>;
    return Ground<Estimate>{estimate_of(ground.horizontal), estimate_of(ground.gravity)};
}

/// Whether a push includes a gravity that varies.
template <class Push>
inline constexpr bool has_gravity = false;
template <class Part>
inline constexpr bool has_gravity<Ground<Part>> = true;

/// The horizontal part of a push.
template <class Push>
const Push& horizontal_of(const Push& push)
{
    return push;
}
template <class Part>
const Part& horizontal_of(const Ground<Part>& ground)
{
    return ground.horizontal;
}

/// The gravity over g, or its derivative; `constant` without a vertical motion: 1, or 0.
template <Number T>
T gravity_of(const T&, const T& constant)
{
    return constant;
}
template <Number T>
T gravity_of(const Ground<T>& ground, const T&)
{
    return ground.gravity;
}

} // namespace overturn
