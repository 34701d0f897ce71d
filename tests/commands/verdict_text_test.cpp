// The sentence that gives a verdict, and which of two directions is worse.
#include "commands/verdict_text.hpp"
#include "support/given_values.hpp"
#include "support/two_sides.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace overturn {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr auto safe = Verdict::safe;
constexpr auto topples = Verdict::topples;
constexpr auto undecided = Verdict::undecided;

/// Alternating with safe ones, from 0 to 5 g.
VerdictRanges ranges_of(const std::vector<VerdictRange>& unsafe)
{
    VerdictRanges ranges{.all = {}, .lifting = 0.3};
    double end = 0;
    for (const VerdictRange& range : unsafe) {
        ranges.all.push_back({end, range.first, safe});
        ranges.all.push_back(range);
        end = range.last;
    }
    if (end < 5) {
        ranges.all.push_back({end, 5, safe});
    }
    return ranges;
}

/// At r = 0.9 r_max, with r_max = 0.8.
ToppleAnswer answer_at(double pga, Verdict verdict, const std::vector<VerdictRange>& unsafe)
{
    ToppleAnswer answer;
    answer.verdict = verdict;
    answer.pga = pga;
    answer.unit = 0.5;
    answer.by_restitution = {{0.9, 0.72, ranges_of(unsafe)}};
    return answer;
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
