// The motion of one block that may slip on its base, with the modes rest, slide (flat), rock (the
// corner sticks) and slide-rock (it slips), during the ground motion and after it. Each mode is a
// Taylor series; a change of the mode is a root of a series.
#pragma once

#include "overturn/integrate/first_fall.hpp"
#include "overturn/integrate/stepper_types.hpp"
#include "overturn/mechanics/energy_criteria.hpp"
#include "overturn/mechanics/free_contact.hpp"
#include "overturn/mechanics/free_rocking.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"
#include "overturn/mechanics/record_excitation.hpp"
#include "overturn/mechanics/sliding_series.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace overturn {

enum class SlidingMode { rest, slide, rock, slide_rock };

/// How the motion of a block that may slip ended.
template <class S>
struct SlidingEnd {
    State<S> state;                    ///< at the end of the ground motion, or at a fall before it
    Region region = Region::undecided; ///< undecided if it jams, leaves the ground or is stopped
    bool fell = false;                 ///< during the ground motion
    bool slipped = false;
    bool slips_after = false; ///< it slips after the end of the ground motion: there is no margin
    bool jammed = false;
    bool lifted_off = false;
    bool capped = false;
    int impacts = 0; ///< during the ground motion
    int steps = 0;
    S uplift = S(std::numeric_limits<double>::infinity()); ///< phase of the first uplift
    S phase = S(0);        ///< of the end of the ground motion, or of a fall before it
    S time_of_fall = S(0); ///< from that phase on, in units of time; infinite if it stands
    S peak = S(0);         ///< the largest tilt; on the side minus, times alpha+ / alpha- [rad]
    S slide = S(0);        ///< of the base, positive towards the side plus
    S slide_peak = S(0);   ///< its largest absolute value
};

/// A larger tolerance would gain little time: the series have the order 20.
inline constexpr double loosest_sliding_tolerance = 1e-10;

/// A verdict is confirmed by runs with these, the last one in long double.
inline constexpr std::array tolerances_to_confirm{1e-12, 1e-14, 1e-17};

/// How far a motion is followed after the ground has stopped.
enum class Follow {
    until_decided, ///< the verdict is known
    until_rest     ///< the block does not slip any more, or has fallen
};

/// The largest number of steps of a motion, in addition to one per interval of a record.
inline constexpr int most_sliding_steps = 1 << 18;

/// Excitation: PulseExcitation, or RecordExcitation. S: a scalar.
template <Number S, class Excitation,
          int order = std::same_as<Excitation, PulseExcitation<S>> ? 20
                      : std::same_as<S, double>                    ? 10
                                                                   : 16>
    requires(lanes_v<S> == 1)
class SlidingMotion {
    using Series = SlidingSeries<order, S>;
    using Coeffs = Coefficients<order + 1, S>;
    static constexpr Theory theory = Theory::nonlinear; // the only one with these forces

public:
    /// block: as seen from its side plus; gyration: see contact_side(). The excitation has the
    /// frequency of the side plus. tolerance: bound of the last terms of rates at the end of a
    /// step, over alpha [1].
    SlidingMotion(const Block<S>& block, const S& gyration, const S& friction,
                  const Excitation& excitation, const S& tolerance,
                  Follow follow = Follow::until_rest)
        : block_(block), plus_(sliding_side(block, gyration, friction)), minus_(plus_.turned()),
          contact_(block, gyration), excitation_(with_thresholds(excitation)),
          end_(excitation.motion.end), phase_(excitation.motion.begin), follow_(follow),
          loss_(lesser<S>(share_of_rate_kept(plus_, block.restitution), S(1))),
          unit_(1 / greater<S>(block.frequency_parameter, frequency_of(excitation))),
          rate_(frequency_of(excitation) * unit_),
          least_(lesser<S>(block.slenderness, block.other.slenderness)),
          allowed_(tolerance * least_),
          step_limit_(most_sliding_steps + int(double(excitation.motion.pieces())))
    {
        rest();
    }

