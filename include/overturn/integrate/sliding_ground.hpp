// The ground as a block that may slip sees it, and the time that has passed.
#pragma once

#include "overturn/integrate/first_fall.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"
#include "overturn/mechanics/record_excitation.hpp"
#include "overturn/mechanics/sliding_series.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace overturn {

/// The sides of the block, the ground motion, and the present instant. Series are over a time in
/// units of unit().
template <Number S, class Excitation, int order>
class SlidingGround {
    using Coeffs = Coefficients<order + 1, S>;

public:
    /// See SlidingMotion.
    SlidingGround(const SlidingSide<S>& plus, const S& frequency_parameter,
                  const Excitation& excitation)
        : plus_(plus), minus_(plus.turned()), excitation_(with_thresholds(excitation)),
          unit_(1 / greater<S>(frequency_parameter, excitation.frequency)),
          per_unit_(excitation.frequency * unit_), end_(excitation.motion.end),
          phase_(excitation.motion.begin)
    {}

    const SlidingSide<S>& on(const S& side) const { return side > 0 ? plus_ : minus_; }
    const SlidingSide<S>& plus() const { return plus_; }
    const SlidingSide<S>& minus() const { return minus_; }
    bool is_level() const { return plus_.sine == 0; }

    const S& unit() const { return unit_; }
    const S& end() const { return end_; }
    const S& phase() const { return phase_; }
    const S& time_after() const { return after_; } ///< since the end of the motion
    bool is_free() const { return phase_ >= end_; }

    /// In the frame of the side plus, a time in units after the present instant.
    Field2<S> field_after(const S& time) const
    {
        if (is_free()) {
            return field_on(plus_, S(0), S(1));
        }
        const auto ground = excitation_.ground(lesser<S>(phase_ + time * per_unit_, end_));
        return field_on(plus_, S(horizontal_of(ground)), gravity_of(ground, S(1)));
    }

    /// From the present instant on, in lengths per square of the unit.
    Field2<Coeffs> field_series(const S& side) const
    {
        const GroundSeries ground = ground_series();
        const SlidingSide<S>& of = on(side);
        const S scale = of.gravity * unit_ * unit_;
        Field2<Coeffs> field;
        for (std::size_t k = 0; k <= std::size_t(order); ++k) {
            const S push = side * ground.push[k];
            field.along[k] = scale * (ground.gravity[k] * of.sine - push * of.cosine);
            field.normal[k] = -scale * (push * of.sine + ground.gravity[k] * of.cosine);
        }
        return field;
    }

    /// What is left of the smooth piece, in units of time; infinite after the motion.
    S left_of_piece() const
    {
        return is_free() ? std::numeric_limits<S>::infinity()
                         : S((excitation_.motion.end_of_piece(phase_) - phase_) / per_unit_);
    }

    /// The longest step, in units, of at most `left`, whose last terms in c are at most `allowed`.
    S longest(const S& left, const Coeffs& c, int last, const S& allowed) const
    {
        constexpr int terms = 4;
        S h = left;
        if constexpr (Excitation::is_recorded) { // an interval of a record is mostly short enough
            for (bool is_short = is_free(); !is_short;) {
                S power(1);
                for (int k = 0; k < last - terms; ++k) {
                    power = power * h;
                }
                is_short = true;
                for (int k = last - terms + 1; k <= last; ++k) {
                    power = power * h;
                    is_short = is_short && abs(c[std::size_t(k)]) * power <= allowed;
                }
                h = is_short ? h : S(h * S(0.5));
                is_short = is_short || h < left * S(0x1p-40);
            }
            if (!is_free()) {
                return h;
            }
        }
        for (int k = last; k > last - terms; --k) {
            const S size = abs(c[std::size_t(k)]);
            const auto is_too_long = [&] {
                S power = h;
                for (int i = 1; i < k; ++i) {
                    power = power * h;
                }
                return !(size * power <= allowed);
            };
            if (size > 0 && is_too_long()) {
                h = lesser<S>(h, S(std::pow(double(allowed / size), 1.0 / k)));
            }
        }
        if constexpr (!Excitation::is_recorded) {
            if (excitation_.motion.is_wavelet() && !is_free()) {
                const S ratio = following_ratio<order>(excitation_.motion.pulse, phase_, per_unit_);
                h = lesser<S>(h, S(0.75) / ratio);
            }
        }
        return h;
    }

    /// ends_piece: whether `h` is all that is left of the smooth piece.
    void pass_time(const S& h, bool ends_piece)
    {
        if (is_free()) {
            after_ = after_ + h * unit_;
        } else {
            phase_ = ends_piece ? excitation_.motion.end_of_piece(phase_)
                                : lesser<S>(phase_ + h * per_unit_, end_);
        }
    }

    /// Passes the time until the ground moves a block at rest, and returns the side to which it
    /// does; nullopt, at the end of the motion, if it does not.
    std::optional<S> wait()
    {
        if (is_free()) {
            return std::nullopt;
        }
        const Field2<S> field = field_after(S(0));
        for (const S& side : {S(1), S(-1)}) {
            if (side * field.along > on(side).threshold() * -field.normal) {
                moved_ = phase_;
                return side;
            }
        }
        const S next = excitation_.next_uplift(true, phase_, moved_);
        if (!(next < end_)) {
            phase_ = end_;
            return std::nullopt;
        }
        phase_ = moved_ = next;
        return horizontal_of(excitation_.ground(next)) < 0 ? S(1) : S(-1);
    }

private:
    /// The excitation whose uplifts are the phases at which a block at rest begins to move.
    Excitation with_thresholds(Excitation excitation) const
    {
        const S to_plus = plus_.acceleration_to_move();
        const S to_minus = minus_.acceleration_to_move();
        if constexpr (!Excitation::is_recorded) {
            const S size = abs(excitation.acceleration);
            LobeAmplitudes<S> lobes{size / to_minus, size / to_plus};
            if (excitation.acceleration < 0) {
                std::swap(lobes.positive, lobes.negative);
            }
            excitation.uplifts =
                uplift_phases(excitation.motion, flanks_of(excitation.motion), lobes);
        } else {
            excitation.to_plus = to_plus;
            excitation.to_minus = to_minus;
        }
        return excitation;
    }

    struct GroundSeries {
        Coeffs push; // of the ground acceleration over g
        Coeffs gravity;
    };
    GroundSeries ground_series() const
    {
        GroundSeries c;
        c.push.fill(S(0));
        c.gravity.fill(S(0));
        c.gravity[0] = S(1);
        if (is_free()) {
            return c;
        }
        const auto push =
            excitation_.template series<order + 1>(excitation_.acceleration, phase_, per_unit_);
        unrolled<order + 1>([&]<int k>() {
            c.push[k] = coefficient<k>(horizontal_of(push));
            if constexpr (has_gravity<std::remove_cvref_t<decltype(push)>>) {
                c.gravity[k] = coefficient<k>(push.gravity);
            }
        });
        return c;
    }

    SlidingSide<S> plus_;
    SlidingSide<S> minus_;
    Excitation excitation_;
    S unit_;     // of time
    S per_unit_; // phase
    S end_;
    S phase_;
    S after_ = S(0);
    S moved_ = S(-std::numeric_limits<S>::infinity()); // phase at which it last began to move
};

} // namespace overturn
