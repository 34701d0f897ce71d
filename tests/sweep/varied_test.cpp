// Verdicts along quantities of the block, at one strength of the motion.
#include "overturn/problem/coordinates.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "support/given_values.hpp"
#include "support/random_record.hpp"
#include "support/verdict_ranges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace overturn {
namespace {

struct Extents {
    const char* quantity;
    double first;
    double last;
};

/// A block of about 0.6 m x 1.8 m; the quantities have these values without the given one.
Quantities block_without(const char* varied, std::mt19937_64& generator)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto about = [&](double value) { return value * (0.8 + 0.4 * uniform(generator)); };
    const std::string name = varied;
    Quantities block;
    if (name == "size" || name == "slenderness") {
        block = {number("size", about(1)), number("slenderness", about(0.3))};
    } else {
        block = {number("width", about(0.6)), number("height", about(1.8))};
        if (name == "incline" || name == "center_offset") {
            block.push_back(number("center_height", about(0.9)));
        }
    }
    block.push_back(number("restitution_of_maximum", 0.8 + 0.2 * uniform(generator)));
    std::erase_if(block, [&](const Given& given) { return given.quantity->name == name; });
    return block;
}

Problem problem_of(const Scene& scene, Quantities given)
{
    return {.scene = scene, .grid = grid_of(scene, std::move(given))};
}

/// The verdicts of `overturn topple` at these values of a quantity.
std::vector<Verdict> verdicts_at(const Scene& scene, Quantities given, const char* quantity,
                                 const AxisList& values)
{
    given.push_back(axis(quantity, values));
    std::vector<Verdict> verdicts;
    for (const double peak : accurate_values(problem_of(scene, std::move(given)), Field::peak)) {
        verdicts.push_back(verdict_of_peak(peak));
    }
    return verdicts;
}

struct Agreement {
    int ranges = 0;
    int toppling = 0;
    int safe = 0;
    int differences = 0;
};

/// Compares the ranges of a quantity with single verdicts at random values, and at the ends.
Agreement agreement_along(const Extents& extents, const Scene& scene, const Quantities& given,
                          std::mt19937_64& generator, int count)
{
    const auto& [name, first, last] = extents;
    const VerdictRanges ranges = ranges_along(
        problem_of(scene, given + Quantities{number(name, first)}), quantity(name), first, last);
    EXPECT_EQ(ranges.all.front().first, first);
    EXPECT_EQ(ranges.all.back().last, last);
    AxisList values{first, last};
    std::uniform_real_distribution<double> uniform(first, last);
    for (int i = 0; i < count; ++i) {
        values.push_back(uniform(generator));
    }
    for (const VerdictRange& range : ranges.with(safe)) { // which end at safe values
        values.insert(values.end(), {range.first, range.last});
    }
    std::ranges::sort(values);
    const auto [begin, end] = std::ranges::unique(values);
    values.erase(begin, end);
    Agreement agreement{.ranges = int(ranges.all.size())};
    const std::vector<Verdict> verdicts = verdicts_at(scene, given, name, values);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const bool is_end_of_safe =
            std::ranges::any_of(ranges.with(safe), [&](const VerdictRange& range) {
                return range.first == values[i] || range.last == values[i];
            });
        const Verdict expected = is_end_of_safe ? safe : ranges.verdict_at(values[i]);
        agreement.toppling += expected == topples;
        agreement.safe += expected == safe;
        agreement.differences += expected != undecided && verdicts[i] != expected;
    }
    return agreement;
}

constexpr Extents all_extents[]{{"width", 0.3, 1.2},
                                {"height", 0.9, 3},
                                {"center_height", 0.4, 1.8},
                                {"center_offset", -0.1, 0.1},
                                {"incline", -0.1, 0.1},
                                {"restitution_of_maximum", 0.5, 1},
                                {"size", 0.3, 4},
                                {"slenderness", 0.1, 0.6}};

