// Properties of the forced stage under records.
#include "support/observed_order.hpp"
#include "support/one_point.hpp"
#include "support/record_point.hpp"
#include "support/special_values.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace overturn {
namespace {

/// Calls visit.template operator()<theory, directions>().
template <class Visitor>
void for_every_kind(const Visitor& visit)
{
    visit.template operator()<Theory::nonlinear, Directions::horizontal>();
    visit.template operator()<Theory::nonlinear, Directions::both>();
    visit.template operator()<Theory::linear, Directions::horizontal>();
    visit.template operator()<Theory::linear, Directions::both>();
}

template <class T>
void expect_same_bits(const ForcedEnd<T>& ours, const ForcedEnd<T>& theirs)
{
    EXPECT_EQ(ours.state.tilt, theirs.state.tilt);
    EXPECT_EQ(ours.state.rate, theirs.state.rate);
    EXPECT_EQ(ours.fell, theirs.fell);
    EXPECT_EQ(ours.rested, theirs.rested);
    EXPECT_EQ(ours.impacts, theirs.impacts);
    EXPECT_EQ(ours.steps, theirs.steps);
    EXPECT_EQ(ours.phase, theirs.phase);
    EXPECT_EQ(ours.error, theirs.error);
}

TEST(RecordStage, MirroredRecordGivesTheMirroredEndToTheBit)
{
    std::mt19937_64 generator(31);
    for_every_kind([&]<Theory theory, Directions directions>() {
        for (int i = 0; i < 50; ++i) {
            const RecordPoint point = random_record_point(generator, 40, directions);
            RecordPoint by_scale = point;
            by_scale.scale = -point.scale;
            RecordPoint by_samples = point;
            std::vector<double> mirrored = point.record.horizontal();
            for (double& a : mirrored) {
                a = -a;
            }
            by_samples.record = accelerogram(mirrored, point.record.upwards());
            const auto plain = run_record<theory, directions>(point, 1e-9);
            for (const RecordPoint& other : {by_scale, by_samples}) {
                const auto end = run_record<theory, directions>(other, 1e-9);
                expect_same_bits(plain, end);
                if (plain.state.tilt != 0 || plain.state.rate != 0) {
                    EXPECT_EQ(plain.state.side, -end.state.side);
                }
            }
        }
    });
}

TEST(RecordStage, DependsOnTheTimeStepOnlyByItsProductWithTheFrequencyParameter)
{
    std::mt19937_64 generator(32);
    for (int i = 0; i < 50; ++i) {
        RecordPoint point = random_record_point(generator, 40, Directions::both);
        const double p = 2.25;
        const auto end_at = [&](double time_step, double parameter) {
            point.record =
                Accelerogram(point.record.horizontal(), point.record.upwards(), time_step);
            point.frequency = 1 / (parameter * time_step);
            return run_record<Theory::nonlinear, Directions::both>(point, 1e-9);
        };
        expect_same_bits(end_at(0.01, p), end_at(0.02, p / 2));
    }
}

TEST(RecordStage, ScaledSamplesAreAScaledRecord)
{
    std::mt19937_64 generator(33);
    for (int i = 0; i < 50; ++i) {
        const RecordPoint point = random_record_point(generator, 40, Directions::both);
        RecordPoint other = point;
        const auto halved = [](std::vector<double> samples) {
            for (double& a : samples) {
                a /= 2;
            }
            return samples;
        };
        other.record =
            accelerogram(halved(point.record.horizontal()), halved(point.record.upwards()));
        other.scale = 2 * point.scale;
        // A power of two: no bit may change.
        expect_same_bits(run_record<Theory::nonlinear, Directions::both>(point, 1e-9),
                         run_record<Theory::nonlinear, Directions::both>(other, 1e-9));
    }
}

TEST(RecordStage, AVerticalMotionOfZeroChangesNothingButRoundOff)
{
    std::mt19937_64 generator(34);
    for (int i = 0; i < 200; ++i) {
        const RecordPoint point = random_record_point(generator, 40, Directions::horizontal);
        RecordPoint still = point;
        still.record = accelerogram(point.record.horizontal(), std::vector<double>(40, 0.0));
        const auto without = run_record<Theory::nonlinear, Directions::horizontal>(point, 1e-12);
        const auto with = run_record<Theory::nonlinear, Directions::both>(still, 1e-12);
        if (without.error < infinity && with.error < infinity) {
            EXPECT_NEAR(margin_of<Theory::nonlinear>(without, point.block),
                        margin_of<Theory::nonlinear>(with, point.block),
                        without.error + with.error);
        }
    }
}

/// Runs of the same motion must agree within the sum of their errors, where these are known.
struct Agreement {
    int runs = 0;
    int known = 0;
    double largest_error = 0;

