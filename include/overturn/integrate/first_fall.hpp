// The first time at which a polynomial of any degree falls below zero. No root is missed: the
// polynomial is bounded by its Bernstein coefficients.
#pragma once

#include "overturn/integrate/power_series.hpp"

#include <algorithm>

namespace overturn {

/// 1 / (k + 1). Functions, because a constant of 50 digits would be computed when the program
/// starts.
template <Number S, std::size_t count>
const std::array<S, count>& shares()
{
    static const std::array<S, count> values = [] {
        std::array<S, count> all{};
        for (std::size_t k = 0; k < count; ++k) {
            all[k] = S(1) / S(int(k) + 1);
        }
        return all;
    }();
    return values;
}

/// 1 / (degree over k).
template <Number S, std::size_t count>
const std::array<S, count>& per_choices()
{
    static const std::array<S, count> values = [] {
        std::array<S, count> all{};
        S choices(1);
        for (std::size_t k = 0; k < count; ++k) {
            all[k] = 1 / choices;
            choices = choices * S(int(count - 1 - k)) / S(int(k) + 1);
        }
        return all;
    }();
    return values;
}

/// The integral of c[0] + c[1] t + c[2] t^2 + ... from 0 to t.
template <Number S, std::size_t count>
    requires(lanes_v<S> == 1)
S integral_of(const std::array<S, count>& c, const S& t)
{
    S sum(0);
    for (std::size_t k = count - 1; k-- > 0;) {
        sum = fma(sum, t, c[k] * shares<S, count>()[k]);
    }
    return sum * t;
}

/// The derivative of the same at t.
template <Number S, std::size_t count>
    requires(lanes_v<S> == 1)
S derivative_of(const std::array<S, count>& c, const S& t)
{
    S sum(0);
    for (std::size_t k = count - 1; k > 0; --k) {
        sum = fma(sum, t, S(int(k)) * c[k]);
    }
    return sum;
}

/// Its Bernstein coefficients on [0, h].
template <Number S, std::size_t count>
    requires(lanes_v<S> == 1)
std::array<S, count> bernstein_of(const std::array<S, count>& c, const S& h)
{
    std::array<S, count> b;
    S power(1);
    for (std::size_t k = 0; k < count; ++k) {
        b[k] = c[k] * power * per_choices<S, count>()[k];
        power = power * h;
    }
    unrolled<int(count) - 1>([&]<int level>() {
        unrolled<int(count) - 1 - level>([&]<int i>() {
            constexpr std::size_t k = count - 1 - i;
            b[k] = b[k] + b[k - 1];
        });
    });
    return b;
}

/// The root of c between two times, at which it is positive, but for noise, and negative. guess: in
/// between.
template <Number S, std::size_t count>
    requires(lanes_v<S> == 1)
S root_of_polynomial(const std::array<S, count>& c, S low, S high, const S& guess)
{
    S t = guess;
    S last_step(0); // of Newton's method, of which the error is then about step^3 / last_step^2
    for (int i = 0; i < 100 && high - low > std::numeric_limits<S>::epsilon() * high; ++i) {
        S value = c[count - 1];
        S slope(0);
        for (std::size_t k = count - 1; k-- > 0;) {
            slope = fma(slope, t, value);
            value = fma(value, t, c[k]);
        }
        (value < 0 ? high : low) = t;
        if (value == 0) {
            return t;
        }
        const S newton = slope < 0 ? S(t - value / slope) : high;
        const bool is_inside = newton > low && newton < high;
        const S next = is_inside ? newton : S((low + high) * S(0.5));
        const S step = is_inside ? S(abs(next - t)) : S(0);
        const S allowed = std::numeric_limits<S>::epsilon() * high;
        if (is_inside &&
            (step <= allowed || step * step * step <= allowed * last_step * last_step)) {
            return next;
        }
        last_step = step;
        t = next;
    }
    return high;
}

/// The first time in [0, h] at which the polynomial falls below -noise, corrected to its root;
/// negative if there is none. Dips below 2^-40 h wide are not found.
template <Number S, std::size_t count>
    requires(lanes_v<S> == 1)
S first_fall(const std::array<S, count>& c, const S& h, const S& noise)
{
    const S none(-1);
    // With u = t / h, a sum of terms up to u^m that are not negative is at least u^m times that of
    // their coefficients, and the other terms are at most u^m times that of their absolute values.
    S least = greater<S>(c[0], 0);
    S power(1);
    bool leads = c[0] >= -noise;
    for (std::size_t k = 1; k < count; ++k) {
        power = power * h;
        leads = leads && c[k] >= 0;
        least = least + (leads ? c[k] : -abs(c[k])) * power;
    }
    if (c[0] >= -noise && least >= (c[0] > 0 ? S(-noise) : S(0))) {
        return none;
    }
    using Coefficients = std::array<S, count>;
    const auto search = [&](const auto& again, Coefficients b, const S& left, const S& width) -> S {
        const auto is_low = [&](const S& value) { return value < -noise; };
        if (std::none_of(b.begin(), b.end(), is_low)) {
            return none;
        }
        std::size_t changes = 0;
        for (std::size_t k = 1; k < count; ++k) {
            changes += is_low(b[k]) != is_low(b[k - 1]);
        }
        const bool is_narrow = width < S(0x1p-40);
        if (is_low(b[0])) {
            return h * left;
        }
        if (is_low(b[count - 1]) && (changes == 1 || is_narrow)) {
            const S chord = b[0] > 0 ? S(b[0] / (b[0] - b[count - 1])) : S(0.5);
            return root_of_polynomial(c, S(h * left), S(h * (left + width)),
                                      S(h * (left + width * chord)));
        }
        if (is_narrow) {
            return none;
        }
        Coefficients lower; // de Casteljau: b becomes the upper half
        const S half = width * S(0.5);
        for (std::size_t level = 0; level < count; ++level) {
            lower[level] = b[0];
            for (std::size_t k = 0; k + 1 + level < count; ++k) {
                b[k] = (b[k] + b[k + 1]) * S(0.5);
            }
        }
        const S found = again(again, lower, left, half);
        return found >= 0 ? found : again(again, b, S(left + half), half);
    };
    return search(search, bernstein_of(c, h), S(0), S(1));
}

} // namespace overturn
