// Ranges and verdicts in words.
#include "overturn/answers/ranges_text.hpp"
#include "support/verdict_ranges.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace overturn {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(VerdictRanges, NameEveryKindAndTheEndOfTheSearch)
{
    const std::vector<VerdictRange> start{{0, 0.5, safe}, {0.5, 1, topples}};
    const auto text = [&](const std::vector<VerdictRange>& rest) {
        VerdictRanges ranges{.all = start};
        ranges.all.insert(ranges.all.end(), rest.begin(), rest.end());
        return text_of(ranges, 2, 3);
    };
    EXPECT_EQ(text({}), "above 0.50 g, searched up to 1 g");
    EXPECT_EQ(text({{1, 5, safe}}), "0.50 to 1.00 g, searched up to 5 g");
    EXPECT_EQ(text({{1, 5, undecided}}),
              "0.50 to 1.00 g; undecided: above 1.00 g, searched up to 5 g");
    EXPECT_EQ(text({{1, 2, undecided}, {2, 3, safe}, {3, 4, topples}}),
              "0.50 to 1.00 g, above 3.00 g; undecided: 1.00 to 2.00 g, searched up to 4 g");
    EXPECT_EQ(text_of(VerdictRanges{.all = {{0, 0.25, safe}}}, 2, 3),
              "none, searched up to 0.25 g");
}

TEST(VerdictRanges, OfAnotherQuantityHaveItsUnitAndMayReachBothEnds)
{
    const auto text = [](const std::vector<VerdictRange>& all) {
        return text_of(VerdictRanges{.all = all}, 2, 3, " m");
    };
    EXPECT_EQ(text({{-0.1, 0.1, topples}}), "all, searched from -0.1 up to 0.1 m");
    EXPECT_EQ(text({{-0.1, 0, topples}, {0, 0.05, safe}, {0.05, 0.1, topples}}),
              "below 0.00 m, above 0.05 m, searched from -0.1 up to 0.1 m");
    EXPECT_EQ(text({{0.3, 0.4, undecided}, {0.4, 1.2, safe}}),
              "none; undecided: below 0.40 m, searched from 0.3 up to 1.2 m");
}

