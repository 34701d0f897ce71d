// One point for a general ODE solver: the equation of motion on one side (Eq. 47), and the handling
// of uplift, impact, rest and fall. All peers share it, so they differ only in the integration.
// State: tilt |theta| and its rate d|theta|/d tau [rad]; time tau = p t since the beginning of the
// ground motion [1/p].
#pragma once

#include "peer.hpp"

#include "overturn/mechanics/bounce_series.hpp"
#include "overturn/mechanics/energy_criteria.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"
#include "overturn/mechanics/record_excitation.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace overturn::benchmarks {

/// The region of a block that the ground motion left standing.
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

/// The end of a flight, which is the motion between two events within a smooth piece of the ground
/// motion: a pulse, or the interval between two samples of a record.
enum class Outcome { impact, fall, piece_end, failure };

/// The beginning of a flight. At a sample, it continues the previous one: the acceleration has a
/// kink, but no jump.
enum class Start { uplift, impact, sample };

/// The acceleration of the ground over g towards the side of the tilt, over time, on the piece that
/// contains or begins at the phase. towards: the peak of the acceleration, or the factor on the
/// record, with the sign of the side [1].
template <class Excitation, Sines sines>
class Push;

template <class S, Sines sines>
class Push<PulseExcitation<S>, sines> {
public:
    Push(const PulseExcitation<S>& excitation, const S& towards, const S&)
        : towards_(towards), frequency_(excitation.frequency)
    {}
    S at(const S& time) const
    {
        const S phase = time * frequency_;
        return towards_ * (sines == Sines::overturn ? OneSine::value(phase) : S(std::sin(phase)));
    }

private:
    S towards_, frequency_;
};

template <class S, Sines sines>
class Push<RecordExcitation<S, Directions::horizontal>, sines> {
public:
    Push(const RecordExcitation<S, Directions::horizontal>& excitation, const S& towards,
         const S& phase)
        : begin_(phase / excitation.frequency),
          line_(excitation.template series<1>(towards, phase, excitation.frequency))
    {}
    S at(const S& time) const { return line_.at(time - begin_); }

private:
    S begin_; // of the piece, or of the flight within it [1/p]
    Ramp<S> line_;
};

/// The equation of motion on the side on which the block rocks. Excitation: PulseExcitation, or
/// RecordExcitation without vertical motion.
template <class S, class Excitation, Sines sines>
class Rocking {
public:
    Rocking(const S& slenderness, const Excitation& excitation)
        : slenderness_(slenderness), excitation_(excitation), end_(0),
          push_(excitation, S(0), excitation.motion.begin)
    {}

    // All calls are inlined; otherwise they cost a peer up to 10 % of its time.
    [[gnu::flatten]] S acceleration(const S& tilt, const S& time) const
    {
        const S push = push_.at(time);
        if constexpr (sines == Sines::overturn) {
            return Equations<Theory::nonlinear>::acceleration(BlockSide<S>{slenderness_}, tilt,
                                                              push);
        } else {
            const S y = slenderness_ - tilt;
            return -(std::sin(y) + push * std::cos(y));
        }
    }
    void operator()(const RockingState<S>& state, RockingState<S>& derivative, const S& time) const
    {
        derivative = {state[1], acceleration(state[0], time)};
    }

    /// Sets the side and the piece that contains or begins at the phase.
    void begin(const S& side, const S& phase)
    {
        end_ = excitation_.motion.end_of_piece(phase) / excitation_.frequency;
        push_ = Push<Excitation, sines>(excitation_, side * excitation_.acceleration, phase);
    }

    S end() const { return end_; } ///< time at which the piece ends [1/p]

    /// The faster of the motion of the block and a pulse [p]. A record limits steps by its samples.
    S fastest() const
    {
        return std::is_same_v<Excitation, PulseExcitation<S>> && excitation_.frequency > 1
                   ? excitation_.frequency
                   : S(1);
    }

private:
    const S slenderness_;
    const Excitation& excitation_;
    S end_;
    Push<Excitation, sines> push_;
};

