// The end of a bounce series in closed form: infinitely many impacts in finite time.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"

namespace overturn {

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
template <Theory theory, Number T>
mask_t<T> bounces_die_out(const Block<T>& block, const auto& excitation, const T& phase,
                          const T& rate)
{
    using std::abs;
    using std::sqrt;
    using S = scalar_t<T>;
    const T zero(S(0));
    const T one(S(1));
    // Most impacts are faster than this and need no further check. Unless the ground accelerates
    // upwards, the weaker pull is at most alpha, so that none of them would pass it.
    const T& alpha = block.slenderness;
    const mask_t<T> slow = T(S(10)) * rate * rate <= alpha * alpha;
    if (!any<T>(slow)) {
        return slow;
    }
    const auto pull = [&](const auto& push) -> T {
        return -rocking_acceleration<theory>(zero, block.slenderness, push);
    };
    const auto ground_now = excitation.ground(phase);
    const T plus = pull(ground_now);
    const T minus = pull(mirrored(ground_now));
    const T weaker = select<T>(plus < minus, plus, minus);
    // Without loss or pull, no series ends; 1 avoids divisions by zero.
    const T loss = one - T(sqrt(block.restitution));
    const mask_t<T> fades = slow && loss > zero && weaker > zero;
    const T series = rate / select<T>(fades, loss, one);                 // v (1 + sqrt r + r + ...)
    const T duration = T(S(3)) * series / select<T>(fades, weaker, one); // D

    // A lane without an impact may have a negative rate and thus a phase far before the pulse.
    const T over = phase + duration * excitation.frequency;
    const mask_t<T> in_time = fades && over >= phase && over <= T(excitation.motion.end) &&
                              excitation.motion.is_monotone(phase, over);
    const auto ground_then = excitation.ground(select<T>(in_time, over, phase));
    const T plus_then = pull(ground_then);
    const T minus_then = pull(mirrored(ground_then));
    const T twice = series + series;
    mask_t<T> short_enough;
    if constexpr (std::same_as<decltype(ground_now), const T>) {
        const mask_t<T> plus_rises = plus_then >= plus;
        const T rise = select<T>(plus_rises, plus, minus);
        const T rise_then = select<T>(plus_rises, plus_then, minus_then);
        const T fall_then = select<T>(plus_rises, minus_then, plus_then);
        const T growth =
            sqrt(select<T>(rise > zero, rise_then, zero) / select<T>(rise > zero, rise, one));
        short_enough = twice <= duration * rise && twice * growth <= duration * fall_then;
    } else {
        const auto growth = [&](const T& first, const T& last) -> T {
            return sqrt(greater<T>(last / select<T>(first > zero, first, one), one));
        };
        const T least = lesser<T>(weaker, lesser<T>(plus_then, minus_then));
        short_enough =
            twice * growth(plus, plus_then) * growth(minus, minus_then) <= duration * least;
    }
    const mask_t<T> low =
        T(S(10)) * rate * rate * largest_stiffness<T>(ground_now) <= weaker * weaker;
    return weaker > zero && ((in_time && short_enough && low) || rate == zero);
}

} // namespace overturn
