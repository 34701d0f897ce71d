#include "overturn/problem/plausibility.hpp"

#include "support/given_values.hpp"
#include "support/random_record.hpp"
#include "support/two_sides.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace overturn {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

using Columns = std::map<std::string, std::vector<double>>;

/// Blocks of 0.3 m to 2 m under pulses of 0.2 s to 2 s and 0.1 g to 1 g, one in each row.
Columns random_blocks(std::mt19937_64& generator, int count)
{
    const auto column = [&](double first, double last) {
        std::uniform_real_distribution<double> uniform(first, last);
        std::vector<double> values(std::size_t(count), 0.0);
        for (double& value : values) {
            value = uniform(generator);
        }
        return values;
    };
    return {{"width", column(0.1, 0.4)},
            {"height", column(0.5, 2)},
            {"pga", column(0.1, 1)},
            {"pulse_period", column(0.2, 2)},
            {"restitution_of_maximum", column(0.7, 1)}};
}

std::string found_in(const Columns& columns, const Scene& scene = {})
{
    std::vector<Given> given;
    for (const auto& [name, values] : columns) {
        given.push_back(column(name, values));
    }
    if (scene.is_under(Under::record)) {
        given.push_back(number("motion", 1));
    }
    return implausible_values(scene, grid_of(scene, given));
}

void multiply(std::vector<double>& values, double factor)
{
    for (double& value : values) {
        value *= factor;
    }
}

TEST(Plausibility, OfBlocksInMetresSecondsAndGFindsNothing)
{
    std::mt19937_64 generator(1);
    for (int i = 0; i < 100; ++i) {
        EXPECT_THAT(found_in(random_blocks(generator, 5)), IsEmpty());
    }
}

TEST(Plausibility, OfOtherUnitsNamesTheQuantity)
{
    struct OtherUnit {
        std::vector<const char*> columns;
        double factor;
        const char* found;
    };
    std::mt19937_64 generator(2);
    for (const OtherUnit& unit :
         {OtherUnit{{"width", "height"}, 45, "R = "}, OtherUnit{{"width", "height"}, 0.001, "R = "},
          OtherUnit{{"pga"}, 981, "the peak ground acceleration = "},
          OtherUnit{{"pga"}, 100, "the peak ground acceleration = "},
          OtherUnit{{"pulse_period"}, 1000, "the period of the pulse = "},
          OtherUnit{{"height"}, 0.1, "alpha = "},
          OtherUnit{{"restitution"}, 1.8, "is above r_max"}}) {
        for (int i = 0; i < 50; ++i) {
            Columns columns = random_blocks(generator, 1);
            columns["height"] = {4.5 * columns["width"][0]}; // r_max = 0.86
            columns["restitution"] = {0.5};
            columns.erase("restitution_of_maximum");
            for (const char* name : unit.columns) {
                multiply(columns[name], unit.factor);
            }
            EXPECT_THAT(found_in(columns), HasSubstr(unit.found));
        }
    }
}

TEST(Plausibility, OfSmallObjectsInCentimetresNamesTheirSize)
{
    std::mt19937_64 generator(7);
    std::uniform_real_distribution<double> height(20, 40); // of vases [cm]
    for (int i = 0; i < 50; ++i) {
        Columns columns = random_blocks(generator, 1);
        columns["height"] = {height(generator)};
        columns["width"] = {columns["height"][0] / 3};
        EXPECT_THAT(found_in(columns), HasSubstr("R = "));
        multiply(columns["height"], 0.01);
        multiply(columns["width"], 0.01);
        EXPECT_THAT(found_in(columns), IsEmpty());
    }
}

TEST(Plausibility, OfBlocksWithTwoSidesAsksForAFullCircleOfDirections)
{
    Scene scene;
    scene.motion = Suite{
        {std::make_shared<const Accelerogram>(std::vector<double>{0, 0.3, 0}, std::vector<double>(),
                                              0.1, std::vector<double>{0, 0.2, -0.1})}};
    const auto found = [&](double plus, double minus, const std::vector<double>& directions) {
        return implausible_values(
            scene, grid_of(scene, {number("slenderness_plus", plus),
                                   number("slenderness_minus", minus), number("size_plus", 1),
                                   number("size_minus", 1), number("radius_of_gyration", 0.6),
                                   number("restitution_of_maximum", 0.9), number("scale", 1),
                                   axis("direction", AxisList(directions)), number("motion", 1)}));
    };
    EXPECT_THAT(found(0.3, 0.25, {0, 45, 90, 135}), HasSubstr("mirror images"));
    EXPECT_THAT(found(0.3, 0.25, {180, 355}), HasSubstr("give a full circle"));
    EXPECT_THAT(found(0.3, 0.25, {0, 180}), IsEmpty());
    EXPECT_THAT(found(0.3, 0.25, {0, 90, 180, 270}), IsEmpty());
    EXPECT_THAT(found(0.3, 0.25, {30}), IsEmpty()); // one direction was chosen
    EXPECT_THAT(found(0.3, 0.3, {0, 45, 90, 135}), IsEmpty());
}