    /// Whether the verdict is known, or will not be, or the block is at rest; see Follow.
    bool is_over() const { return is_over_; }

    /// Takes one step and handles the event at its end.
    void advance()
    {
        if (++result_.steps > step_limit_) {
            result_.capped = true;
            give_up();
        } else if (mode_ == SlidingMode::slide) {
            slide();
        } else {
            rock();
        }
    }

    /// How the motion ended, once it is over.
    const SlidingEnd<S>& end() const { return result_; }

    SlidingMode mode() const { return mode_; }
    const S& phase() const { return phase_; }
    const S& time_after() const { return after_; } ///< since the end of the ground motion
    S side() const { return side_; }
    const S& tilt() const { return tilt_; }
    S rate() const { return turning_ / unit_; } ///< d tilt / d time
    const S& base_velocity() const { return velocity_; }
    const S& base_position() const { return result_.slide; }

private:
    static S frequency_of(const Excitation& excitation) { return excitation.frequency; }

    const SlidingSide<S>& on(const S& side) const { return side > 0 ? plus_ : minus_; }
    const SlidingSide<S>& here() const { return on(side_); }
    const S& p_of_side() const
    {
        return side_ > 0 ? block_.frequency_parameter : block_.other.frequency_parameter;
    }
    bool is_free() const { return phase_ >= end_; }
    bool is_level() const { return plus_.sine == 0; }

    /// The excitation whose uplifts are the phases at which a block at rest begins to move.
    Excitation with_thresholds(Excitation excitation) const
    {
        const S to_plus = plus_.acceleration_to_move();
        const S to_minus = minus_.acceleration_to_move();
        if constexpr (is_pulse) {
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
            excitation_.template series<order + 1>(excitation_.acceleration, phase_, rate_);
        unrolled<order + 1>([&]<int k>() {
            c.push[k] = coefficient<k>(horizontal_of(push));
            if constexpr (has_gravity<std::remove_cvref_t<decltype(push)>>) {
                c.gravity[k] = coefficient<k>(push.gravity);
            }
        });
        return c;
    }

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
                         : S((excitation_.motion.end_of_piece(phase_) - phase_) / rate_);
    }

    /// The longest step, in units, of at most `left`, whose last terms in c are at most `allowed`.
    S longest(const S& left, const Coeffs& c, int last, const S& allowed) const
    {
        constexpr int terms = 4;
        S h = left;
        if constexpr (!is_pulse) { // an interval of a record is mostly short enough
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
            if (size > 0) {
                const S most = S(std::pow(double(allowed / size), 1.0 / k));
                h = most < h ? most : h;
            }
        }
        if constexpr (is_pulse) {
            if (excitation_.motion.is_wavelet() && !is_free()) {
                const S ratio = following_ratio<order>(excitation_.motion.pulse, phase_, rate_);
                h = lesser<S>(h, S(0.75) / ratio);
            }
        }
        return h;
    }

    void pass_time(const S& h, bool ends_piece)
    {
        if (is_free()) {
            after_ = after_ + h * unit_;
        } else {
            phase_ = ends_piece ? excitation_.motion.end_of_piece(phase_)
                                : lesser<S>(phase_ + h * rate_, end_);
        }
        result_.slide_peak = greater<S>(result_.slide_peak, abs(result_.slide));
    }

    /// At rest: waits for the ground to move the block.
    void rest()
    {
        mode_ = SlidingMode::rest;
        tilt_ = turning_ = slip_ = velocity_ = S(0);
        if (!is_free()) {
            const auto now = excitation_.ground(phase_);
            for (const S side : {S(1), S(-1)}) {
                const Field2<S> field =
                    field_on(on(side), S(side * horizontal_of(now)), gravity_of(now, S(1)));
                if (field.along > on(side).threshold() * -field.normal) {
                    moved_ = phase_;
                    return move(side);
                }
            }
            const S next = excitation_.next_uplift(true, phase_, moved_);
            if (next < end_) {
                phase_ = moved_ = next;
                return move(horizontal_of(excitation_.ground(next)) < 0 ? S(1) : S(-1));
            }
            phase_ = end_;
        }
        end_forced_stage();
        decide(Region::S);
    }

