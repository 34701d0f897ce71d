// Wavelets cut by a window: at their beginning, the ground may be about to lift the block, already
// lift it, or no longer lift it.
#include "boundary.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace overturn {
namespace {

const double full_turn = 2 * std::acos(-1.0);
const double zero_of_symmetric = std::sqrt(2.0) / full_turn;   ///< windows at which f = 0
const double trough_of_symmetric = std::sqrt(6.0) / full_turn; ///< and f' = 0
const double zero_of_antisymmetric = 3 / full_turn;
const double peak_of_antisymmetric = std::sqrt(9 - 3 * std::sqrt(6.0)) / full_turn;
const double outer_of_antisymmetric = std::sqrt(9 + 3 * std::sqrt(6.0)) / full_turn;

constexpr std::array wavelets{PulseKind::symmetric_ricker, PulseKind::antisymmetric_ricker};

TEST(RickerWindow, OfAnyWidthGivesAVerdict)
{
    for (const PulseKind pulse : wavelets) {
        for (const double window : {0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0}) {
            for (const double amplitude : {1.2, 2.6, 6.0}) {
                expect_right_verdicts(
                    {.pulse = pulse, .frequency = 4, .amplitude = amplitude, .window = window});
            }
        }
    }
}

TEST(RickerWindow, OnlyTheMainLobeLiftsTheBlockUnlessASideLobeReachesTheThreshold)
{
    // The side lobes of the symmetric wavelet peak at 2 exp(-3/2).
    const double threshold = std::exp(1.5) / 2;
    const HardCase beside{
        .pulse = PulseKind::symmetric_ricker, .frequency = 4, .amplitude = threshold};
    for (const double share :
         {1 - 1e-6, 1 - 1e-12, 1 - 1e-15, 1.0, 1 + 1e-15, 1 + 1e-12, 1 + 1e-6, 1.01, 1.1}) {
        HardCase point = beside;
        point.amplitude *= share;
        expect_right_verdicts(point);
    }
}

TEST(RickerWindow, UpliftInTheTailIsIntegratedFromThereOn)
{
    for (const PulseKind pulse : wavelets) {
        for (const double amplitude : {1e2, 1e4, 1e8}) {
            for (const double frequency : {3.0, 1e3, 1e6}) {
                expect_right_verdicts(
                    {.pulse = pulse, .frequency = frequency, .amplitude = amplitude, .window = 5});
            }
        }
    }
}

TEST(RickerWindow, NoUpliftLeavesTheBlockAtRest)
{
    for (const PulseKind pulse : wavelets) {
        for (const double window : {0.1, 0.39, 1.0, 5.0}) {
            const Truth truth =
                expect_right_verdicts({.pulse = pulse, .amplitude = 0.999, .window = window});
            EXPECT_EQ(truth.region, Region::S);
            EXPECT_EQ(truth.steps, 0);
        }
    }
}

TEST(RickerWindow, ThatBeginsAndEndsOnALobeOrBetweenTwoGivesAVerdict)
{
    for (const double amplitude : {1.5, 2.5, 5.0}) {
        for (const double ulps : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
            const double share = 1 + ulps * 0x1p-52;
            for (const double window : {zero_of_symmetric, trough_of_symmetric}) {
                expect_right_verdicts({.pulse = PulseKind::symmetric_ricker,
                                       .frequency = 4,
                                       .amplitude = amplitude,
                                       .window = window * share});
            }
            for (const double window :
                 {zero_of_antisymmetric, peak_of_antisymmetric, outer_of_antisymmetric}) {
                expect_right_verdicts({.pulse = PulseKind::antisymmetric_ricker,
                                       .frequency = 4,
                                       .amplitude = amplitude,
                                       .window = window * share});
            }
        }
    }
}

TEST(RickerWindow, IsResolvedWhereTheVerdictFlips)
{
    const HardCase point{.pulse = PulseKind::antisymmetric_ricker, .frequency = 4, .amplitude = 3};
    for (const auto& [low, high] : {std::array{0.32, 0.34}, std::array{0.68, 0.70}}) {
        const Neighbours flip =
            neighbours_of_root(point, &HardCase::window, low, high, &Truth::margin);
        expect_right_verdicts_around(flip, &HardCase::window);
    }
}

} // namespace
} // namespace overturn