TEST(VariedQuantity, HasTheVerdictsOfSingleBlocks)
{
    std::mt19937_64 generator(11);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const Extents& extents : all_extents) {
        Agreement all;
        for (int i = 0; i < 10; ++i) {
            const Scene scene{
                Pulse{i % 2 == 0 ? PulseKind::one_sine : PulseKind::symmetric_ricker}};
            const Quantities given =
                block_without(extents.quantity, generator) +
                Quantities{number("pga", 0.4 + 1.2 * uniform(generator)),
                           number("pulse_period", 0.3 + 0.7 * uniform(generator))};
            const Agreement each = agreement_along(extents, scene, given, generator, 200);
            EXPECT_EQ(each.differences, 0) << extents.quantity << " " << i;
            all.ranges += each.ranges;
            all.toppling += each.toppling;
            all.safe += each.safe;
        }
        EXPECT_GT(all.ranges, 10) << extents.quantity;
        EXPECT_GT(all.toppling, 200) << extents.quantity;
        EXPECT_GT(all.safe, 200) << extents.quantity;
    }
}

TEST(VariedQuantity, HasNoMoreFlipsInTenTimesSmallerSteps)
{
    std::mt19937_64 generator(17);
    std::uniform_real_distribution<double> uniform(0, 1);
    int flips = 0;
    for (int i = 0; i < 150; ++i) { // of 4000 lines, with 3759 flips, none misses one
        const auto& [name, first, last] = all_extents[i % std::size(all_extents)];
        const Quantities given =
            block_without(name, generator) +
            Quantities{number("pga", 0.4 + 2 * uniform(generator)),
                       number("pulse_period", 0.3 + 1.5 * uniform(generator)), number(name, first)};
        const QuantityLine line = line_along(quantity(name), grid_of({}, given), {});
        const auto flips_in = [&](const std::vector<double>& values) {
            return boundary_on({}, line, values, widest_kernel()).flips.size();
        };
        const auto found = flips_in({first, last});
        EXPECT_EQ(found, flips_in(Axis(AxisRange{first, last, 4001}).values())) << name << " " << i;
        flips += int(found);
    }
    EXPECT_GT(flips, 90);
}

TEST(VariedQuantity, OfABlockThatMaySlipHasTheVerdictsOfSingleBlocks)
{
    std::mt19937_64 generator(12);
    Agreement all;
    for (const Extents& extents : {Extents{"friction", 0.1, 1}, Extents{"width", 0.4, 0.9}}) {
        for (int i = 0; i < 3; ++i) {
            Quantities given =
                block_without(extents.quantity, generator) +
                Quantities{number("pga", 1.1 + 0.3 * i), number("pulse_period", 0.5)};
            if (std::string(extents.quantity) == "width") {
                given.push_back(number("friction", 0.6));
            }
            const Agreement each = agreement_along(extents, {}, given, generator, 40);
            EXPECT_EQ(each.differences, 0) << extents.quantity << " " << i;
            all.ranges += each.ranges;
        }
    }
    EXPECT_GT(all.ranges, 9);
}

TEST(VariedQuantity, UnderARecordMissesOnlyNarrowRanges)
{
    std::mt19937_64 generator(13);
    const Accelerogram record = random_record(generator, 400, Directions::horizontal);
    Scene scene;
    scene.motion = Suite{{std::make_shared<const Accelerogram>(record)}};
    for (const char* name : {"width", "restitution_of_maximum"}) {
        const Extents extents =
            name == std::string("width") ? Extents{name, 0.3, 1.2} : Extents{name, 0.7, 1};
        const Quantities given =
            block_without(name, generator) + Quantities{number("pga", 1.2), number("motion", 1)};
        const Agreement each = agreement_along(extents, scene, given, generator, 200);
        // Strips that are narrower than the steps of 0.1 % of the range are missed.
        EXPECT_LE(each.differences, 4) << name;
        EXPECT_GT(each.toppling, 5) << name;
    }
}