    /// The ground begins to move a block at rest towards this side.
    void move(const S& side)
    {
        side_ = side;
        if (on(side).friction > on(side).friction_to_lift()) {
            lift();
            stick_or_slip();
        } else {
            mode_ = SlidingMode::slide;
            direction_ = side;
        }
    }

    void lift() { result_.uplift = lesser<S>(result_.uplift, phase_); }

    /// Both corners are on the base, which moves at this velocity.
    void put_down(const S& velocity)
    {
        tilt_ = turning_ = slip_ = S(0);
        velocity_ = velocity;
        if (velocity == 0) {
            return rest();
        }
        const S leading = velocity > 0 ? S(1) : S(-1);
        if (on(leading).friction > on(leading).friction_to_lift()) { // tips over
            side_ = leading;
            slip_ = abs(velocity);
            lift();
            return begin_slip(S(1));
        }
        mode_ = SlidingMode::slide;
        direction_ = leading;
    }

    /// A step of a base that slides flat.
    void slide()
    {
        note_slip();
        const Field2<Coeffs> field = field_series(S(1));
        Coeffs speed; // in its direction
        Coeffs path;
        const S braking = plus_.friction;
        speed[0] = direction_ * velocity_ * unit_;
        path[0] = S(0);
        for (std::size_t k = 0; k < std::size_t(order); ++k) {
            const S share = 1 / S(int(k) + 1);
            speed[k + 1] = share * (direction_ * field.along[k] + braking * field.normal[k]);
            path[k + 1] = share * speed[k];
        }
        const S left = left_of_piece();
        S h = longest(left, speed, order,
                      S(std::numeric_limits<S>::epsilon()) * plus_.gravity * unit_ * unit_);
        if (is_free()) { // of a constant deceleration
            h = speed[1] < 0 ? S(-2 * speed[0] / speed[1]) : h;
        }
        const S noise = S(4 * std::numeric_limits<S>::epsilon()) * h * abs(speed[1]);
        const S stop = first_fall(speed, h, noise);
        const bool stops = stop >= 0;
        const S taken = stops ? stop : h;
        Coeffs pressed = field.normal;
        for (S& each : pressed) {
            each = -each;
        }
        if (first_fall(pressed, taken, S(0)) >= 0) { // as a strong push may on an incline
            return leave_ground();
        }
        result_.slide = result_.slide + direction_ * polynomial_at(path, taken);
        velocity_ = direction_ * polynomial_at(speed, taken) / unit_;
        pass_time(taken, !stops && h == left);
        if (stops) {
            velocity_ = S(0);
            return rest();
        }
        if (is_free()) {
            end_forced_stage();
        }
    }

    /// Sticks if the base can hold the corner, else slips: also if it would have to pull at a
    /// corner that sticks, as one that slips may still be pressed to the base.
    void stick_or_slip()
    {
        slip_ = S(0);
        const Field2<Coeffs> field = field_series(side_);
        const ContactForce<S> force = force_of_sticking(here(), on_corner(here(), tilt_), turning_,
                                                        Field2<S>{field.along[0], field.normal[0]});
        if (abs(force.along) <= here().friction * force.normal) {
            mode_ = SlidingMode::rock;
            velocity_ = S(0);
            if (is_free()) {
                decide_if_it_sticks();
            }
            return;
        }
        begin_slip(force.along > 0 ? S(-1) : S(1));
    }

    void begin_slip(const S& outward)
    {
        mode_ = SlidingMode::slide_rock;
        direction_ = outward;
    }

