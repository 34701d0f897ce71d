// The division of a job into parts: separate runs compute them, each into a file of its own, and
// `overturn merge` joins the files.
#pragma once

#include "overturn/problem/tile_order.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace overturn {

/// One of the parts of a job.
struct JobPart {
    std::int64_t number = 1; ///< 1, 2, ..., count
    std::int64_t count = 1;  ///< at most the number of tiles

    bool operator==(const JobPart&) const = default;
};

/// "part 3 of 16".
inline std::string words_of(const JobPart& part)
{
    return "part " + std::to_string(part.number) + " of " + std::to_string(part.count);
}

/// The division of tiles into parts, whose numbers of tiles differ by at most 1. A part has
/// consecutive places of TileOrder, which are spread evenly over the plane: of 16 parts with 250
/// tiles each, the slowest takes at most 1.1 times the mean time. (Costly tiles are neighbours: if
/// parts were rows of tiles, or columns of them, it could take five times the mean.)
class JobDivision {
public:
    JobDivision(std::int64_t tiles, std::int64_t parts)
        : order_(tiles), each_(tiles / parts), longer_(tiles % parts)
    {}

    /// The number of the part to which a tile belongs.
    std::int64_t part_of(std::int64_t tile) const
    {
        const std::int64_t place = order_.place(tile);
        const std::int64_t in_longer = longer_ * (each_ + 1);
        return 1 +
               (place < in_longer ? place / (each_ + 1) : longer_ + (place - in_longer) / each_);
    }
    std::int64_t tiles_in(std::int64_t part) const { return each_ + (part <= longer_ ? 1 : 0); }

private:
    TileOrder order_;
    std::int64_t each_;   ///< the number of tiles of a part
    std::int64_t longer_; ///< the number of parts that have one more, the first ones
};

/// The tiles of a part; without one, all tiles of the job.
class TilesOfPart {
public:
    TilesOfPart(std::int64_t tiles, const std::optional<JobPart>& part)
        : division_(tiles, part ? part->count : 1), number_(part ? part->number : 1)
    {}

    std::int64_t size() const { return division_.tiles_in(number_); }
    bool contains(std::int64_t tile) const { return division_.part_of(tile) == number_; }

private:
    JobDivision division_;
    std::int64_t number_;
};

} // namespace overturn
