// Uncertain verdicts, and only those, are settled with more digits.
#include "overturn/sweep/compute_tile.hpp"
#include "point_run.hpp"
#include "support/every_kernel.hpp"
#include "support/given_values.hpp"
#include "support/one_point.hpp"
#include "support/random_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace overturn {
namespace {

struct Found {
    Region region;
    double margin, error;
    std::uint16_t flags;
};

Found compute(const Numerics& numerics, const PulsePoint<double>& point)
{
    const Problem problem{.grid = grid_of_point(point),
                          .numerics = numerics,
                          .fields = {Field::region, Field::margin, Field::error, Field::status}};
    const TileFields fields = compute_tile(problem, tiling_of(problem)[0], widest_kernel());
    return {Region(std::get<std::vector<std::uint8_t>>(fields.values[0])[0]),
            std::get<std::vector<double>>(fields.values[1])[0],
            std::get<std::vector<double>>(fields.values[2])[0],
            std::get<std::vector<std::uint8_t>>(fields.values[3])[0]};
}

constexpr Numerics resolved_rk45{Method::rk45, 1e-4, true};
constexpr Numerics resolved_taylor{Method::taylor, 1e-4, true};

TEST(ErrorOfABlockThatSlips, IsNotBelowTheRoundingOfItsMargin)
{
    const Problem problem{
        .grid = grid_of({}, {number("slenderness", 0.3217506), number("restitution_of_maximum", 1),
                             number("friction", 0.4), axis("amplitude", AxisRange{1.2, 8, 10}),
                             axis("frequency", AxisRange{0.5, 8, 10})}),
        .numerics = {Method::taylor, 1e-14},
        .fields = {Field::margin, Field::error}};
    const TileFields fields = compute_tile(problem, tiling_of(problem)[0], widest_kernel());
    const auto& margin = std::get<std::vector<double>>(fields.values[0]);
    const auto& error = std::get<std::vector<double>>(fields.values[1]);
    int large = 0;
    for (std::size_t i = 0; i < margin.size(); ++i) {
        if (!std::isnan(margin[i])) {
            EXPECT_GE(error[i], 0x1p-52 * std::abs(margin[i])) << margin[i];
            large += std::abs(margin[i]) > 8; // whose rounding is above 0x1p-50
        }
    }
    EXPECT_GT(large, 5);
}

Digits50 true_margin(const PulsePoint<double>& point)
{
    return margin_of<Theory::nonlinear>(
        forced_end<Theory::nonlinear>(PulseKind::one_sine, in_digits(point), 1e-28),
        in_digits(point));
}

/// The last amplitude below 1.5 at which the paper's block is safe, and the first at which it is
/// not: neighbouring doubles.
std::pair<double, double> neighbours_at_the_flip(PulsePoint<double> point)
{
    double safe = 1.2;
    double unsafe = 1.5;
    while (std::nextafter(safe, 2.0) < unsafe) {
        point.amplitude = (safe + unsafe) / 2;
        (true_margin(point) > 0 ? safe : unsafe) = point.amplitude;
    }
    return {safe, unsafe};
}

TEST(ResolvedVerdicts, AreRightToTheLastBitOfTheAmplitude)
{
    const double slenderness = papers_slenderness();
    PulsePoint<double> point{slenderness, largest_restitution(slenderness), 3, 0};
    const auto [safe, unsafe] = neighbours_at_the_flip(point);
    for (const Numerics& numerics : {resolved_rk45, resolved_taylor}) {
        point.amplitude = safe;
        EXPECT_TRUE(is_safe(compute(numerics, point).region));
        EXPECT_GT(compute(numerics, point).margin, 0);
        point.amplitude = unsafe;
        EXPECT_TRUE(is_unsafe(compute(numerics, point).region));
        EXPECT_LT(compute(numerics, point).margin, 0);
        // Doubles alone are not sufficient: the margin is of the order of their round-off.
        EXPECT_LT(std::abs(compute(numerics, point).margin), 1e-14);
        EXPECT_LT(compute(numerics, point).error, std::abs(compute(numerics, point).margin));
        EXPECT_EQ(compute(numerics, point).flags, 0);
    }
}

TEST(ResolvedVerdicts, AreThoseOfTheFirstPassWhereItIsCertain)
{
    const PulsePoint<double> point{0.2, 0.8, 3, 4};
    Numerics plain = resolved_taylor;
    plain.resolve = false;
    const Found once = compute(plain, point);
    const Found resolved = compute(resolved_taylor, point);
    ASSERT_LT(once.error, std::abs(once.margin));
    EXPECT_EQ(once.margin, resolved.margin);
    EXPECT_EQ(once.error, resolved.error);
}

TEST(ResolvedVerdicts, HavePeaksThatAreAccurateAfterManyImpacts)
{
    // After many impacts, a tolerance that settles the verdict may be wrong by half of the peak.
    const Scene scene{.motion = Pulse{PulseKind::cosine, {.cycles = 4}}};
    const Problem accurate{.scene = scene,
                           .grid = grid_of(scene, {axis("slenderness", {0.1, 0.18, 0.3}),
                                                   axis("restitution_of_maximum", {0.6, 0.9}),
                                                   axis("amplitude", AxisRange{1.05, 3, 40}),
                                                   axis("frequency", AxisRange{0.5, 8, 60})}),
                           .numerics = {Method::taylor, 1e-13},
                           .fields = {Field::peak, Field::margin, Field::error}};
    for (const Numerics& numerics : {resolved_rk45, resolved_taylor}) {
        Problem resolved = accurate;
        resolved.numerics = numerics;
        int compared = 0;
        const Tiling tiling = tiling_of(accurate);
        for (std::int64_t n = 0; n < tiling.size(); ++n) {
            const TileFields expected = compute_tile(accurate, tiling[n], widest_kernel());
            const TileFields found = compute_tile(resolved, tiling[n], widest_kernel());
            const auto value = [](const TileFields& fields, std::size_t field, std::size_t i) {
                return std::get<std::vector<double>>(fields.values[field])[i];
            };
            for (std::size_t i = 0; i < std::size_t(tiling[n].points()); ++i) {
                if (value(expected, 2, i) < std::abs(value(expected, 1, i))) { // no more digits
                    EXPECT_EQ(value(expected, 0, i), value(found, 0, i));
                    ++compared;
                }
            }
        }
        EXPECT_GT(compared, 14000);
    }
}

TEST(ResolvedVerdicts, AreUndecidedIfMoreDigitsDoNotHelp)
{
    // Without loss the block bounces a hundred thousand times before a slow pulse lifts it again.
    const Found found = compute(resolved_taylor, {0.3, 1, 0.02, 1.00002});
    EXPECT_EQ(found.region, Region::undecided);
    EXPECT_EQ(found.flags, status::unresolved);
}

TEST(ResolvedVerdicts, AreThoseOfLimitedNumbersOfPointsUnderARecordIn50Digits)
{
    std::mt19937_64 generator(7);
    RecordPoint point = random_record_point(generator, 500, Directions::horizontal);
    for (int i = 0; i < 2865; ++i) { // one that 31 digits do not settle, after many bounces
        point = random_record_point(generator, 500, Directions::horizontal);
    }
    Scene scene;
    scene.motion = Suite{{std::make_shared<const Accelerogram>(point.record)}};
    const Point block{{point.block.slenderness, 1}, point.scale, point.frequency};
    const std::vector<Point> points(3, block);
    const PointRun run(scene, points, widest_kernel());
    for (const int most : {1, 3}) {
        const Outcomes outcomes = outcomes_of(run, resolved_taylor, {.region = true}, most);
        EXPECT_EQ(outcomes.in_50_digits, most);
        for (int i = 0; i < run.size(); ++i) {
            const std::uint16_t flags = i < most ? 0 : status::unresolved | outcome_flag::in_doubt;
            EXPECT_EQ(outcomes[std::size_t(i)].flags, flags) << i;
            EXPECT_EQ(outcomes[std::size_t(i)].region == Region::undecided, i >= most);
        }
    }
}

TEST(PointsIn31Digits, AreTheSameOnEveryKernel)
{
    std::mt19937_64 generator(8);
    for (const Directions directions : {Directions::horizontal, Directions::both}) {
        const RecordPoint drawn = random_record_point(generator, 60, directions);
        Scene scene;
        scene.motion = Suite{{std::make_shared<const Accelerogram>(drawn.record)}};
        std::vector<Point> points;
        for (int i = 0; i < 21; ++i) {
            points.push_back({{drawn.block.slenderness, 0.7 + 0.01 * i},
                              drawn.scale * (1 - 0.02 * i),
                              drawn.frequency * (1 + 0.01 * i)});
        }
        std::vector<int> chosen;
        for (int i = 0; i < 21; i += 1 + i % 2) {
            chosen.push_back(i);
        }
        constexpr Outputs outputs{.impacts = true,
                                  .error = true,
                                  .peak = true,
                                  .region = true,
                                  .margin = true,
                                  .steps = true};
        std::optional<Outcomes> first;
        for (const Kernel kernel : every_kernel()) {
            Outcomes found(21, outputs);
            PointRun(scene, points, kernel).run_in_31_digits(found, chosen);
            if (!first) {
                first = std::move(found);
                continue;
            }
            for (const int i : chosen) {
                const auto k = std::size_t(i);
                EXPECT_EQ(found[k].tilt, (*first)[k].tilt);
                EXPECT_EQ(found[k].margin, (*first)[k].margin);
                EXPECT_EQ(found[k].error, (*first)[k].error);
                EXPECT_EQ(found[k].peak, (*first)[k].peak);
                EXPECT_EQ(found[k].steps, (*first)[k].steps);
                EXPECT_EQ(found[k].region, (*first)[k].region);
                EXPECT_EQ(found[k].flags, (*first)[k].flags);
            }
        }
    }
}

TEST(ResolvedVerdicts, UnderARecordComeWithThePeakOfTheMotionThatSettledThem)
{
    std::mt19937_64 generator(2);
    int sensitive = 0;
    for (int i = 0; i < 2000 && sensitive < 3; ++i) {
        const RecordPoint point = random_record_point(generator, 150, Directions::horizontal);
        Scene scene;
        scene.motion = Suite{{std::make_shared<const Accelerogram>(point.record)}};
        const PointRun run(scene, {{{point.block.slenderness, 1}, point.scale, point.frequency}},
                           widest_kernel());
        constexpr Outputs outputs{.error = true, .peak = true, .region = true, .margin = true};
        const Outcomes in_doubles = outcomes_of(run, {Method::taylor, 1e-13}, outputs);
        if (std::isfinite(in_doubles[0].error)) {
            continue; // it is not sensitive
        }
        Outcomes exact(1, outputs);
        run.run_in_more_digits<Digits50>(0, exact);
        if (exact[0].flags & outcome_flag::without_end) {
            continue; // too many steps for 50 digits
        }
        ++sensitive;
        const Outcomes resolved = outcomes_of(run, resolved_taylor, outputs);
        EXPECT_EQ(resolved[0].region, exact[0].region);
        // The error of the peak has no bound of its own; that of the end has been amplified more.
        EXPECT_NEAR(resolved[0].peak, exact[0].peak,
                    1e-6 * point.block.slenderness + resolved[0].error);
    }
    EXPECT_EQ(sensitive, 3);
}

/// All points of a block of slenderness 0.2 at these amplitudes and at frequencies from 0.3 to 8.
std::vector<Point> points_of_block(double restitution, const AxisRange& amplitudes)
{
    const Grid grid =
        grid_of({}, {number("slenderness", 0.2), number("restitution", restitution),
                     axis("amplitude", amplitudes),
                     axis("frequency", AxisRange{0.3, 8, amplitudes.count, Spacing::log})});
    return Coordinates({}, grid).points();
}

TEST(FirstPass, EndsWhereItIsUncertainAndIsUnchangedElsewhere)
{
    // Without loss, from hardly lifted to overturned.
    const std::vector<Point> points = points_of_block(1, {1.001, 6, 24, Spacing::log});
    for (const Numerics& numerics : {Numerics{Method::rk45, 1e-4}, {Method::taylor, 1e-4}}) {
        const PointRun run({}, points, widest_kernel());
        Outcomes whole(run.size(), {.error = true, .steps = true});
        Outcomes ended(run.size(), whole.outputs);
        run.run(numerics, whole, run.all());
        run.run(numerics, ended, run.all(), UncertainImpact::stop);
        double steps_of_doubtful = 0;
        double steps_until_doubt = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_EQ(std::isinf(whole[i].error), std::isinf(ended[i].error));
            if (std::isinf(whole[i].error)) {
                steps_of_doubtful += whole[i].steps;
                steps_until_doubt += ended[i].steps;
            } else {
                EXPECT_EQ(whole[i].tilt, ended[i].tilt);
                EXPECT_EQ(whole[i].rate, ended[i].rate);
                EXPECT_EQ(whole[i].error, ended[i].error);
                EXPECT_EQ(whole[i].steps, ended[i].steps);
            }
        }
        EXPECT_LE(steps_until_doubt, steps_of_doubtful);
        if (numerics.method == Method::rk45) {
            EXPECT_LT(steps_until_doubt, 0.8 * steps_of_doubtful);
        }
    }
}

