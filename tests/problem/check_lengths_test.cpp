// Blocks whose lengths are in centimetres or millimetres are refused, with their lengths in metres.
#include "support/given_values.hpp"
#include "support/short_records.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <random>

namespace overturn {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// A block in metres and radians, by name.
using Described = std::map<std::string, double>;

const Quantities motion{number("pga", 0.5), number("pulse_period", 0.7),
                        number("restitution", 0.5)};

Quantities given(const Described& block)
{
    Quantities all;
    for (const auto& [name, value] : block) {
        all.push_back(number(name, value));
    }
    return all;
}

bool is_length(const std::string& name)
{
    return quantity(name).units == "m";
}

Described in_unit(Described block, double unit)
{
    for (auto& [name, value] : block) {
        value *= is_length(name) ? unit : 1;
    }
    return block;
}

double rounded(double value)
{
    return std::round(1000 * value) / 1000;
}

/// A statue of 1.5 m to 3 m in each of the ways to describe it.
std::vector<Described> random_statue(std::mt19937_64& generator)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    const double height = rounded(1.5 + 1.5 * uniform(generator));
    const double width = rounded(height * (0.2 + 0.3 * uniform(generator)));
    const double center = rounded(height * (0.35 + 0.25 * uniform(generator)));
    const double gyration = rounded(height * (0.25 + 0.1 * uniform(generator)));
    const double offset = rounded(0.1 * width);
    const double plus = rounded(0.5 * height);
    const double minus = rounded(0.45 * height);
    return {{{"width", width}, {"height", height}},
            {{"half_width", width}, {"half_height", height}},
            {{"width", width}, {"height", height}, {"center_height", center}},
            {{"width", width}, {"height", height}, {"center_offset", offset}, {"incline", 0.02}},
            {{"width", width}, {"height", height}, {"radius_of_gyration", gyration}},
            {{"slenderness", 0.3}, {"size", plus}},
            {{"aspect_ratio", 3}, {"size", plus}},
            {{"slenderness_plus", 0.3},
             {"slenderness_minus", 0.25},
             {"size_plus", plus},
             {"size_minus", minus},
             {"radius_of_gyration", gyration}}};
}

/// The message that refuses the block; empty if it is not refused.
std::string refusal_of(const Quantities& block, const Scene& scene = {},
                       const Quantities& of_motion = motion)
{
    try {
        grid_of(scene, block + of_motion);
    } catch (const GivenError& error) {
        return error.quantity() + error.what();
    }
    return "";
}

/// "size 0.8 m" for each length.
std::vector<std::string> lengths_of(const Described& block)
{
    std::vector<std::string> texts;
    for (const auto& [name, value] : block) {
        if (name == "width") {
            texts.push_back(fmt::format("{:.6g} m x {:.6g} m", value, block.at("height")));
        } else if (is_length(name) && (name != "height" || !block.contains("width"))) {
            texts.push_back(fmt::format("{} {:.6g} m", name, value));
        }
    }
    return texts;
}

TEST(LengthsInMetres, AreTheQuestionOfARefusalInCentimetresOrMillimetres)
{
    std::mt19937_64 generator(1);
    for (int i = 0; i < 20; ++i) {
        for (const Described& block : random_statue(generator)) {
            EXPECT_EQ(refusal_of(given(block)), "");
            for (const double unit : {100.0, 1000.0}) {
                const std::string refusal = refusal_of(given(in_unit(block, unit)));
                EXPECT_THAT(refusal, AllOf(HasSubstr("above 50 m. Lengths are in metres: "),
                                           testing::EndsWith("?")));
                for (const std::string& length : lengths_of(block)) {
                    EXPECT_THAT(refusal, HasSubstr(length));
                }
            }
        }
    }
}

TEST(LengthsInMetres, AreTheQuestionIfOneLengthIsInCentimetresBesideOthersInMetres)
{
    std::mt19937_64 generator(2);
    for (int i = 0; i < 20; ++i) {
        for (const Described& block : random_statue(generator)) {
            for (const char* name : {"center_height", "radius_of_gyration", "size_plus"}) {
                if (block.contains(name)) {
                    Described wrong = block;
                    wrong[name] *= 100;
                    const std::string refusal = refusal_of(given(wrong));
                    EXPECT_THAT(refusal, StartsWith(name));
                    for (const std::string& length : lengths_of(block)) {
                        EXPECT_THAT(refusal, HasSubstr(length));
                    }
                }
            }
        }
    }
}

TEST(LengthsInMetres, OfASmallBlockAreJudgedByTheirRatios)
{
    // Their half diagonals are below 50 m even in centimetres.
    const Described vase{{"width", 0.12}, {"height", 0.3}};
    Described high = vase;
    high["center_height"] = 14;
    EXPECT_EQ(refusal_of(given(high)),
              "center_height = 14: it is 93.33 times half the height of the block, above 20. "
              "Lengths are in metres: 0.12 m x 0.3 m, center_height 0.14 m?");
    Described wide = vase;
    wide["radius_of_gyration"] = 9;
    EXPECT_THAT(refusal_of(given(wide)),
                AllOf(StartsWith("radius_of_gyration = 9: it is 55.71 R, above 10 R."),
                      HasSubstr("radius_of_gyration 0.09 m?")));
}

TEST(LengthsInMetres, AreExpectedInEveryRowOfATableAndOnEveryAxis)
{
    const Quantities table{column("width", {0.4, 0.42, 42}), column("height", {1.5, 1.55, 155})};
    try {
        grid_of({}, table + motion);
        ADD_FAILURE();
    } catch (const GivenError& error) {
        EXPECT_EQ(error.row(), 2);
        EXPECT_STREQ(error.what(), " = 155: the half diagonal R is 80.29 m, above 50 m. Lengths "
                                   "are in metres: 0.42 m x 1.55 m?");
    }
    const Quantities axes{number("slenderness", 0.3), axis("size", AxisRange{20, 120, 11})};
    EXPECT_THAT(refusal_of(axes), HasSubstr("size = 120: the half diagonal R is 120 m"));
}

TEST(LengthsInMetres, AreExpectedUnderRecords)
{
    Scene scene;
    scene.motion = Suite{{short_record(1, 0.01)}};
    const Quantities under_record{number("motion", 1), number("scale", 1),
                                  number("restitution", 0.5)};
    EXPECT_THAT(refusal_of(given({{"width", 42}, {"height", 155}}), scene, under_record),
                HasSubstr("0.42 m x 1.55 m?"));
}

TEST(LengthsInMetres, OfATowerWithoutAGuessAreRefused)
{
    EXPECT_EQ(refusal_of(given({{"width", 30000}, {"height", 90000}})),
              "height = 90000: the half diagonal R is 4.743e+04 m, above 50 m. Lengths are in "
              "metres.");
}

TEST(LengthsInMetres, AreNotExpectedWhereTheyAreRight)
{
    EXPECT_EQ(refusal_of(given({{"width", 30}, {"height", 95.3}})), ""); // R = 49.95 m
    Scene centimetres;
    centimetres.gravity = 981;
    EXPECT_EQ(refusal_of(given({{"width", 42}, {"height", 155}}), centimetres), "");
    const Quantities dimensionless{number("amplitude", 2), number("frequency", 3),
                                   number("restitution", 0.5)};
    EXPECT_EQ(refusal_of(given({{"half_width", 100}, {"half_height", 567}}), {}, dimensionless),
              "");
    // p is no length.
    EXPECT_EQ(refusal_of(given({{"slenderness", 0.3}, {"frequency_parameter", 0.3}})), "");
}

} // namespace
} // namespace overturn