    void note_slip()
    {
        result_.slipped = true;
        result_.slips_after = result_.slips_after || is_free();
    }

    /// A step on one corner.
    void rock()
    {
        const bool slips = mode_ == SlidingMode::slide_rock;
        const Field2<Coeffs> field = field_series(side_);
        const SlidingState<S> state{tilt_, turning_, slip_ * unit_};
        const Series c = slips ? series_of_slipping<order>(here(), state, direction_, field)
                               : series_of_sticking<order>(here(), state, field);
        if (slips) {
            note_slip();
            if (!(c.yield[0] > 0)) {
                result_.jammed = true;
                return give_up();
            }
            if (!(c.normal[0] > 0)) {
                return leave_ground();
            }
        }
        const S left = left_of_piece();
        S h = longest(left, c.rate, order, allowed_ * unit_);
        const S reach = here().height;
        if (slips) {
            h = longest(h, c.slip, order, allowed_ * unit_ * reach);
        }
        const S epsilon(std::numeric_limits<S>::epsilon());
        const S weight = here().gravity * unit_ * unit_;

        // The first of these to fall below zero ends the step.
        enum Event { none, impact, fall, sticks, slips_out, slips_in, off, jam };
        Event event = none;
        S when = h;
        const auto watch = [&](Event kind, const auto& values, const S& noise) {
            const S found = first_fall(values, when, noise);
            if (found >= 0 && (event == none || found < when)) {
                event = kind;
                when = found;
            }
        };
        watch(impact, c.tilt, S(8 * epsilon * least_ * h * h));
        Coeffs room = c.tilt;
        for (S& each : room) {
            each = -each;
        }
        room[0] = pi<S>() / 2 - tilt_;
        watch(fall, room, S(0));
        if (slips) {
            Coeffs speed = c.slip;
            for (S& each : speed) {
                each = direction_ * each;
            }
            watch(sticks, speed, S(8 * epsilon * weight * h));
            watch(off, c.normal, S(0));
            watch(jam, c.yield, S(0));
        } else {
            Coefficients<order - 1, S> outward;
            Coefficients<order - 1, S> inward;
            for (std::size_t k = 0; k < outward.size(); ++k) {
                const S most = here().friction * c.normal[k];
                outward[k] = most + c.along[k]; // the force is inward, and the slip outward
                inward[k] = most - c.along[k];
            }
            const S noise = 16 * epsilon * weight;
            watch(slips_out, outward, noise);
            watch(slips_in, inward, noise);
        }
        see_peak(c, when);
        move_base(c, when, slips);
        tilt_ = greater<S>(polynomial_at(c.tilt, when), S(0));
        turning_ = polynomial_at(c.rate, when);
        slip_ = slips ? S(polynomial_at(c.slip, when) / unit_) : S(0);
        velocity_ = side_ * slip_;
        const bool was_free = is_free();
        pass_time(when, event == none && when == left);
        if (!(tilt_ - tilt_ + turning_ - turning_ == 0)) {
            result_.capped = true;
            return give_up();
        }
        if (!was_free && is_free()) {
            if (event == fall) {
                return fall_down();
            }
            end_forced_stage();
        }
        switch (event) {
        case none:
            if (is_free()) {
                decide_by_energy();
                if (!is_over_ && !was_free && !slips) {
                    decide_if_it_sticks();
                }
            }
            return;
        case impact: return strike();
        case fall: return fall_down();
        case sticks: return stick_or_slip();
        case slips_out: return begin_slip(S(1));
        case slips_in: return begin_slip(S(-1));
        case off: return leave_ground();
        case jam: result_.jammed = true; return give_up();
        }
    }

    void move_base(const Series& c, const S& h, bool slips)
    {
        if (!slips) {
            return;
        }
        Coeffs path;
        path[0] = S(0);
        for (std::size_t k = 0; k < std::size_t(order); ++k) {
            path[k + 1] = c.slip[k] / S(int(k) + 1);
        }
        result_.slide = result_.slide + side_ * polynomial_at(path, h);
    }

