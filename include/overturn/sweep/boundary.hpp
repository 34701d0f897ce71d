// Boundaries between safe and unsafe: for one block at one frequency, the amplitudes at which the
// verdict changes, in ascending order.
#pragma once

#include "overturn/mechanics/region.hpp"
#include "overturn/problem/point.hpp"
#include "overturn/problem/scene.hpp"
#include "overturn/problem/tile.hpp"
#include "overturn/sweep/kernel.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace overturn {

/// A change of the verdict, either between two amplitudes with different settled verdicts, or from
/// a settled amplitude to an undecided range that ends at the next settled amplitude, or back.
struct Flip {
    double below;        ///< [1]
    double above;        ///< [1]
    Region region_below; ///< Region::undecided if the verdict could not be settled
    Region region_above; ///< Region::undecided if the verdict could not be settled

    double amplitude() const { return below + (above - below) / 2; }
};

/// How closely a line is searched for flips; step and width over the amplitude [1].
struct FlipSearch {
    /// Steps of the scan that are smaller are not halved. Under a record all steps are divided
    /// evenly until each is at most this.
    double finest_step;
    double flip_width; ///< of the two amplitudes of a flip, unless they are adjacent doubles
    std::size_t most_flips = std::numeric_limits<std::size_t>::max();
    /// The largest number of amplitudes that are computed in 50 digits.
    int most_in_50_digits = std::numeric_limits<int>::max();
    /// After this many amplitudes, no further steps are halved; after as many again, no strips are
    /// searched for between neighbours.
    std::size_t most_amplitudes = std::numeric_limits<std::size_t>::max();
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

/// One line through a plane.
struct BoundaryLine {
    Point point;     ///< its amplitude is not used
    double unit = 1; ///< the strength at the amplitude 1; negative: the mirrored motion
};

/// The largest strength at which no vertical motion cancels gravity, but for more than the
/// roundings of a scale; infinite without a vertical motion.
double last_before_free_fall(const Scene& scene, const BoundaryLine& line);

/// A part of a line that was searched in steps wider than the finest ones, although the margins
/// indicate further flips.
struct CoarseSearch {
    double first; ///< [1]
    double last;  ///< [1]
    double step;  ///< the widest one, over its upper amplitude [1]
};

struct Boundary {
    Region region_at_first = Region::undecided; ///< at the first amplitude
    std::vector<Flip> flips;                    ///< in ascending order
    bool complete = true;                       ///< all computed verdicts could be settled
    bool has_more = false;                      ///< there are flips above the last one
    std::optional<CoarseSearch> coarse;         ///< set if the effort was limited
    /// The shares of the interval of amplitudes at which the block overturns, and in which verdicts
    /// could not be settled; under a record only, otherwise 0 [1].
    double unsafe_share = 0;
    double undecided_share = 0;
};

/// The lowest flips, at most `most_flips`, between the first and the last of these ascending
/// amplitudes, all of which are computed.
/// Steps wider than an eighth of the amplitude are divided, and steps are halved where the margin
/// is not linear or the number of impacts changes, down to the finest step of the search. If the
/// verdicts of two neighbours differ, there is a flip between them. If they overturn to different
/// sides, there is a safe strip between them, however narrow, unless the sides of the block differ
/// so much that r > W_i / W_j. If |margin| has a local minimum, there may be two flips next to it,
/// and the minimum is searched for them. Only a strip narrower than two steps of the scan that
/// satisfies none of these criteria can be missed. Under a record all steps are divided evenly
/// until each is at most `finest_step`; the other criteria are not applied, and narrower strips are
/// missed. search: default: flip_search().
Boundary boundary_on(const Scene& scene, const BoundaryLine& line,
                     const std::vector<double>& amplitudes, Kernel kernel,
                     const std::optional<FlipSearch>& search = std::nullopt);

} // namespace overturn
