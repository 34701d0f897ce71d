// Steps of Dormand-Prince 5(4) along the motion of a rocking block (Eq. 47). An event within a step
// is found on its dense output; the step is then taken again, to end there.
#pragma once

#include "overturn/integrate/crossing.hpp"
#include "overturn/integrate/landing.hpp"
#include "overturn/integrate/rocking_step.hpp"
#include "overturn/integrate/step.hpp"
#include "overturn/integrate/step_size.hpp"
#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/excitation.hpp"

namespace overturn {

/// tolerance: largest local error per step of tilt and rate, over the size of the motion [1].
template <class Pulse, Theory theory, Number T>
class RungeKuttaStepper {
    using S = scalar_t<T>;
    using Mask = mask_t<T>;

public:
    RungeKuttaStepper(const Block<T>& block, const Excitation<Pulse, T>& excitation,
                      const S& tolerance)
        : block_(block), excitation_(excitation), tolerance_(tolerance), end_(excitation.end),
          zero_(S(0)), acceleration_(zero_), landing_step_(zero_), towards_fall_(zero_),
          landing_(zero_ != zero_)
    {
        const T frequency = excitation.frequency;
        const T fastest = select<T>(frequency > T(S(1)), frequency, T(S(1)));
        first_step_ = step_error_power(T(tolerance)) / fastest;
        step_size_ = first_step_;
    }

    /// Uplift: nothing is known of how long a step may be.
    void lift(const Rocking<T>& now, const Mask& lanes)
    {
        step_size_ = select<T>(lanes, first_step_, step_size_);
        turn(now, lanes);
    }

    /// The block goes on about its other corner.
    void turn(const Rocking<T>& now, const Mask& lanes)
    {
        const T push = now.side * excitation_.ground(now.phase);
        const T acceleration = rocking_acceleration<theory>(now.tilt, block_.slenderness, push);
        acceleration_ = select<T>(lanes, acceleration, acceleration_);
    }

    /// One trial step in every lane; what the lanes that are not active do means nothing.
    StepEnd<T> step(const Rocking<T>& now, const Mask& active)
    {
        const Motion<T> start{now.tilt, now.rate, acceleration_};
        const T left = (end_ - now.phase) / excitation_.frequency;
        const Mask last = !landing_ && step_size_ >= left;
        const T h = select<T>(landing_, landing_step_, select<T>(last, left, step_size_));
        const T phase_step = h * excitation_.frequency;
        const auto acceleration = [&](const S& node, const T& tilt) {
            using std::fma;
            const T push = now.side * excitation_.ground(fma(T(node), phase_step, now.phase));
            return rocking_acceleration<theory>(tilt, block_.slenderness, push);
        };
        const Step<T> step = runge_kutta_step(start, h, acceleration);
        const T error = relative_error(step, h);
        const Mask accepted = error <= T(S(1));

        const Mask looked_at = active && accepted && !landing_;
        const Mask event = looked_at && find_event(start, step, h, looked_at);
        const Mask moved = active && accepted && !event;
        acceleration_ = select<T>(moved, step.end.acceleration, acceleration_);
        // A landing step says nothing of how long a step may be.
        const T resized = h * step_size_factor(error);
        const Mask resize = active && !event && !(landing_ && accepted);
        step_size_ = select<T>(resize && !(last && accepted), resized, step_size_);

        const Mask landed = moved && landing_;
        landing_ = event;
        const Mask finite = h * (step.end.position - step.end.position) == zero_;
        StepEnd<T> end{.phase = select<T>(last, end_, now.phase + phase_step),
                       .tilt = step.end.position,
                       .rate = step.end.rate,
                       .moved = moved,
                       .strikes = landed && !landed,
                       .falls = landed && !landed,
                       .broken = active && !finite && h < first_step_ * T(S(0x1p-60))};
        if (any<T>(landed)) {
            const Mask flat = towards_fall_ > zero_;
            land_on_event(end, landed && !flat, landed && flat, acceleration_, excitation_);
        }
        return end;
    }

private:
    /// Local error in units of what is allowed: the tolerance times the size of the motion, at
    /// most alpha, and round-off on top: of the motion, and of an acceleration of order alpha over
    /// the step. Were it alpha throughout, a block lifted by a millionth
    /// of alpha would come down 1e-6 beside its true speed at a tolerance of 1e-10, and a series of
    /// bounces would carry that on.
    T relative_error(const Step<T>& step, const T& h) const
    {
        using std::abs;
        using std::fma;
        const T& alpha = block_.slenderness;
        const T tilt = abs(step.end.position);
        const T rate = abs(step.end.rate);
        const T size = lesser<T>(tilt + rate, alpha);
        const T round_off = T(16 * std::numeric_limits<S>::epsilon()) * fma(alpha, h, tilt + rate);
        const T allowed = fma(T(tolerance_), size, round_off);
        const T position_error = abs(step.position_error);
        const T rate_error = abs(step.rate_error);
        // Written so that an error that is not a number stays one.
        const T error = select<T>(position_error < rate_error, rate_error,
                                  position_error + (rate_error - rate_error));
        return error / allowed;
    }

    /// Finds the first impact or fall within an accepted step, and sets the lanes that have one to
    /// land on it with their next step.
    Mask find_event(const Motion<T>& start, const Step<T>& step, const T& h, const Mask& lanes)
    {
        const T noise = dip_of_round_off(block_.slenderness, h);
        const Quintic<T> tilt = dense_output(start, step.end, h);
        const Mask suspect =
            lanes && (lower_bound(tilt) < -noise || T(pi<S>() / 2) - upper_bound(tilt) < -noise);
        return any<T>(suspect) ? set_out_to_land(tilt, noise, h, suspect) : suspect;
    }

    [[gnu::noinline]] Mask set_out_to_land(const Quintic<T>& tilt, const T& noise, const T& h,
                                           const Mask& suspect)
    {
        const T impact = first_fall_below_zero(tilt, noise, suspect);
        const T fall = first_fall_below_zero(room_above(tilt), noise, suspect);
        const T first = select<T>(fall < impact, fall, impact);
        const Mask event = suspect && first <= T(S(1));
        landing_step_ = select<T>(event, h * first, landing_step_);
        towards_fall_ = select<T>(event, select<T>(fall < impact, T(S(1)), zero_), towards_fall_);
        return event;
    }

    const Block<T> block_;
    const Excitation<Pulse, T> excitation_;
    const S tolerance_;
    const T end_;
    const T zero_;
    T first_step_;

    T acceleration_; // at the beginning of the next step
    T step_size_;    // the next step, unless it lands or ends the pulse [1/p]
    T landing_step_; // the step that ends at an event found before [1/p]
    T towards_fall_; // 1 if that event is the fall, 0 if it is an impact
    Mask landing_;
};

/// The method as a choice: Dormand-Prince 5(4).
struct RungeKutta {
    template <class Pulse, Theory theory, Number T>
    using Stepper = RungeKuttaStepper<Pulse, theory, T>;
};

} // namespace overturn