    void see_peak(const Series& c, const S& h)
    {
        const S scale = side_ > 0 ? S(1) : S(block_.slenderness / block_.other.slenderness);
        S highest = polynomial_at(c.tilt, h);
        if (c.rate[0] > 0) {
            const S turn = first_fall(c.rate, h, S(0));
            if (turn >= 0) {
                highest = greater<S>(highest, polynomial_at(c.tilt, turn));
            }
        }
        result_.peak = greater<S>(result_.peak, scale * highest);
    }

    void strike()
    {
        const SlidingSide<S>& next = on(-side_);
        const S speed = -turning_ / unit_;
        const S slip = -slip_;
        (is_free() ? free_impacts_ : result_.impacts) += 1;
        const AfterImpact<S> after = impact_with_friction(next, speed, slip, loss_);
        side_ = -side_;
        tilt_ = S(0);
        turning_ = after.rate * unit_;
        if (after.slip != 0 || after.stays_down) {
            if (after.slip != 0) {
                note_slip();
            }
        }
        // A bounce this low ends within the tolerance.
        if (after.stays_down || turning_ <= allowed_ * unit_ * S(0.1)) {
            return put_down(side_ * after.slip);
        }
        slip_ = after.slip;
        velocity_ = side_ * slip_;
        if (is_free()) {
            decide_by_energy();
            if (is_over_) {
                return;
            }
        }
        if (slip_ == 0) {
            return stick_or_slip();
        }
        begin_slip(slip_ > 0 ? S(1) : S(-1));
    }

    void end_forced_stage()
    {
        if (is_ended_) {
            return;
        }
        is_ended_ = true;
        result_.phase = end_;
        if (mode_ == SlidingMode::rest) { // the side of the higher barrier has the smaller margin
            const S largest = Equations<theory>::separatrix_rate(block_, S(0));
            side_ = barrier_ratio<theory>(largest, block_) > 1 ? S(-1) : S(1);
        }
        result_.state = {tilt_, turning_ / (unit_ * p_of_side()), side_};
        const Block<S> block = seen_from(side_, block_);
        const S c = Equations<theory>::separatrix_rate(block, tilt_);
        is_inside_ = abs(result_.state.rate) <= c;
    }

    void fall_down()
    {
        const bool in_motion = !is_ended_;
        if (in_motion) {
            is_ended_ = true;
            result_.phase = phase_;
            result_.state = {pi<S>() / 2, turning_ / (unit_ * p_of_side()), side_};
            result_.fell = true;
        }
        result_.time_of_fall = after_;
        const bool plus = side_ > 0;
        decide(in_motion            ? (plus ? Region::F_plus : Region::F_minus)
               : free_impacts_ == 0 ? (plus ? Region::U0_plus : Region::U0_minus)
               : free_impacts_ == 1 ? (plus ? Region::U1_plus : Region::U1_minus)
                                    : (plus ? Region::U2_plus : Region::U2_minus));
    }

    /// The block stands: its region depends on the state at the end of the ground motion.
    Region region_of_standing() const
    {
        return is_inside_                                             ? Region::S
               : (result_.state.rate > 0) == (result_.state.side > 0) ? Region::S_plus
                                                                      : Region::S_minus;
    }

    void decide(Region region)
    {
        result_.region = region == Region::S ? region_of_standing() : region;
        is_over_ = true;
    }

    void give_up()
    {
        end_forced_stage();
        result_.region = Region::undecided;
        is_over_ = true;
    }

    void leave_ground()
    {
        result_.lifted_off = true;
        give_up();
    }

