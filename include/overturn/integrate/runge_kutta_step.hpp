// One Runge-Kutta step of x'' = acceleration(time, x): order 5, with an embedded solution of order
// 4, dense output and step size control.
#pragma once

#include "overturn/integrate/tableau.hpp"
#include "overturn/number/number.hpp"
#include "overturn/number/unrolled.hpp"

namespace overturn {

/// The motion at one point of a step, in any unit of time.
template <Number T>
struct StepMotion {
    T position;
    T rate;
    T acceleration;
};

/// A polynomial of degree 5 in s on [0, 1], given by its Bernstein coefficients; the smallest and
/// the largest coefficient bound the polynomial.
template <Number T>
using Quintic = std::array<T, 6>;

/// The position over a step of length h: the polynomial that matches position, rate and
/// acceleration at both ends. Its error, O(h^6), is below that of the step. The dense output of
/// Dormand and Prince has order 4, costs more, and does not match the acceleration at the start: a
/// block at uplift (position, rate and acceleration 0) would sink into the ground first.
template <Number T>
Quintic<T> dense_output(const StepMotion<T>& start, const StepMotion<T>& end, const T& h)
{
    using S = scalar_t<T>;
    const T fifth = h * T(S(1) / 5);
    const T bend = h * h * T(S(1) / 20);
    const T first = fma(fifth, start.rate, start.position);
    const T last = fma(-fifth, end.rate, end.position);
    return {start.position,
            first,
            fma(bend, start.acceleration, fma(fifth, start.rate, first)),
            fma(bend, end.acceleration, fma(-fifth, end.rate, last)),
            last,
            end.position};
}

/// The motion [per step] at a share of a step whose position is this polynomial, by de Casteljau's
/// scheme.
template <Number T>
StepMotion<T> motion_at(Quintic<T> c, const T& share)
{
    const auto reduce = [&](std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            c[i] = fma(share, c[i + 1] - c[i], c[i]);
        }
    };
    reduce(5);
    reduce(4);
    reduce(3);
    const T bend = (c[2] - c[1]) - (c[1] - c[0]);
    reduce(2);
    const T slope = c[1] - c[0];
    reduce(1);
    return {c[0], 5 * slope, 20 * bend};
}

template <Number T>
struct Step {
    StepMotion<T> end;
    T position_error; ///< local error estimates
    T rate_error;
};

/// The sum of row[j] x[j] over j < count; zeros are skipped.
template <auto row, int count, Number T>
T weighted_sum(const std::array<T, DormandPrince::stages>& x)
{
    using S = scalar_t<T>;
    T sum = T(row[0].template in<S>()) * x[0];
    unrolled<count - 1>([&]<int i>() {
        constexpr int j = i + 1;
        if constexpr (row[j].numerator != 0) {
            sum = fma(T(row[j].template in<S>()), x[j], sum);
        }
    });
    return sum;
}

/// A step of length h from `start`. acceleration(stage, position) returns x'' at the time of a
/// stage, 1 to 6: node[stage] h after the start.
template <Number T, class Acceleration>
Step<T> runge_kutta_step(const StepMotion<T>& start, const T& h, const Acceleration& acceleration)
{
    using Table = DormandPrince;
    std::array<T, Table::stages> rate{start.rate};
    std::array<T, Table::stages> pull{start.acceleration};
    T position = start.position;
    unrolled<Table::stages - 1>([&]<int before>() {
        constexpr int i = before + 1;
        position = fma(h, weighted_sum<Table::stage[i], i>(rate), start.position);
        rate[i] = fma(h, weighted_sum<Table::stage[i], i>(pull), start.rate);
        pull[i] = acceleration(i, position);
    });
    return {.end = {position, rate[6], pull[6]},
            .position_error = h * weighted_sum<Table::error, 7>(rate),
            .rate_error = h * weighted_sum<Table::error, 7>(pull)};
}

/// error^(3/16), computed by square roots, which IEEE 754 rounds identically at every lane width.
/// The exponent for a method of order 5 is 1/5; a slightly smaller one damps the control.
template <Number T>
T step_error_power(const T& error)
{
    const T eighth = sqrt(sqrt(sqrt(error)));
    return eighth * sqrt(eighth);
}

/// Factor for the step size after a step with this error, in units of the tolerance: 0.9
/// error^(-3/16) within [0.2, 4]; 0.2 if the error is NaN.
template <Number T>
T step_size_factor(const T& error)
{
    using S = scalar_t<T>;
    const T shortest(S(1) / 5);
    const S safety = S(9) / 10;
    // 4 is the upper bound of the factor, applied here to avoid a division by an error of 0.
    const T power = greater<T>(step_error_power(error), T(safety / 4));
    const T factor = T(safety) / power;
    const T grown = select<T>(factor > shortest, factor, shortest);
    return select<T>(error == error, grown, shortest);
}

} // namespace overturn
