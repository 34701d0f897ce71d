// Free rocking by numerical integration in 50 digits, arc by arc: the reference for its closed
// form. Plain loops over Taylor coefficients, independent of the program.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/number/digits50.hpp"

#include <array>

namespace overturn {

template <Theory theory>
class FreeMotion {
    static constexpr int order = 40;
    using Series = std::array<Digits50, order + 2>;

public:
    FreeMotion(const State<Digits50>& begin, const Digits50& slenderness)
        : state_(begin), slenderness_(slenderness)
    {}

    const State<Digits50>& state() const { return state_; }
    const Digits50& time() const { return time_; }

    /// Integrates to this time; there must be no impact before.
    void go_on_until(const Digits50& time)
    {
        while (time_ < time) {
            const Digits50 left = time - time_;
            step(left < longest ? left : longest);
        }
    }

    /// Integrates to the next time at which the tilt passes this one: 0, an impact, or pi/2.
    void go_on_to_tilt(const Digits50& tilt)
    {
        const bool above = state_.tilt > tilt || (state_.tilt == tilt && state_.rate > 0);
        for (;;) {
            const State<Digits50> before = state_;
            const Digits50 began = time_;
            step(longest);
            if ((state_.tilt > tilt) != above) {
                state_ = before;
                time_ = began;
                break;
            }
        }
        for (int i = 0; i < 200; ++i) { // Newton's method
            const Digits50 left = (tilt - state_.tilt) / state_.rate;
            step(left);
            if (abs(left) < 1e-45) {
                break;
            }
        }
    }

    void strike(const Digits50& restitution)
    {
        state_ = {.tilt = 0, .rate = -sqrt(restitution) * state_.rate, .side = -state_.side};
    }

private:
    /// y'' = sin y with y = alpha - tilt, or y'' = y.
    void step(const Digits50& h)
    {
        Series y{slenderness_ - state_.tilt, -state_.rate};
        if constexpr (theory == Theory::linear) {
            for (int k = 0; k < order; ++k) {
                y[k + 2] = y[k] / ((k + 1) * (k + 2));
            }
        } else {
            Series sine{sin(y[0])};
            Series cosine{cos(y[0])};
            for (int k = 0; k < order; ++k) {
                y[k + 2] = sine[k] / ((k + 1) * (k + 2));
                Digits50 next_sine = 0;
                Digits50 next_cosine = 0;
                for (int j = 0; j <= k; ++j) {
                    next_sine += (j + 1) * y[j + 1] * cosine[k - j];
                    next_cosine -= (j + 1) * y[j + 1] * sine[k - j];
                }
                sine[k + 1] = next_sine / (k + 1);
                cosine[k + 1] = next_cosine / (k + 1);
            }
        }
        Digits50 value = 0;
        Digits50 slope = 0;
        for (int k = order + 1; k >= 0; --k) {
            slope = slope * h + value;
            value = value * h + y[k];
        }
        state_.tilt = slenderness_ - value;
        state_.rate = -slope;
        time_ += h;
    }

    /// The terms decrease like powers of its ratio to the distance of the nearest pole in complex
    /// time, more than 1/2 for |y'| up to 3: the truncation error is below 4^-41 = 2e-25.
    const Digits50 longest = Digits50(1) / 8;

    State<Digits50> state_;
    Digits50 slenderness_;
    Digits50 time_ = 0;
};

} // namespace overturn
