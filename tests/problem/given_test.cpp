// From given quantities to a grid: which combinations and values are refused, and with what text.
#include "overturn/problem/coordinates.hpp"
#include "support/given_values.hpp"
#include "support/short_records.hpp"
#include "support/untrapped_floating_point.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace overturn {
namespace {

using testing::HasSubstr;

/// A complete block and pulse in three parts.
const Quantities block{number("width", 0.6), number("height", 1.8)};
const Quantities loss{number("restitution_of_maximum", 0.9)};
const Quantities pulse{number("pga", 0.5), number("pulse_period", 0.7)};

std::vector<std::string> names_of_dimensions(const Grid& grid)
{
    std::vector<std::string> names;
    for (const Dimension& dimension : grid.dimensions) {
        names.push_back(dimension.name);
    }
    return names;
}

/// Expects that the quantity, and the row unless it is no_row, are refused with this text.
void expect_refused(const Scene& scene, const Quantities& given, const std::string& quantity,
                    const std::string& text, std::int64_t row = GivenError::no_row)
{
    try {
        grid_of(scene, given);
        ADD_FAILURE() << quantity << text << " is not refused";
    } catch (const GivenError& error) {
        EXPECT_EQ(error.quantity(), quantity) << text;
        EXPECT_EQ(error.row(), row) << text;
        EXPECT_THAT(error.what(), HasSubstr(text));
    }
}

TEST(GridOf, NumbersHasNoDimension)
{
    const Grid grid = grid_of({}, block + loss + pulse);
    EXPECT_TRUE(grid.dimensions.empty());
    EXPECT_EQ(grid.points(), 1);
    EXPECT_EQ(grid.numbers.size(), 5u);
    EXPECT_EQ(grid.find("height")->values.first(), 1.8);
    EXPECT_EQ(grid.find("slenderness"), nullptr);
    EXPECT_EQ(grid.table(), nullptr);
}

TEST(GridOf, AListOfOneValueHasADimensionOfLengthOne)
{
    const Grid grid = grid_of({}, block + loss + Quantities{axis("pga", {0.5}), pulse[1]});
    EXPECT_EQ(grid.shape(), (Shape{1}));
    EXPECT_EQ(grid.dimension_of("pga"), 0u);
    EXPECT_EQ(grid.dimension_of(Role::strength), 0u);
    EXPECT_EQ(grid.dimension_of(Role::rate), std::nullopt);
}

TEST(GridOf, AxesHasTheirOrderWhicheverComesFirst)
{
    Quantities given{axis("pulse_period", {0.5, 1}), axis("pga", {0.5, 1}),
                     axis("restitution", {0.7, 0.8}), axis("size", {1, 2}),
                     axis("slenderness", {0.1, 0.2})};
    const std::vector<std::string> order{"slenderness", "size", "restitution", "pga",
                                         "pulse_period"};
    EXPECT_EQ(names_of_dimensions(grid_of({}, given)), order);
    std::reverse(given.begin(), given.end());
    EXPECT_EQ(names_of_dimensions(grid_of({}, given)), order);
}

TEST(GridOf, SizesUnderARecordIsTheFastestDimension)
{
    const Scene scene = scene_of_three_records();
    for (const char* size : {"size", "frequency_parameter"}) {
        const Quantities given{axis(size, {1, 2}), axis("scale", {1, 2}), axis("motion", {1, 2, 3}),
                               axis("slenderness", {0.1, 0.2}), number("restitution", 0.8)};
        EXPECT_EQ(names_of_dimensions(grid_of(scene, given)),
                  (std::vector<std::string>{"motion", "slenderness", "scale", size}));
    }
}

TEST(GridOf, ATableHasOneDimensionForAllItsColumns)
{
    const Grid grid =
        grid_of({}, Quantities{column("width", {0.4, 0.6, 1}), column("height", {2, 1.8, 5}),
                               axis("pulse_period", {0.5, 1}), axis("pga", {0.1, 0.2, 0.3, 0.4})} +
                        loss);
    EXPECT_EQ(names_of_dimensions(grid),
              (std::vector<std::string>{"block", "pga", "pulse_period"}));
    EXPECT_EQ(grid.shape(), (Shape{3, 4, 2}));
    ASSERT_NE(grid.table(), nullptr);
    EXPECT_EQ(grid.table()->columns.size(), 2u);
    EXPECT_EQ(grid.dimension_of("height"), 0u);
    EXPECT_EQ(grid.axis_or_number(Role::block), nullptr);
    EXPECT_EQ(grid.axis_or_number(Role::strength)->quantity->name, "pga");
}

TEST(GridOf, ATableUnderRecordsFollowsTheMotion)
{
    const Scene scene = scene_of_three_records();
    const Grid grid =
        grid_of(scene, Quantities{column("width", {0.4, 0.6}), column("height", {2, 1.8}),
                                  axis("scale", {1, 2}), axis("motion", {1, 2, 3})} +
                           loss);
    EXPECT_EQ(names_of_dimensions(grid), (std::vector<std::string>{"motion", "block", "scale"}));
}

TEST(GridOf, APgaUnderAPulseNeedsNoSize)
{
    const Grid grid = grid_of({}, {number("slenderness", 0.2), number("restitution", 0.8),
                                   axis("pga", {0.1, 0.2}), number("frequency", 3)});
    const Scene scene;
    EXPECT_DOUBLE_EQ(Coordinates(scene, grid).of("amplitude").values[1], 0.2 / std::tan(0.2));
}

TEST(GridOf, RefusesAQuantityThatIsGivenTwice)
{
    const Quantities all = block + loss + pulse;
    // The later one in the order of quantities is refused.
    expect_refused({}, all + Quantities{number("half_width", 0.3)}, "half_width",
                   "cannot be combined with width, which gives the same quantity");
    expect_refused({}, all + Quantities{number("amplitude", 2)}, "pga",
                   "cannot be combined with amplitude, which gives the same quantity");
    expect_refused({}, all + Quantities{axis("frequency", {2, 3})}, "pulse_period",
                   "cannot be combined with frequency, which gives the same quantity");
    expect_refused({}, all + Quantities{number("restitution", 0.8)}, "restitution_of_maximum",
                   "cannot be combined with restitution, which gives the same quantity");
    expect_refused({}, all + Quantities{number("slenderness", 0.3)}, "slenderness",
                   "cannot be combined with width, which describes the block in another way");
    expect_refused({}, all + Quantities{number("size", 2)}, "size",
                   "cannot be combined with width, which describes the block in another way");
    expect_refused({}, all + Quantities{column("width", {1, 2})}, "width", "cannot be combined");
}

TEST(GridOf, SaysWhereTheOtherQuantityIsGiven)
{
    Quantities given = block + loss + pulse + Quantities{number("amplitude", 2)};
    given.back().label = "plane.amplitude";
    expect_refused({}, given, "pga", "cannot be combined with plane.amplitude, which");
    expect_refused({}, block + loss + Quantities{column("amplitude", {1, 2})} + pulse, "pga",
                   "cannot be combined with the column amplitude, which");
}

TEST(GridOf, SaysWhatIsMissing)
{
    const std::string advice_on_block = "Give the slenderness [rad]; or width and height";
    expect_refused({}, loss + pulse, "slenderness", "is missing");
    expect_refused({}, Quantities{number("restitution", 0.8)} + pulse, "slenderness",
                   "is missing. " + advice_on_block);
    expect_refused({}, Quantities{block[0]} + loss + pulse, "height",
                   "is missing. Give width and height, or their halves, in metres.");
    expect_refused({}, Quantities{block[1]} + loss + pulse, "width", "is missing.");
    expect_refused({}, block + pulse, "restitution",
                   "is missing. Give restitution, the energy ratio r, or restitution_of_maximum");
    expect_refused({}, block + loss + Quantities{pulse[0]}, "frequency",
                   "is missing. Give frequency, or pulse_period [s] or pulse_frequency [Hz]");
    expect_refused({}, block + loss + Quantities{pulse[1]}, "amplitude",
                   "is missing. Give amplitude, or pga [g].");
    const Quantities without_size{number("slenderness", 0.2), number("restitution", 0.8), pulse[0]};
    for (const char* rate : {"pulse_period", "pulse_frequency"}) {
        expect_refused({}, without_size + Quantities{number(rate, 1)}, rate,
                       "needs the dimensions of the block. Give width and height");
    }
}

TEST(GridOf, SaysWhatIsMissingUnderARecord)
{
    const Scene scene = scene_of_three_records();
    const Quantities motion{number("motion", 1)};
    expect_refused(scene, block + loss + motion, "scale",
                   "is missing. Give scale, a factor on the record, or pga [g].");
    const Quantities shape{number("slenderness", 0.2), number("restitution", 0.8)};
    expect_refused(scene, shape + motion + Quantities{number("scale", 2)}, "size",
                   "is missing. Give size [m] or frequency_parameter [1/s], or width and height");
}

TEST(GridOf, RefusesTheRowOfATableThatMakesNoBlock)
{
    const Quantities heights{column("height", {1, 2, 3})};
    const auto with_widths = [&](AxisList widths) {
        return heights + pulse +
               Quantities{column("width", std::move(widths)), number("restitution", 0.9)};
    };
    grid_of({}, with_widths({1, 60, 3}));
    expect_refused({}, with_widths({1, 2, 1e200}), "width", "slenderness = 1.57", 2);
    expect_refused({}, with_widths({1, 1e-110, 1}), "width", "is outside [1e-100, pi/2)", 1);
    // A number beside the table has no row.
    expect_refused({}, heights + pulse + loss + Quantities{number("width", 1e200)}, "width",
                   "slenderness = 1.57");
}

TEST(GridOf, RefusesTheRowOfATableWhoseRestitutionIsNotAllowed)
{
    const Quantities columns{column("width", {0.4, 0.6, 1}), column("height", {2, 1.8, 5})};
    const auto with_shares = [&](AxisList shares) {
        return columns + pulse + Quantities{column("restitution_of_maximum", std::move(shares))};
    };
    grid_of({}, with_shares({1, 1.05, 1})); // r_max is no physical limit
    expect_refused({}, with_shares({1, 1, 1.5}), "restitution_of_maximum", ": restitution = ", 2);
    expect_refused({}, with_shares({1, 1.7, 1.5}), "restitution_of_maximum",
                   "= 1.7: restitution = ", 1);
    expect_refused({}, block + pulse + Quantities{number("restitution_of_maximum", 1.5)},
                   "restitution_of_maximum", "= 1.5: restitution = ");
    const Quantities wide{column("width", {0.4, 3}), number("height", 2)};
    expect_refused({}, wide + pulse + Quantities{column("restitution_of_maximum", {1, 1})},
                   "restitution_of_maximum", "r_max is defined only for a slenderness below", 1);
}

TEST(GridOf, RefusesAShareOfWhichAnyCombinationIsNotAllowed)
{
    // Allowed for the wider block only.
    const auto given = [](double share) {
        return Quantities{axis("slenderness", {0.1, 0.2, 0.4}),
                          axis("restitution_of_maximum", {0.5, 0.9, share})} +
               Quantities{number("amplitude", 2), number("frequency", 3)};
    };
    const double limit = 1 / std::pow(1 - 1.5 * std::pow(std::sin(0.1), 2), 2);
    grid_of({}, given(limit * (1 - 1e-12)));
    expect_refused({}, given(limit * (1 + 1e-9)), "restitution_of_maximum", ": restitution = 1.0");
}

TEST(GridOf, RefusesAFactorOnARecordThatOverflows)
{
    const UntrappedFloatingPoint overflows;
    Scene scene;
    scene.motion = Suite{{short_record(1e-5, 0.01)}};
    const Quantities others = block + loss + Quantities{number("motion", 1)};
    expect_refused(scene, others + Quantities{axis("pga", {0.5, 1e307})}, "pga",
                   "= 1e+307: scale = inf is outside [0, inf). The factor on a record");
    expect_refused(scene, others + Quantities{column("pga", {0.5, 1e307, 1e308})}, "pga",
                   "= 1e+307: scale = inf", 1);
    scene.motion = Suite{{short_record(1, 0.01, 1e5)}};
    expect_refused(scene, others + Quantities{column("scale", {1e-7, 1e305})}, "scale",
                   "= 1e+305: vertical_pga = inf", 1);
}

TEST(GridOf, RefusesStrengthsAtAllOfWhichTheVerticalMotionCancelsGravity)
{
    Scene scene;
    scene.motion = Suite{{short_record(1, 0.01, -0.5), short_record(1, 0.01, -0.25)}};
    const Quantities others = block + loss;
    const auto given = [&](const Given& motion, AxisList scales) {
        return others + Quantities{motion, axis("scale", std::move(scales))};
    };
    grid_of(scene, given(number("motion", 1), {1, 2, 3})); // allowed at scale 1
    expect_refused(scene, given(number("motion", 1), {2, 3}), "scale",
                   "= 2: from here on, the vertical motion cancels gravity under every record. "
                   "Choose a value below the scale 2");
    grid_of(scene, given(number("motion", 2), {2, 3}));
    grid_of(scene, given(axis("motion", {1, 2}), {2, 3}));
    expect_refused(scene, given(axis("motion", {1, 2}), {4}), "scale",
                   "= 4: from here on, the vertical motion");
}

TEST(GridOf, TakesAnyDirectionOfTwoComponentsAndOnlyTwoOfOne)
{
    Scene scene;
    scene.motion = Suite{{short_record(1, 0.01)}};
    const Quantities others = block + loss + Quantities{number("motion", 1)};
    const Quantities scale{number("scale", 1)};
    grid_of(scene, others + scale + Quantities{axis("direction", {0, 180})});
    expect_refused(scene, others + scale + Quantities{axis("direction", {0, 30, 180})}, "direction",
                   "= 30 needs two horizontal components");
    scene.motion = Suite{{record_of_two_components(0.5, 0.01)}};
    grid_of(scene, others + scale + Quantities{axis("direction", AxisRange{0, 345, 24})});
    expect_refused(scene, others + scale, "direction", "is missing");
    expect_refused(scene, others + Quantities{number("pga", 1), number("direction", 30)}, "pga",
                   "depends on the direction");
}

TEST(GridOf, RefusesABlockWithTwoSidesThatDoesNotStand)
{
    std::mt19937_64 generator(38);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 100; ++i) {
        const double alpha = std::atan(0.6 / 1.8);
        const double incline = 0.5 * uniform(generator);
        const Quantities given = block + loss + pulse + Quantities{number("incline", incline)};
        if (incline < alpha) {
            EXPECT_NO_THROW(grid_of({}, given));
        } else {
            expect_refused({}, given, "incline", "The block does not stand");
        }
        const double offset = 0.6 * uniform(generator);
        const Quantities eccentric =
            block + loss + pulse + Quantities{number("center_offset", offset)};
        if (offset < 0.3) {
            EXPECT_NO_THROW(grid_of({}, eccentric));
        } else {
            expect_refused({}, eccentric, "center_offset", ": slenderness_plus = -");
        }
    }
    expect_refused({}, block + loss + pulse + Quantities{axis("incline", {0, 0.2, 0.4})}, "incline",
                   "-0.0782");
    const Quantities wide{number("width", 1.6), number("height", 0.3), number("incline", 0.5)};
    expect_refused({}, wide + loss + pulse, "incline", "= 0.5: slenderness_minus = 1.88");
}