TEST(FirstPass, IsUncertainUnlessTheMarginExceedsTheError)
{
    const std::vector<Point> points = points_of_block(0.9, {1.001, 20, 32, Spacing::log});
    int sure = 0;
    int doubted = 0;
    int doubted_of_fallen = 0;
    for (const Numerics& numerics : {Numerics{Method::rk45, 1e-2}, {Method::taylor, 1e-2}}) {
        for (const Theory theory : {Theory::nonlinear, Theory::linear}) {
            const PointRun run({.theory = theory}, points, widest_kernel());
            Outcomes outcomes(run.size(), {.error = true, .margin = true});
            run.run(numerics, outcomes, run.all());
            for (std::size_t i = 0; i < points.size(); ++i) {
                const bool in_doubt = outcomes[i].flags & outcome_flag::in_doubt;
                EXPECT_EQ(in_doubt, !(outcomes[i].error < std::abs(outcomes[i].margin)));
                ++(!in_doubt                                ? sure
                   : outcomes[i].flags & outcome_flag::fell ? doubted_of_fallen
                                                            : doubted);
            }
        }
    }
    EXPECT_GT(sure, 0);
    EXPECT_GT(doubted, 0);
    EXPECT_GT(doubted_of_fallen, 0);
}

TEST(ResolvedVerdicts, AreRightWhereTheFirstPassExceedsItsBound)
{
    // The bound of the first pass is less than half its margin, a twelfth of its error.
    const Scene scene{Pulse{PulseKind::cosine, {.cycles = 3}}, Theory::linear};
    const Point point{
        {0.11492817379204712, 0.78992179750511027}, 1.0894839980764797, 1.9658077169821069};
    const PointRun run(scene, {point}, widest_kernel());
    const Outputs outputs{.error = true, .region = true, .margin = true};
    const Outcomes first = outcomes_of(run, {Method::rk45, 1e-4}, outputs);
    EXPECT_GT(first[0].margin, 2 * first[0].error);
    Outcomes exact(1, outputs);
    run.run_in_more_digits<Digits50>(0, exact);
    EXPECT_LT(exact[0].margin, first[0].margin - 10 * first[0].error);
    const Outcomes resolved = outcomes_of(run, resolved_rk45, outputs);
    EXPECT_EQ(resolved[0].region, exact[0].region);
    EXPECT_NEAR(resolved[0].margin, exact[0].margin, resolved[0].error);
}

