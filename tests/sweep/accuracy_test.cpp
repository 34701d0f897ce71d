#include "overturn/sweep/accuracy.hpp"
#include "support/given_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace overturn {
namespace {

/// The paper's block.
Grid papers_grid(const Given& amplitude, const Given& frequency)
{
    return grid_of(
        {}, {number("slenderness", 0.1745716), number("restitution", 0.9), amplitude, frequency});
}

const AccuracyStudy& study()
{
    static const AccuracyStudy made({},
                                    papers_grid(axis("amplitude", AxisRange{1.2, 12, 200}),
                                                axis("frequency", AxisRange{0.5, 8, 300})),
                                    1024, 64, widest_kernel());
    return made;
}

TEST(AccuracyStudy, DistributesItsSampleOverTheGrid)
{
    const Grid& sample = study().sample().grid;
    EXPECT_EQ(sample.find("frequency")->values.first(), 0.5);
    EXPECT_EQ(sample.find("frequency")->values.last(), 8);
    EXPECT_EQ(sample.find("amplitude")->values.first(), 1.2);
    EXPECT_EQ(sample.find("amplitude")->values.last(), 12);
    EXPECT_LE(sample.points(), 1024);
    EXPECT_GT(sample.points(), 900);
    EXPECT_EQ(study().sample().in_digits, 64);
}

TEST(AccuracyStudy, UsesAllPointsOfASmallGrid)
{
    const Grid grid =
        papers_grid(axis("amplitude", AxisList{2, 3}), axis("frequency", AxisList{1, 2, 5}));
    const AccuracyStudy small({}, grid, 1024, 100, widest_kernel());
    EXPECT_EQ(small.sample().grid.points(), 6);
    EXPECT_EQ(small.sample().in_digits, 6);
}

TEST(AccuracyStudy, CountsEveryPointByRegionAndByDistance)
{
    const AccuracySample& sample = study().sample();
    const auto sum = [](const auto& counts) {
        return std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
    };
    EXPECT_EQ(sample.settled, sample.grid.points());
    EXPECT_EQ(sum(sample.by_region), sample.settled);
    EXPECT_EQ(sum(sample.by_distance), sample.settled);
}

TEST(AccuracyStudy, HasErrorsThatDecreaseWithTheTolerance)
{
    for (const Method method : {Method::rk45, Method::taylor}) {
        const AccuracyRow loose = study().measure({method, 1e-5});
        const AccuracyRow tight = study().measure({method, 1e-10});
        // Five decades of tolerance; the median error of each method decreases by at least four.
        EXPECT_LT(tight.margin[0], 1e-4 * loose.margin[0]);
        EXPECT_GT(tight.steps, loose.steps);
        EXPECT_GT(tight.margin[0], 0);
        EXPECT_EQ(tight.wrong_verdicts, 0);
    }
}

TEST(AccuracyStudy, CurveOfRungeKuttaHasTheSlopeOfItsOrder)
{
    const AccuracyRow coarse = study().measure({Method::rk45, 1e-8});
    const AccuracyRow fine = study().measure({Method::rk45, 1e-11});
    const double slope =
        std::log(coarse.margin[0] / fine.margin[0]) / std::log(fine.steps / coarse.steps);
    // Order 5; slightly more because the cost of events does not depend on the tolerance.
    EXPECT_NEAR(slope, 5, 0.5);
}

TEST(AccuracyStudy, FindsWrongVerdictsAtLooseTolerancesAndNoneIfResolved)
{
    const AccuracyRow loose = study().measure({Method::rk45, 1e-2});
    EXPECT_GT(loose.wrong_verdicts, 0);
    EXPECT_EQ(std::accumulate(loose.wrong_verdicts_by_region.begin(),
                              loose.wrong_verdicts_by_region.end(), std::int64_t(0)),
              loose.wrong_verdicts);
    EXPECT_EQ(std::accumulate(loose.wrong_verdicts_by_distance.begin(),
                              loose.wrong_verdicts_by_distance.end(), std::int64_t(0)),
              loose.wrong_verdicts);
    const AccuracyRow resolved = study().measure({Method::taylor, 1e-2, true});
    EXPECT_EQ(resolved.wrong_verdicts, 0);
    EXPECT_EQ(resolved.undecided, 0);
}

TEST(AccuracyStudy, HasBoundsOnlyWhereErrorsAreKnown)
{
    EXPECT_TRUE(std::isnan(study().measure({Method::rk45, 1e-2}).bound_over_error));
    const AccuracyRow row = study().measure({Method::rk45, 1e-6});
    EXPECT_EQ(row.bound_exceeded, 0);
    EXPECT_GT(row.bound_over_error, 1);
}

TEST(AccuracyLadder, HasEveryDecadeOfBothMethods)
{
    int plain = 0;
    for (const Numerics& numerics : accuracy_ladder({})) {
        plain += !numerics.resolve;
    }
    EXPECT_EQ(plain, 26);
}

} // namespace
} // namespace overturn