TEST(VariedQuantity, DoesNotTopplePastTheWidthThatTheMotionLifts)
{
    std::mt19937_64 generator(14);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (std::size_t kind = 0; kind < pulses.size(); ++kind) {
        Pulse pulse{PulseKind(kind)};
        pulse.shape.cycles = 1.5;
        pulse.shape.gamma = 1.5;
        const double height = 1 + uniform(generator);
        const double pga = 0.2 + 0.4 * uniform(generator);
        const Problem problem =
            problem_of({pulse}, {number("height", height), number("width", 1),
                                 number("restitution_of_maximum", 1), number("pga", pga),
                                 number("pulse_period", 6)});
        const VerdictRanges ranges =
            ranges_along(problem, quantity("width"), 0.02, 1.3 * height * pga);
        EXPECT_LE(ranges.safe_from().value_or(9), height * pga) << name_of(pulse.kind);
        EXPECT_EQ(ranges.verdict_at(0.5 * height * pga), topples) << name_of(pulse.kind);
    }
}

TEST(VariedQuantity, OfTheLinearTheoryUnderARectangularPulseFlipsWhereTheClosedFormDoes)
{
    // The pulse lasts T / 2, so that the block overturns if pga (1 - exp(-p T / 2)) > alpha.
    const Scene scene{Pulse{PulseKind::rectangular}, Theory::linear};
    constexpr double height = 1.8, period = 0.5, pga = 0.8;
    const auto excess = [&](double alpha, double size) {
        const double p = std::sqrt(3 * scene.gravity / (4 * size));
        return -pga * std::expm1(-p * period / 2) - alpha;
    };
    const auto flip_of = [&](Quantities given, const Extents& extents) {
        given.insert(given.end(), {number("restitution", 0.8), number("pga", pga),
                                   number("pulse_period", period)});
        const VerdictRanges ranges = ranges_along(
            problem_of(scene, given), quantity(extents.quantity), extents.first, extents.last);
        EXPECT_EQ(ranges.all.size(), 2u) << extents.quantity;
        EXPECT_EQ(ranges.all.front().verdict, topples) << extents.quantity;
        EXPECT_EQ(ranges.safe_from(), ranges.all.back().first) << extents.quantity;
        return ranges.all.back().first;
    };
    const double width =
        flip_of({number("width", 0.5), number("height", height)}, {"width", 0.3, 1.2});
    // The flips are found to 1e-12 of the range.
    EXPECT_NEAR(excess(std::atan(width / height), std::hypot(width, height) / 2), 0, 1e-11);
    const double alpha =
        flip_of({number("slenderness", 0.3), number("size", 1)}, {"slenderness", 0.1, 0.7});
    EXPECT_NEAR(excess(alpha, 1), 0, 1e-11);
    const double size = flip_of({number("slenderness", 0.3), number("size", 1)}, {"size", 0.1, 9});
    EXPECT_NEAR(excess(0.3, size), 0, 1e-11);
}

TEST(VariedQuantity, FlipsWhereTheStrengthOfTheSameBlockFlips)
{
    std::mt19937_64 generator(15);
    int flips = 0;
    for (int i = 0; i < 6; ++i) {
        constexpr double pga = 1;
        const Quantities given =
            block_without("width", generator) +
            Quantities{number("pga", pga), number("pulse_period", 0.3 + 0.1 * i)};
        const QuantityLine line =
            line_along(quantity("width"), grid_of({}, given + Quantities{number("width", 1)}), {});
        for (const Flip& flip : boundary_on({}, line, {0.2, 1.3}, widest_kernel()).flips) {
            const Point point = line.points({}, {flip.value()}).front();
            const BoundaryLine strengths{.point = point, .unit = pga_of_unit({}, point)};
            const Boundary near =
                boundary_on({}, strengths, {0.999 * pga, 1.001 * pga}, widest_kernel());
            EXPECT_TRUE(std::ranges::any_of(near.flips, [&](const Flip& other) {
                return std::abs(other.value() - pga) < 1e-9;
            })) << flip.value();
            ++flips;
        }
    }
    EXPECT_GT(flips, 6);
}