TEST(GridOf, RefusesABlockWithTwoSidesThatDoesNotRockOn)
{
    // J/m = k^2 + h^2 - b^2, of a plate without height.
    const Quantities plate{number("width", 2), number("height", 0.2),
                           number("radius_of_gyration", 0.5)};
    expect_refused({}, plate + loss + pulse, "width", "for the block to rock on");
}

TEST(GridOf, RefusesDimensionlessMotionsOfABlockWithTwoSides)
{
    const Quantities leaning = block + loss + Quantities{number("incline", 0.05)};
    expect_refused({}, leaning + Quantities{number("amplitude", 2), pulse[1]}, "amplitude",
                   "Give pga [g] instead");
    expect_refused({}, leaning + Quantities{pulse[0], number("frequency", 3)}, "frequency",
                   "Give pulse_period [s] or pulse_frequency [Hz] instead");
    expect_refused({}, leaning + Quantities{pulse[0]}, "pulse_period", " is missing");
    expect_refused({}, leaning + Quantities{pulse[1]}, "pga", " is missing");
    expect_refused({}, block + pulse + Quantities{number("incline", 0.05)}, "restitution",
                   " is missing");
    expect_refused({},
                   block + pulse +
                       Quantities{number("incline", 0.05), number("restitution_of_maximum", 1.05)},
                   "restitution_of_maximum", "Give at most 1");
    expect_refused({}, loss + pulse + Quantities{number("slenderness_plus", 0.2)},
                   "slenderness_minus", " is missing");
}

