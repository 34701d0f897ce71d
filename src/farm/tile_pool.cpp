#include "overturn/farm/tile_pool.hpp"

#include <algorithm>

namespace overturn {

namespace {

constexpr int length_bits = 24;

std::int64_t length(std::uint64_t packed)
{
    return std::int64_t(packed & ((std::uint64_t(1) << length_bits) - 1));
}

std::int64_t first(std::uint64_t packed)
{
    return std::int64_t(packed >> length_bits);
}

std::uint64_t pack(std::int64_t first, std::int64_t length)
{
    return length == 0 ? 0 : std::uint64_t(first) << length_bits | std::uint64_t(length);
}

} // namespace

std::optional<std::int64_t> TilePool::take()
{
    for (std::atomic<Packed>& range : ranges_) {
        Packed found = range.load();
        while (length(found) > 0) {
            if (range.compare_exchange_weak(found, pack(first(found) + 1, length(found) - 1))) {
                return first(found);
            }
        }
    }
    return {};
}

std::int64_t TilePool::tiles() const
{
    std::int64_t tiles = 0;
    for (const std::atomic<Packed>& range : ranges_) {
        tiles += length(range.load());
    }
    return tiles;
}

int TilePool::room() const
{
    return int(std::count(ranges_.begin(), ranges_.end(), Packed(0)));
}

void TilePool::put(const TileRange& range)
{
    *std::find(ranges_.begin(), ranges_.end(), Packed(0)) = pack(range.begin, range.length());
}

void TilePool::clear()
{
    for (std::atomic<Packed>& range : ranges_) {
        range = 0;
    }
}

} // namespace overturn
