// The records in jobs/, and records as they were published where these are available: they are not
// part of the sources. The numbers are those of the records' headers.
#include "reading.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

namespace overturn {
namespace {

/// The path of a record; empty, with a remark, if it is not there.
std::string path_of(const std::string& name)
{
    const std::string path = std::string(OVERTURN_RECORDS_DIRECTORY "/") + name;
    if (!std::filesystem::exists(path)) {
        std::cout << "nothing is tested: " << path << " is not there\n";
        return "";
    }
    return path;
}

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
    const std::string path = path_of("WTMC.V2A");
    if (path.empty()) {
        return;
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
    const std::string path = path_of("APEEL2_43.smc");
    if (path.empty()) {
        return;
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
