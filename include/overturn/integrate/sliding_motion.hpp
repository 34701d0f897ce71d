// The motion of one block that may slip on its base, with the modes rest, slide (flat), rock (the
// corner sticks) and slide-rock (it slips), during the ground motion and after it. Each mode is a
// Taylor series; a change of the mode is a root of a series.
#pragma once

#include "overturn/integrate/run_sliding.hpp"
#include "overturn/integrate/sliding_ground.hpp"
#include "overturn/integrate/sliding_mode.hpp"
#include "overturn/mechanics/energy_criteria.hpp"
#include "overturn/mechanics/free_contact.hpp"
#include "overturn/mechanics/free_rocking.hpp"

namespace overturn {

/// Excitation: PulseExcitation, or RecordExcitation. S: a scalar.
template <Number S, class Excitation,
          int order =
              std::same_as<Excitation, RecordExcitation<double, Directions::both>> ? 10 : 16>
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
                  Follow follow = Follow::until_stuck)
        : block_(block), contact_(block, gyration),
          ground_(sliding_side(block, gyration, friction), block.frequency_parameter, excitation),
          follow_(follow),
          loss_(lesser<S>(share_of_rate_kept(ground_.plus(), block.restitution), S(1))),
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
        } else if (mode_ == SlidingMode::rest) {
            wait();
        } else if (mode_ == SlidingMode::slide) {
            slide();
        } else {
            rock();
        }
    }

    /// How the motion ended, once it is over.
    const SlidingEnd<S>& end() const { return result_; }

    SlidingMode mode() const { return mode_; }
    const S& phase() const { return ground_.phase(); }
    const S& time_after() const { return ground_.time_after(); } ///< since the ground motion
    S side() const { return side_; }
    /// Of the slip: of the corner, outward; of a flat base, towards plus.
    const S& direction() const { return direction_; }
    int impacts() const { return result_.impacts + free_impacts_; }
    const S& tilt() const { return tilt_; }
    S rate() const { return turning_ / unit(); } ///< d tilt / d time
    const S& base_velocity() const { return velocity_; }
    const S& base_position() const { return result_.slide; }

    struct Instant {
        State<S> state; ///< the rate is d tilt / d time
        S acceleration; ///< d rate / d time
        S velocity;     ///< of the base
        S position;
        ContactForce<S> force; ///< over the weight, positive towards plus
    };

    /// The state a time after the present one, within the step that advance() will take.
    Instant after(const S& time) const
    {
        const S t = time / unit();
        const auto pressed = [&](S side, const ContactForce<S>& force) -> ContactForce<S> {
            const S weight = ground_.plus().gravity;
            return {side * force.along / weight, force.normal / weight};
        };
        if (mode_ == SlidingMode::rest) {
            const Field2<S> field = ground_.field_after(t);
            return {{S(0), S(0), S(1)},
                    S(0),
                    S(0),
                    base_position(),
                    pressed(S(1), {-field.along, -field.normal})};
        }
        const S side = mode_ == SlidingMode::slide ? S(1) : side_;
        const Field2<Coeffs> series = ground_.field_series(side);
        const Field2<S> field{polynomial(series.along, t) / (unit() * unit()),
                              polynomial(series.normal, t) / (unit() * unit())};
        if (mode_ == SlidingMode::slide) {
            const Coeffs speed = speed_series(series);
            const S normal = -field.normal;
            return {{S(0), S(0), S(1)},
                    S(0),
                    direction_ * polynomial(speed, t) / unit(),
                    base_position() + direction_ * integral_of(speed, t),
                    pressed(side, {-ground_.plus().friction * direction_ * normal, normal})};
        }
        const Series c = corner_series(series);
        const bool slips = mode_ == SlidingMode::slide_rock;
        const S tilt = greater<S>(polynomial(c.tilt, t), S(0));
        const S rate = polynomial(c.rate, t) / unit();
        const OnCorner<S> at = on_corner(here(), tilt);
        return {{tilt, rate, side_},
                derivative_of(c.rate, t) / (unit() * unit()),
                slips ? S(side_ * polynomial(c.slip, t) / unit()) : S(0),
                base_position() + (slips ? S(side_ * integral_of(c.slip, t)) : S(0)),
                pressed(side_, slips ? force_of_slipping(here(), at, rate, direction_, field)
                                     : force_of_sticking(here(), at, rate, field))};
    }