TEST(GridOf, RefusesDirectionsOtherThanTheMotionAndItsMirrorImage)
{
    for (const double degrees : {0.0, 180.0}) {
        EXPECT_NO_THROW(
            grid_of({}, block + loss + pulse + Quantities{number("direction", degrees)}));
    }
    expect_refused({}, block + loss + pulse + Quantities{number("direction", 90)}, "direction",
                   "needs two horizontal components");
}

TEST(ScalesOf, EveryRecordAreItsSmallestAndLargestFactor)
{
    const Scene scene = scene_of_three_records(); // peaks of 0.5 g, 0.25 g and 2 g
    const Quantities others = block + loss;
    const auto as_pairs = [&](const Quantities& given) {
        std::vector<std::pair<double, double>> pairs;
        for (const Extent& scales : scales_of(scene, grid_of(scene, others + given))) {
            pairs.emplace_back(scales.first, scales.last);
        }
        return pairs;
    };
    using Pairs = std::vector<std::pair<double, double>>;
    const Given all = axis("motion", {1, 2, 3});
    EXPECT_EQ(as_pairs({all, axis("scale", {1, 2, 3})}), (Pairs{{1, 3}, {1, 3}, {1, 3}}));
    EXPECT_EQ(as_pairs({all, axis("pga", {1, 2})}), (Pairs{{2, 4}, {4, 8}, {0.5, 1}}));
    EXPECT_EQ(as_pairs({column("motion", {2, 1, 2}), column("pga", {1, 2, 3})}),
              (Pairs{{4, 4}, {4, 12}, {infinity, 0}}));
}

