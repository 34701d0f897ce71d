// Whether a cell of a spectrum is uniform, as far as nine of its points show. The nodes of a cell
// are its corners, the middles of its sides and its middle.
#pragma once

#include "point_run.hpp"

#include "overturn/sweep/fill.hpp"

#include <array>
#include <cstdint>

namespace overturn {

/// The switch functions: a code or a number of impacts changes only where one of them is zero.
/// Only their ratios to their own differences matter. c, u, q_min: see energy_criteria.hpp. If the
/// sides of the block differ, those that bound safe states are scaled to 1 at rest on both sides.
enum class Switch {
    outward,    ///< c - u: overturning on the side of the tilt
    inward,     ///< u + sqrt(c^2 - q_min): overturning on the other side after one impact; if the
                ///< sides differ, q0 - q_min
    back,       ///< q0 - q_min: overturning after two impacts, only if the sides differ
    impact,     ///< u + c: an impact after the pulse
    rebound,    ///< sqrt(r) c - u: if positive, an impact at the end of the pulse leaves a safe
                ///< block in region S; if the sides differ: c - u of the other side, before it
    end_tilt,   ///< tilt at the end of the pulse: an impact just before or after the end
    room,       ///< pi/2 - tilt at the end of the pulse: a fall just before the end
    time_left,  ///< phase from the fall to the end of the pulse
    fall_speed, ///< rate at the fall
    turn,       ///< lowest tilt at which the block turned outward: an impact could appear
    softest,    ///< speed of the softest impact before which it could turn: one could vanish
    last,       ///< speed of the last impact: it depends on all others
};
inline constexpr std::size_t switches = std::size_t(Switch::last) + 1;

/// An integrated point, as far as the test of a cell needs it.
struct CellNode {
    Region region;
    std::uint16_t flags; ///< see outcome_flag
    std::uint32_t lobes; ///< bit set of those that lift a block at rest
    int side;            ///< +1 or -1, at the end; 0 if the sides of the block are equal
    double impacts;      ///< counted
    double peak;         ///< largest tilt times exp(pi / Omega), see docs/filling.md [alpha]
    std::array<double, switches> values;
};

/// The outputs from which nodes are made.
inline constexpr Outputs node_outputs{
    .impacts = true, .peak = true, .region = true, .phase = true, .grazes = true};

/// The node at a point of a run with this outcome.
CellNode node_of(const PointRun& run, int point, const Outcome& outcome);

/// The nodes of a cell, row by row, with their places on both axes.
struct CellNodes {
    std::array<const CellNode*, 9> nodes;
    std::array<int, 3> rows;
    std::array<int, 3> columns;
};

/// Whether all points of a cell have the code of its nodes, and their number of impacts if it is
/// stored.
bool is_uniform(const CellNodes& cell, const FillRule& rule, bool with_impacts);

} // namespace overturn
