#include "commands/verdict_ranges.hpp"
#include "support/random_record.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>

namespace overturn {
namespace {

constexpr auto safe = Verdict::safe;
constexpr auto topples = Verdict::topples;
constexpr auto undecided = Verdict::undecided;

TEST(VerdictRanges, NameEveryKindAndTheEndOfTheSearch)
{
    const std::vector<VerdictRange> start{{0, 0.5, safe}, {0.5, 1, topples}};
    const auto text = [&](const std::vector<VerdictRange>& rest) {
        VerdictRanges ranges{.all = start};
        ranges.all.insert(ranges.all.end(), rest.begin(), rest.end());
        return ranges.text(2, 3);
    };
    EXPECT_EQ(text({}), "above 0.50 g, searched up to 1 g");
    EXPECT_EQ(text({{1, 5, safe}}), "0.50 to 1.00 g, searched up to 5 g");
    EXPECT_EQ(text({{1, 5, undecided}}),
              "0.50 to 1.00 g; undecided: above 1.00 g, searched up to 5 g");
    EXPECT_EQ(text({{1, 2, undecided}, {2, 3, safe}, {3, 4, topples}}),
              "0.50 to 1.00 g, above 3.00 g; undecided: 1.00 to 2.00 g, searched up to 4 g");
    EXPECT_EQ((VerdictRanges{.all = {{0, 0.25, safe}}}.text(2, 3)), "none, searched up to 0.25 g");
}

TEST(VerdictRanges, TellWhatWasSearchedInWideSteps)
{
    VerdictRanges ranges{.all = {{0, 5, safe}}};
    ranges.coarse = CoarseSearch{1, 2, 0.02};
    EXPECT_EQ(ranges.text(2, 3), "none, searched up to 5 g, from 1.00 to 2.00 g only in steps of "
                                 "up to 2 %");
}

TEST(VerdictRanges, AreRoundedOutwardsSoThatWhatIsOutsideIsSafe)
{
    std::mt19937_64 generator(3);
    std::uniform_real_distribution<double> uniform(0.01, 1);
    for (int i = 0; i < 2000; ++i) {
        std::vector<double> ends{uniform(generator)};
        ends.push_back(ends.back() + 1e-3 * uniform(generator));
        ends.push_back(ends.back() + 1e-3 * uniform(generator));
        const VerdictRanges ranges{.all = {{0, ends[0], safe},
                                           {ends[0], ends[1], i % 2 == 0 ? topples : undecided},
                                           {ends[1], ends[2], safe},
                                           {ends[2], 5, topples}}};
        const std::string whole = ranges.text(4, 3);
        const std::string text = whole.substr(0, whole.find(", searched"));
        const double above = std::stod(text.substr(text.find("above ") + 6));
        EXPECT_LE(above, ends[2]);
        EXPECT_GT(above, ends[0] - 1e-4);
        const std::size_t to = text.find(" to ");
        const std::size_t before = text.find("undecided: ");
        const double first =
            to == std::string::npos ? above : std::stod(text.substr(before < to ? before + 11 : 0));
        EXPECT_LE(first, ends[0]);
        EXPECT_GT(first, ends[0] - 1e-4);
        if (to != std::string::npos) {
            const double last = std::stod(text.substr(to + 4));
            EXPECT_GE(last, ends[1]);
            EXPECT_LT(last, ends[1] + 1e-4);
        }
    }
    EXPECT_EQ(
        (VerdictRanges{.all = {{0, 0.25, safe}, {0.25, 0.5, topples}, {0.5, 5, safe}}}.text(4, 3)),
        "0.2500 to 0.5000 g, searched up to 5 g");
    EXPECT_EQ(rounded_down(0.3333, 4), 0.3333);
    EXPECT_EQ(rounded_down(0.33339, 4), 0.3333);
    EXPECT_EQ(rounded_down(-0.33331, 4), -0.3334);
}

/// Up to 200 ranges between 0.3 and 3 g, some of them thin, that topple or are undecided, with safe
/// ones between them.
VerdictRanges random_ranges(std::mt19937_64& generator)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    VerdictRanges ranges{.all = {{0, 0.3, safe}}, .lifting = 0.3};
    const int count = int(200 * uniform(generator));
    for (int i = 0; i < count; ++i) {
        const double first = ranges.all.back().last;
        const double width = 2.7 / count * uniform(generator);
        ranges.all.push_back({first, first + width * uniform(generator),
                              uniform(generator) < 0.8 ? topples : undecided});
        ranges.all.push_back({ranges.all.back().last, first + width, safe});
    }
    if (uniform(generator) < 0.5) {
        ranges.all.push_back({ranges.all.back().last, 5, topples});
    }
    return ranges;
}

TEST(VerdictRanges, ThatAreThinAreShownAsTheShareOfAnInterval)
{
    std::vector<VerdictRange> all{{0, 0.5, safe}};
    for (int i = 0; i < 100; ++i) { // a quarter of 0.5 to 0.7 g, and half of 0.9 to 1.1 g
        const double first = i < 50 ? 0.5 + 0.004 * i : 0.9 + 0.004 * (i - 50);
        const double last = first + (i < 50 ? 0.001 : 0.002);
        all.back().last = first;
        all.push_back({first, last, topples});
        all.push_back({last, last, safe});
    }
    all.back().last = 2;
    all.push_back({2, 5, topples});
    EXPECT_EQ((VerdictRanges{.all = all}.text(4, 3)),
              "25 % of 0.5000 to 0.6970 g, 51 % of 0.9000 to 1.0980 g, above 2.0000 g, searched "
              "up to 5 g");
}

TEST(VerdictRanges, AreCoveredByFewIntervalsWithTheirShares)
{
    std::mt19937_64 generator(4);
    for (int i = 0; i < 100; ++i) {
        const VerdictRanges ranges = random_ranges(generator);
        for (const Verdict verdict : {topples, undecided}) {
            const auto intervals = ranges.intervals(verdict, 6);
            EXPECT_LE(intervals.size(), 6u);
            double shown = 0;
            for (std::size_t j = 0; j < intervals.size(); ++j) {
                shown += intervals[j].share * (intervals[j].last - intervals[j].first);
                EXPECT_GT(intervals[j].first, j > 0 ? intervals[j - 1].last : 0);
            }
            double all = 0;
            for (const VerdictRange& range : ranges.with(verdict)) {
                all += range.last - range.first;
                EXPECT_TRUE(std::ranges::any_of(intervals, [&](const VerdictInterval& interval) {
                    return interval.first <= range.first && range.last <= interval.last;
                }));
            }
            EXPECT_NEAR(shown, all, 1e-13); // 200 roundings of widths below 5
        }
        // Nothing is hidden in what topples up to the end of the search.
        if (ranges.all.back().verdict == topples) {
            EXPECT_EQ(ranges.intervals(topples, 6).back().first, ranges.all.back().first);
        }
    }
}

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
        scene.records = {std::make_shared<const Accelerogram>(record)};
        const BoundaryLine line{.point = {{0.3, 0.85}, 1, 1000 / 50.0}, .unit = record.peak()};
        const double asked = std::tan(0.3) * (1.5 + 0.05 * i);
        const VerdictRanges ranges =
            verdict_ranges(scene, line, 0.97 * asked, 1.03 * asked, asked, nullptr);
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

TEST(VerdictRanges, HaveEnoughDecimalsForTheRequestedAcceleration)
{
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> uniform(0.1, 2);
    for (int digits = 5; digits < 12; ++digits) {
        const double flip = uniform(generator);
        const double pga = flip + 4 * std::pow(10, -digits);
        const VerdictRanges ranges{.all = {{0, flip, safe}, {flip, 5, topples}}};
        const int decimals = ranges.decimals(pga);
        EXPECT_NE(rounded_down(flip, decimals), rounded_down(pga, decimals));
    }
    // Many narrow ranges do not make all numbers long.
    EXPECT_EQ((VerdictRanges{.all = {{0, 1, safe}, {1, 1 + 1e-12, topples}, {1 + 1e-12, 5, safe}}}
                   .decimals(3)),
              7);
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
        const VerdictRanges ranges = verdict_ranges({}, line, threshold, 4, asked, nullptr);
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

} // namespace
} // namespace overturn
