// The records in jobs/, and records as they were published. The numbers are those of the records'
// headers.
#include "reading.hpp"

#include "support/published_record.hpp"

#include <algorithm>
#include <cmath>

namespace overturn {
namespace {

double peak_of(const RecordComponent& component)
{
    double peak = 0;
    for (const double a : component.acceleration) {
        peak = std::abs(a) > std::abs(peak) ? a : peak;
    }
    return peak;
}

TEST(AShippedRecord, HasTwentySecondsAndItsPeak)
{
    const std::vector<std::pair<std::string, double>> peaks{{"synthetic.AT2", 0.4},
                                                            {"synthetic_vertical.AT2", 0.2}};
    for (const auto& [name, peak] : peaks) {
        const RecordFile file = read_record(OVERTURN_JOBS_DIRECTORY "/" + name);
        EXPECT_EQ(file.format, "AT2");
        EXPECT_EQ(file.components.at(0).acceleration.size(), 2001) << name;
        EXPECT_EQ(file.components.at(0).time_step, 0.01) << name;
        EXPECT_EQ(std::abs(peak_of(file.components.at(0))), peak) << name;
    }
}

TEST(ARecordOfGeoNet, HasThreeComponentsWithThePeaksOfTheirHeaders)
{
    const std::string path = published_record("WTMC.V2A");
    if (path.empty()) {
        GTEST_SKIP() << "$OVERTURN_RECORDS has no file WTMC.V2A";
    }
    const RecordFile file = read_record(path);
    EXPECT_EQ(file.format, "V2A");
    ASSERT_EQ(file.components.size(), 3);
    const std::vector<std::string> names{"N28W", "S62W", "Up"};
    const Values peaks{-9733.1, 7966.4, 18021.9}; // [mm/s2]
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(file.components[i].name, names[i]);
        EXPECT_EQ(file.components[i].unit, AccelerationUnit::mm_per_s2);
        EXPECT_EQ(file.components[i].acceleration.size(), 8192);
        EXPECT_EQ(file.components[i].time_step, 0.02);
        EXPECT_EQ(peak_of(file.components[i]), peaks[i]);
    }
    EXPECT_NEAR(peak_of(file.components[0]) / 9806.65, -0.99, 0.005);
}

TEST(ARecordOfUsgs, HasThePeakOfItsHeader)
{
    const std::string path = published_record("APEEL2_43.smc");
    if (path.empty()) {
        GTEST_SKIP() << "$OVERTURN_RECORDS has no file APEEL2_43.smc";
    }
    const RecordFile file = read_record(path);
    EXPECT_EQ(file.format, "SMC");
    ASSERT_EQ(file.components.size(), 1);
    EXPECT_EQ(file.components[0].name, "43");
    EXPECT_EQ(file.components[0].unit, AccelerationUnit::cm_per_s2);
    EXPECT_EQ(file.components[0].acceleration.size(), 7184);
    EXPECT_EQ(file.components[0].time_step, 0.005);
    EXPECT_EQ(file.components[0].header.size(), 39);
    EXPECT_NEAR(peak_of(file.components[0]), 272.3, 0.05);
}

} // namespace
} // namespace overturn