TEST(Plausibility, OneRowOfATableIsEnough)
{
    std::mt19937_64 generator(3);
    for (int i = 0; i < 50; ++i) {
        Columns columns = random_blocks(generator, 20);
        const std::size_t row = generator() % 20;
        columns["width"][row] *= 0.01;
        columns["height"][row] *= 0.01;
        EXPECT_THAT(found_in(columns), HasSubstr("R = "));
    }
}

TEST(Plausibility, OfRecordsFindsValuesThatNoOtherComesNear)
{
    std::mt19937_64 generator(5);
    Columns columns{{"width", {0.3}}, {"height", {1.0}}, {"restitution_of_maximum", {1.0}}};
    columns["scale"] = {0.01};
    const auto found = [&](const std::vector<double>& horizontal,
                           const std::vector<double>& upwards = {}) {
        Scene scene;
        scene.motion = Suite{{std::make_shared<const Accelerogram>(horizontal, upwards, 0.01)}};
        return found_in(columns, scene);
    };
    std::uniform_real_distribution<double> uniform(-0.3, 0.3);
    for (int i = 0; i < 50; ++i) {
        std::vector<double> samples(200);
        std::ranges::generate(samples, [&] { return uniform(generator); });
        EXPECT_THAT(found(samples), IsEmpty());
        std::vector<double> marked = samples;
        const std::size_t place = generator() % marked.size();
        for (const double marker : {0.65, -1.01832, 4.9}) {
            marked[place] = marked[(place + 7) % marked.size()] = marker;
            EXPECT_THAT(found(marked), HasSubstr(fmt::format("{:.4g} g at ", marker)));
            EXPECT_THAT(found(samples, marked), HasSubstr("a marker of missing values"));
        }
    }
    std::vector<double> pulse(50, 0.01);
    pulse[20] = 1;
    EXPECT_THAT(found(pulse), IsEmpty());
}

TEST(Plausibility, OfAmplitudesThatLiftNoBlock)
{
    std::mt19937_64 generator(6);
    for (int i = 0; i < 50; ++i) {
        Columns columns = random_blocks(generator, 5);
        columns["amplitude"] = columns.extract("pga").mapped();
        EXPECT_THAT(found_in(columns), HasSubstr("lifts no block"));
        columns["amplitude"][2] = 1.5;
        EXPECT_THAT(found_in(columns), IsEmpty());
    }
}

TEST(Plausibility, OfRecordsJudgesPeakAndTimeStep)
{
    Columns columns{{"width", {0.3}}, {"height", {1.0}}, {"restitution_of_maximum", {1.0}}};
    columns["scale"] = {0.001};
    const auto found = [&](double peak, double time_step) {
        Scene scene;
        scene.motion = Suite{{std::make_shared<const Accelerogram>(
            std::vector<double>{0, peak, 0}, std::vector<double>(), time_step)}};
        return found_in(columns, scene);
    };
    EXPECT_THAT(found(0.5, 0.01), IsEmpty());
    EXPECT_THAT(found(300, 0.01),
                HasSubstr("the peak of a component of a record = 300 g is outside 0.001 to 5 g"));
    EXPECT_THAT(found(0.5e-4, 0.01),
                HasSubstr("the peak of a component of a record = 5e-05 g is outside"));
    EXPECT_THAT(found(0.5, 100), HasSubstr("the time step of a record = 100 s"));
}

