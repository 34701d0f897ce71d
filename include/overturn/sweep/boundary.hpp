// Where verdicts flip: for one block at one frequency, all amplitudes at which safe turns to unsafe
// or back, in order.
#pragma once

#include "overturn/mechanics/region.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/scene.hpp"
#include "overturn/sweep/sweep_tile.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace overturn {

/// Where the verdict changes: between two amplitudes whose own verdicts are settled, and differ; or
/// at a settled one, beyond which it is undecided, up to the next settled one.
struct Flip {
    double below;        ///< [1]
    double above;        ///< [1]
    Region region_below; ///< Region::undecided where verdicts could not be settled
    Region region_above; ///< the same

    double amplitude() const { return below + (above - below) / 2; }
};

/// The two amplitudes of a flip are this close, over themselves, or neighbours among the doubles
/// [1].
inline constexpr double flip_width = 1e-12;

/// Steps of a scan over their amplitude, below which they are not halved any more [1].
inline constexpr double finest_step = 1e-6;

/// One line through a plane: everything but the amplitude.
struct BoundaryLine {
    double slenderness; ///< [rad]
    double restitution; ///< r [1]
    double frequency;   ///< Omega [1]
};

struct Boundary {
    Region region_at_first = Region::undecided; ///< at the first amplitude
    std::vector<Flip> flips;                    ///< in ascending order
    bool complete = true;  ///< every verdict that was looked at could be settled
    bool has_more = false; ///< there are flips beyond the last one
};

/// The lowest flips, most_flips at most, between the first and the last of these ascending
/// amplitudes, which are all looked at.
/// Steps are halved where the margin bends or the impacts change, down to finest_step. Where two
/// neighbours differ in their verdict, a flip is between them. Where both overturn, but to
/// different sides, a safe strip is between them, however thin. And where the margin has come
/// nearest to 0, without reaching it, two flips may be: what is there is found by going on to its
/// extremum. Missed can only be a strip thinner than two steps of the scan of which none of these
/// tells.
Boundary boundary_on(const Scene& scene, const BoundaryLine& line,
                     const std::vector<double>& amplitudes, Kernel kernel,
                     std::size_t most_flips = std::numeric_limits<std::size_t>::max(),
                     DropRequested drop_requested = nullptr);

/// Value of region_below and region_above, beyond those of regions, where there is no flip.
inline constexpr std::uint8_t no_flip = 253;

/// The boundaries of a tile whose rows are the flips of a line, from the first on, and whose
/// columns are frequencies. Values in the order of boundary_fields; not a number and no_flip beyond
/// the last flip, but region_below of a line without any is the region at the first amplitude.
/// Where there are more flips than rows, the last region_above is undecided.
TileFields boundary_tile(const Scene& scene, const Plane& plane,
                         const std::vector<double>& amplitudes, const Tile& tile, Kernel kernel,
                         DropRequested drop_requested = nullptr);

} // namespace overturn
