// Boundaries between safe and unsafe: along the strength of the motion, or along another quantity,
// the values at which the verdict of a block changes, in ascending order.
#pragma once

#include "overturn/mechanics/region.hpp"
#include "overturn/problem/grid.hpp"
#include "overturn/problem/point.hpp"
#include "overturn/problem/scene.hpp"
#include "overturn/problem/tile.hpp"
#include "overturn/sweep/kernel.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace overturn {

/// A change of the verdict, either between two values with different settled verdicts, or from a
/// settled value to an undecided range that ends at the next settled value, or back.
struct Flip {
    double below;
    double above;
    Region region_below; ///< Region::undecided if the verdict could not be settled
    Region region_above; ///< Region::undecided if the verdict could not be settled

    double value() const { return below + (above - below) / 2; }
};

/// Steps of the scan along a quantity other than the strength under a pulse, over its range [1].
inline constexpr double widest_step_of_range = 1.0 / 400;

/// How closely a line is searched for flips; step and width over the strength, or over the range of
/// another quantity [1].
struct FlipSearch {
    /// Steps of the scan that are smaller are not halved. Under a record all steps are divided
    /// evenly until each is at most this.
    double finest_step;
    double flip_width; ///< of the two values of a flip, unless they are adjacent doubles
    std::size_t most_flips = std::numeric_limits<std::size_t>::max();
    /// The largest number of points that are computed in 50 digits.
    int most_in_50_digits = std::numeric_limits<int>::max();
    /// After this many points, no further steps are halved; after as many again, no strips are
    /// searched for between neighbours.
    std::size_t most_points = std::numeric_limits<std::size_t>::max();
    DropRequested drop_requested = nullptr;
};

/// Under a record, smaller steps find more flips, and the verdicts closer to a flip need more
/// digits. So do those of a block that may slip, for which there are none.
inline FlipSearch flip_search(const Scene& scene, bool may_slip = false)
{
    const MotionTraits& motion = scene.motion_traits();
    constexpr double width_with_slip = 1e-8;
    return {.finest_step = motion.finest_step,
            .flip_width =
                may_slip ? std::max(motion.flip_width, width_with_slip) : motion.flip_width};
}

/// The points of one block at all strengths of its motion.
struct BoundaryLine {
    Point point;     ///< its amplitude is not used
    double unit = 1; ///< the strength at the amplitude 1; negative: the mirrored motion

    /// The points at these strengths.
    std::vector<Point> points(std::span<const double> strengths) const;
};

/// The points of a problem that differ in one quantity of the block or of its loss at impacts.
struct QuantityLine {
    const Quantity* quantity;
    Grid others; ///< the other quantities, of single values

    /// The points with these ascending values of the quantity.
    std::vector<Point> points(const Scene& scene, const std::vector<double>& values) const;
};

/// The line along a quantity through a point of a grid. place: of the point along each dimension;
/// its value of the quantity, or of another spelling of it, is not used.
QuantityLine line_along(const Quantity& quantity, const Grid& grid, const Shape& place);

/// The largest strength at which no vertical motion cancels gravity, but for more than the
/// roundings of a scale; infinite without a vertical motion.
double last_before_free_fall(const Scene& scene, const BoundaryLine& line);

/// A part of a line that was searched in steps wider than the finest ones, although the margins
/// indicate further flips.
struct CoarseSearch {
    double first;
    double last;
    double step; ///< the widest one, over its upper strength or over the range [1]
};

struct Boundary {
    Region region_at_first = Region::undecided; ///< at the first value
    std::vector<Flip> flips;                    ///< in ascending order
    bool complete = true;                       ///< all computed verdicts could be settled
    bool has_more = false;                      ///< there are flips above the last one
    std::optional<CoarseSearch> coarse;         ///< set if the effort was limited
    /// The shares of the interval of values at which the block overturns, and in which verdicts
    /// could not be settled; under a record only, otherwise 0 [1].
    double unsafe_share = 0;
    double undecided_share = 0;
};

/// The lowest flips, at most `most_flips`, between the first and the last of these ascending
/// strengths, all of which are computed.
/// Steps wider than an eighth of the strength are divided, and steps are halved where the margin
/// is not linear or the number of impacts changes, down to the finest step of the search. If the
/// verdicts of two neighbours differ, there is a flip between them. If they overturn to different
/// sides, there is a safe strip between them, however narrow, unless the sides of the block differ
/// so much that r > W_i / W_j. If |margin| has a local minimum, there may be two flips next to it,
/// and the minimum is searched for them. Only a strip narrower than two steps of the scan that
/// satisfies none of these criteria can be missed. Under a record all steps are divided evenly
/// until each is at most `finest_step`; the other criteria are not applied, and narrower strips are
/// missed. search: default: flip_search().
Boundary boundary_on(const Scene& scene, const BoundaryLine& line,
                     const std::vector<double>& strengths, Kernel kernel,
                     const std::optional<FlipSearch>& search = std::nullopt);

/// The same along another quantity, by the same criteria, which assume no more than that the motion
/// varies continuously along the line. Steps and widths are shares of the range between the first
/// and the last value, because values may be 0 or negative. The steps of the scan are
/// `widest_step_of_range` under a pulse, and `finest_step` under a record. All values must be
/// allowed.
Boundary boundary_on(const Scene& scene, const QuantityLine& line,
                     const std::vector<double>& values, Kernel kernel,
                     const std::optional<FlipSearch>& search = std::nullopt);

} // namespace overturn
