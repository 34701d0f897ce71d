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

/// A file of one or more components. The peaks are those of the header, in its unit and digits.
struct Published {
    const char* path;
    const char* format;
    std::vector<std::string> names;
    Values peaks;
    double last_digit; ///< of the peaks
    double time_step;  ///< [s]
    std::size_t samples;
    bool is_uncorrected;
};

// clang-format off
const std::vector<Published> published{
    {"knet/CHB0021412312349.EW", "K-NET", {"E-W"}, {6.847}, 1e-3, 0.01, 6800, true},
    {"knet/CHB0021412312349.NS", "K-NET", {"N-S"}, {3.868}, 1e-3, 0.01, 6800, true},
    {"knet/CHB0021412312349.UD", "K-NET", {"U-D"}, {7.859}, 1e-3, 0.01, 6800, true},
    {"kiknet/AICH040010061330.EW2", "KiK-net", {"EW2"}, {3.896}, 1e-3, 0.005, 28600, true},
    {"kiknet/AICH040010061330.NS2", "KiK-net", {"NS2"}, {5.605}, 1e-3, 0.005, 28600, true},
    {"kiknet/AICH040010061330.UD2", "KiK-net", {"UD2"}, {1.488}, 1e-3, 0.005, 28600, true},
    {"cosmos/AKBMR_BNZ_acc.V2c", "COSMOS", {"BNZ"}, {6.851512}, 1e-6, 0.005, 42000, false},
    {"cosmos/Cosmos12TimeSeriesTest.v1", "COSMOS", {"340 deg"}, {161.962}, 1e-3, 0.01, 7000, false},
    {"csmip/CE58667.V2", "CSMIP", {"H1", "Up", "H2"}, {27.114, 11.244, 26.411}, 1e-3, 0.01, 7500, false},
    {"esm/HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC", "ESM", {"HNE"}, {0.300022}, 1e-6, 0.005, 19128, false},
    {"esm/HI.ARS1..HNN.D.20190728.160908.C.ACC.ASC", "ESM", {"HNN"}, {0.359017}, 1e-6, 0.005, 19128, false},
    {"esm/HI.ARS1..HNZ.D.20190728.160908.C.ACC.ASC", "ESM", {"HNZ"}, {0.202093}, 1e-6, 0.005, 19128, false}};
// clang-format on

TEST(ARecordOfANetwork, HasThePeaksOfItsHeaderInCentimetresPerSecondSquared)
{
    for (const Published& expected : published) {
        const std::string path = published_record(expected.path);
        if (path.empty()) {
            GTEST_SKIP() << "$OVERTURN_RECORDS has no file " << expected.path;
        }
        const RecordFile file = read_record(path);
        EXPECT_EQ(file.format, expected.format);
        ASSERT_EQ(file.components.size(), expected.names.size()) << path;
        for (std::size_t i = 0; i < file.components.size(); ++i) {
            const RecordComponent& component = file.components[i];
            EXPECT_EQ(component.name, expected.names[i]);
            EXPECT_EQ(over_gravity(component, 0.01), component.acceleration) << path; // cm/s2
            EXPECT_EQ(component.time_step, expected.time_step) << path;
            EXPECT_EQ(component.acceleration.size(), expected.samples) << path;
            EXPECT_EQ(component.is_uncorrected, expected.is_uncorrected) << path;
            EXPECT_EQ(component.remarks, std::vector<std::string>()) << path;
            EXPECT_NEAR(std::abs(peak_of(component)), expected.peaks[i],
                        0.51 * expected.last_digit) // rounded
                << path;
        }
    }
}

} // namespace
} // namespace overturn
