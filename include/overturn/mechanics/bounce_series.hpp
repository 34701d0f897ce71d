// The end of a bounce series in closed form: infinitely many impacts in finite time.
#pragma once

#include "overturn/mechanics/pulse_excitation.hpp"
#include "overturn/mechanics/theory/theories.hpp"

#include <limits>

namespace overturn {

/// The factor on a pull on the other side; see bounces_die_out().
template <Number T>
T level_of_other_side(const Block<T>& block)
{
    return sqrt(block.other.size / block.size) *
           (block.other.frequency_parameter / block.frequency_parameter);
}

/// The rate after an impact above which bounces_die_out() is false, because the ground motion has
/// an extremum first: infinite under a pulse. Under a record, a series must end before the next
/// sample, D frequency <= 1. The ground increases the pull on one side only, so that the weaker
/// pull is at most that of the strongest gravity alone on one of the sides.
template <Number T>
T fastest_bounce_series(const Block<T>& block, const auto& excitation)
{
    using S = scalar_t<T>;
    if constexpr (!std::remove_cvref_t<decltype(excitation)>::is_recorded) {
        return T(std::numeric_limits<S>::infinity());
    } else {
        const T pull =
            excitation.strongest_gravity() *
            greater<T>(block.slenderness, T(level_of_other_side(block) * block.other.slenderness));
        const T rounding(S(1) + 16 * std::numeric_limits<S>::epsilon());
        return rounding * (1 - sqrt(block.restitution)) * pull / (3 * excitation.frequency);
    }
}

/// The pulls on both sides.
template <Number T>
struct Pulls {
    T plus;
    T minus;

    T weaker() const { return lesser<T>(plus, minus); }
};

/// Whether all flights, which would last `twice` under a pull of 1, end within the duration over
/// which the pulls change from `first` to `last`; see bounces_die_out(). one_increases: the pull on
/// one side, while that on the other decreases.
template <bool one_increases, Number T>
mask_t<T> all_flights_end_within(const T& duration, const T& twice, const Pulls<T>& first,
                                 const Pulls<T>& last)
{
    if constexpr (one_increases) {
        const mask_t<T> plus_rises = last.plus >= first.plus;
        const T rise = select<T>(plus_rises, first.plus, first.minus);
        const T rise_then = select<T>(plus_rises, last.plus, last.minus);
        const T fall_then = select<T>(plus_rises, last.minus, last.plus);
        const T growth = sqrt(select<T>(rise > 0, rise_then, 0) / select<T>(rise > 0, rise, 1));
        return twice <= duration * rise && twice * growth <= duration * fall_then;
    } else {
        const auto growth = [&](const T& from, const T& to) -> T {
            return sqrt(greater<T>(to / select<T>(from > 0, from, 1), 1));
        };
        const T least = lesser<T>(first.weaker(), last.weaker());
        return twice * growth(first.plus, last.plus) * growth(first.minus, last.minus) <=
               duration * least;
    }
}

/// Per lane: whether the bounces after an impact at `phase` [rad or samples] are certain to die out
/// before the motion ends and before the ground can lift the block. v >= 0 is the rate just after
/// the impact.
///
/// Let g(t) be the pull towards the ground on one side, sin(alpha) +- A cos(alpha), A = ground
/// acceleration / g. Between two extrema of the ground motion, the pull increases on one side,
/// rise(t), and decreases on the other, fall(t). A flight under a decreasing pull ends no faster
/// than it began; under an increasing pull, it ends faster by at most the factor sqrt(g(end) /
/// g(begin)). After n impacts, the speed is at most v r^(n/2) sqrt(rise(t) / rise(0)). Each flight
/// lasts at most 2 speed / g, so that all flights together last at most
///
///     2 v / (1 - sqrt r) max(1 / rise(0), sqrt(rise(D) / rise(0)) / fall(D))
///
/// if this is at most D. D is 3 v / (1 - sqrt r) over the weaker pull, 1.5 times the sum under
/// constant pulls. With a vertical motion, both pulls may increase, and the flights together last
/// at most 2 v / (1 - sqrt r) times both growths over the weakest pull. The tilt stays below v^2 /
/// 2g and changes the pull by less than a twentieth.
///
/// Of a block with two different sides, everything is measured as on this side i, from which it
/// struck: v is sqrt(r) times the rate of the impact. At the rate u_j of the same energy on the
/// other side j, R_j u_j^2 = R_i v^2, a flight under the pull g_j lasts 2 u_j / (p_j g_j), as long
/// as one under the pull sqrt(R_j / R_i) p_j / p_i g_j on this side.
///
/// side: +1 or -1, that from which the block struck.
template <Theory theory, Number T>
mask_t<T> bounces_die_out(const Block<T>& block, const auto& excitation, const T& phase,
                          const T& rate, const T& side = T(1))
{
    // Unless the ground accelerates upwards, the weaker pull is at most alpha, so that no faster
    // impact would pass the check of the tilt.
    const T& alpha = block.slenderness;
    const mask_t<T> slow = 10 * rate * rate <= alpha * alpha;
    if (!any<T>(slow)) {
        return slow;
    }
    const mask_t<T> from_plus = side > 0;
    const T level = level_of_other_side(block);
    const auto pull_on = [&](const mask_t<T>& this_side, const auto& push) -> T {
        const BlockSide<T> on = combined(
            [&](const T& here, const T& there) { return select<T>(this_side, here, there); },
            side_of(block), block.other);
        const T pull = -Equations<theory>::acceleration(on, T(0), push);
        return select<T>(this_side, pull, level * pull);
    };
    const auto pulls_under = [&](const auto& ground) -> Pulls<T> {
        return {pull_on(from_plus, ground), pull_on(!from_plus, T(-1) * ground)};
    };
    const auto ground_now = excitation.ground(phase);
    const Pulls<T> now = pulls_under(ground_now);
    const T weaker = now.weaker();
    // Without loss or pull, no series ends; 1 avoids divisions by zero.
    const T loss = 1 - sqrt(block.restitution);
    const mask_t<T> fades = slow && loss > 0 && weaker > 0;
    const T series = rate / select<T>(fades, loss, 1);           // v (1 + sqrt r + r + ...)
    const T duration = 3 * series / select<T>(fades, weaker, 1); // D

    // A lane without an impact may have a negative rate and thus a phase far before the pulse.
    const T over = phase + duration * excitation.frequency;
    const mask_t<T> in_time = fades && over >= phase && over <= T(excitation.motion.end) &&
                              excitation.motion.is_monotone(phase, over);
    const Pulls<T> then = pulls_under(excitation.ground(select<T>(in_time, over, phase)));
    constexpr bool one_increases = std::same_as<decltype(ground_now), const T>;
    const mask_t<T> short_enough =
        all_flights_end_within<one_increases, T>(duration, series + series, now, then);
    // On the other side, the square of the rate is larger by R_i / R_j. A change of the tilt
    // changes the pull by no more than the stiffness.
    const T smaller =
        weaker / greater<T>(block.other.frequency_parameter / block.frequency_parameter, 1);
    const T stiffness = gravity_of(ground_now, T(1)) + abs(horizontal_of(ground_now));
    const mask_t<T> low = 10 * rate * rate * stiffness <= smaller * smaller;
    return weaker > 0 && ((in_time && short_enough && low) || rate == 0);
}

} // namespace overturn
