// A block that the ground barely lifts and that loses little energy bounces thousands of times.
// The height of its bounces is bounded here without integrating them.
#pragma once

#include "overturn/mechanics/pulse_excitation.hpp"
#include "overturn/mechanics/record_excitation.hpp"
#include "overturn/mechanics/theory/theories.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace overturn {

/// Upper bounds at the end of a pulse, of the block on either side.
struct LowBounces {
    double tilt; ///< of |theta| [rad]
    double rate; ///< of |theta'| [rad]
};

/// A step of bound_of_low_bounces() on one side, in the letters of its equations.
struct LowBounceStep {
    double duration; ///< [1/p]
    double highest;  ///< the tilt above which there is no bound [rad]
    double k;
    double tangent; ///< tan(alpha), see Equations::lever_growth()
    double size;    ///< R
    double growth = duration < 1 ? k * duration * duration : 1;
    double weakest = 0; ///< g: the smallest pull towards the ground
    double rise = 0;    ///< the largest increase of the pull

    /// The largest tilt of a flight of the energy e.
    double height(double e) const
    {
        const double& g = weakest;
        const double square = g * g - 2 * k * e;
        return g > 0 && square > 0 ? 2 * e / (g + std::sqrt(square)) : 2 * highest;
    }

    /// The largest tilt at the end of a step of a flight of the energy e that begins at `tilt`: it
    /// increases by the duration of the step times the bound of x' at the increased x, which is the
    /// larger root of a quadratic equation.
    double tilt_after(double e, double tilt, double lifting) const
    {
        const double linear = tilt + lifting * duration * duration;
        const double constant = tilt * tilt - 2 * e * duration * duration;
        return (linear + std::sqrt(std::max(0.0, linear * linear - (1 - growth) * constant))) /
               (1 - growth);
    }
};

/// The bounds of a block after some steps.
struct LowBounceBounds {
    double energy; ///< R e
    double tilt;

    /// An energy that is not exceeded by the growth computed from it, and its largest tilt.
    std::optional<LowBounceBounds> after(const std::array<LowBounceStep, 2>& sides,
                                         double lifting) const
    {
        for (double guess = energy + std::numeric_limits<double>::min();; guess *= 1.01) {
            double bound = energy;
            double higher = 0;
            for (const LowBounceStep& side : sides) {
                const double e = guess / side.size;
                const double here = std::min(side.tilt_after(e, tilt, lifting), side.height(e));
                if (here > side.highest) {
                    return std::nullopt;
                }
                higher = std::max(higher, here);
                bound = std::max(bound,
                                 energy + side.size * side.rise * here * (1 + here * side.tangent));
            }
            if (bound <= guess) {
                return LowBounceBounds{bound, higher};
            }
            guess = bound;
        }
    }
};

/// Bounds for any restitution up to 1; none unless the tilt is at most a quarter of alpha. block:
/// as seen from its side plus.
///
/// With the pull towards the ground on one side, g(t, x) = sin(alpha - x) +- A(t) cos(alpha - x) at
/// the tilt x (alpha - x +- A(t) in the linear theory), the energy of a flight is
///
///     e = x'^2 / 2 + int_0^x g(t, s) ds,    de/dt <= max(0, dg(t, 0)/dt) x (1 + x tan(alpha))
///
/// Impacts do not increase R e, so one bound of it is valid for all flights, with R = 1 if the
/// block is symmetric; E is the bound of e on one side. g(t, x) >= g(t, 0) - k x with k = sqrt(1 +
/// A^2) (1 in the linear theory) gives bounds of x and x':
///
///     |x'|^2 <= 2 E + 2 max(0, -g) x + k x^2,     and where g > 0    g x - k x^2 / 2 <= E.
///
/// The bounds are advanced through the pulse in steps. Each step uses bounds of the weakest pull
/// and of the largest increase of the pull within the step.
///
/// step: of the phase; between: the most by which the ground acceleration exceeds its values at the
/// ends of a step within a smooth piece.
template <Theory theory>
std::optional<LowBounces> bound_of_low_bounces(const Block<double>& block, const auto& excitation,
                                               double step, double between)
{
    const double most = excitation.largest_acceleration();
    const std::array<Block<double>, 2> seen{block, block.turned()};
    const bool is_symmetric = block.is_symmetric();
    const auto step_on = [&](const Block<double>& side) -> LowBounceStep {
        const double frequency =
            excitation.frequency / (is_symmetric ? 1 : side.frequency_parameter);
        return {.duration = step / frequency,
                .highest = side.slenderness / 4,
                .k = Equations<theory>::largest_stiffness(most),
                .tangent = Equations<theory>::lever_growth(side),
                .size = side.size};
    };
    std::array<LowBounceStep, 2> sides{step_on(seen[0]), step_on(seen[1])};
    for (const std::size_t i : {0, 1}) {
        if (most > 2 * Equations<theory>::uplift_acceleration(seen[i]) || sides[i].growth > 0.01) {
            return std::nullopt; // the push is too strong, or the step too long
        }
    }

    const auto pull = [&](double phase, std::size_t i) -> double {
        const double push = (i == 0 ? 1 : -1) * horizontal_of(excitation.ground(phase));
        return -Equations<theory>::acceleration(seen[i], 0.0, push);
    };
    const auto& motion = excitation.motion;
    double phase =
        excitation.next_uplift(true, motion.begin, -std::numeric_limits<double>::infinity());
    LowBounceBounds bounds{0, 0};
    double rate = 0;
    while (phase < motion.end) {
        const double next = std::min(phase + step, motion.end_of_piece(phase));
        for (const std::size_t i : {0, 1}) {
            const double first = pull(phase, i);
            const double last = pull(next, i);
            sides[i].weakest = std::min(first, last) - between;
            sides[i].rise = std::max(0.0, last - first) + 2 * between;
        }
        const double lifting = std::max(0.0, -std::min(sides[0].weakest, sides[1].weakest));
        const auto after = bounds.after(sides, lifting);
        if (!after) {
            return std::nullopt;
        }
        bounds = *after;
        const double tilt = bounds.tilt;
        const double energy = bounds.energy / std::min(sides[0].size, sides[1].size);
        rate = std::sqrt(2 * energy + 2 * lifting * tilt + sides[0].k * tilt * tilt);
        phase = next;
    }
    return LowBounces{bounds.tilt, rate};
}

inline constexpr double step_of_pulse = std::numbers::pi / (1 << 12); // [rad]

template <Theory theory>
std::optional<LowBounces> bound_of_low_bounces(const Block<double>& block,
                                               const PulseExcitation<double>& excitation)
{
    const double step = step_of_pulse;
    const double between =
        excitation.motion.largest_curvature() / 8 * step * step * excitation.largest_acceleration();
    return bound_of_low_bounces<theory>(block, excitation, step, between);
}

/// None with a vertical motion.
template <Theory theory>
std::optional<LowBounces>
bound_of_low_bounces(const Block<double>& block,
                     const RecordExcitation<double, Directions::both>& excitation)
{
    if (!excitation.motion.record->upwards().empty()) {
        return std::nullopt;
    }
    const double step = excitation.motion.has_own_phases() ? step_of_pulse : 0.125; // [samples]
    return bound_of_low_bounces<theory>(block, excitation, step, 0.0);
}

} // namespace overturn