TEST(Plausibility, OfRecordsJudgesEachComponent)
{
    Columns columns{{"width", {0.3}}, {"height", {1.0}}, {"restitution_of_maximum", {1.0}}};
    columns["scale"] = {0.001};
    columns["direction"] = {30};
    std::mt19937_64 generator(5);
    std::uniform_real_distribution<double> uniform(0.05, 0.9);
    for (int i = 0; i < 50; ++i) {
        const auto found = [&](double vertical, double second) {
            const auto samples = [&](double peak) {
                return std::vector<double>{0, -peak, peak / 3};
            };
            Scene scene;
            scene.motion = Suite{{std::make_shared<const Accelerogram>(
                samples(uniform(generator)), samples(vertical), 0.01, samples(second))}};
            return found_in(columns, scene);
        };
        const double g = uniform(generator);
        EXPECT_THAT(found(g, g), IsEmpty());
        EXPECT_THAT(found(g / 981, g), HasSubstr("the peak of a component of a record = "));
        EXPECT_THAT(found(g, g / 981), HasSubstr("the peak of a component of a record = "));
    }
}

TEST(Plausibility, OfDirectionsExpectsDegrees)
{
    const auto found = [](std::vector<double> directions) {
        const auto all = [&](double value) {
            return std::vector<double>(directions.size(), value);
        };
        const Columns columns{{"width", all(0.3)},
                              {"height", all(1)},
                              {"restitution_of_maximum", all(1)},
                              {"scale", all(0.001)},
                              {"direction", directions}};
        Scene scene;
        scene.motion = Suite{{std::make_shared<const Accelerogram>(
            std::vector<double>{0, 0.5, 0}, std::vector<double>(), 0.01,
            std::vector<double>{0, 0.4, 0})}};
        return found_in(columns, scene);
    };
    for (const std::vector<double>& degrees : {std::vector<double>{0}, {0, 90}, {180, 1}, {345}}) {
        EXPECT_THAT(found(degrees), IsEmpty());
    }
    for (const std::vector<double>& radians :
         {std::vector<double>{1.5708}, {0, 3.1416}, {6.2832, 1}}) {
        EXPECT_THAT(found(radians), HasSubstr("directions are in degrees"));
    }
}

TEST(Plausibility, OfGravityExpectsMetresPerSecondSquared)
{
    Scene scene;
    std::mt19937_64 generator(4);
    const Columns columns = random_blocks(generator, 1);
    for (const double moon_earth_and_jupiter : {1.62, 9.81, 24.8}) {
        scene.gravity = moon_earth_and_jupiter;
        EXPECT_THAT(found_in(columns, scene), IsEmpty());
    }
    for (const double in_g : {0.98, 1.0}) {
        scene.gravity = in_g;
        EXPECT_THAT(found_in(columns, scene), HasSubstr("gravity = "));
    }
    scene.gravity = 981;
    EXPECT_THAT(found_in(columns, scene), HasSubstr("gravity = 981 m/s2"));
}

/// What is found for a block of 0.6 m x 1.8 m.
std::string found_of_statue(const Given& strength, const Given& rate)
{
    return implausible_values({}, grid_of({}, {number("width", 0.6), number("height", 1.8),
                                               number("restitution", 0.7), strength, rate}));
}

TEST(Plausibility, OfDimensionlessAxesNeedsOnePlausibleValue)
{
    const Given amplitudes = axis("amplitude", AxisRange{0.1, 30, 10});   // up to 10 g
    const Given frequencies = axis("frequency", AxisRange{0.01, 12, 10}); // 0.2 s to 226 s
    EXPECT_THAT(found_of_statue(amplitudes, frequencies), IsEmpty());
    const Given slow = axis("frequency", AxisRange{0.01, 0.02, 10}); // from 113 s
    EXPECT_THAT(found_of_statue(amplitudes, slow), HasSubstr("the period of the pulse = 112"));
    const Given strong = axis("amplitude", AxisRange{16, 30, 10}); // from 5.3 g
    EXPECT_THAT(found_of_statue(strong, frequencies),
                HasSubstr("the peak ground acceleration = 5.333"));
}

TEST(Plausibility, OfAxesWithUnitsNeedsAllValues)
{
    const Given pga = axis("pga", AxisRange{0.1, 4, 10});
    const Given hertz = axis("pulse_frequency", AxisRange{0.5, 5, 10});
    EXPECT_THAT(found_of_statue(pga, hertz), IsEmpty());
    const Given in_other_units = axis("pga", AxisRange{1, 10, 10}); // m/s2
    EXPECT_THAT(found_of_statue(in_other_units, hertz), HasSubstr("= 1 to 10 g is above 5 g"));
    const Given millihertz = axis("pulse_frequency", AxisRange{5, 5000, 10});
    EXPECT_THAT(found_of_statue(pga, millihertz), HasSubstr("the period of the pulse = 0.0002"));
}

