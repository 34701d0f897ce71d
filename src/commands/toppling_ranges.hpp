// The ranges of peak ground acceleration in which a block topples.
#pragma once

#include "overturn/sweep/boundary.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace overturn {

/// The largest step of the scan under a record, over the acceleration [1].
inline constexpr double toppling_step = 0.005;

struct TopplingRanges {
    struct Range {
        double first; ///< peak ground acceleration over g
        double last;  ///< infinite if the block still topples at the end of the scan
    };
    std::vector<Range> toppling; ///< ascending; with the undecided accelerations next to them
    double undecided_share = 0;  ///< of the scanned accelerations [1]

    /// Such as "1.1110 to 1.6440 g, above 2.1300 g"; at most this many ranges, including the last.
    std::string text(int decimals,
                     std::size_t most = std::numeric_limits<std::size_t>::max()) const;

    /// At least 4, and enough to tell all ends of the ranges, and the acceleration `pga`, apart.
    int decimals(double pga) const;

    /// A list of [first, last], in which null stands for an infinite end.
    std::string json() const;
};

/// line: amplitudes in units of g. first: below it, the block is not lifted; last: of the scan.
/// included: an acceleration whose verdict the ranges must agree with.
TopplingRanges toppling_ranges(const Scene& scene, const BoundaryLine& line, double first,
                               double last, double included);

} // namespace overturn
