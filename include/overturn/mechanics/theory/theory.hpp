// The theories of the block between impacts. Each is a specialisation of Equations in a header of
// its own; theories.hpp lists them.
#pragma once

namespace overturn {

enum class Theory { nonlinear, linear };

/// The equations of a theory: static functions of the side on which the block rocks (BlockSide) and
/// of the tilt |theta| [rad], which is never negative. With y = alpha - |theta|, the steppers and
/// the energy criteria rely on what RockingTheory requires.
template <Theory theory>
struct Equations;

/// What the steppers and the criteria assume: the restoring moment over m g R is at most |y|, and
/// its potential has one top, at y = 0.
template <Theory theory>
concept RockingTheory =
    Equations<theory>::moment_is_at_most_distance && Equations<theory>::has_one_top;

} // namespace overturn
