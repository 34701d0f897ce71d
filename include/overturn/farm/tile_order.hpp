// The order in which the tiles of a plane are computed. Neighbours cost alike, and the costliest
// tiles, of slow pulses, are often the first: in the order of their numbers, the time of the first
// ones would say little about the time left. In this order, each beginning is spread over the
// plane.
#pragma once

#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

namespace overturn {

/// Place k has the tile n / 2 + k step mod n: a Kronecker sequence, whose step is next to n over
/// the golden ratio, and has no divisor in common with n, so that every tile has a place.
class TileOrder {
public:
    explicit TileOrder(std::int64_t tiles) : tiles_(tiles)
    {
        constexpr std::int64_t most = std::int64_t(1) << 31; // products fit into 64 bits
        if (tiles < 3 || tiles > most) {
            return; // in the order of their numbers
        }
        first_ = tiles / 2;
        step_ = std::int64_t(double(tiles) / std::numbers::phi);
        while (std::gcd(step_, tiles) != 1) {
            ++step_; // tiles - 1 has none
        }
    }

    /// The tile at a place.
    std::int64_t tile(std::int64_t place) const { return (first_ + place * step_) % tiles_; }

    /// The places of tiles, in ascending order.
    std::vector<std::int64_t> places_of(const std::vector<std::int64_t>& tiles) const
    {
        if (tiles.empty()) {
            return {};
        }
        std::vector<bool> is_chosen(std::size_t(tiles_), false);
        for (const std::int64_t each : tiles) {
            is_chosen[std::size_t(each)] = true;
        }
        std::vector<std::int64_t> places;
        places.reserve(tiles.size());
        for (std::int64_t place = 0; place < tiles_; ++place) {
            if (is_chosen[std::size_t(tile(place))]) {
                places.push_back(place);
            }
        }
        return places;
    }

private:
    std::int64_t tiles_;
    std::int64_t first_ = 0;
    std::int64_t step_ = 1;
};

} // namespace overturn