    /// On a level base, friction and impacts only take energy: a block below both barriers, with G
    /// between its corners, stands.
    void decide_by_energy()
    {
        if (!is_level() || follow_ == Follow::until_rest) {
            return;
        }
        const SlidingSide<S>& side = here();
        const OnCorner<S> at = on_corner(side, tilt_);
        const S rate = turning_ / unit_;
        const S along = slip_ + rate * at.y;
        const S upwards = -rate * at.x;
        const S kinetic =
            S(0.5) * (along * along + upwards * upwards + side.gyration * rate * rate);
        const auto reach = [&](const S& base) -> S {
            return sqrt(base * base + side.height * side.height);
        };
        const S barrier = side.gravity * lesser<S>(reach(side.base), reach(side.other_base));
        const S rounding(S(1) - 64 * std::numeric_limits<S>::epsilon());
        if (at.x < 0 && kinetic + side.gravity * at.y < barrier * rounding) {
            decide(Region::S);
        }
    }

    /// After the ground motion: the exact criterion, if the corner sticks from now on.
    void decide_if_it_sticks()
    {
        const State<S> state{tilt_, turning_ / (unit_ * p_of_side()), side_};
        const Block<S> block = seen_from(side_, block_);
        const S impacts = greater<S>(plus_.friction_of_impact(), minus_.friction_of_impact());
        const S demand = greater<S>(free_contact(state, block, contact_, true).friction, impacts);
        if (!(demand <= plus_.friction)) {
            return;
        }
        const auto region = Region(int(region_code_after_pulse<theory>(state, block)));
        if (is_safe(region)) {
            const S scale = block_.slenderness; // of the largest tilts over alpha
            result_.peak =
                greater<S>(result_.peak, scale * largest_free_tilt<theory>(state, block));
            return decide(Region::S);
        }
        if (follow_ == Follow::until_rest) {
            return;
        }
        const bool at_once = region == Region::U0_plus || region == Region::U0_minus;
        const bool after_one = region == Region::U1_plus || region == Region::U1_minus;
        free_impacts_ += at_once ? 0 : after_one ? 1 : 2;
        side_ = after_one ? -side_ : side_;
        fall_down();
    }

    static constexpr bool is_pulse = std::same_as<Excitation, PulseExcitation<S>>;

    Block<S> block_;
    SlidingSide<S> plus_;
    SlidingSide<S> minus_;
    ContactSides<S> contact_;
    Excitation excitation_;
    S end_;
    S phase_;
    Follow follow_;
    S loss_;
    S unit_;  // of the time of the series
    S rate_;  // phase per unit
    S least_; // the smaller alpha
    S allowed_;
    int step_limit_;

    SlidingMode mode_ = SlidingMode::rest;
    S side_ = S(1);
    S tilt_ = S(0);
    S turning_ = S(0);   // d tilt / d unit
    S slip_ = S(0);      // of the corner, outward, per time
    S velocity_ = S(0);  // of the base, towards plus, per time
    S direction_ = S(1); // of the slip: of the corner, outward; of a flat base, towards plus
    S moved_ = S(-std::numeric_limits<S>::infinity());
    S after_ = S(0);
    bool is_ended_ = false;
    bool is_inside_ = true;
    bool is_over_ = false;
    int free_impacts_ = 0;
    SlidingEnd<S> result_{};
};

/// Follows a block that may slip to the end.
template <Number S, class Excitation>
SlidingEnd<S> run_sliding(const Block<S>& block, const S& gyration, const S& friction,
                          const Excitation& excitation, const S& tolerance,
                          Follow follow = Follow::until_rest)
{
    SlidingMotion<S, Excitation> motion(block, gyration, friction, excitation, tolerance, follow);
    while (!motion.is_over()) {
        motion.advance();
    }
    return motion.end();
}

extern template class SlidingMotion<double, PulseExcitation<double>>;
extern template class SlidingMotion<double, RecordExcitation<double, Directions::both>>;
extern template class SlidingMotion<long double, PulseExcitation<long double>>;
extern template class SlidingMotion<long double, RecordExcitation<long double, Directions::both>>;

} // namespace overturn
