// The search for ranges of verdicts, and which of two directions is worse.
#include "support/given_values.hpp"
#include "support/random_record.hpp"
#include "support/two_sides.hpp"
#include "support/verdict_ranges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <random>

namespace overturn {
namespace {

TEST(VerdictRanges, KnowTheNearestOnesOnBothSides)
{
    std::mt19937_64 generator(5);
    std::uniform_real_distribution<double> uniform(0.2, 4);
    for (int i = 0; i < 100; ++i) {
        const VerdictRanges ranges = random_ranges(generator);
        const double pga = uniform(generator);
        for (const Verdict verdict : {topples, undecided}) {
            std::optional<double> below, above;
            for (const VerdictRange& range : ranges.with(verdict)) {
                for (const double end : {range.first, range.last}) {
                    below = end <= pga && end > below.value_or(0) ? end : below;
                    above = end >= pga && end < above.value_or(9) ? end : above;
                }
            }
            const bool has_it = ranges.verdict_at(pga) == verdict;
            EXPECT_EQ(ranges.nearest_below(verdict, pga), has_it ? pga : below);
            EXPECT_EQ(ranges.nearest_above(verdict, pga), has_it ? pga : above);
        }
    }
}

TEST(VerdictRanges, UnderARecordAreSearchedInSmallStepsNextToTheAskedAcceleration)
{
    std::mt19937_64 generator(6);
    int toppling = 0;
    for (int i = 0; i < 20; ++i) {
        // Long records, under which toppling ranges are thin.
        const Accelerogram record = random_record(generator, 1000, Directions::horizontal);
        Scene scene;
        scene.motion = Suite{{std::make_shared<const Accelerogram>(record)}};
        const BoundaryLine line{.point = {{0.3, 0.85}, 1, 1000 / 50.0}, .unit = record.peak()};
        const double asked = std::tan(0.3) * (1.5 + 0.05 * i);
        const VerdictRanges ranges = verdict_ranges(scene, line, 0.97 * asked, 1.03 * asked, asked);
        for (int k = -20; k <= 20; ++k) {
            const double pga = asked * (1 + 0.001 * k);
            if (is_unsafe(boundary_on(scene, line, {pga}, widest_kernel()).region_at_first)) {
                EXPECT_NE(ranges.verdict_at(pga), safe) << i << ": " << pga;
                ++toppling;
            }
        }
    }
    EXPECT_GT(toppling, 50);
}

TEST(VerdictRanges, CoverTheSearchAndAgreeWithSingleVerdicts)
{
    std::mt19937_64 generator(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 5; ++i) {
        const double alpha = 0.15 + 0.2 * uniform(generator);
        const double threshold = std::tan(alpha);
        const double restitution = 0.7 + 0.2 * uniform(generator);
        const double frequency = 1 + 5 * uniform(generator);
        const BoundaryLine line{.point = {{alpha, restitution}, 1, frequency}, .unit = threshold};
        const double asked = threshold * (1 + 10 * uniform(generator));
        const VerdictRanges ranges = verdict_ranges({}, line, threshold, 4, asked);
        EXPECT_EQ(ranges.all.front().first, 0);
        EXPECT_EQ(ranges.all.back().last, 4);
        for (std::size_t j = 1; j < ranges.all.size(); ++j) {
            EXPECT_EQ(ranges.all[j].first, ranges.all[j - 1].last);
            EXPECT_NE(ranges.all[j].verdict, ranges.all[j - 1].verdict);
        }
        const auto verdict_at = [&](double pga) {
            return verdict_of(boundary_on({}, line, {pga}, widest_kernel()).region_at_first);
        };
        for (const double pga : {asked, 4 * uniform(generator), 4 * uniform(generator)}) {
            for (const VerdictRange& range : ranges.all) {
                if (range.first < pga && pga < range.last && range.verdict != undecided) {
                    EXPECT_EQ(verdict_at(pga), range.verdict) << pga;
                }
            }
        }
    }
}

TEST(ToppleAnswer, DoesNotDependOnTheNumberOfThreads)
{
    std::mt19937_64 generator(8);
    Problem problem;
    problem.scene.motion = Suite{{std::make_shared<const Accelerogram>(
        random_record(generator, 600, Directions::horizontal))}};
    problem.grid =
        grid_of(problem.scene, {number("motion", 1), number("width", 0.4), number("height", 1.6),
                                number("restitution_of_maximum", 1), number("scale", 1)});
    const auto answer_in = [&](int threads) {
        return answer_of(problem,
                         {.has_strength = true, .pga = {}, .pga_max = 2, .threads = threads});
    };
    const ToppleAnswer one = answer_in(1);
    const ToppleAnswer three = answer_in(3);
    ASSERT_EQ(one.by_restitution.size(), 6U);
    for (std::size_t i = 0; i < one.by_restitution.size(); ++i) {
        const std::vector<VerdictRange>& ranges = one.by_restitution[i].ranges.all;
        EXPECT_GT(ranges.size(), 2U);
        EXPECT_EQ(one.by_restitution[i].ratio, three.by_restitution[i].ratio);
        ASSERT_EQ(ranges.size(), three.by_restitution[i].ranges.all.size());
        for (std::size_t k = 0; k < ranges.size(); ++k) {
            EXPECT_EQ(ranges[k].last, three.by_restitution[i].ranges.all[k].last);
            EXPECT_EQ(ranges[k].verdict, three.by_restitution[i].ranges.all[k].verdict);
        }
    }
    EXPECT_EQ(one.friction_to_topple.size(), one.requested().ranges.with(topples).size());
    EXPECT_EQ(one.friction_to_topple, three.friction_to_topple);
}

TEST(Directions, OfABlockWhoseSidesDifferAreBothUnlessOneIsGiven)
{
    std::mt19937_64 generator(2);
    for (int i = 0; i < 30; ++i) {
        const Body body = random_body(generator);
        const auto directions = [&](Given width, std::vector<Given> more) {
            more.insert(more.end(), {width, number("height", 2), number("restitution", 0.5),
                                     number("pga", 0.3), number("pulse_period", 0.5)});
            Problem problem;
            problem.grid = grid_of(problem.scene, std::move(more));
            return directions_of(problem);
        };
        const Given width = number("width", body.plus + body.minus);
        const Given offset = number("center_offset", (body.minus - body.plus) / 2);
        using Directions = std::vector<double>;
        EXPECT_EQ(directions(width, {offset}), (Directions{0, 180}));
        EXPECT_EQ(directions(width, {number("incline", 0.01)}), (Directions{0, 180}));
        EXPECT_EQ(directions(width, {offset, number("direction", 0)}), (Directions{0}));
        EXPECT_EQ(directions(width, {offset, number("direction", 180)}), (Directions{180}));
        EXPECT_EQ(directions(width, {number("center_height", body.height)}), (Directions{0}));
        EXPECT_EQ(directions(width, {}), (Directions{0}));
    }
}

TEST(Directions, AreWorseIfTheBlockTopplesOrTopplesCloserToTheAskedStrength)
{
    // From the worst to the best.
    const std::vector<ToppleAnswer> answers{
        answer_at(1, topples, {{0.5, 5, topples}}),
        answer_at(1, topples, {{0.9, 1.1, topples}}),
        answer_at(1, undecided, {{0.95, 1.05, undecided}, {1.1, 5, topples}}),
        answer_at(1, safe, {{1.001, 1.002, topples}}),
        answer_at(1, safe, {{0.9, 0.998, topples}}),
        answer_at(1, safe, {{0.5, 0.6, topples}, {1.1, 5, topples}}),
        answer_at(1, safe, {{1.1, 5, topples}}),
        answer_at(1, safe, {})};
    for (std::size_t i = 0; i < answers.size(); ++i) {
        for (std::size_t j = 0; j < answers.size(); ++j) {
            EXPECT_EQ(is_worse(answers[i], answers[j]), i < j) << i << " " << j;
        }
    }
    const auto without_strength = [](double first) {
        ToppleAnswer answer = answer_at(0, safe, {{first, 5, topples}});
        answer.verdict.reset();
        return answer;
    };
    EXPECT_TRUE(is_worse(without_strength(0.4), without_strength(0.6)));
    EXPECT_FALSE(is_worse(without_strength(0.6), without_strength(0.4)));
}

} // namespace
} // namespace overturn