TEST(Plausibility, OfALeaningBlockExpectsRadiansAndACentreWithinTheBlock)
{
    const auto found = [](double incline, double center_height) {
        const std::vector<Given> given{
            number("width", 0.6),        number("height", 1.8),
            number("incline", incline),  number("center_height", center_height),
            number("restitution", 0.6),  number("pga", 0.3),
            number("pulse_period", 0.5), number("direction", 180)};
        return implausible_values({}, grid_of({}, given));
    };
    EXPECT_THAT(found(-0.1, 1.8), IsEmpty());
    EXPECT_THAT(found(0.2, 0.9),
                HasSubstr("the incline = 11.46 degrees is outside -10 to 10 degrees"));
    EXPECT_THAT(found(-0.2, 0.9), HasSubstr("angles are in radians"));
    EXPECT_THAT(
        found(0.02, 1.9),
        HasSubstr("center_height = 1.9 m is above the top of the block, which is 1.8 m high"));
}

TEST(Plausibility, OfAnglesAndDistancesJudgesTheInclineThatTheyImply)
{
    const auto found = [](const Body& body) {
        const Block<double> block = body.block(0.5);
        return implausible_values(
            {},
            grid_of({},
                    {number("slenderness_plus", block.slenderness),
                     number("slenderness_minus", block.other.slenderness),
                     number("size_plus", block.size), number("size_minus", block.other.size),
                     number("radius_of_gyration", body.gyration), number("restitution", 0.5),
                     number("pga", 0.3), number("pulse_period", 0.5), number("direction", 180)}));
    };
    std::mt19937_64 generator(38);
    for (int i = 0; i < 50; ++i) {
        Body body{0.3, 0.25, 1, 0.6};
        std::uniform_real_distribution<double> degrees(i % 2 == 0 ? -9.9 : 10.1,
                                                       i % 2 == 0 ? 9.9 : 13.0);
        body.incline = degrees(generator) * std::numbers::pi / 180;
        if (i % 4 == 3) {
            body = body.mirrored();
        }
        if (i % 2 == 0) {
            EXPECT_THAT(found(body), IsEmpty());
        } else {
            EXPECT_THAT(found(body),
                        HasSubstr(fmt::format("the incline that the angles and distances imply = "
                                              "{:.4g} degrees is outside -10 to 10 degrees",
                                              body.incline * 180 / std::numbers::pi)));
        }
    }
}

TEST(Plausibility, OfAVerticalRecordThatContainsGravityFindsIt)
{
    std::mt19937_64 generator(36);
    for (int i = 0; i < 50; ++i) {
        Scene scene;
        std::uniform_real_distribution<double> uniform(0, 1);
        std::vector<double> horizontal = random_samples(generator, 200);
        std::vector<double> upwards;
        for (const double value : random_samples(generator, 200)) {
            upwards.push_back(0.1 * value);
        }
        const auto found = [&](double offset) {
            std::vector<double> measured = upwards;
            for (double& value : measured) {
                value += offset;
            }
            scene.motion =
                Suite{{std::make_shared<const Accelerogram>(horizontal, measured, 0.01)}};
            return found_in(
                {{"width", {0.4}}, {"height", {1.8}}, {"scale", {0.5}}, {"restitution", {0.7}}},
                scene);
        };
        EXPECT_THAT(found(0), IsEmpty());
        EXPECT_THAT(found(0.9 + 0.2 * uniform(generator)),
                    HasSubstr("the mean of a vertical record"));
    }
}

TEST(Plausibility, OfTheRadiusOfGyrationAndOfTheDirectionIsJudged)
{
    std::mt19937_64 generator(37);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 50; ++i) {
        const double height = 0.5 + 2 * uniform(generator);
        const double gyration = height * (0.15 + 0.3 * uniform(generator));
        Columns columns{
            {"width", {0.3 * height}}, {"height", {height}},   {"pga", {0.3}},
            {"pulse_period", {0.5}},   {"restitution", {0.5}}, {"radius_of_gyration", {gyration}},
            {"incline", {0.05}},       {"direction", {180}}};
        EXPECT_THAT(found_in(columns), IsEmpty());
        columns["radius_of_gyration"] = {gyration * (i % 2 == 0 ? 6 : 0.1)};
        EXPECT_THAT(found_in(columns), HasSubstr("the radius of gyration"));
        columns["radius_of_gyration"] = {gyration};
        columns.erase("direction");
        EXPECT_THAT(found_in(columns), HasSubstr("direction 180, is not computed"));
        columns["incline"] = {0};
        EXPECT_THAT(found_in(columns), IsEmpty());
    }
}

} // namespace
} // namespace overturn