TEST(VariedQuantity, OfTheMirroredBlockUnderTheMirroredMotionIsMirrored)
{
    std::mt19937_64 generator(16);
    for (const char* name : {"center_offset", "incline"}) {
        const Quantities given =
            block_without(name, generator) +
            Quantities{number("pga", 0.9), number("pulse_period", 0.5), number(name, 0)};
        const auto ranges_in = [&](double direction) {
            return ranges_along(problem_of({}, given + Quantities{number("direction", direction)}),
                                quantity(name), -0.1, 0.1);
        };
        const VerdictRanges one = ranges_in(0);
        const VerdictRanges other = ranges_in(180);
        ASSERT_EQ(one.all.size(), other.all.size());
        EXPECT_GT(one.all.size(), 1u) << name;
        for (std::size_t i = 0; i < one.all.size(); ++i) {
            const VerdictRange& mirrored = other.all[one.all.size() - 1 - i];
            EXPECT_EQ(one.all[i].verdict, mirrored.verdict);
            EXPECT_NEAR(one.all[i].first, -mirrored.last, 1e-12);
        }
    }
}

TEST(VariedQuantity, OfATileHasTheFlipsOfItsLine)
{
    const Grid grid = grid_of({}, {axis("width", AxisRange{0.3, 1.2, 4}), number("height", 1.8),
                                   axis("restitution_of_maximum", {0.9, 1}),
                                   axis("pga", {0.5, 0.9}), axis("pulse_period", {0.5, 0.8})});
    const Boundaries along{&quantity("width")};
    const Problem problem{.grid = grid,
                          .product = along,
                          .fields = {Field::flip_value, Field::region_below, Field::region_above}};
    const Tile tile{.begin = {0, 1, 1, 1}, .count = {8, 1, 1, 1}};
    const QuantityLine line = line_along(
        quantity("width"),
        grid_of({}, {number("width", 1), number("height", 1.8), number("restitution_of_maximum", 1),
                     number("pga", 0.9), number("pulse_period", 0.8)}),
        {});
    const Boundary boundary =
        boundary_on({}, line, Axis(AxisRange{0.3, 1.2, 4}).values(), widest_kernel());
    ASSERT_GT(boundary.flips.size(), 1u);
    const TileFields fields = compute_tile(problem, tile, widest_kernel());
    const auto& value = std::get<std::vector<double>>(fields.values[0]);
    const auto& below = std::get<std::vector<std::uint8_t>>(fields.values[1]);
    for (std::size_t i = 0; i < 8; ++i) {
        if (i < boundary.flips.size()) {
            EXPECT_EQ(value[i], boundary.flips[i].value());
            EXPECT_EQ(Region(below[i]), boundary.flips[i].region_below);
        } else {
            EXPECT_TRUE(std::isnan(value[i]));
        }
    }
}

TEST(VariedQuantity, IsWorstWhereAnyDirectionIs)
{
    const VerdictRanges one{.all = {{0, 1, safe}, {1, 2, topples}, {2, 5, safe}}};
    const VerdictRanges other{.all = {{0, 1.5, undecided}, {1.5, 3, topples}, {3, 5, safe}}};
    const VerdictRanges worst = worst_of({one, other});
    ASSERT_EQ(worst.all.size(), 3u);
    EXPECT_EQ(worst.all[0].verdict, undecided);
    EXPECT_EQ(worst.all[1].verdict, topples);
    EXPECT_EQ((std::pair{worst.all[1].first, worst.all[1].last}), (std::pair{1.0, 3.0}));
    EXPECT_EQ(worst.safe_from(), 3);
    EXPECT_FALSE(worst.safe_up_to());
    EXPECT_EQ(one.safe_up_to(), 1);
}

} // namespace
} // namespace overturn