/// The forced stage of one point. `fly(rocking, moment, start)` integrates from `moment` to the
/// next event or the end of the piece, stores the end in `moment`, and returns the outcome. The
/// tilt of 0 at the beginning of a flight is not an event.
template <class S, Sines sines, class Excitation, class Fly>
PeerEnd<S> run_point(const Block<S>& block, const Excitation& excitation, Fly&& fly)
{
    using std::sqrt;
    Rocking<S, Excitation, sines> rocking(block.slenderness, excitation);
    const auto& motion = excitation.motion;
    const S sqrt_restitution = sqrt(block.restitution);
    State<S> end{S(0), S(0), S(1)};
    S phase = motion.begin;
    S uplift = -std::numeric_limits<S>::infinity();
    while (true) {
        uplift = excitation.next_uplift(true, phase, uplift);
        if (!(uplift < motion.end)) {
            break; // at rest until the ground motion ends
        }
        phase = uplift;
        end.side = excitation.ground(uplift) < 0 ? S(1) : S(-1);
        Moment<S> now{uplift / excitation.frequency, {S(0), S(0)}};
        Start start = Start::uplift;
        while (true) {
            rocking.begin(end.side, phase);
            Outcome outcome = Outcome::piece_end;
            if (now.time < rocking.end()) {
                outcome = fly(rocking, now, start);
                start = Start::sample;
            }
            if (outcome == Outcome::failure) {
                const S none = std::numeric_limits<S>::quiet_NaN();
                return {none, none, Region::undecided};
            }
            if (outcome == Outcome::fall) {
                return {end.side * pi<S>() / 2, end.side * now.state[1],
                        end.side > 0 ? Region::F_plus : Region::F_minus};
            }
            if (outcome == Outcome::piece_end) {
                phase = motion.end_of_piece(phase);
                if (phase < motion.end) {
                    now.time = rocking.end();
                    continue;
                }
                end.tilt = now.state[0] > 0 ? now.state[0] : S(0);
                end.rate = now.state[1];
                return {end.side * end.tilt, end.side * end.rate,
                        region_after_pulse<Theory::nonlinear>(end, block)};
            }
            end = state_after_impact<S>({S(0), now.state[1], end.side}, sqrt_restitution);
            now.state = {end.tilt, end.rate};
            start = Start::impact;
            phase = now.time * excitation.frequency;
            if (bounces_die_out<Theory::nonlinear>(block, excitation, phase, end.rate)) {
                break;
            }
        }
    }
    return {S(0), S(0),
            region_after_pulse<Theory::nonlinear>(State<S>{S(0), S(0), end.side}, block)};
}

/// Calls visit(excitation) for one point of a problem.
template <class S, class Visitor>
auto with_excitation(const Scene& scene, const Point& point, const Visitor& visit)
{
    const Block<S> block = block_in<S>(point.block);
    if (scene.is_under(Under::record)) {
        return visit(RecordExcitation<S, Directions::horizontal>{
            .motion = record_motion<S>(*scene.records().front()),
            .acceleration = S(point.amplitude),
            .frequency = S(point.frequency),
            .to_plus = Equations<Theory::nonlinear>::uplift_acceleration(block),
            .to_minus = Equations<Theory::nonlinear>::uplift_acceleration(block)});
    }
    return visit(pulse_excitation<Theory::nonlinear>(pulse_motion<S>(PulseKind::one_sine), block,
                                                     S(point.amplitude), S(point.frequency)));
}

/// The forced stage of every point; see run_point().
template <class S, Sines sines = Sines::library, class Fly>
std::vector<PeerEnd<S>> run_points(const PeerProblem& problem, Fly&& fly)
{
    std::vector<PeerEnd<S>> ends;
    ends.reserve(problem.points.size());
    for (const Point& point : problem.points) {
        const Block<S> block = block_in<S>(point.block);
        ends.push_back(with_excitation<S>(problem.scene, point, [&](const auto& excitation) {
            return run_point<S, sines>(block, excitation, fly);
        }));
    }
    return ends;
}

} // namespace overturn::benchmarks