private:
    const SlidingSide<S>& on(const S& side) const { return ground_.on(side); }
    const SlidingSide<S>& here() const { return on(side_); }
    const S& unit() const { return ground_.unit(); } // of the time of the series
    bool is_free() const { return ground_.is_free(); }
    const S& p_of_side() const
    {
        return side_ > 0 ? block_.frequency_parameter : block_.other.frequency_parameter;
    }

    void pass(const S& h, bool ends_piece)
    {
        ground_.pass_time(h, ends_piece);
        result_.slide_peak = greater<S>(result_.slide_peak, abs(result_.slide));
    }

    void rest()
    {
        mode_ = SlidingMode::rest;
        tilt_ = turning_ = slip_ = velocity_ = S(0);
    }

    /// At rest, until the ground moves the block.
    void wait()
    {
        if (const std::optional<S> side = ground_.wait()) {
            return move(*side);
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

    void lift() { result_.uplift = lesser<S>(result_.uplift, phase()); }

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

    /// The speed of a base that slides flat, in its direction, per unit.
    Coeffs speed_series(const Field2<Coeffs>& field) const
    {
        Coeffs speed;
        speed[0] = direction_ * velocity_ * unit();
        for (std::size_t k = 0; k < std::size_t(order); ++k) {
            speed[k + 1] = shares<S, order>()[k] * (direction_ * field.along[k] +
                                                    ground_.plus().friction * field.normal[k]);
        }
        return speed;
    }

    static Coeffs scaled(Coeffs series, const S& factor)
    {
        for (S& each : series) {
            each = factor * each;
        }
        return series;
    }

    Series corner_series(const Field2<Coeffs>& field) const
    {
        const SlidingState<S> state{tilt_, turning_, slip_ * unit()};
        return straight_line<S>([&] {
            return mode_ == SlidingMode::slide_rock
                       ? series_of_slipping<order>(here(), state, direction_, field)
                       : series_of_sticking<order>(here(), state, field);
        });
    }

    /// A step of a base that slides flat.
    void slide()
    {
        note_slip();
        const Field2<Coeffs> field = ground_.field_series(S(1));
        const Coeffs speed = speed_series(field);
        const S left = ground_.left_of_piece();
        const S share = lesser<S>(allowed_ / least_, S(0x1p-52)); // rounding of double, or less
        S h = ground_.longest(left, speed, order, share * ground_.plus().gravity * unit() * unit());
        if (is_free()) { // of a constant deceleration
            h = speed[1] < 0 ? S(-2 * speed[0] / speed[1]) : h;
        }
        const S noise = S(4 * std::numeric_limits<S>::epsilon()) * h * abs(speed[1]);
        const S stop = first_fall(speed, h, noise);
        const bool stops = stop >= 0;
        S taken = stops ? stop : h;
        const S off = // as a strong push may on an incline
            first_fall(scaled(field.normal, S(-1)), taken, S(0));
        const bool leaves = off >= 0;
        taken = leaves ? off : taken;
        result_.slide = result_.slide + direction_ * integral_of(speed, taken);
        velocity_ = direction_ * polynomial(speed, taken) / unit();
        pass(taken, !stops && !leaves && h == left);
        if (leaves) {
            return leave_ground();
        }
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
        const Field2<Coeffs> field = ground_.field_series(side_);
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
        result_.slips_after = result_.slips_after || (is_free() && !is_known_);
    }

    /// A step on one corner.
    void rock()
    {
        const bool slips = mode_ == SlidingMode::slide_rock;
        const Field2<Coeffs> field = ground_.field_series(side_);
        const Series c = corner_series(field);
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
        const S left = ground_.left_of_piece();
        S h = ground_.longest(left, c.rate, order, allowed_ * unit());
        const S reach = here().height;
        if (slips) {
            h = ground_.longest(h, c.slip, order, allowed_ * unit() * reach);
        }
        const auto [event, when] = first_event(c, h);
        see_peak(c, when);
        if (slips) {
            result_.slide = result_.slide + side_ * integral_of(c.slip, when);
        }
        tilt_ = greater<S>(polynomial(c.tilt, when), S(0));
        turning_ = polynomial(c.rate, when);
        slip_ = slips ? S(polynomial(c.slip, when) / unit()) : S(0);
        velocity_ = side_ * slip_;
        const bool was_free = is_free();
        pass(when, event == Event::none && when == left);
        if (!(tilt_ - tilt_ + turning_ - turning_ == 0)) {
            result_.capped = true;
            return give_up();
        }
        if (!was_free && is_free()) {
            if (event == Event::fall) {
                return fall_down();
            }
            end_forced_stage();
        }
        switch (event) {
        case Event::none:
            if (is_free()) {
                decide_by_energy();
                if (!is_over_ && !was_free && !slips) {
                    decide_if_it_sticks();
                }
            }
            return;
        case Event::impact: return strike();
        case Event::fall: return fall_down();
        case Event::sticks: return stick_or_slip();
        case Event::slips_out: return begin_slip(S(1));
        case Event::slips_in: return begin_slip(S(-1));
        case Event::off: return leave_ground();
        case Event::jam: result_.jammed = true; return give_up();
        }
    }

    enum class Event { none, impact, fall, sticks, slips_out, slips_in, off, jam };
    struct EventInStep {
        Event event;
        S when; // in units; the end of the step if there is no event
    };

    /// The first event of a step of length h on one corner: of the functions that it watches, the
    /// first one that falls below zero.
    EventInStep first_event(const Series& c, const S& h) const
    {
        const S epsilon(std::numeric_limits<S>::epsilon());
        const S weight = here().gravity * unit() * unit();
        EventInStep first{Event::none, h};
        const auto watch = [&](Event kind, const auto& values, const S& noise) {
            const S found = first_fall(values, first.when, noise);
            if (found >= 0 && (first.event == Event::none || found < first.when)) {
                first = {kind, found};
            }
        };
        watch(Event::impact, c.tilt, S(8 * epsilon * least_ * h * h));
        Coeffs room = scaled(c.tilt, S(-1));
        room[0] = pi<S>() / 2 - tilt_;
        watch(Event::fall, room, S(0));
        if (mode_ == SlidingMode::slide_rock) {
            watch(Event::sticks, scaled(c.slip, direction_), S(8 * epsilon * weight * h));
            watch(Event::off, c.normal, S(0));
            watch(Event::jam, c.yield, S(0));
            return first;
        }
        Coefficients<order - 1, S> outward;
        Coefficients<order - 1, S> inward;
        for (std::size_t k = 0; k < outward.size(); ++k) {
            const S most = here().friction * c.normal[k];
            outward[k] = most + c.along[k]; // the force is inward, and the slip outward
            inward[k] = most - c.along[k];
        }
        const S noise = 16 * epsilon * weight;
        watch(Event::slips_out, outward, noise);
        watch(Event::slips_in, inward, noise);
        return first;
    }

    void see_peak(const Series& c, const S& h)
    {
        const S scale = side_ > 0 ? S(1) : S(block_.slenderness / block_.other.slenderness);
        S highest = polynomial(c.tilt, h);
        if (c.rate[0] > 0) {
            const S turn = first_fall(c.rate, h, S(0));
            if (turn >= 0) {
                highest = greater<S>(highest, polynomial(c.tilt, turn));
            }
        }
        result_.peak = greater<S>(result_.peak, scale * highest);
    }

    void strike()
    {
        const SlidingSide<S>& next = on(-side_);
        const S speed = -turning_ / unit();
        const S slip = -slip_;
        (is_free() ? free_impacts_ : result_.impacts) += 1;
        const AfterImpact<S> after = impact_with_friction(next, speed, slip, loss_);
        side_ = -side_;
        tilt_ = S(0);
        turning_ = after.rate * unit();
        if (after.slip != 0) {
            note_slip();
        }
        // A bounce this low ends within the tolerance.
        if (after.stays_down || turning_ <= allowed_ * unit() * S(0.1)) {
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
        result_.phase = ground_.end();
        if (mode_ == SlidingMode::rest) { // the side of the higher barrier has the smaller margin
            const S largest = Equations<theory>::separatrix_rate(block_, S(0));
            side_ = barrier_ratio<theory>(largest, block_) > 1 ? S(-1) : S(1);
        }
        result_.state = {tilt_, turning_ / (unit() * p_of_side()), side_};
        const Block<S> block = seen_from(side_, block_);
        const S c = Equations<theory>::separatrix_rate(block, tilt_);
        is_inside_ = abs(result_.state.rate) <= c;
    }

    void fall_down()
    {
        const bool in_motion = !is_ended_;
        if (in_motion) {
            is_ended_ = true;
            result_.phase = phase();
            result_.state = {pi<S>() / 2, turning_ / (unit() * p_of_side()), side_};
            result_.fell = true;
        }
        result_.time_of_fall = time_after();
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
        if (!ground_.is_level() || is_known_) {
            return;
        }
        const SlidingSide<S>& side = here();
        const OnCorner<S> at = on_corner(side, tilt_);
        const S rate = turning_ / unit();
        const S along = slip_ + rate * at.y;
        const S upwards = -rate * at.x;
        const S kinetic =
            S(0.5) * (along * along + upwards * upwards + side.gyration * rate * rate);
        const auto reach = [&](const S& base) -> S {
            return sqrt(base * base + side.height * side.height);
        };
        const S barrier = side.gravity * lesser<S>(reach(side.base), reach(side.other_base));
        const S rounding(S(1) - 64 * std::numeric_limits<S>::epsilon());
        is_known_ = at.x < 0 && kinetic + side.gravity * at.y < barrier * rounding;
        if (is_known_ && follow_ == Follow::until_decided) {
            decide(Region::S);
        }
    }

    /// After the ground motion: the exact criterion, if the corner sticks from now on.
    void decide_if_it_sticks()
    {
        if (follow_ == Follow::until_rest) {
            return;
        }
        const State<S> state{tilt_, turning_ / (unit() * p_of_side()), side_};
        const Block<S> block = seen_from(side_, block_);
        const S impacts =
            greater<S>(ground_.plus().friction_of_impact(), ground_.minus().friction_of_impact());
        const S demand = greater<S>(free_contact(state, block, contact_, true).friction, impacts);
        if (!(demand <= ground_.plus().friction)) {
            return;
        }
        const auto region = Region(int(region_code_after_pulse<theory>(state, block)));
        if (is_safe(region)) {
            const S scale = block_.slenderness; // of the largest tilts over alpha
            result_.peak =
                greater<S>(result_.peak, scale * largest_free_tilt<theory>(state, block));
            return decide(Region::S);
        }
        is_known_ = true;
        if (follow_ != Follow::until_decided) {
            return;
        }
        const bool at_once = region == Region::U0_plus || region == Region::U0_minus;
        const bool after_one = region == Region::U1_plus || region == Region::U1_minus;
        free_impacts_ += at_once ? 0 : after_one ? 1 : 2;
        side_ = after_one ? -side_ : side_;
        fall_down();
    }

    Block<S> block_;
    ContactSides<S> contact_;
    SlidingGround<S, Excitation, order> ground_;
    Follow follow_;
    S loss_;
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
    bool is_ended_ = false;
    bool is_inside_ = true;
    bool is_over_ = false;
    bool is_known_ = false; // the verdict, whatever is left of the motion
    int free_impacts_ = 0;
    SlidingEnd<S> result_{};
};

template <Number S, class Excitation>
SlidingEnd<S> run_sliding(const Block<S>& block, const S& gyration, const S& friction,
                          const Excitation& excitation, const S& tolerance, Follow follow)
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