    void expect(double ours, double our_error, double theirs, double their_error)
    {
        ++runs;
        if (our_error < infinity && their_error < infinity) {
            ++known;
            EXPECT_NEAR(ours, theirs, our_error + their_error) << "run " << runs;
        }
    }
    void expect_mostly_known() const { EXPECT_GT(known, 0.9 * runs); }
};

TEST(RecordStage, MoreSamplesOfTheSameMotionChangeTheMarginByLessThanTheErrors)
{
    std::mt19937_64 generator(35);
    Agreement agreement;
    for_every_kind([&]<Theory theory, Directions directions>() {
        for (int i = 0; i < 150; ++i) {
            const RecordPoint point = random_record_point(generator, 40, directions);
            const auto ours = run_record<theory, directions>(point, 1e-11);
            const auto finer = run_record<theory, directions>(refined(point, 2), 1e-11);
            agreement.expect(margin_of<theory>(ours, point.block), ours.error,
                             margin_of<theory>(finer, point.block), finer.error);
        }
    });
    agreement.expect_mostly_known();
}

TEST(RecordStage, OrdersAgreeWithinTheirErrors)
{
    std::mt19937_64 generator(36);
    Agreement agreement;
    for_every_kind([&]<Theory theory, Directions directions>() {
        for (int i = 0; i < 150; ++i) {
            const RecordPoint point = random_record_point(generator, 40, directions);
            const auto best = run_record<theory, directions, 20>(point, 1e-14);
            const auto compare = [&](const ForcedEnd<double>& end) {
                agreement.expect(margin_of<theory>(end, point.block), end.error,
                                 margin_of<theory>(best, point.block), best.error);
            };
            for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
                compare(run_record<theory, directions, 8>(point, tolerance));
                compare(run_record<theory, directions, 14>(point, tolerance));
                compare(run_record<theory, directions, 20>(point, tolerance));
            }
        }
    });
    agreement.expect_mostly_known();
}

TEST(RecordStage, InDoublesAgreesWithFiftyDigitsWithinTheError)
{
    std::mt19937_64 generator(37);
    Agreement agreement;
    const auto expect_agreement = [&]<Directions directions>() {
        for (int i = 0; i < 12; ++i) {
            RecordPoint point = random_record_point(generator, 12, directions);
            point.block.restitution = std::min(point.block.restitution, 0.6); // few bounces
            const Block<Digits50> block{point.block.slenderness, point.block.restitution};
            const auto exact = run_in_more_digits<Digits50, Theory::nonlinear>(
                block, excitation_of<Theory::nonlinear, Directions::both, Digits50>(point), nullptr,
                1e-25);
            const double margin(margin_of<Theory::nonlinear>(exact, block));
            for (const double tolerance : {1e-8, 1e-13}) {
                const auto ours = run_record<Theory::nonlinear, directions>(point, tolerance);
                agreement.expect(margin_of<Theory::nonlinear>(ours, point.block), ours.error,
                                 margin, 0);
            }
        }
    };
    expect_agreement.operator()<Directions::horizontal>();
    expect_agreement.operator()<Directions::both>();
    agreement.expect_mostly_known();
}

TEST(RecordStage, SamplesOfAPulseConvergeToThePulseWithOrderTwo)
{
    const PulsePoint<double> point{0.2, 0.8, 3, 2.2};
    const auto expect_order = [&]<Theory theory>() {
        const auto pulse = forced_end<theory, Taylor<20>>(PulseKind::one_sine, point, 1e-14);
        ASSERT_FALSE(pulse.fell);
        ASSERT_GT(pulse.impacts, 0);
        const auto error = [&](int intervals) {
            std::vector<double> samples;
            for (int i = 0; i <= intervals; ++i) {
                samples.push_back(std::sin(2 * pi<double>() * i / intervals));
            }
            const RecordPoint sampled{accelerogram(samples), point.block(),
                                      point.amplitude * Equations<theory>::uplift_acceleration(
                                                            BlockSide{point.slenderness}),
                                      point.frequency * intervals / (2 * pi<double>())};
            const auto end = run_record<theory, Directions::horizontal, 20>(sampled, 1e-14);
            EXPECT_EQ(end.impacts, pulse.impacts);
            EXPECT_EQ(end.state.side, pulse.state.side);
            return std::abs(end.state.tilt - pulse.state.tilt) +
                   std::abs(end.state.rate - pulse.state.rate);
        };
        // A chord of the sine is off by its mean second derivative times h^2 / 12. The terms of
        // order h^3, of the interval in which the block is lifted, change the slope by 1 / n.
        EXPECT_NEAR(observed_order({64, 96, 128, 256, 512}, error), 2, 0.05);
        EXPECT_LT(error(512), 1e-4);
    };
    expect_order.template operator()<Theory::nonlinear>();
    expect_order.template operator()<Theory::linear>();
}

TEST(RecordStage, PeakIsTheLargestTiltOfAFineHistory)
{
    std::mt19937_64 generator(38);
    for_every_kind([&]<Theory theory, Directions directions>() {
        for (int i = 0; i < 30; ++i) {
            const RecordPoint point = random_record_point(generator, 20, directions);
            const int parts = 64;
            const std::vector<double> tilts =
                tilts_at_samples<theory, directions>(refined(point, parts), 1e-12);
            const double highest = *std::max_element(tilts.begin(), tilts.end());
            const double peak = peak_under_record<theory, directions>(point, 1e-12);
            const double error = run_record<theory, directions>(point, 1e-12).error;
            // Errors grow: until the peak they are at most as large as at the end.
            const double tolerance = (8 * error + 1e-11) * point.block.slenderness;
            EXPECT_GE(peak, highest - tolerance);
            // Between two samples h apart, a peak exceeds the higher one by h^2 / 8 times the
            // largest acceleration at most; one at an impact, or at a fall, is a sample.
            const double h = 1 / (parts * point.frequency);
            const double acceleration =
                2 + point.scale * (point.record.peak() + 2 * point.record.upwards_peak());
            EXPECT_LE(peak, highest + h * h / 8 * acceleration + tolerance);
        }
    });
}

} // namespace
} // namespace overturn
