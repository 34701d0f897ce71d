// Headers of which one number was altered: no file is read with a wrong unit, scale, time step or
// length. The files are made here, and are those of $OVERTURN_RECORDS.
#include "reading.hpp"

#include "overturn/record/text_file.hpp"
#include "support/published_record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace overturn {
namespace {

/// Of those that do not determine the motion alone, a wrong one is remarked on.
enum class Kind { count, time, rate, acceleration, ratio, remarked_time, remarked_acceleration };

/// Where a number of a header is: behind some words of a line, or in a column.
struct Place {
    std::size_t line; ///< counted from 1
    Kind kind;
    const char* words; ///< empty: in a column
    std::size_t column = 0;
    std::size_t width = 0;
};

/// Factors that make a number wrong by 10 %, double it, or give it in another unit.
std::vector<double> wrong_factors(Kind kind)
{
    switch (kind) {
    case Kind::count: return {1.1, 2, 0.5};
    case Kind::time: // in ms, and in minutes
    case Kind::remarked_time: return {0.9, 1.1, 2, 1000, 1 / 60.0};
    case Kind::rate: // in kHz
        return {0.9, 1.1, 2, 0.001};
    case Kind::acceleration: // in mm/s2, in m/s2, and in g
    case Kind::remarked_acceleration: return {0.9, 1.1, 2, 10, 0.01, 1 / 980.665};
    default: return {0.9, 1.1, 2, 100};
    }
}

/// The number with the same width, if it fits, and with the same digits behind its point.
std::string scaled(const std::string& number, double factor)
{
    const double value = std::strtod(number.c_str(), nullptr) * factor;
    const std::size_t exponent = number.find_first_of("eE");
    const std::size_t point = number.find('.');
    const std::size_t decimals =
        point == number.npos ? 0 : std::min(exponent, number.size()) - point - 1;
    return exponent == number.npos ? fmt::format("{:.{}f}", value, decimals)
                                   : fmt::format("{:.{}E}", value, decimals);
}

/// The text with the number in this place multiplied; the text itself if its column is too
/// narrow, or if its digits are, so that it is 0, which stands for an unknown number.
std::string altered(const std::string& text, const Place& place, double factor)
{
    std::size_t begin = 0;
    for (std::size_t line = 1; line < place.line; ++line) {
        begin = text.find('\n', begin) + 1;
    }
    const std::size_t end_of_line = std::min(text.find('\n', begin), text.size());
    const std::string words = place.words;
    const std::size_t after =
        words.empty() ? begin + place.column * place.width : text.find(words, begin) + words.size();
    EXPECT_LE(after, end_of_line) << place.line << ": " << words;
    const std::size_t first = text.find_first_of("+-.0123456789", after);
    const std::size_t last =
        words.empty() ? after + place.width
                      : std::min(text.find_first_not_of("+-.0123456789", first), end_of_line);
    const std::string number = text.substr(first, last - first);
    EXPECT_NE(std::strtod(number.c_str(), nullptr), 0) << place.line << ": " << number;
    const std::string other = scaled(number, factor);
    const std::size_t room = last - after;
    if ((words.empty() && other.size() > room) || std::strtod(other.c_str(), nullptr) == 0) {
        return text;
    }
    const std::string between =
        words.empty() ? std::string(room - other.size(), ' ') : text.substr(after, first - after);
    return text.substr(0, after) + between + other + text.substr(last);
}

/// What must not be wrong: the accelerations [m/s2, of which g are 9.81] and the time step.
std::vector<std::pair<Values, double>> motions_of(const RecordFile& file)
{
    std::vector<std::pair<Values, double>> motions;
    for (const RecordComponent& component : file.components) {
        motions.emplace_back(over_gravity(component, 9.81), component.time_step);
    }
    return motions;
}

std::vector<std::string> remarks_on(const std::string& text)
{
    std::vector<std::string> remarks;
    for (const RecordComponent& component : parse_record(text, "a.txt").components) {
        remarks.insert(remarks.end(), component.remarks.begin(), component.remarks.end());
    }
    return remarks;
}

/// Expects that no altered text is read in another way than the text. Returns their number.
int expect_none_is_read_wrongly(const std::string& name, const std::string& text,
                                const std::vector<Place>& places)
{
    const RecordFile file = parse_record(text, name);
    const auto motions = motions_of(file);
    int count = 0;
    for (const Place& place : places) {
        for (const double factor : wrong_factors(place.kind)) {
            const std::string wrong = altered(text, place, factor);
            if (wrong == text) {
                continue;
            }
            ++count;
            const std::string what = fmt::format("{}:{}: {} column {} times {}", name, place.line,
                                                 place.words, place.column, factor);
            const bool may_be_read =
                place.kind == Kind::remarked_time || place.kind == Kind::remarked_acceleration;
            try {
                EXPECT_EQ(motions_of(parse_record(wrong, name)), motions) << what;
                EXPECT_TRUE(may_be_read) << what;
                EXPECT_FALSE(remarks_on(wrong).empty()) << what;
            } catch (const Error& error) {
                EXPECT_FALSE(may_be_read) << what << error.what();
            }
        }
    }
    return count;
}

/// Words of a line that state a unit, and others.
struct UnitOfLine {
    std::size_t line;
    const char* words;
    const char* others;
};

/// Expects that every text with another unit is refused. Returns their number.
int expect_other_units_are_refused(const std::string& name, const std::string& text,
                                   const std::vector<UnitOfLine>& units)
{
    for (const auto& [line, words, others] : units) {
        std::size_t begin = 0;
        for (std::size_t i = 1; i < line; ++i) {
            begin = text.find('\n', begin) + 1;
        }
        const std::string wrong = text.substr(0, begin) + with(text.substr(begin), words, others);
        EXPECT_THROW(parse_record(wrong, name), Error) << name << ":" << line << ": " << others;
    }
    return int(units.size());
}

/// The places of a format, and those of its units.
struct Format {
    std::vector<Place> places;
    std::vector<UnitOfLine> units;
};

// clang-format off
const Format v2a{
    {{10, Kind::count, "points"}, {10, Kind::time, "Duration"}, {11, Kind::time, " at"},
     {14, Kind::acceleration, "peak"}, {14, Kind::remarked_time, " at"}, {14, Kind::remarked_acceleration, "rms"},
     {20, Kind::count, "", 3, 8}, {23, Kind::time, "", 3, 8}, {23, Kind::time, "", 5, 8},
     {24, Kind::acceleration, "", 5, 8}, {24, Kind::remarked_time, "", 6, 8}},
    {{14, "mm/s/s", "cm/s/s"}, {14, "mm/s/s", "m/s/s"}, {14, "mm/s/s", "g"}}};
const Format smc{
    {{7, Kind::acceleration, "pk     ="}, {14, Kind::count, "", 0, 10}, {18, Kind::rate, "", 1, 15},
     {23, Kind::time, "", 3, 15}, {23, Kind::acceleration, "", 4, 15},
     {24, Kind::time, "", 0, 15}, {24, Kind::acceleration, "", 1, 15}},
    {}};
const Format knet{
    {{11, Kind::rate, "Freq(Hz)"}, {12, Kind::time, "Time(s)"}, {14, Kind::acceleration, "Factor"},
     {14, Kind::ratio, "(gal)/"}, {15, Kind::acceleration, "(gal)"}},
    {{14, "(gal)", "(g)"}, {14, "(gal)", "(m/s2)"}, {15, "(gal)", "(g)"}, {15, "(gal)", "(m/s2)"}}};
const Format cosmos{
    {{11, Kind::acceleration, "Max ="}, {11, Kind::remarked_time, "cm/sec2 at"}, {38, Kind::time, "", 1, 15},
     {38, Kind::time, "", 2, 15}, {38, Kind::acceleration, "", 3, 15}, {38, Kind::remarked_time, "", 4, 15},
     {53, Kind::count, "", 0, 8}},
    {{11, "cm/sec2", "g"}, {15, "       4", "       2"}, {53, "cm/sec2(04)", "g (02)"},
     {53, "cm/sec2", "m/sec2"}}};
const Format csmip{
    {{12, Kind::time, "length ="}, {16, Kind::count, "", 0, 6}, {17, Kind::time, "of"},
     {18, Kind::acceleration, "="}, {18, Kind::remarked_time, " at"},
     {29, Kind::count, "", 4, 5}, {40, Kind::time, "", 3, 10}, {40, Kind::time, "", 4, 10},
     {41, Kind::remarked_time, "", 0, 10}, {41, Kind::acceleration, "", 1, 10},
     {46, Kind::count, "", 0, 6}, {46, Kind::time, "spaced at"}},
    {{18, "cm/sec/sec", "g"}, {46, "in cm/sec2", "in g"}, {46, "in cm/sec2", "in m/sec2"},
     {46, "in cm/sec2", "in mm/sec2"}}};
const Format esm{
    {{29, Kind::time, "INTERVAL_S:"}, {30, Kind::count, "NDATA:"}, {31, Kind::time, "DURATION_S:"},
     {40, Kind::acceleration, "S^2:"}, {41, Kind::remarked_time, "PGA_S:"}},
    {{33, "cm/s^2", "g"}, {33, "cm/s^2", "m/s^2"}, {33, "cm/s^2", "mm/s^2"}, {40, "PGA_CM", "PGA_M"}}};
const Format at2_format{
    {{3, Kind::acceleration, "PEAK ="}, {4, Kind::count, "NPTS="}, {4, Kind::time, "DURATION="}},
    {{3, "UNITS OF G", "UNITS OF CM/S/S"}, {3, "UNITS OF G", "M/S/S"}, {3, "0 G", "0 M/S/S"}}};
// clang-format on

TEST(AnAlteredHeader, OfAPublishedFileIsNeverReadWithAWrongScaleOrLength)
{
    Format test_of_cosmos = cosmos; // has its reals in columns of 13 characters
    // clang-format off
    test_of_cosmos.places = {
        {11, Kind::acceleration, "Max ="}, {11, Kind::remarked_time, "cm/sec2  at"}, {36, Kind::time, "", 1, 13},
        {36, Kind::time, "", 2, 13}, {36, Kind::acceleration, "", 3, 13}, {36, Kind::remarked_time, "", 4, 13},
        {46, Kind::count, "", 0, 7}, {46, Kind::time, "approx"}};
    // clang-format on
    test_of_cosmos.units[2].line = test_of_cosmos.units[3].line = 46;
    const std::vector<std::pair<const char*, Format>> files{
        {"WTMC.V2A", v2a},
        {"APEEL2_43.smc", smc},
        {"knet/CHB0021412312349.EW", knet},
        {"kiknet/AICH040010061330.EW2", knet},
        {"cosmos/AKBMR_BNZ_acc.V2c", cosmos},
        {"cosmos/Cosmos12TimeSeriesTest.v1", test_of_cosmos},
        {"csmip/CE58667.V2", csmip},
        {"esm/HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC", esm}};
    int count = 0;
    for (const auto& [name, format] : files) {
        const std::string path = published_record(name);
        if (path.empty()) {
            GTEST_SKIP() << "$OVERTURN_RECORDS has no file " << name;
        }
        const std::string text = text_of_file(path, {"a record", largest_record_file, "", ""});
        EXPECT_EQ(remarks_on(text), std::vector<std::string>()) << name;
        count += expect_none_is_read_wrongly(name, text, format.places);
        count += expect_other_units_are_refused(name, text, format.units);
    }
    EXPECT_GE(count, 200);
}

/// A made motion: 60 samples at 0.02 s, in steps of 0.1, with the peak at 0.8 s and the largest
/// value of the other sign at 0.6 s.
struct Made {
    Values values; ///< [cm/s2]
    double peak;
    double other;
    double root_mean_square;
};

constexpr std::size_t made_samples = 60;

Made made(unsigned seed)
{
    std::mt19937 random(seed);
    const auto up_to = [&](unsigned most) { return double(random() % (10 * most)) / 10; };
    const double sign = random() % 2 == 0 ? 1 : -1;
    Made motion{{}, sign * (200 + up_to(100)), -sign * (150 + up_to(40)), 0};
    for (std::size_t i = 0; i < made_samples; ++i) {
        motion.values.push_back(up_to(200) - 100);
    }
    motion.values[40] = motion.peak;
    motion.values[30] = motion.other;
    for (const double value : motion.values) {
        motion.root_mean_square += value * value / double(made_samples);
    }
    motion.root_mean_square = std::sqrt(motion.root_mean_square);
    return motion;
}

std::string lines(int count, const char* line = "USER: ")
{
    std::string text;
    for (int i = 0; i < count; ++i) {
        text += fmt::format("{}\n", line);
    }
    return text;
}

/// Numbers in columns of a format, such as "{:8.1f}".
std::string columns(const Values& values, const char* format, std::size_t per_line)
{
    std::string text;
    for (std::size_t i = 0; i < values.size(); ++i) {
        text += fmt::format(fmt::runtime(format), values[i]);
        text += (i + 1) % per_line == 0 || i + 1 == values.size() ? "\n" : "";
    }
    return text;
}

std::string esm_file(const Made& motion)
{
    return lines(28, "EVENT_ID: ") +
           "SAMPLING_INTERVAL_S: 0.020000\nNDATA: 60\nDURATION_S: 1.200\nSTREAM: HNE\n"
           "UNITS: cm/s^2\n" +
           lines(6) +
           fmt::format("PGA_CM/S^2: {:.6f}\nTIME_PGA_S: 0.800000\nPROCESSING: manual\n",
                       motion.peak) +
           columns(motion.values, "{:.6f}", 1);
}

std::string at2_file(const Made& motion)
{
    return fmt::format("PEER\nNowhere, 230\nACCELERATION IN UNITS OF G, PEAK ={:7.2f}0 G\n"
                       "NPTS=   60, DT= .02000 SEC, DURATION= 1.200 SEC\n",
                       motion.peak) +
           columns(motion.values, "{:15.7E}", 5);
}

/// A count is 0.1 gal, and the mean is removed.
std::string knet_file(Made motion)
{
    double sum = 0;
    for (const double value : motion.values) {
        sum += std::round(10 * value);
    }
    motion.values.back() -= std::fmod(sum, double(made_samples)) / 10; // the mean is an integer
    double mean = 0;
    for (double& value : motion.values) {
        value = std::round(10 * value);
        mean += value / double(made_samples);
    }
    return "Origin Time       2014/12/31 23:49:00\n" + lines(9, "Lat.") +
           fmt::format("Sampling Freq(Hz) 50Hz\nDuration Time(s)  1.2\nDir.              E-W\n"
                       "Scale Factor      600(gal)/6000\nMax. Acc. (gal)   {:.3f}\n",
                       std::abs(motion.peak - mean / 10)) +
           columns(motion.values, "{:8.0f} ", 8);
}

std::string v2a_file(const Made& motion)
{
    return "Corrected accelerogram\n" + lines(8) +
           fmt::format("Number of points    60    Duration   1.18 sec\n"
                       "Instrument corrected data at 0.020 sec intervals\n\n"
                       "Component N28W  Longitudinal Accelerometer Axis\n"
                       "Acceleration:  peak {:8.1f} mm/s/s at   0.80 sec     rms {:8.1f} mm/s/s\n",
                       motion.peak, motion.root_mean_square) +
           lines(5) + "   65536     250     250      60       0       0\n" + lines(2) +
           "  327.68    0.00    0.00    1.18  0.0050  0.0200      0.      0.      0.  9806.6\n" +
           fmt::format("     0.0     0.0     0.0     0.0     0.0{:8.1f}    0.80\n", motion.peak) +
           lines(2) + columns(motion.values, "{:8.1f}", 10);
}

std::string smc_file(const Made& motion)
{
    const bool is_highest = motion.peak > 0;
    const std::string mark = "  0.1700000E+39";
    return "2 CORRECTED ACCELEROGRAM\n" + lines(4, "*") + "station = Nowhere  component=     43\n" +
           fmt::format("epicentral dist =     63.0       pk     =  {:7.1f}\n",
                       std::abs(motion.peak)) +
           lines(6, "*") + "        60    -32768\n" + lines(3, "    -32768") + mark +
           "  0.5000000E+02\n" + lines(4, mark.c_str()) +
           fmt::format("{0}{0}{0}{1:15.7E}{2:15.7E}\n", mark, is_highest ? 0.8 : 0.6,
                       std::max(motion.peak, motion.other)) +
           fmt::format("{:15.7E}{:15.7E}\n", is_highest ? 0.6 : 0.8,
                       std::min(motion.peak, motion.other)) +
           lines(3, mark.c_str()) + columns(motion.values, "{:15.7E}", 5);
}

std::string cosmos_file(const Made& motion)
{
    const std::string unknown = columns(Values(5, -999), "{:15.6f}", 5);
    std::string reals;
    for (int i = 0; i < 20; ++i) {
        reals += i == 12 ? fmt::format("{:15.6f}{:15.6f}{:15.6f}{:15.6f}{:15.6f}\n", -999.0, 20.0,
                                       1.2, motion.peak, 0.8)
                         : unknown;
    }
    return "Corrected acceleration    (Format v01.20 with 13 text lines)\n" + lines(9) +
           fmt::format("Processed: today   Max = {:9.3f} cm/sec2 at    0.800 sec\n", motion.peak) +
           lines(2) + " 100 Integer-header values follow on  10 lines, Format= (10I8)\n" +
           "       2       1       4" + columns(Values(7, -999), "{:8.0f}", 7) +
           columns(Values(90, -999), "{:8.0f}", 10) +
           " 100 Real-header values follow on  20 lines, Format= (5F15.6)\n" + reals +
           "   6 Comment line(s) follow, each starting with a \"|\":\n" + lines(6, "| none") +
           "      60 acceleration pts, approx    1 secs, units=cm/sec2(04),Format=(8F10.5)\n" +
           columns(motion.values, "{:10.5f}", 8);
}

std::string csmip_file(const Made& motion)
{
    const std::string zeros = columns(Values(8, 0), "{:10.3f}", 8);
    return "Corrected accelerogram\n" + lines(6) + "Chan  1:  90 Deg\n" + lines(3) +
           fmt::format("                        Record length =  1.200 sec.\n\n\n\n"
                       "    60 points of instrument- and baseline-corrected accel data\n"
                       "At equally-spaced intervals of    .020  sec.\n"
                       "Peak acceleration = {:9.3f}    cm/sec/sec  at     .800   sec.\n",
                       motion.peak) +
           lines(7) + lines(3, "    0    0") + "    0    0    0    0   60    2\n" +
           lines(3, "    0    0") + zeros + lines(6, zeros.substr(0, 80).c_str()) +
           "      .000      .000      .000  1.200000  .0200000\n" +
           fmt::format("   .800000{:10.5f}\n", motion.peak) +
           lines(4, zeros.substr(0, 80).c_str()) +
           "    60 points of accel data equally spaced at  .020 sec, in cm/sec2. (8f10.3)\n" +
           columns(motion.values, "{:10.3f}", 8);
}

TEST(AnAlteredHeader, OfAMadeFileIsNeverReadWithAWrongScaleOrLength)
{
    struct MadeFile {
        const char* name;
        std::string (*text)(Made);
        const Format& format;
    };
    const std::vector<MadeFile> files{
        {"ESM", [](Made motion) { return esm_file(motion); }, esm},
        {"AT2", [](Made motion) { return at2_file(motion); }, at2_format},
        {"K-NET", [](Made motion) { return knet_file(motion); }, knet},
        {"V2A", [](Made motion) { return v2a_file(motion); }, v2a},
        {"SMC", [](Made motion) { return smc_file(motion); }, smc},
        {"COSMOS", [](Made motion) { return cosmos_file(motion); }, cosmos},
        {"CSMIP", [](Made motion) { return csmip_file(motion); }, csmip}};
    for (const auto& [name, text, format] : files) {
        int count = 0;
        for (const unsigned seed : {1U, 2U}) {
            const std::string file = text(made(seed));
            EXPECT_EQ(parse_record(file, name).format, name);
            EXPECT_EQ(remarks_on(file), std::vector<std::string>()) << name;
            count += expect_none_is_read_wrongly(name, file, format.places);
            count += expect_other_units_are_refused(name, file, format.units);
        }
        EXPECT_GE(count, 20) << name;
    }
}

TEST(AMarkOfMissingValues, AmongTheSamplesIsRefused)
{
    const std::vector<std::pair<std::string (*)(Made), const char*>> files{
        {[](Made motion) { return esm_file(motion); }, "-999"},
        {[](Made motion) { return at2_file(motion); }, "-32768"},
        {[](Made motion) { return v2a_file(motion); }, "-9999"},
        {[](Made motion) { return smc_file(motion); }, "1.7e+38"},
        {[](Made motion) { return cosmos_file(motion); }, "-999"},
        {[](Made motion) { return csmip_file(motion); }, "-9999"}};
    for (const auto& [text, mark] : files) {
        for (const unsigned seed : {1U, 2U, 3U, 4U}) {
            Made motion = made(seed);
            motion.values[5 + seed] = motion.values[20 + seed] = std::strtod(mark, nullptr);
            EXPECT_EQ(refusal_of(text(motion)),
                      fmt::format("a.txt: sample {} is {}, which stands for a missing value; the "
                                  "largest other one is {}. Give a record without gaps.",
                                  6 + seed, mark, std::abs(motion.peak)));
        }
    }
}

} // namespace
} // namespace overturn
