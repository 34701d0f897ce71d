// One point for a general ODE solver: the equation of motion on one side (Eq. 47), and the handling
// of uplift, impact, rest and fall. All peers share it, so they differ only in the integration.
// State: tilt |theta| and its rate d|theta|/d tau [rad]; time tau = p t since the beginning of the
// pulse [1/p].
#pragma once

#include "peer.hpp"

#include "overturn/mechanics/bounce_series.hpp"
#include "overturn/mechanics/energy_criteria.hpp"
#include "overturn/mechanics/excitation.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace overturn::benchmarks {

/// The region of a block that the pulse left standing.
template <Theory theory, class T>
Region region_after_pulse(const State<T>& state, const Block<T>& block)
{
    return Region(int(region_code_after_pulse<theory>(state, block)));
}

template <class S>
using RockingState = std::array<S, 2>; // tilt, rate

template <class S>
struct Moment {
    S time;
    RockingState<S> state;
};

/// The end of a flight, which is the motion between two events.
enum class Outcome { impact, fall, pulse_end, failure };

/// The equation of motion on the side on which the block rocks.
template <class S, Sines sines = Sines::library>
class Rocking {
public:
    explicit Rocking(const PeerPoint& point)
        : block_{S(point.slenderness), S(point.restitution)},
          excitation_(excitation_of<Theory::nonlinear>(ground_motion<S>(PulseKind::one_sine),
                                                       block_.slenderness, S(point.amplitude),
                                                       S(point.frequency))),
          end_(excitation_.motion.end / excitation_.frequency), push_(excitation_.acceleration)
    {}

    // All calls are inlined; otherwise they cost a peer up to 10 % of its time.
    [[gnu::flatten]] S acceleration(const S& tilt, const S& time) const
    {
        const S phase = time * excitation_.frequency;
        if constexpr (sines == Sines::overturn) {
            const S push = push_ * OneSine::value(phase);
            return rocking_acceleration<Theory::nonlinear>(tilt, block_.slenderness, push);
        } else {
            const S push = push_ * std::sin(phase);
            const S y = block_.slenderness - tilt;
            return -(std::sin(y) + push * std::cos(y));
        }
    }
    void operator()(const RockingState<S>& state, RockingState<S>& derivative, const S& time) const
    {
        derivative = {state[1], acceleration(state[0], time)};
    }

    void set_side(const S& side) { push_ = side * excitation_.acceleration; }

    const Block<S>& block() const { return block_; }
    const Excitation<S>& excitation() const { return excitation_; }
    S end() const { return end_; }
    S frequency() const { return excitation_.frequency; }

private:
    Block<S> block_;
    Excitation<S> excitation_;
    S end_;  // time at which the pulse ends
    S push_; // a_p/g with the sign of the side
};

/// The forced stage of one point. `fly(rocking, moment, from_rest)` integrates from `moment` to the
/// next event or the end of the pulse, stores the end in `moment`, and returns the outcome;
/// `from_rest` is true for the flight after an uplift. The tilt of 0 at the beginning of a flight
/// is not an event.
template <class S, Sines sines, class Fly>
PeerEnd<S> run_point(const PeerPoint& point, Fly&& fly)
{
    using std::sqrt;
    Rocking<S, sines> rocking(point);
    const Block<S>& block = rocking.block();
    const Excitation<S>& excitation = rocking.excitation();
    const S sqrt_restitution = sqrt(block.restitution);
    State<S> end{S(0), S(0), S(1)};
    S phase = excitation.motion.begin;
    while (true) {
        S uplift = std::numeric_limits<S>::infinity();
        for (const S& candidate : excitation.uplifts) {
            uplift = candidate >= phase && candidate < uplift ? candidate : uplift;
        }
        if (!(uplift < excitation.motion.end)) {
            break; // at rest until the pulse ends
        }
        end.side = excitation.ground(uplift) < 0 ? S(1) : S(-1);
        Moment<S> now{uplift / excitation.frequency, {S(0), S(0)}};
        bool from_rest = true;
        while (true) {
            rocking.set_side(end.side);
            const Outcome outcome =
                now.time < rocking.end() ? fly(rocking, now, from_rest) : Outcome::pulse_end;
            from_rest = false;
            if (outcome == Outcome::failure) {
                const S none = std::numeric_limits<S>::quiet_NaN();
                return {none, none, Region::undecided};
            }
            if (outcome == Outcome::fall) {
                return {end.side * pi<S>() / 2, end.side * now.state[1],
                        end.side > 0 ? Region::F_plus : Region::F_minus};
            }
            if (outcome == Outcome::pulse_end) {
                end.tilt = now.state[0] > 0 ? now.state[0] : S(0);
                end.rate = now.state[1];
                return {end.side * end.tilt, end.side * end.rate,
                        region_after_pulse<Theory::nonlinear>(end, block)};
            }
            end = state_after_impact<S>({S(0), now.state[1], end.side}, sqrt_restitution);
            now.state = {end.tilt, end.rate};
            phase = now.time * excitation.frequency;
            if (bounces_die_out<Theory::nonlinear>(block, excitation, phase, end.rate)) {
                break;
            }
        }
    }
    return {S(0), S(0),
            region_after_pulse<Theory::nonlinear>(State<S>{S(0), S(0), end.side}, block)};
}

/// The forced stage of every point; see run_point().
template <class S, Sines sines = Sines::library, class Fly>
std::vector<PeerEnd<S>> run_points(const Problem& problem, Fly&& fly)
{
    std::vector<PeerEnd<S>> ends;
    ends.reserve(problem.points.size());
    for (const PeerPoint& point : problem.points) {
        ends.push_back(run_point<S, sines>(point, fly));
    }
    return ends;
}

} // namespace overturn::benchmarks