TEST(ResolvedVerdicts, AreNotSoughtWhereGravityVanishes)
{
    Scene scene;
    scene.motion = Suite{{std::make_shared<const Accelerogram>(
        std::vector<double>{0, 0.5, 0}, std::vector<double>{0, -0.5, 0}, 0.1)}};
    const PointRun run(scene, {{{0.2, 0.9}, 1, 3}, {{0.2, 0.9}, 2, 3}, {{0.2, 0.9}, 3, 3}},
                       widest_kernel());
    const Outcomes outcomes = outcomes_of(run, {Method::taylor, 1e-4, true}, {.region = true}, 100);
    EXPECT_EQ(outcomes.in_50_digits, 0);
    EXPECT_NE(outcomes[0].region, Region::undecided);
    for (const std::size_t i : {1, 2}) {
        EXPECT_EQ(outcomes[i].region, Region::undecided);
        EXPECT_EQ(outcomes[i].flags, status::free_fall);
    }
}

TEST(ResolvedVerdicts, AreCertainForABlockThatIsNeverLifted)
{
    for (const double amplitude : {0.0, 0.5, 1.0}) {
        const Found found = compute(resolved_rk45, {0.2, 0.8, 3, amplitude});
        EXPECT_EQ(found.region, Region::S);
        EXPECT_EQ(found.margin, 1);
        EXPECT_EQ(found.flags, 0);
    }
}

} // namespace
} // namespace overturn
