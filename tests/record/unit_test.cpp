// Units of acceleration that headers state.
#include "reading.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <random>

namespace overturn {
namespace {

/// An AT2 file with these lines of the database, of the unit and of the sampling.
std::string at2_with_unit(const std::string& unit_line, const std::string& first_line = "PEER",
                          const std::string& sampling = "NPTS= 2, DT= .01 SEC")
{
    return first_line + "\nSan Fernando, 2/9/1971, LA - Unit 2 Gals Bldg. G, 230\n" + unit_line +
           "\n" + sampling + "\n.5 -1\n";
}

/// The number of units of the first sample in 1 m/s2, or -1 if the text is refused; g is 0.
double factor_of(const std::string& text)
{
    try {
        const RecordComponent component = component_of(text);
        return component.unit == AccelerationUnit::g ? 0 : .5 / over_gravity(component, 1).front();
    } catch (const Error&) {
        return -1;
    }
}

struct Group {
    double factor;
    std::vector<std::string> lines;
};

// clang-format off
const std::vector<Group> groups{
    {0, {"ACCELERATION TIME SERIES IN UNITS OF G",
         "ACCELERATION TIME HISTORY IN UNITS OF G",
         "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 HZ LP=30.0 HZ",
         "ACCELERATION TIME SERIES IN UNITS OF G, FILTERED",
         "ACCELERATION TIME HISTORY, UNITS OF G - CORRECTED", "Acceleration in g", "Acceleration (g)",
         "acceleration [g]", "ACCELERATION IN G'S", "UNITS: G", "Units = g", "ACC. IN G.", "ACCELERATION (G), DT IN SEC",
         "ACCELERATION TIME HISTORY IN FRACTIONS OF G", "ACCELERATION UNITS ARE G", "ACCELERATION IN UNITS OF GRAVITY",
         "ACCELERATION IN G, PEAK = 981 CM/S/S AT .01 SEC"}},
    {100, {"ACCELERATION IN CM/S/S", "ACCELERATION TIME SERIES (CM/SEC/SEC)", "UNITS: CM/S**2", "ACCELERATION [cm/s^2]",
           "ACCELERATION TIME SERIES IN UNITS OF CM/S/S", "ACCELERATION TIME SERIES IN UNITS OF CM/S/S, FILTERED",
           "acceleration in cm/sec2", "Acceleration (Gal)", "ACCELERATION IN GALS", "UNITS OF GAL.",
           "ACCELERATION, CM/SEC**2", "ACCELERATION CM/S2 CORRECTED", "Acceleration in cm per sec per sec",
           "ACCELERATION IN CM/SEC SQUARED", "acceleration in cm s-2", "acceleration in cm/s\xc2\xb2",
           "acceleration in cm/s\xb2", "ACCELERATION: CM / SEC / SEC", "ACCELERATION IN CM/(S*S)"}},
    {1, {"ACCELERATION TIME SERIES m\xc2\xb7s\xe2\x81\xbb\xc2\xb2", "ACCELERATION (m s\xe2\x88\x92\xc2\xb2)", "ACCELERATION IN M/S/S", "UNITS: M/S^2", "acceleration (m/s2)", "ACCELERATION IN METERS/SEC/SEC", "units = m s^-2"}},
    {1000, {"ACCELERATION IN MM/S/S", "UNITS OF MM/SEC**2", "acceleration [mm/s^2]"}},
    {-1, {"ACCELERATION IN G/10", "ACCELERATION IN G / 10", "UNITS OF G*981", "ACCELERATION (G/100)", "ACCELERATION IN 0.01 G",
          "ACCELERATION IN 10**-3 G", "ACCELERATION IN PERCENT OF G", "ACCELERATION IN % G", "ACCELERATION (%G)",
          "ACCELERATION IN MILLI-G", "ACCELERATION IN TENTHS OF G", "UNITS: FURLONGS", "ACCELERATION (CM/S)",
          "ACCELERATION IN FT/S/S", "ACCELERATION IN IN/SEC/SEC", "ACCELERATION IN SI UNITS", "ACCELERATION IN COUNTS",
          "ACCELERATION IN CM", "ACCELERATION IN CM/S/S * 10", "ACCELERATION IN UNITS OF G (CM/S/S)", "UNITS: MG",
          "ACCELERATION IN CM/S/S/S", "ACCELERATION IN VOLTS", "ACCELERATION TIME SERIES N/kg", "ACCELERATION TIME SERIES SI",
          "ACCELERATION TIME SERIES [10^-3 G]", "ACCELERATION TIME SERIES IN UNITS OF G (SCALED BY 10)", "ACCELERATION G X 100", "IN UNITS OF G. MULTIPLY BY 2.0", "IN UNITS OF G (X 10)", "UNITS OF G. SCALE FACTOR 1000", "ACCELERATION (G) FACTOR=0.5", "UNITS OF G (X10)", "UNITS OF G, X1000", "IN UNITS OF G (10**-3)", "UNITS OF G E-3", "UNITS OF G (PERCENT)", "IN UNITS OF G BY 1000", "UNITS OF G TO BE MULTIPLIED BY 0.001", "IN UNITS OF G; SF=0.001", "UNITS OF G, 10-3", "UNITS OF G %", "UNITS OF G (DIVIDED BY 10)", "UNITS OF G, SCALED TO 0.1", "UNITS OF G, SCALED", "UNITS OF G. NORMALISED", "UNITS OF G CORRECTED, HALVED", "UNITS: CM/S/S, MULTIPLIED BY 2",
          "SPECTRAL ACCELERATION (G)", "ACCELERATION IN MGAL", "ACCELERATION IN CM/S**3", "UNITS OF 0.1 G",
          "ACCELERATION, % OF G", "ACCELERATION, MICRO-G", "ACCELERATION IN CMSS", "ACCELERATION PERCENT G",
          // a title without a unit, or with words that resemble one
          "ACCELERATION TIME HISTORY", "ACCELERATION TIME SERIES", "", "CORRECTED ACCELERATION, COMPONENT 230",
          "ACCELERATION RECORDED IN GILROY", "ACCELERATION IN DIRECTION 230",
          "ACCELERATION IN THE BASEMENT OF BUILDING G", "ACCELERATION RECORDED IN MILLIKAN LIBRARY",
          "ACCELERATION, COMPONENT N/S (UP)", "ACCELERATION E/W 1/17/1994", "ACCELERATION TIME HISTORY, PGA = 0.35 G",
          "ACCELERATION (FILTERED)", "ACCELERATION HISTORY OF UNIT 2", "ACCELERATION IN M. SMITH BUILDING",
          "ACCELERATION (10 G)", "ACCELERATION, 10 M/S2", "ACCELERATION (DAM/S2)", "ACCELERATION (KGAL)",
          "ACCELERATION IN YD/S2", "ACCELERATION (V)", "ACCELERATION FPS2", "ACCELERATION RAW COUNTS",
          "DISPL. TIME SERIES IN M", "BASELINE CORRECTED VEL. TIME SERIES"}}};
// clang-format on

TEST(AStatedUnit, OfAnAt2FileIsUsedIfItIsUnderstoodAndRefusedOtherwise)
{
    for (const auto& [factor, lines] : groups) {
        for (const std::string& line : lines) {
            EXPECT_EQ(factor_of(at2_with_unit(line)), factor) << line;
        }
    }
}

TEST(AStatedUnit, OfAnAt2FileIsRefusedInAnyLineButTheTitle)
{
    for (const char* title : {"ACCELERATION TIME SERIES", "ACCELERATION IN UNITS OF G"}) {
        EXPECT_EQ(factor_of(at2_with_unit(title, "PEER, UNITS: CM/S/S")), -1);
        EXPECT_EQ(factor_of(at2_with_unit(title, "PEER", "NPTS= 2, DT= .01 SEC, UNITS OF MM/S/S")),
                  -1);
        EXPECT_EQ(factor_of(at2_with_unit(title, "PEER", "NPTS= 2, DT= .01 SEC, CM/S/S")), -1);
        EXPECT_EQ(factor_of(at2_with_unit(title, "PEER", "2 .01 NPTS, DT, IN G/10")), -1);
    }
}

TEST(AStatedUnit, InAnySpellingCaseAndContextIsUnderstoodOrRefusedButNeverG)
{
    std::mt19937_64 random(4);
    const auto one_of = [&](const std::vector<std::string>& words) {
        return words[random() % words.size()];
    };
    for (int i = 0; i < 4000; ++i) {
        const std::string length = one_of({"mm", "cm", "m"});
        const std::string blank = one_of({"", "", " "});
        const std::string second = one_of({"s", "sec", "second"});
        const std::string square =
            one_of({blank + "/" + blank + second, "2", "^2", "**2", " squared"});
        std::string unit = length + blank + "/" + blank + second + square;
        const bool is_understood = random() % 4 != 0;
        if (!is_understood) {
            unit = one_of({unit + "/10", unit + " * 10", unit + " x 0.1", "0.01 " + unit, "km/s2",
                           "g/10", "g * 10", "0.1 g", "percent of g", "mg", "ft" + square});
        }
        for (char& letter : unit) {
            letter = random() % 2 == 0 ? char(std::toupper(letter)) : letter;
        }
        const auto [before,
                    after] = std::vector<std::pair<std::string, std::string>>{{"in ", ""},
                                                                              {"(", ")"},
                                                                              {"[", "] corrected"},
                                                                              {"UNITS: ", ""},
                                                                              {"in units of ",
                                                                               ", filtered"}}
            [random() % (unit.find_first_of(".k") == unit.npos && std::isalpha(unit[0]) ? 5 : 1)];
        const std::string line = "Acceleration time series " + before + unit + after;
        const double factor = length == "mm" ? 1000 : length == "cm" ? 100 : 1;
        EXPECT_EQ(factor_of(at2_with_unit(line)), is_understood ? factor : -1) << line;
    }
}

TEST(AStatedUnit, ThatIsNotUnderstoodIsNamedWithTheWaysToStateIt)
{
    EXPECT_EQ(
        refusal_of(at2_with_unit("ACCELERATION TIME SERIES IN G/10")),
        "a.txt:3: \"ACCELERATION TIME SERIES IN G/10\" does not state a unit that is understood, "
        "such as UNITS OF G or CM/SEC/SEC, as the only one of the header and without a "
        "factor. Give one of g, m/s2, cm/s2, mm/s2, gal: scene.units in a job, --set "
        "scene.units=... on the command line, or units=... in Python.");
}

TEST(AStatedUnit, ThatIsNotUnderstoodOrMissingMayBeGiven)
{
    const RecordOptions in_gal{.time_step = {}, .unit = AccelerationUnit::gal};
    for (const char* line : {"ACCELERATION IN G/10", "ACCELERATION TIME SERIES"}) {
        EXPECT_EQ(component_of(at2_with_unit(line), in_gal).unit, AccelerationUnit::gal) << line;
    }
    EXPECT_EQ(refusal_of(at2_with_unit("ACCELERATION IN CM/S/S"), in_g),
              "a.txt: units = g was given, but this AT2 file is in cm/s2. Remove units.");
}

TEST(AStatedUnit, InTheCommentsOfATextMustBeTheGivenOne)
{
    const RecordOptions in_gal{.time_step = 0.01, .unit = AccelerationUnit::gal};
    EXPECT_EQ(refusal_of("# units: m/s2\n1\n", in_gal),
              "a.txt:1: the comment \"# units: m/s2\" contains \"m/s2\", but may only contain the "
              "given unit, gal, without a factor. Correct one of them, or remove the comment.");
    EXPECT_NE(refusal_of("# in units of cm/s^2\n# from m/s/s, unit 2\n1\n", in_gal), "");
    EXPECT_EQ(component_of("# in units of cm/s^2\n# unit 2\n1\n", in_gal).acceleration, Values{1});
}

TEST(AStatedUnit, InTheHeadOfAColumnMustBeTheGivenOne)
{
    const RecordOptions in_metres{.time_step = 0.01, .unit = AccelerationUnit::m_per_s2};
    for (const char* other : {"# acceleration [g]",
                              "# acc (g)",
                              "# Time [s]  Acc [g]",
                              "# in g",
                              "# ACC(GAL)",
                              "# [cm/s2]",
                              "# velocity [cm/s]",
                              "# units: mg",
                              "# displacement [cm]",
                              "# acc_g",
                              "# acceleration, g",
                              "# a/g",
                              "# t a_g",
                              "# acceleration_cm_s2",
                              "# t,acc_x_cmps2",
                              "# cmss",
                              "# acceleration, milli-g",
                              "# accel, g/1000",
                              "# normalised by gravity",
                              "# acc.%g",
                              "# acceleration divided by g",
                              "# Acc-gal",
                              "# acceleration g",
                              "#g",
                              "# g",
                              "#in g",
                              "% g",
                              "# converted from cm/s2, units: m/s2",
                              "# t a_g [m/s2]",
                              "# acceleration, component G",
                              "# acceleration [m/s2]\n# from records in g",
                              "#acc [g]"}) {
        EXPECT_NE(refusal_of(std::string(other) + "\n1\n", in_metres), "") << other;
    }
    for (const char* same :
         {"# acceleration [m/s2]", "# Time [s]  Acc [m/s^2]", "# in m/s/s", "# no unit",
          "# PGA = 0.35 g, acceleration [m/s2]", "# acc_m_s2", "# acceleration, mps2", "# acc_x",
          "# t_s, a/b", "# acceleration, component N", "# acceleration, 230"}) {
        EXPECT_EQ(component_of(std::string(same) + "\n1\n", in_metres).acceleration, Values{1})
            << same;
    }
}

TEST(AStatedUnit, OfGInAnyCommentMustBeTheGivenOne)
{
    const auto with = [](AccelerationUnit unit, const std::string& comment) {
        return refusal_of(comment + "\n1\n", {.time_step = 0.01, .unit = unit});
    };
    std::mt19937_64 random(10);
    const auto one_of = [&](const std::vector<std::string>& words) {
        return words[random() % words.size()];
    };
    for (int i = 0; i < 4000; ++i) {
        const std::string g = one_of({"g", "G", "g's", "gn"});
        std::string words = one_of({"unit " + g,
                                    "unit: " + g,
                                    "a " + g,
                                    "acc; " + g,
                                    "acc - " + g,
                                    "acc. " + g + ".",
                                    "s " + g,
                                    "s, " + g,
                                    "sec\t" + g,
                                    "multiples of " + g,
                                    "fraction of " + g,
                                    "component EW, " + g,
                                    g,
                                    "in " + g,
                                    "accg",
                                    "ag",
                                    "EW_g",
                                    "acc_g",
                                    "time s acc_ns_g",
                                    "g-units",
                                    "g0",
                                    "PGA 0.3 g, acceleration " + g});
        words = one_of({"#", "# ", "%", "% ", "#\u00a0", "##"}) + words;
        EXPECT_EQ(with(AccelerationUnit::g, words), "") << words;
        EXPECT_NE(with(AccelerationUnit::m_per_s2, words), "") << words;
        EXPECT_NE(with(AccelerationUnit::gal, words), "") << words;
    }
    for (const char* neither :
         {"# g/10", "# 0.01 g", "# mg", "# displacement [m]", "# 1/100 of g", "# % of g",
          "# a [g x 10]", "# in units of 0.01 g", "# 10^-3 g", "# a in g, scaled by 2",
          "# a [g] * 981", "# a [\u00b5g]", "# a [g\u00d710]", "# acceleration 0.01 g",
          "# a [g] scale factor 2", "# a [km/s2]", "# a [ft/s/s]", "# counts: [counts]"}) {
        EXPECT_NE(with(AccelerationUnit::g, neither), "") << neither;
        EXPECT_NE(with(AccelerationUnit::m_per_s2, neither), "") << neither;
    }
    for (const char* other :
         {"# recorded by M. Miller", "# component N", "# PGA 0.35 g", "# g = 9.81 m/s2",
          "# station A, 12 km", "#\u00a0m/s2", "# unit: m/s2 (g = 9.81 m/s2)",
          "# peak acceleration = 0.35 g", "# VS30 450 m/s, Ms 7.1"}) {
        EXPECT_EQ(with(AccelerationUnit::m_per_s2, other), "") << other;
    }
    for (const char* name : {"# recorded by G. Miller", "# component G", "# station G, 12 km"}) {
        EXPECT_EQ(with(AccelerationUnit::g, name), "") << name;
        EXPECT_NE(with(AccelerationUnit::m_per_s2, name), "") << name;
    }
    for (const char* metres : {"#\u00a0m/s2", "# unit: m/s2 (g = 9.81 m/s2)"}) {
        EXPECT_NE(with(AccelerationUnit::g, metres), "") << metres;
    }
}

TEST(AStatedUnit, InTheNameOfAColumnMustBeTheGivenOne)
{
    std::mt19937_64 random(9);
    const auto one_of = [&](const std::vector<std::string>& words) {
        return words[random() % words.size()];
    };
    for (int i = 0; i < 4000; ++i) {
        const std::string length = one_of({"mm", "cm", "m"});
        const std::string unit =
            length + one_of({"/s2", "_s2", "ps2", "/s/s", "/s^2", "s-2", "_per_s2", "/sec2"});
        const std::string column =
            one_of({"a", "acc", "accel", "acceleration", "t,acc", "time_s acc"}) +
            one_of({"_", "/", "-", ".", "_x_", "_230_"});
        std::string name = one_of({column, ""}) + unit; // or the unit alone
        for (char& letter : name) {
            letter = random() % 2 == 0 ? char(std::toupper(letter)) : letter;
        }
        const RecordOptions given{.time_step = 0.01, .unit = AccelerationUnit::m_per_s2};
        name = one_of({"#", "##", "%", "# ", "#\t", "% "}) + name;
        EXPECT_EQ(refusal_of(name + "\n1\n", given) == "", length == "m") << name;
        const RecordOptions in_g_too{.time_step = 0.01, .unit = AccelerationUnit::g};
        EXPECT_NE(refusal_of(name + "\n1\n", in_g_too), "") << name;
    }
}

/// The refusal of two columns with this comment, in this unit.
std::string refusal_with(const std::string& comment, AccelerationUnit unit)
{
    return refusal_of("# " + comment + "\n0.00 1.0\n0.01 2.0\n", {.time_step = {}, .unit = unit});
}

constexpr AccelerationUnit some_units[] = {AccelerationUnit::g, AccelerationUnit::m_per_s2,
                                           AccelerationUnit::gal};

TEST(AStatedUnit, OfAnotherQuantityIsNotThatOfTheSamples)
{
    const std::vector<std::pair<std::string, std::vector<std::string>>> quantities{
        {"km",
         {"Depth", "Hypocentral depth", "Epicentral distance", "Rjb", "R_rup",
          "Distance to rupture", "Fault length"}},
        {"m/s", {"Vs30", "Average shear-wave velocity", "Arias intensity", "S wave velocity"}},
        {"m",
         {"Station elevation", "Altitude", "Sensor depth", "Location X", "UTM E", "Soil thickness",
          "Slip"}},
        {"cm/s", {"PGV", "Peak velocity", "Maximum ground velocity"}},
        {"cm", {"PGD", "Peak displacement", "Fault displacement", "Housner intensity"}},
        {"g",
         {"PGA", "Peak acceleration", "Peak ground acceleration", "Trigger level",
          "Full-scale range", "PSA"}},
        {"cm/s2", {"PGA", "Max. acceleration", "Maximum absolute acceleration"}},
        {"ms", {"Filter delay", "Magnitude"}},
        {"min", {"Duration"}},
        {"V/g", {"Sensitivity"}},
        {"counts/g", {"Gain", "Sensitivity"}},
        {"degrees", {"Latitude", "Azimuth"}}};
    for (const auto& [unit, names] : quantities) {
        for (const std::string& name : names) {
            for (const std::string& comment :
                 {fmt::format("{} ({}): 12.3", name, unit), fmt::format("{}({}): 12.3", name, unit),
                  fmt::format("{} [{}] = 12.3", name, unit),
                  fmt::format("{} ({}) 12.3", name, unit), fmt::format("{}: 12.3 {}", name, unit),
                  fmt::format("{} in {}: 12.3", name, unit),
                  fmt::format("Station A, {} ({}): 12.3, Mw 6.5", name, unit)}) {
                for (const AccelerationUnit given : some_units) {
                    EXPECT_EQ(refusal_with(comment, given), "");
                }
            }
        }
    }
}

TEST(AStatedUnit, InAListOfOtherQuantitiesIsNotThatOfTheSamples)
{
    for (const char* comment :
         {"distances in km, times in UTC", "lat lon depth(km) mag", "Station, Vs30 (m/s), Rjb (km)",
          "Depth unit: km", "Coordinate units: degrees", "g = 9.81", "g (m/s2): 9.81",
          "gravity [m/s2] = 9.80665", "Gravity: 981 cm/s2", "Sample count: 4000", "PGA of 0.35 g",
          "peak acceleration 0.35 g", "Magnitude Ms 7.1", "EVENT_DEPTH_KM: 12.0",
          "STATION_ELEVATION_M: 735", "VS30_M/S: 450", "PGA_CM/S^2: 0.300022", "PGV_CM/S: 3.2",
          "PGD_CM: 0.3"}) {
        for (const AccelerationUnit given : some_units) {
            EXPECT_EQ(refusal_with(comment, given), "");
        }
    }
}

TEST(AStatedUnit, OfManyQuantitiesInOneCommentIsReadInLinearTime)
{
    // A hundred times slower if all words before each unit were read.
    std::string comment;
    for (int i = 0; i < 20'000; ++i) {
        comment += "depth (m/s) ";
    }
    EXPECT_EQ(refusal_with(comment, AccelerationUnit::g), "");
}

TEST(AStatedUnit, OfAccelerationOrAColumnIsThatOfTheSamplesAlsoBesideOtherQuantities)
{
    const std::vector<std::pair<std::string, std::optional<AccelerationUnit>>> units{
        {"g", AccelerationUnit::g},
        {"m/s2", AccelerationUnit::m_per_s2},
        {"cm/s^2", AccelerationUnit::gal},
        {"gal", AccelerationUnit::gal},
        {"mm/s2", AccelerationUnit::mm_per_s2},
        {"0.01 g", {}},
        {"ft/s2", {}},
        {"mg", {}}};
    for (const auto& [unit, stated] : units) {
        for (const char* name :
             {"acceleration", "Acc", "column 2", "data", "samples", "component EW", "ground motion",
              "Acceleration of the ground", "record", "NS", "floor level 3", "noise-free data",
              "full record"}) {
            for (const std::string& statement :
                 {fmt::format("{} in {}", name, unit), fmt::format("{} ({})", name, unit),
                  fmt::format("{} [{}], 100 samples", name, unit),
                  fmt::format("Depth (km): 10, {} in {}", name, unit),
                  fmt::format("Vs30 (m/s): 360; {} ({})", name, unit),
                  fmt::format("PGA 343 gal, {} in {}", name, unit)}) {
                for (const AccelerationUnit given : some_units) {
                    EXPECT_EQ(refusal_with(statement, given) == "", stated == given) << statement;
                }
            }
        }
    }
    for (const char* statement :
         {"units: km", "units: furlongs", "units of the samples: km", "acc (km)",
          "acceleration [m]", "velocity [cm/s]", "displacement [cm]", "channel 1 [cm/s]",
          "horizontal (m/s)", "(km)", "series [cm]", "acceleration (cm): 3", "raw counts",
          "raw counts, 24 bit", "max 35 in units of 0.01 g", "t (ms), Depth (km): 10",
          "PGA-scaled record (mg): 4000"}) {
        for (const AccelerationUnit given : some_units) {
            EXPECT_NE(refusal_with(statement, given), "") << statement;
        }
    }
}

TEST(AStatedUnit, OfTheTimesOfATextIsSeconds)
{
    for (const char* other :
         {"# t [ms]  a [g]", "# time_ms, acc_g", "# acceleration in g, time in ms", "# t_ms acc_g",
          "# t (min), a (g)"}) {
        EXPECT_THAT(refusal_of(std::string(other) + "\n0 1\n10 2\n", in_g),
                    testing::HasSubstr("Give times in seconds."))
            << other;
    }
    EXPECT_EQ(component_of("# t [s]  a [g]\n0 1\n10 2\n", in_g).time_step, 10);
}

TEST(AStatedUnit, OfTheTimeStepIsSeconds)
{
    const auto text = [](const std::string& step) {
        return at2_with_unit("ACCELERATION TIME SERIES IN UNITS OF G", "PEER",
                             "NPTS= 2, DT= " + step);
    };
    for (const char* seconds : {"0.01 SEC", "0.01 sec,", "0.01", ".0100 S", "0.01SEC"}) {
        EXPECT_EQ(component_of(text(seconds)).time_step, 0.01) << seconds;
    }
    for (const char* other :
         {"10 MSEC", "100 Hz", "10 ms", "0.01 SEC/2", "0.01SEC*1E-3", "200 SPS", "0.01 SAMPLES"}) {
        EXPECT_NE(refusal_of(text(other)), "") << other;
    }
}

TEST(Gal, IsOneCentimetrePerSquareSecond)
{
    const auto over_g = [](AccelerationUnit unit) {
        return over_gravity(component_of("3\n", {.time_step = 1, .unit = unit}), 9.81);
    };
    EXPECT_EQ(over_g(AccelerationUnit::gal), over_g(AccelerationUnit::cm_per_s2));
}

} // namespace
} // namespace overturn
