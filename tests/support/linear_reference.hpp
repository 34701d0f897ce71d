// The forced stage of a block under a recorded horizontal acceleration in the linear theory,
// exactly: the reference for integration. Independent of the program but for its parameters.
#pragma once

#include "support/random_record.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overturn {

struct LinearEnd {
    long double tilt = 0; // [rad]
    long double rate = 0; // [rad p]
    long double side = 1;
    long double peak = 0; // the largest tilt [rad]
    bool fell = false;    // the tilt reached pi/2
    bool rested = false;
    int impacts = 0;
};

/// The motion on one side from time 0 on, while the ground acceleration is a + slope t:
///
///     tilt'' = tilt - alpha - side (a + slope t)
///     tilt = tilt_0 + rate_0 sinh t + x (cosh t - 1) - side slope (sinh t - t),
///
/// where x is the acceleration at 0. Each term is free of cancellation.
struct LinearFlight {
    long double tilt;
    long double rate;
    long double x;
    long double slope; // times the side

    static long double sinh_minus(long double t) // sinh t - t
    {
        if (t > 1) {
            return std::sinh(t) - t;
        }
        long double term = t * t * t / 6;
        long double sum = 0;
        for (int k = 4; term > 1e-22L * sum && k < 40; k += 2) {
            sum += term;
            term *= t * t / (k * (k + 1));
        }
        return sum;
    }
    static long double cosh_minus(long double t) // cosh t - 1
    {
        const long double half = std::sinh(t / 2);
        return 2 * half * half;
    }

    long double tilt_at(long double t) const
    {
        return tilt + rate * std::sinh(t) + x * cosh_minus(t) - slope * sinh_minus(t);
    }
    long double rate_at(long double t) const
    {
        return rate * std::cosh(t) + x * std::sinh(t) - slope * cosh_minus(t);
    }

    template <class F>
    static long double root(const F& f, long double low, long double high)
    {
        const long double at_low = f(low);
        const long double at_high = f(high);
        if (at_low == 0 || at_high == 0) {
            return at_low == 0 ? low : high;
        }
        std::uintmax_t iterations = 200;
        const auto bracket = boost::math::tools::toms748_solve(
            f, low, high, at_low, at_high, boost::math::tools::eps_tolerance<long double>(),
            iterations);
        return (bracket.first + bracket.second) / 2;
    }

    /// 0, h, and the times between them at which the rate is 0. tilt'' is a combination of cosh
    /// and sinh and changes its sign once at most, so the rate is monotone on both sides of that.
    std::vector<long double> turns(long double h) const
    {
        std::vector<long double> turns{0};
        std::vector<long double> ends{0};
        // x cosh t + (rate - slope) sinh t = 0
        if (x * (rate - slope) < 0 && std::abs(x) < std::abs(rate - slope) * std::tanh(h)) {
            ends.push_back(std::atanh(-x / (rate - slope)));
        }
        ends.push_back(h);
        for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
            if (rate_at(ends[i]) * rate_at(ends[i + 1]) < 0) {
                turns.push_back(
                    root([&](long double t) { return rate_at(t); }, ends[i], ends[i + 1]));
            }
        }
        turns.push_back(h);
        return turns;
    }
};

class LinearReference {
public:
    explicit LinearReference(const RecordPoint& point)
        : point_(point), alpha_(point.block.slenderness),
          loss_(1 - std::sqrt((long double)point.block.restitution))
    {}

    LinearEnd run()
    {
        const std::vector<double>& samples = point_.record.horizontal();
        const long double duration = 1 / (long double)point_.frequency;
        for (std::size_t i = 0; i + 1 < samples.size() && !end_.fell; ++i) {
            ground_ = {(long double)point_.scale * samples[i],
                       (long double)point_.scale * (samples[i + 1] - (long double)samples[i]) /
                           duration};
            long double t = 0;
            while (t < duration && !end_.fell) {
                t = resting_ ? rest(t, duration) : fly(t, duration);
            }
        }
        return end_;
    }

private:
    struct Line {
        long double start, slope;
        long double at(long double t) const { return start + slope * t; }
    };

    /// From t to the uplift, or to the end of the interval.
    long double rest(long double t, long double duration)
    {
        acceleration_ = std::abs(ground_.at(t)) - alpha_;
        if (acceleration_ <= 0) {
            const long double side = ground_.slope > 0 ? 1 : -1;
            t = std::max(t, (side * alpha_ - ground_.start) / ground_.slope);
            acceleration_ = 0;
        }
        if (!(t < duration)) {
            return duration;
        }
        resting_ = false;
        end_.side = ground_.at(t) > 0 ? -1 : 1;
        return t;
    }

    /// From t to the next impact, to the fall, or to the end of the interval.
    long double fly(long double t, long double duration)
    {
        constexpr long double flat = std::numbers::pi_v<long double> / 2;
        constexpr long double round_off = 1e-25L; // of a tilt of 0
        const LinearFlight flight{end_.tilt, end_.rate, acceleration_, end_.side * ground_.slope};
        const auto tilt_at = [&](long double s) { return flight.tilt_at(s); };
        const std::vector<long double> turns = flight.turns(duration - t);
        for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
            const long double tilt = tilt_at(turns[i + 1]);
            if (tilt >= flat) {
                const long double s = LinearFlight::root(
                    [&](long double at) { return tilt_at(at) - flat; }, turns[i], turns[i + 1]);
                end_.tilt = end_.peak = flat;
                end_.rate = flight.rate_at(s);
                end_.fell = true;
                return t + s;
            }
            end_.peak = std::max(end_.peak, tilt);
            if (tilt < -round_off) {
                const long double s = LinearFlight::root(tilt_at, turns[i], turns[i + 1]);
                strike(t + s, -flight.rate_at(s), duration);
                return t + s;
            }
        }
        end_.tilt = std::max(tilt_at(turns.back()), 0.0L);
        end_.rate = flight.rate_at(turns.back());
        acceleration_ = flight.x + end_.tilt - flight.tilt - flight.slope * (duration - t);
        return duration;
    }

    void strike(long double t, long double speed, long double duration)
    {
        ++end_.impacts;
        end_.tilt = 0;
        end_.rate = (1 - loss_) * speed;
        end_.side = -end_.side;
        acceleration_ = -alpha_ - end_.side * ground_.at(t);
        // Bounces at a constant pull last 2 rate / (loss pull); twice that while it hardly changes.
        const long double weaker = alpha_ - std::abs(ground_.at(t));
        const auto lasts = [&] { return 4 * end_.rate / (loss_ * weaker); };
        if (end_.rate < 1e-7L * alpha_ && weaker > 0 && t + lasts() < duration &&
            alpha_ - std::abs(ground_.at(t + lasts())) > weaker / 2) {
            end_.rate = 0;
            resting_ = end_.rested = true;
        }
    }

    RecordPoint point_;
    long double alpha_;
    long double loss_; // 1 - sqrt r
    LinearEnd end_;
    bool resting_ = true;
    Line ground_{};
    long double acceleration_ = 0; // tilt'' at the current time
};

} // namespace overturn
