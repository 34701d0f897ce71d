// The regions of a tile at the cost of their boundaries: cells of a quad-tree in which nothing
// changes are filled. That a cell is uniform is concluded from nine of its points; this rests on
// numerical evidence, not on a proof. See docs/filling.md.
#pragma once

#include "overturn/sweep/compute_tile.hpp"

#include <cstdint>
#include <vector>

namespace overturn {

/// The conditions under which a cell is filled. Tests use weaker ones.
struct FillRule {
    /// Each switch function exceeds kappa/2 times its second differences between the nodes of a
    /// cell; kappa = 0.25 is the nominal error of an interpolation. After
    /// n > 3 impacts it is multiplied by 2 (n - 2), except where `low` applies: every impact of a
    /// series increases small differences [1].
    double kappa = 4;
    /// In a cell of region S, impacts are ignored, unless they are stored, if the largest tilt
    /// times exp(pi / Omega) is below this at every node [alpha].
    double low = 0.1;
    bool grazes = true; ///< whether impacts that could appear or vanish are considered
};

struct FilledTile {
    std::vector<std::uint8_t> region;
    std::vector<std::uint16_t> impacts;  ///< only if requested
    std::vector<std::uint8_t> evaluated; ///< 1: integrated, 0: filled
    AuditCount audit;
};

/// Fills a tile of a spectrum under a pulse, along its strengths and rates; the tile has one value
/// of every other coordinate. If the audit finds a wrong point, every point is integrated. The
/// result depends on the problem and the tile, not on the kernel.
FilledTile fill_tile(const Problem& problem, const Tile& tile, Kernel kernel,
                     DropRequested drop_requested = nullptr, const FillRule& rule = {});

} // namespace overturn
