// The order in which the tiles of a plane are computed. Neighbours cost alike, and the costliest
// tiles, of slow pulses, are often the first: in the order of their numbers, the time of the first
// ones would say little about the time left. In this order, each beginning is spread over the
// plane.
#pragma once

#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>
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
        inverse_ = inverse_of_step();
    }

    /// The tile at a place.
    std::int64_t tile(std::int64_t place) const { return (first_ + place * step_) % tiles_; }

    /// The place of a tile.
    std::int64_t place(std::int64_t tile) const
    {
        return (tile - first_ + tiles_) % tiles_ * inverse_ % tiles_;
    }

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
    /// Its product with the step is 1 mod n, by Euclid's algorithm: each remainder is the step
    /// times its factor mod n.
    std::int64_t inverse_of_step() const
    {
        std::int64_t before = tiles_, remainder = step_;
        std::int64_t factor_before = 0, factor = 1;
        while (remainder > 1) {
            const std::int64_t quotient = before / remainder;
            before = std::exchange(remainder, before - quotient * remainder);
            factor_before = std::exchange(factor, factor_before - quotient * factor);
        }
        return factor < 0 ? factor + tiles_ : factor;
    }

    std::int64_t tiles_;
    std::int64_t first_ = 0;
    std::int64_t step_ = 1;
    std::int64_t inverse_ = 1; ///< of the step, mod n
};

} // namespace overturn