TEST(VerdictRanges, TellWhatWasSearchedInWideSteps)
{
    VerdictRanges ranges{.all = {{0, 5, safe}}};
    ranges.coarse = CoarseSearch{1, 2, 0.02};
    EXPECT_EQ(text_of(ranges, 2, 3),
              "none, searched up to 5 g, from 1.00 to 2.00 g only in steps of "
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
        const std::string whole = text_of(ranges, 4, 3);
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
    EXPECT_EQ(text_of(VerdictRanges{.all = {{0, 0.25, safe}, {0.25, 0.5, topples}, {0.5, 5, safe}}},
                      4, 3),
              "0.2500 to 0.5000 g, searched up to 5 g");
    EXPECT_EQ(rounded_down(0.3333, 4), 0.3333);
    EXPECT_EQ(rounded_down(0.33339, 4), 0.3333);
    EXPECT_EQ(rounded_down(-0.33331, 4), -0.3334);
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
    EXPECT_EQ(text_of(VerdictRanges{.all = all}, 4, 3),
              "25 % of 0.5000 to 0.6970 g, 51 % of 0.9000 to 1.0980 g, above 2.0000 g, searched "
              "up to 5 g");
}

TEST(VerdictRanges, AreCoveredByFewIntervalsWithTheirShares)
{
    std::mt19937_64 generator(4);
    for (int i = 0; i < 100; ++i) {
        const VerdictRanges ranges = random_ranges(generator);
        for (const Verdict verdict : {topples, undecided}) {
            const auto intervals = intervals_of(ranges, verdict, 6);
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
            EXPECT_EQ(intervals_of(ranges, topples, 6).back().first, ranges.all.back().first);
        }
    }
}

TEST(VerdictRanges, HaveEnoughDecimalsForTheRequestedAcceleration)
{
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> uniform(0.1, 2);
    for (int digits = 5; digits < 12; ++digits) {
        const double flip = uniform(generator);
        const double pga = flip + 4 * std::pow(10, -digits);
        const VerdictRanges ranges{.all = {{0, flip, safe}, {flip, 5, topples}}};
        const int decimals = decimals_of(ranges, pga);
        EXPECT_NE(rounded_down(flip, decimals), rounded_down(pga, decimals));
    }
    // Many narrow ranges do not make all numbers long.
    EXPECT_EQ(
        decimals_of(
            VerdictRanges{.all = {{0, 1, safe}, {1, 1 + 1e-12, topples}, {1 + 1e-12, 5, safe}}}, 3),
        7);
}

void add_restitution(ToppleAnswer& answer, double share, const std::vector<VerdictRange>& unsafe)
{
    answer.by_restitution.push_back({share, share * 0.8, ranges_of(unsafe)});
}

TEST(Sentence, GivesTheNearestTopplingStrengthOnBothSides)
{
    const std::vector<VerdictRange> unsafe{{0.5, 0.9, topples}, {0.98891, 1.5, topples}};
    EXPECT_EQ(verdict_sentence(answer_at(0.95, safe, unsafe), std::nullopt),
              "does not topple at 0.95 g; topples at 0.9889 g (4.1 % more) and at 0.9000 g (5.3 % "
              "less)");
    EXPECT_EQ(verdict_sentence(answer_at(0.2, safe, unsafe), std::nullopt, " in direction 180"),
              "does not topple at 0.2 g in direction 180; topples at 0.5000 g (150 % more)");
    EXPECT_EQ(verdict_sentence(answer_at(2, safe, unsafe), std::nullopt),
              "does not topple at 2 g; topples at 1.5000 g (25 % less)");
    EXPECT_EQ(verdict_sentence(answer_at(2, safe, {}), std::nullopt), "does not topple at 2 g");
    EXPECT_EQ(verdict_sentence(answer_at(1, topples, unsafe), std::nullopt), "topples at 1 g");
}

TEST(Sentence, GivesFactorsOnARecord)
{
    const ToppleAnswer answer = answer_at(0.5, safe, {{0.5011, 0.502, topples}});
    EXPECT_EQ(verdict_sentence(answer, 1),
              "does not topple at 1 times the record, 0.5000 g; topples at 1.002 times the record "
              "(0.2 % more)");
}

TEST(Sentence, SaysThatTheBlockTopplesJustBesideTheAskedStrength)
{
    EXPECT_EQ(verdict_sentence(answer_at(0.7, safe, {{0.7, 0.9, topples}}), std::nullopt),
              "does not topple at 0.7 g; topples just above");
    EXPECT_EQ(verdict_sentence(answer_at(0.9, safe, {{0.7, 0.9, topples}}), std::nullopt),
              "does not topple at 0.9 g; topples just below");
}

TEST(Sentence, NamesUndecidedStrengthsThatAreNearerThanTopplingOnes)
{
    const std::vector<VerdictRange> unsafe{{0.5, 0.6, undecided}, {0.9, 1, topples}};
    EXPECT_EQ(verdict_sentence(answer_at(0.4, safe, unsafe), std::nullopt),
              "does not topple at 0.4 g; topples at 0.9000 g (125 % more); undecided at 0.5000 g "
              "(25 % more)");
    EXPECT_EQ(verdict_sentence(answer_at(0.55, undecided, unsafe), std::nullopt),
              "undecided at 0.55 g; topples at 0.9000 g (64 % more)");
    EXPECT_THAT(verdict_sentence(answer_at(0.85, safe, unsafe), std::nullopt),
                Not(HasSubstr("undecided")));
}

TEST(Sentence, SaysThatTheSearchEndsAtTheAskedStrength)
{
    EXPECT_EQ(verdict_sentence(answer_at(5, safe, {{1, 4, topples}}), std::nullopt),
              "does not topple at 5 g; topples at 4.0000 g (20 % less); larger accelerations are "
              "not searched");
}

TEST(Sentence, GivesTheWorstOfTheOtherRestitutions)
{
    ToppleAnswer answer = answer_at(0.95, safe, {{1.5, 5, topples}});
    add_restitution(answer, 0.8, {{1.6, 5, topples}});
    const std::string same = "does not topple at 0.95 g; topples at 1.5000 g (58 % more)";
    EXPECT_EQ(verdict_sentence(answer, std::nullopt), same);
    add_restitution(answer, 0.95, {{0.98, 5, topples}});
    EXPECT_EQ(verdict_sentence(answer, std::nullopt),
              same + "; with r = 0.95 r_max, it topples at 0.9800 g (3.2 % more)");
    add_restitution(answer, 0.85, {{0.94, 0.96, undecided}});
    EXPECT_EQ(verdict_sentence(answer, std::nullopt),
              same + "; with r = 0.85 r_max, this strength is undecided");
    add_restitution(answer, 1, {{0.9, 5, topples}});
    EXPECT_EQ(verdict_sentence(answer, std::nullopt),
              same + "; with r = r_max, it topples at this strength");
    add_restitution(answer, 0.8, {{0.9, 5, topples}});
    EXPECT_EQ(verdict_sentence(answer, std::nullopt),
              same + "; with r = 1, 0.8 r_max, it topples at this strength");
}

TEST(Sentence, NeverOverstatesTheDistanceToTheNearestTopplingStrength)
{
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 200; ++i) {
        const double distance = std::pow(10, -8 * uniform(generator));
        const double flip = 0.3 + uniform(generator);
        const bool is_above = i % 2 == 0;
        const double asked = is_above ? flip / (1 + distance) : flip * (1 + distance);
        const std::vector<VerdictRange> unsafe{is_above ? VerdictRange{flip, 5, topples}
                                                        : VerdictRange{0.2, flip, topples}};
        const std::optional<double> scale =
            i % 4 < 2 ? std::nullopt : std::optional(asked / 0.5); // the unit of the answer
        const std::string text = verdict_sentence(answer_at(asked, safe, unsafe), scale);
        const double named = std::stod(text.substr(text.find("topples at ") + 11));
        const double unit = scale ? 0.5 : 1;
        EXPECT_LE((named - asked / unit) / (flip - asked) * unit, 1 + 1e-6) << text;
        EXPECT_GT((named - asked / unit) / (flip - asked), 0) << text;
        EXPECT_THAT(text, HasSubstr(is_above ? " % more)" : " % less)"));
    }
}

} // namespace
} // namespace overturn
