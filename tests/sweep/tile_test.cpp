#include "overturn/sweep/tile.hpp"

#include <gtest/gtest.h>

#include <set>

namespace overturn {
namespace {

Plane plane_of(std::int64_t slenderness, std::int64_t restitution, std::int64_t amplitude,
               std::int64_t frequency)
{
    Plane plane;
    plane.slenderness = Axis(AxisRange{0.1, 0.4, slenderness, Spacing::linear});
    plane.restitution = Axis(AxisRange{0.5, 1.0, restitution, Spacing::linear});
    plane.amplitude = Axis(AxisRange{1, 9, amplitude, Spacing::linear});
    plane.frequency = Axis(AxisRange{1, 9, frequency, Spacing::linear});
    return plane;
}

TEST(Tiling, CoversEveryPointOnce)
{
    const Plane plane = plane_of(2, 3, 23, 31);
    for (const auto& [rows, columns] : {std::pair{7, 8}, {1, 31}, {23, 1}, {64, 64}}) {
        const Tiling tiling(plane, rows, columns);
        std::set<std::array<std::int64_t, 4>> seen;
        for (std::int64_t n = 0; n < tiling.size(); ++n) {
            const Tile tile = tiling[n];
            EXPECT_EQ(tile.number, n);
            for (std::int64_t i = 0; i < tile.amplitude_count; ++i) {
                for (std::int64_t j = 0; j < tile.frequency_count; ++j) {
                    const bool is_new =
                        seen.insert({tile.slenderness, tile.restitution, tile.amplitude_begin + i,
                                     tile.frequency_begin + j})
                            .second;
                    EXPECT_TRUE(is_new);
                }
            }
        }
        EXPECT_EQ(std::int64_t(seen.size()), plane.points());
        EXPECT_EQ((*seen.rbegin()), (std::array<std::int64_t, 4>{1, 2, 22, 30}));
    }
}

TEST(Tiling, NumbersTilesFrequencyFastest)
{
    const Tiling tiling(plane_of(1, 2, 20, 20), 10, 10);
    EXPECT_EQ(tiling[1].frequency_begin, 10);
    EXPECT_EQ(tiling[2].amplitude_begin, 10);
    EXPECT_EQ(tiling[4].restitution, 1);
}

TEST(Tiling, CountsBeyondThirtyTwoBits)
{
    const Tiling tiling(plane_of(1, 1, std::int64_t(1) << 22, std::int64_t(1) << 22), 1, 1);
    EXPECT_EQ(tiling.size(), std::int64_t(1) << 44);
    const Tile last = tiling[tiling.size() - 1];
    EXPECT_EQ(last.frequency_begin, (std::int64_t(1) << 22) - 1);
    EXPECT_EQ(last.amplitude_begin, (std::int64_t(1) << 22) - 1);
}

} // namespace
} // namespace overturn
