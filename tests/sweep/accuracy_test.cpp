#include "overturn/sweep/accuracy.hpp"

#include "overturn/integrate/run_sliding.hpp"
#include "overturn/mechanics/pulse_excitation.hpp"
#include "overturn/number/digits50.hpp"
#include "overturn/problem/coordinates.hpp"
#include "support/given_values.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <set>

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

/// Blocks that stay flat, that rock and slip, and that hardly slip.
AccuracyStudy made_with_friction()
{
    return {
        {},
        grid_of({}, {number("slenderness", 0.3217506), number("restitution_of_maximum", 1),
                     axis("friction", {0.3, 0.4, 0.7}), axis("amplitude", AxisRange{1.2, 8, 100}),
                     axis("frequency", AxisRange{0.5, 8, 100})}),
        108,
        18,
        widest_kernel()};
}

const AccuracyStudy& study_with_friction()
{
    static const AccuracyStudy made = made_with_friction();
    return made;
}

TEST(AccuracyStudyWithFriction, HasErrorsOfTheSlideThatDecreaseWithTheTolerance)
{
    const AccuracyRow loose = study_with_friction().measure({Method::taylor, 1e-8});
    const AccuracyRow tight = study_with_friction().measure({Method::taylor, 1e-12});
    for (const auto error : {&AccuracyRow::slide, &AccuracyRow::margin, &AccuracyRow::velocity}) {
        // Four decades of tolerance; the largest error decreases by at least three.
        EXPECT_LT((tight.*error)[4], 1e-3 * (loose.*error)[4]);
        EXPECT_GT((tight.*error)[4], 0);
    }
    // The error that the tolerance allows in each of some twenty steps, amplified tenfold.
    EXPECT_LT(tight.slide[4], 200 * 1e-12);
}

/// The slide of a block that slips, rocks, and slips in the end.
double difference_of_slides_in_50_digits(double tolerance, double other)
{
    const Digits50 alpha(0.3217506);
    const Block<Digits50> block({alpha}, largest_restitution(alpha));
    const auto pulse = pulse_excitation<Theory::nonlinear>(
        pulse_motion<Digits50>(PulseKind::one_sine), block, Digits50(2.5), Digits50(6));
    const auto slide = [&](double at) {
        const auto end =
            run_sliding<Digits50>(block, Digits50(0.57735), Digits50(0.4), pulse, Digits50(at));
        EXPECT_TRUE(end.slipped);
        EXPECT_GT(end.impacts, 0);
        return end.slide;
    };
    return std::abs(double(slide(tolerance) - slide(other)));
}

TEST(AccuracyStudyWithFriction, HasAReferenceWhoseErrorIsFarBelowTheRoundingOfDouble)
{
    const double of_loose = difference_of_slides_in_50_digits(1e-20, 1e-28);
    const double of_reference =
        difference_of_slides_in_50_digits(sliding_tolerance_in_50_digits, 1e-28);
    // Four decades of tolerance; the error decreases by at least two.
    EXPECT_LT(of_reference, 1e-2 * of_loose);
    EXPECT_GT(of_reference, 0);
    EXPECT_LT(of_reference, 1e-20);
}

TEST(AccuracyStudyWithFriction, IsTheSameEachTime)
{
    const Numerics numerics{Method::taylor, 1e-9};
    const AccuracyRow one = study_with_friction().measure(numerics);
    const AccuracyRow other = made_with_friction().measure(numerics);
    EXPECT_EQ(one.slide, other.slide);
    EXPECT_EQ(one.margin, other.margin);
    EXPECT_EQ(one.steps, other.steps);
}

TEST(AccuracyStudyWithFriction, HasTheSlideOf1em8AtLooserTolerances)
{
    const ErrorDistribution finest = study_with_friction().measure({Method::taylor, 1e-8}).slide;
    for (const Method method : {Method::rk45, Method::taylor}) {
        EXPECT_EQ(study_with_friction().measure({method, 1e-4}).slide, finest);
    }
}

TEST(AccuracyStudyWithFriction, HasNoErrorAboveItsBoundAndNoWrongVerdict)
{
    for (const Numerics& numerics :
         {Numerics{Method::rk45, 1e-9}, Numerics{Method::taylor, 1e-9},
          Numerics{Method::taylor, 1e-13}, Numerics{Method::taylor, 1e-14},
          Numerics{Method::taylor, 1e-4, true}}) {
        const AccuracyRow row = study_with_friction().measure(numerics);
        EXPECT_EQ(row.bound_exceeded, 0) << numerics.tolerance;
        EXPECT_EQ(row.wrong_verdicts, 0) << numerics.tolerance;
        EXPECT_EQ(row.undecided, 0) << numerics.tolerance;
    }
}

TEST(AccuracyStudyWithFriction, CountsByDistanceOnlyPointsThatHaveAMargin)
{
    const AccuracySample& sample = study_with_friction().sample();
    const auto sum = [](const auto& counts) {
        return std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
    };
    EXPECT_EQ(sum(sample.by_region), sample.settled);
    EXPECT_LT(sum(sample.by_distance), sample.settled); // the others slip at the end of the pulse
    EXPECT_GT(sum(sample.by_distance), sample.settled / 2);
}

TEST(AccuracyLadder, HasEveryDecadeOfBothMethods)
{
    int plain = 0;
    for (const Numerics& numerics : accuracy_ladder({})) {
        plain += !numerics.resolve;
    }
    EXPECT_EQ(plain, 26);
}

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
    const std::vector<int> chosen = evenly_chosen(tiling, wanted);
    EXPECT_EQ(std::ranges::adjacent_find(chosen, std::greater_equal()), chosen.end());
    const Scene scene;
    std::vector<Point> points;
    for (std::int64_t i = 0; i < tiling.size(); ++i) {
        std::ranges::copy(Coordinates(scene, grid, tiling[i]).points(), std::back_inserter(points));
    }
    Met met;
    met.points = chosen.size();
    for (const int i : chosen) {
        const Point& point = points.at(std::size_t(i));
        met.frequencies.insert(point.frequency);
        met.amplitudes.insert(point.amplitude);
        met.restitutions.insert(point.block.restitution);
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
