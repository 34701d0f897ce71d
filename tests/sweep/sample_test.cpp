#include "sample.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace overturn {
namespace {

Plane plane_of(std::int64_t frequencies, std::int64_t amplitudes, std::int64_t blocks)
{
    Plane plane;
    plane.frequency = Axis(AxisRange{0.5, 8, frequencies, Spacing::linear});
    plane.amplitude = Axis(AxisRange{1.2, 12, amplitudes, Spacing::linear});
    plane.restitution = Axis(AxisRange{0.5, 0.9, blocks, Spacing::linear});
    plane.slenderness = Axis(AxisList{0.1745716});
    return plane;
}

struct Met {
    std::size_t points = 0;
    std::set<double> frequencies, amplitudes, restitutions;
};

Met met_by(const Plane& plane, std::int64_t wanted)
{
    const Tiling tiling(plane);
    const std::vector<std::vector<int>> chosen = evenly_chosen(tiling, wanted);
    EXPECT_EQ(std::int64_t(chosen.size()), tiling.size());
    Met met;
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        const Tile tile = tiling[i];
        int last = -1;
        for (const int point : chosen[std::size_t(i)]) {
            EXPECT_GT(point, last) << "ascending and unique";
            EXPECT_LT(point, tile.points());
            last = point;
            ++met.points;
            met.frequencies.insert(plane.frequency[tile.begin[3] + point % tile.columns()]);
            met.amplitudes.insert(plane.amplitude[tile.begin[2] + point / tile.columns()]);
            met.restitutions.insert(plane.restitution[tile.begin[1]]);
        }
    }
    return met;
}

TEST(EvenlyChosen, PointsIncludeEveryFrequencyAndAmplitude)
{
    // With powers of two for all three, a constant stride would reach only four columns.
    for (const std::int64_t side : {128, 120}) {
        const Met met = met_by(plane_of(side, side, 2), 1024);
        EXPECT_NEAR(double(met.points), 1024, 20);
        EXPECT_EQ(std::int64_t(met.frequencies.size()), side);
        EXPECT_EQ(std::int64_t(met.amplitudes.size()), side);
        EXPECT_EQ(met.restitutions.size(), 2u);
    }
}

TEST(EvenlyChosen, PointsAreAllPointsOfASmallPlane)
{
    for (const std::int64_t wanted : {4000, 2000, 1201}) {
        EXPECT_EQ(met_by(plane_of(40, 30, 2), wanted).points, 2400u);
    }
}

TEST(EvenlyChosen, MayBeASinglePoint)
{
    EXPECT_EQ(met_by(plane_of(300, 200, 1), 1).points, 1u);
    EXPECT_EQ(met_by(plane_of(1, 1, 1), 1).points, 1u);
}

TEST(SampleOfAPlane, ExtendsOverTheWholeOfEachAxis)
{
    const Plane plane = plane_of(3000, 2000, 5);
    const Plane sample = sample_of(plane, 30000);
    EXPECT_LE(sample.points(), 30000);
    EXPECT_GT(sample.points(), 29000);
    EXPECT_EQ(sample.restitution.size(), 3);
    EXPECT_EQ(sample.frequency.first(), plane.frequency.first());
    EXPECT_EQ(sample.frequency.last(), plane.frequency.last());
    EXPECT_EQ(sample.amplitude.first(), plane.amplitude.first());
    EXPECT_EQ(sample.amplitude.last(), plane.amplitude.last());
}

} // namespace
} // namespace overturn
