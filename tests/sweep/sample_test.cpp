#include "sample.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/problem.hpp"
#include "support/given_values.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace overturn {
namespace {

Grid grid_of_size(std::int64_t frequencies, std::int64_t amplitudes, std::int64_t blocks)
{
    return grid_of({}, {number("slenderness", 0.1745716),
                        axis("restitution", AxisRange{0.5, 0.9, blocks}),
                        axis("amplitude", AxisRange{1.2, 12, amplitudes}),
                        axis("frequency", AxisRange{0.5, 8, frequencies})});
}

struct Met {
    std::size_t points = 0;
    std::set<double> frequencies, amplitudes, restitutions;
};

Met met_by(const Grid& grid, std::int64_t wanted)
{
    const Tiling tiling = tiling_of({.grid = grid});
    const std::vector<std::vector<int>> chosen = evenly_chosen(tiling, wanted);
    EXPECT_EQ(std::int64_t(chosen.size()), tiling.size());
    const Scene scene;
    const std::vector<std::size_t> all{0, 1, 2};
    Met met;
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        const Tile tile = tiling[i];
        const Coordinates coordinates(scene, grid, tile);
        const std::vector<double> restitution = coordinates.along(all, "restitution");
        const std::vector<double> amplitude = coordinates.along(all, "amplitude");
        const std::vector<double> frequency = coordinates.along(all, "frequency");
        int last = -1;
        for (const int point : chosen[std::size_t(i)]) {
            EXPECT_GT(point, last) << "ascending and unique";
            EXPECT_LT(point, tile.points());
            last = point;
            ++met.points;
            met.frequencies.insert(frequency[std::size_t(point)]);
            met.amplitudes.insert(amplitude[std::size_t(point)]);
            met.restitutions.insert(restitution[std::size_t(point)]);
        }
    }
    return met;
}

TEST(EvenlyChosen, PointsIncludeEveryFrequencyAndAmplitude)
{
    // With powers of two for all three, a constant stride would reach only four columns.
    for (const std::int64_t side : {128, 120}) {
        const Met met = met_by(grid_of_size(side, side, 2), 1024);
        EXPECT_NEAR(double(met.points), 1024, 20);
        EXPECT_EQ(std::int64_t(met.frequencies.size()), side);
        EXPECT_EQ(std::int64_t(met.amplitudes.size()), side);
        EXPECT_EQ(met.restitutions.size(), 2u);
    }
}

TEST(EvenlyChosen, PointsAreAllPointsOfASmallGrid)
{
    for (const std::int64_t wanted : {4000, 2000, 1201}) {
        EXPECT_EQ(met_by(grid_of_size(40, 30, 2), wanted).points, 2400u);
    }
}

TEST(EvenlyChosen, MayBeASinglePoint)
{
    EXPECT_EQ(met_by(grid_of_size(300, 200, 1), 1).points, 1u);
    EXPECT_EQ(met_by(grid_of_size(1, 1, 1), 1).points, 1u);
}

TEST(SampleOfAGrid, ExtendsOverTheWholeOfEachAxis)
{
    const Grid grid = grid_of_size(3000, 2000, 5);
    const Grid sample = sample_of(grid, 30000);
    EXPECT_LE(sample.points(), 30000);
    EXPECT_GT(sample.points(), 29000);
    EXPECT_EQ(sample.find("restitution")->values.size(), 3);
    for (const char* name : {"restitution", "amplitude", "frequency"}) {
        EXPECT_EQ(sample.find(name)->values.first(), grid.find(name)->values.first());
        EXPECT_EQ(sample.find(name)->values.last(), grid.find(name)->values.last());
    }
}

} // namespace
} // namespace overturn