TEST(CornersOf, AGridAreTheEndsOfItsAxesAndAllRowsOfATable)
{
    const Grid grid =
        grid_of({}, Quantities{column("width", {0.4, 0.6, 1}), axis("height", {2, 3, 4, 5}),
                               axis("pga", AxisRange{0.1, 1, 100}), axis("pulse_period", {1})} +
                        loss);
    const Grid corners = corners_of(grid);
    EXPECT_EQ(grid.shape(), (Shape{3, 4, 100, 1}));
    EXPECT_EQ(corners.shape(), (Shape{3, 2, 2, 1}));
    for (const char* name : {"height", "pga", "pulse_period"}) {
        EXPECT_EQ(corners.find(name)->values.first(), grid.find(name)->values.first());
        EXPECT_EQ(corners.find(name)->values.last(), grid.find(name)->values.last());
    }
}

TEST(Quantity, AppliesToPulsesOrToRecordsOrToBoth)
{
    for (const char* name : {"width", "size", "restitution", "pga"}) {
        EXPECT_TRUE(quantity(name).applies_under(Pulse::traits)) << name;
        EXPECT_TRUE(quantity(name).applies_under(Suite::traits)) << name;
    }
    for (const char* name : {"amplitude", "frequency", "pulse_period", "pulse_frequency"}) {
        EXPECT_TRUE(quantity(name).applies_under(Pulse::traits)) << name;
        EXPECT_FALSE(quantity(name).applies_under(Suite::traits)) << name;
    }
    for (const char* name : {"motion", "scale"}) {
        EXPECT_FALSE(quantity(name).applies_under(Pulse::traits)) << name;
        EXPECT_TRUE(quantity(name).applies_under(Suite::traits)) << name;
    }
    EXPECT_FALSE(quantity("gravity").applies_under(Pulse::traits));
}

} // namespace
} // namespace overturn
