// What the ground does to a block at one time, or over a smooth piece of the ground motion: a
// horizontal acceleration over g, written as a plain number, or that and a vertical one, which
// changes the gravity that the block feels.
#pragma once

#include "overturn/number/number.hpp"

namespace overturn {

/// Multiplying it by a side mirrors the horizontal acceleration only.
template <Number T>
struct Ground {
    T horizontal; ///< acceleration over g [1]
    T gravity;    ///< 1 + the upwards acceleration over g [1]

    friend Ground operator*(const T& side, const Ground& ground)
    {
        return {side * ground.horizontal, ground.gravity};
    }
};

template <Number T>
Ground<estimate_t<T>> estimate_of(const Ground<T>& ground)
{
    return {estimate_of(ground.horizontal), estimate_of(ground.gravity)};
}

template <Number T>
T mirrored(const T& ground)
{
    return -ground;
}
template <Number T>
Ground<T> mirrored(const Ground<T>& ground)
{
    return {-ground.horizontal, ground.gravity};
}

/// An upper bound of |d pull / d tilt| of a block, see rocking_stiffness().
template <Number T>
T largest_stiffness(const T& ground)
{
    using std::abs;
    return T(scalar_t<T>(1)) + abs(ground);
}
template <Number T>
T largest_stiffness(const Ground<T>& ground)
{
    using std::abs;
    return ground.gravity + abs(ground.horizontal);
}

/// A straight line: start + slope t.
template <Number T>
struct Ramp {
    T start;
    T slope;

    T at(const T& t) const
    {
        using arithmetic::fma;
        return fma(slope, t, start);
    }
};

template <Number T>
Ramp<estimate_t<T>> estimate_of(const Ramp<T>& ramp)
{
    return {estimate_of(ramp.start), estimate_of(ramp.slope)};
}

/// The push of a piece on which the accelerations are linear: see rocking_series().
template <Number T>
struct LinearPush {
    Ramp<T> horizontal;

    T at(const T& t) const { return horizontal.at(t); }
    T slope(const T& per_time) const { return horizontal.slope * per_time; }
};

template <Number T>
struct LinearPushAndGravity {
    Ramp<T> horizontal;
    Ramp<T> gravity;

    Ground<T> at(const T& t) const { return {horizontal.at(t), gravity.at(t)}; }
    Ground<T> slope(const T& per_time) const
    {
        return {horizontal.slope * per_time, gravity.slope * per_time};
    }
};

template <Number T>
LinearPush<estimate_t<T>> estimate_of(const LinearPush<T>& push)
{
    return {estimate_of(push.horizontal)};
}
template <Number T>
LinearPushAndGravity<estimate_t<T>> estimate_of(const LinearPushAndGravity<T>& push)
{
    return {estimate_of(push.horizontal), estimate_of(push.gravity)};
}

/// The horizontal part of a push.
template <class Push>
const Push& horizontal_of(const Push& push)
{
    return push;
}
template <Number T>
const Ramp<T>& horizontal_of(const LinearPush<T>& push)
{
    return push.horizontal;
}
template <Number T>
const Ramp<T>& horizontal_of(const LinearPushAndGravity<T>& push)
{
    return push.horizontal;
}
template <Number T>
const T& horizontal_of(const Ground<T>& ground)
{
    return ground.horizontal;
}

/// The gravity over g.
template <Number T>
T gravity_of(const T&)
{
    return T(scalar_t<T>(1));
}
template <Number T>
T gravity_of(const Ground<T>& ground)
{
    return ground.gravity;
}

/// That of a derivative of the ground.
template <Number T>
T gravity_slope_of(const T&)
{
    return T(scalar_t<T>(0));
}
template <Number T>
T gravity_slope_of(const Ground<T>& slope)
{
    return slope.gravity;
}

/// Whether a push includes a gravity that varies.
template <class Push>
inline constexpr bool has_gravity = false;
template <class T>
inline constexpr bool has_gravity<LinearPushAndGravity<T>> = true;

} // namespace overturn
