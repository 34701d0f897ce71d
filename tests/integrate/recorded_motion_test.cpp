// A block under a strong ground motion as published by GeoNet.
#include "support/published_record.hpp"
#include "support/record_point.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <string>

namespace overturn {
namespace {

/// The first component of a V2A file over g, or nothing without the file: 26 header lines, then
/// numbers in fields of eight columns [mm/s^2].
std::vector<double> first_component(const std::string& name, std::size_t samples)
{
    std::ifstream file(published_record(name));
    std::string line;
    for (int i = 0; i < 26; ++i) {
        std::getline(file, line);
    }
    std::vector<double> component;
    while (component.size() < samples && std::getline(file, line)) {
        for (std::size_t column = 0; column + 8 <= line.size() && component.size() < samples;
             column += 8) {
            component.push_back(std::stod(line.substr(column, 8)) / 9810);
        }
    }
    return component;
}

class KaikouraRecord : public testing::Test {
protected:
    void SetUp() override
    {
        const std::vector<double> samples = first_component("WTMC.V2A", 8192);
        if (samples.empty()) {
            GTEST_SKIP() << "$OVERTURN_RECORDS has no file WTMC.V2A";
        }
        ASSERT_EQ(samples.size(), 8192);
        const double half_width = 0.25; // [m]
        const double half_height = 1;
        const double size = std::hypot(half_width, half_height);
        const double parameter = std::sqrt(3 * 9.81 / (4 * size)); // p [1/s]
        const double time_step = 0.02;                             // [s]
        const double slenderness = std::atan2(half_width, half_height);
        point_ = {Accelerogram(samples, {}, time_step),
                  {slenderness, largest_restitution(slenderness)},
                  1,
                  1 / (parameter * time_step)};
    }

    RecordPoint at_scale(double scale) const
    {
        RecordPoint point = point_;
        point.scale = scale;
        return point;
    }

private:
    RecordPoint point_{accelerogram({0, 0}), {1, 1}, 1, 1};
};

TEST_F(KaikouraRecord, OverturnsTheBlockInAWindowOfScales)
{
    const auto end_at = [&](double scale) {
        return run_record<Theory::nonlinear, Directions::horizontal>(at_scale(scale), 1e-12);
    };
    for (const double scale : {0.370, 0.380, 0.550, 0.600, 0.750}) {
        const auto end = end_at(scale);
        EXPECT_FALSE(end.fell) << scale;
        EXPECT_GT(margin_of<Theory::nonlinear>(end, at_scale(1).block), 0) << scale;
    }
    for (const double scale : {0.374, 0.395, 0.475}) {
        EXPECT_TRUE(end_at(scale).fell) << scale;
    }
}

TEST_F(KaikouraRecord, TiltsTheBlockToTheReferencePeaks)
{
    // Scale, peak over alpha.
    const std::array<std::array<double, 2>, 5> expected{{{0.370, 0.369012921},
                                                         {0.380, 0.604722248},
                                                         {0.550, 0.829507869},
                                                         {0.600, 0.847474735},
                                                         {0.750, 0.781651387}}};
    for (const auto& [scale, peak] : expected) {
        const double ours =
            peak_under_record<Theory::nonlinear, Directions::horizontal>(at_scale(scale), 1e-12);
        EXPECT_NEAR(ours / at_scale(1).block.slenderness, peak, 1e-9)
            << scale; // the printed digits
    }
}

} // namespace
} // namespace overturn
