// The peer of the sliding benchmark: a box on a level base under a one-sine pulse, which rests,
// slides flat, rocks and slide-rocks. Boost.odeint integrates each mode by Dormand-Prince 5(4);
// events are roots on its dense output. A step is searched if an event lies before its end; looking
// at its middle as well changes no verdict and takes up to a third more time. In metres, seconds
// and radians; forces are over the mass. Only the law of the impact is that of overturn.
#pragma once

#include "overturn/mechanics/sliding.hpp"

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/dense_output_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace overturn::benchmarks {

struct SlidingBox {
    double b, h; ///< half width and half height [m]
    double friction;
    double gravity; ///< [m/s2]
    double pga;     ///< of the pulse, over gravity [1]
    double period;  ///< of the pulse [s]
};

enum class SlidingVerdict { undecided, stands, topples };

/// Follows the box until it lies on its side, or stands and does not slip any more.
class SlidingPeer {
    /// On the corner of one side: tilt, its rate, position of the base towards the side plus, and
    /// velocity of the corner outward. Of a flat box, the side is plus.
    using State = std::array<double, 4>;

    enum class Mode { flat, rock, slip, over };
    enum Event { impact, fall, stop, off, jam, outward = stop, inward = off };

public:
    SlidingPeer(const SlidingBox& box, double tolerance)
        : b_(box.b), h_(box.h), g_(box.gravity), mu_(box.friction), push_(box.pga * g_),
          turn_(2 * pi<double>() / box.period), end_(box.period), k2_((b_ * b_ + h_ * h_) / 3),
          side_of_box_{b_, b_, h_, k2_, g_, 1, 0, mu_}, tolerance_(tolerance),
          step_(std::pow(tolerance, 0.2) / turn_),
          dense_(boost::numeric::odeint::make_dense_output<Dopri5>(tolerance, tolerance))
    {
        rest();
        while (mode_ != Mode::over) {
            ++modes_ > 100000 ? finish(SlidingVerdict::undecided) : follow_mode();
        }
    }

    SlidingVerdict verdict() const { return verdict_; }
    double slide() const { return now_[2]; } ///< of the base, in the end [m]

private:
    using Dopri5 = boost::numeric::odeint::runge_kutta_dopri5<State>;
    using Dense = boost::numeric::odeint::result_of::make_dense_output<Dopri5>::type;

    /// A box on a corner, and what the base does to it.
    struct Contact {
        double x, y;     ///< from the corner to the centre of mass, along the base and normal to it
        double turning;  ///< omega'
        double slipping; ///< w'
        double along;    ///< F
        double normal;   ///< N
        double yield;    ///< D
    };

    double ground(double time) const { return is_free_ ? 0 : push_ * std::sin(turn_ * time); }

    Contact contact(const State& now, double time, Mode mode) const
    {
        const double s = std::sin(now[0]), c = std::cos(now[0]);
        const double x = h_ * s - b_ * c, y = b_ * s + h_ * c;
        const double g1 = -side_ * ground(time), g2 = -g_, square = now[1] * now[1];
        if (mode == Mode::rock) {
            const double turning = (y * g1 - x * g2) / (4 * k2_); // k^2 + R^2 = 4 k^2
            return {x, y, turning, 0, turning * y - square * x - g1, -turning * x - square * y - g2,
                    1};
        }
        const double lever = x + mu_ * direction_ * y;
        const double yield = 1 + x * lever / k2_;
        const double normal = (-g2 - square * y) / yield;
        const double turning = normal * lever / k2_, along = -mu_ * direction_ * normal;
        return {x, y, turning, g1 + along - turning * y + square * x, along, normal, yield};
    }

    void derivatives(const State& now, State& rates, double time) const
    {
        if (mode_ == Mode::flat) {
            rates = {0, 0, now[3], -ground(time) - mu_ * direction_ * g_};
            return;
        }
        const Contact at = contact(now, time, mode_);
        rates = {now[1], at.turning, side_ * now[3], at.slipping};
    }

    /// By how much each event is missed; negative after it.
    std::array<double, 5> clearances(const State& now, double time) const
    {
        constexpr double far = std::numeric_limits<double>::infinity();
        if (mode_ == Mode::flat) {
            return {far, far, direction_ * now[3], far, far};
        }
        const Contact at = contact(now, time, mode_);
        const double to_fall = pi<double>() / 2 - now[0];
        if (mode_ == Mode::rock) { // the force is inward if the slip is outward
            const double most = mu_ * at.normal;
            return {now[0], to_fall, most + at.along, most - at.along, far};
        }
        return {now[0], to_fall, direction_ * now[3], at.normal, at.yield};
    }

    double clearance(const State& now, double time) const
    {
        return std::ranges::min(clearances(now, time));
    }

    State state_at(double time) // within the last step
    {
        State state;
        dense_.calc_state(time, state);
        return state;
    }

    double clearance_at(double time) { return clearance(state_at(time), time); }

    /// Goes to the first event between `low`, where there is none, and `high`: by regula falsi, in
    /// which an end that stays counts half (Illinois).
    Event find_event(double low, double high)
    {
        double before = clearance_at(low), after = clearance_at(high);
        int stays = 0; // -1: low, 1: high
        while (high - low > 1e-15 * std::max(high, end_)) {
            const double chord = low + (high - low) * before / (before - after);
            const double time = chord > low && chord < high ? chord : (low + high) / 2;
            const double here = clearance_at(time);
            const int stayed = std::exchange(stays, here < 0 ? -1 : 1);
            if (here < 0) {
                before *= stayed == stays ? 0.5 : 1;
                high = time;
                after = here;
            } else {
                after *= stayed == stays ? 0.5 : 1;
                low = time;
                before = here;
            }
        }
        time_ = high;
        now_ = state_at(high);
        const auto all = clearances(now_, high);
        return Event(std::ranges::min_element(all) - all.begin());
    }

    /// Takes steps until an event, or the end of the pulse.
    void follow_mode()
    {
        if (mode_ == Mode::flat && is_free_) {
            now_[2] += now_[3] * std::abs(now_[3]) / (2 * mu_ * g_);
            return finish(SlidingVerdict::stands);
        }
        const auto system = [this](const State& now, State& rates, double time) {
            derivatives(now, rates, time);
        };
        dense_.initialize(now_, time_, step_);
        while (mode_ != Mode::over) {
            const double wanted = dense_.current_time_step();
            const double left = is_free_ ? wanted : end_ - dense_.current_time();
            const double last = dense_.current_time() + left; // rounded
            if (wanted > left) {
                dense_.initialize(dense_.current_state(), dense_.current_time(), left);
            }
            dense_.do_step(std::cref(system));
            const double before = dense_.previous_time(), after = dense_.current_time();
            if (!(after > before)) {
                return finish(SlidingVerdict::undecided);
            }
            const bool ends = !is_free_ && after >= last;
            step_ =
                ends ? std::max(wanted, dense_.current_time_step()) : dense_.current_time_step();
            if (clearance(dense_.current_state(), after) < 0) {
                return handle(find_event(before, after));
            }
            now_ = dense_.current_state();
            time_ = after;
            if (ends) {
                time_ = end_;
                is_free_ = true;
                return;
            }
            decide_if_free();
        }
    }

    void handle(Event event)
    {
        if (event == impact) {
            strike();
        } else if (event == fall) {
            finish(SlidingVerdict::topples);
        } else if (mode_ == Mode::flat) {
            rest();
        } else if (mode_ == Mode::rock) {
            slip(event == outward ? 1 : -1);
        } else if (event == stop) {
            stick_or_slip();
        } else {
            finish(SlidingVerdict::undecided); // it leaves the ground or jams
        }
    }

    void rest()
    {
        now_ = {0, 0, now_[2], 0};
        const double least = g_ * std::min(mu_, b_ / h_);
        const double phase = std::asin(least / push_); // NaN if the ground never moves the box
        if (std::abs(ground(time_)) > least) {
            return move();
        }
        for (const double moves : {phase / turn_, (pi<double>() + phase) / turn_}) {
            if (moves > time_) {
                time_ = moves;
                return move();
            }
        }
        finish(SlidingVerdict::stands);
    }

    /// The ground begins to move the box.
    void move()
    {
        const double towards = ground(time_) < 0 ? 1 : -1;
        if (mu_ > b_ / h_) {
            side_ = towards;
            return stick_or_slip();
        }
        slide_flat(towards);
    }

    void slide_flat(double towards)
    {
        side_ = 1;
        mode_ = Mode::flat;
        direction_ = towards;
    }

    /// Both corners are on the base.
    void put_down(double velocity)
    {
        now_ = {0, 0, now_[2], velocity};
        const double leading = velocity > 0 ? 1 : -1;
        if (velocity == 0) {
            rest();
        } else if (mu_ > b_ / h_) { // tips over
            side_ = leading;
            now_[3] = std::abs(velocity);
            slip(1);
        } else {
            slide_flat(leading);
        }
    }

    void slip(double direction)
    {
        mode_ = Mode::slip;
        direction_ = direction;
    }

    void stick_or_slip()
    {
        now_[3] = 0;
        const Contact at = contact(now_, time_, Mode::rock);
        if (std::abs(at.along) > mu_ * at.normal) {
            return slip(at.along > 0 ? -1 : 1);
        }
        mode_ = Mode::rock;
        decide_if_free();
    }

    void strike()
    {
        const auto after = impact_with_friction<double>(side_of_box_, -now_[1], -now_[3], 1);
        side_ = -side_;
        now_ = {0, after.rate, now_[2], after.slip};
        if (after.stays_down || after.rate < tolerance_ * turn_) {
            put_down(side_ * after.slip);
        } else if (after.slip == 0) {
            stick_or_slip();
        } else {
            slip(after.slip > 0 ? 1 : -1);
        }
    }

    /// After the pulse, a box below its barriers stands. If its corner sticks, it does not slip any
    /// more: with R g / (4 k^2) > omega^2, the force along the base is at most b R g / (4 k^2), and
    /// the normal one at least g (1 - b^2 / (4 k^2)) - R omega^2. For a box of 0.6 m x 1.8 m, that
    /// is a ratio of 0.28, and blocks lift only if friction > b/h = 1/3.
    void decide_if_free()
    {
        const Contact at = contact(now_, time_, Mode::rock);
        const double energy = 2 * k2_ * now_[1] * now_[1] + g_ * at.y;
        if (is_free_ && mode_ == Mode::rock && at.x < 0 && energy < g_ * std::hypot(b_, h_)) {
            finish(SlidingVerdict::stands);
        }
    }

    void finish(SlidingVerdict verdict)
    {
        verdict_ = verdict;
        mode_ = Mode::over;
    }

    double b_, h_, g_, mu_, push_, turn_, end_, k2_;
    SlidingSide<double> side_of_box_;
    double tolerance_;
    double step_; // the next one; kept from mode to mode
    Dense dense_;
    Mode mode_ = Mode::flat;
    SlidingVerdict verdict_ = SlidingVerdict::undecided;
    bool is_free_ = false; // after the pulse
    double side_ = 1;
    double direction_ = 1; // of the slip
    double time_ = 0;
    int modes_ = 0;
    State now_{};
};

} // namespace overturn::benchmarks
