// Files of K-NET and KiK-net.
#include "reading.hpp"

#include "support/untrapped_floating_point.hpp"

namespace overturn {
namespace {

const std::string sound_knet =
    "Origin Time       2014/12/31 23:49:00\n"
    "Lat.              35.785\n"
    "Long.             139.887\n"
    "Depth. (km)       84\n"
    "Mag.              4.2\n"
    "Station Code      NONE01\n"
    "Station Lat.      35.7868\n"
    "Station Long.     139.9031\n"
    "Station Height(m) 14\n"
    "Record Time       2014/12/31 23:50:00\n"
    "Sampling Freq(Hz) 4Hz\n"
    "Duration Time(s)  3\n"
    "Dir.              E-W\n"
    "Scale Factor      3000(gal)/6000\n"
    "Max. Acc. (gal)   4.500\n"
    "Last Correction   2014/12/31 23:49:59\n"
    "Memo.             \n"
    "     103      104      105       97      100       99      101      100 \n"
    "     109       91      100       91 \n";

TEST(Knet, GivesCountsWithoutTheirMeanInGal)
{
    const RecordFile file = parse_record(sound_knet, "a.txt");
    EXPECT_EQ(file.format, "K-NET");
    ASSERT_EQ(file.components.size(), 1);
    EXPECT_EQ(file.components[0].unit, AccelerationUnit::gal);
    EXPECT_EQ(file.components[0].acceleration, // the mean is 100, a count is 0.5 gal
              (Values{1.5, 2, 2.5, -1.5, 0, -0.5, 0.5, 0, 4.5, -4.5, 0, -4.5}));
}

TEST(Knet, DoesNotUseAPeakWithoutAUnit)
{
    for (const char* peak : {"(cm)   9.000", ")(   9.000", ") (gal)   9.000", "9.000", ""}) {
        EXPECT_EQ(component_of(with(sound_knet, "(gal)   4.500", peak)).acceleration,
                  component_of(sound_knet).acceleration)
            << peak;
    }
}

TEST(Knet, ScalesCountsByAnyScaleFactor)
{
    const Values values = component_of(sound_knet).acceleration;
    const std::string doubled = with(sound_knet, "4.500", "9.000");
    for (const char* factor : {"1500.0(gal)/1500", "1(gal)/1", "8e6 (GAL) / 8000000"}) {
        const Values others = component_of(with(doubled, "3000(gal)/6000", factor)).acceleration;
        ASSERT_EQ(others.size(), 12);
        for (std::size_t i = 0; i < 12; ++i) {
            EXPECT_EQ(others[i], 2 * values[i]) << factor;
        }
    }
}

TEST(Knet, HasTheTimeStepOfItsSamplingFrequency)
{
    EXPECT_EQ(component_of(sound_knet).time_step, 0.25);
    EXPECT_EQ(component_of(with(with(sound_knet, "4Hz", "200 hz"), "  3\n", "  0.06\n")).time_step,
              0.005);
    EXPECT_EQ(component_of(with(sound_knet, "4Hz", "4")).time_step, 0.25);
}

TEST(Knet, IsNotCorrected)
{
    EXPECT_TRUE(component_of(sound_knet).is_uncorrected);
}

TEST(Knet, NamesItsDirection)
{
    EXPECT_EQ(component_of(sound_knet).name, "E-W");
    EXPECT_EQ(component_of(with(sound_knet, "E-W", "U-D")).name, "U-D");
}

TEST(Knet, StatesItsEarthquakeAndItsStation)
{
    EXPECT_EQ(component_of(sound_knet).event, "2014/12/31 23:49:00, NONE01");
    EXPECT_EQ(component_of(with(sound_knet, "Station Code      NONE01\n", "")).event,
              "2014/12/31 23:49:00");
}

TEST(Kiknet, NamesItsDirectionAndItsSensor)
{
    const std::vector<std::string> names{"NS1", "EW1", "UD1", "NS2", "EW2", "UD2"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const RecordFile file =
            parse_record(with(sound_knet, "E-W", std::to_string(i + 1)), "a.txt");
        EXPECT_EQ(file.format, "KiK-net");
        EXPECT_EQ(file.components.at(0).name, names[i]);
    }
}

TEST(Knet, KeepsItsHeader)
{
    const std::vector<std::string> header = component_of(sound_knet).header;
    ASSERT_EQ(header.size(), 17);
    EXPECT_EQ(header.front(), "Origin Time       2014/12/31 23:49:00");
    EXPECT_EQ(header.back(), "Memo.             ");
}

TEST(Knet, MayHaveTheLineEndsOfAnySystemAndBlankLines)
{
    const Values values = component_of(sound_knet).acceleration;
    for (const char* end : {"\r\n", "\r\r\n", "\n\n", "\t\n \n"}) {
        EXPECT_EQ(component_of(with_line_ends(sound_knet, end)).acceleration, values);
    }
    EXPECT_EQ(component_of("\n" + sound_knet).acceleration, values);
}

TEST(Knet, MayEndWithPadding)
{
    for (const std::string& padding : paddings()) {
        EXPECT_EQ(component_of(sound_knet + padding).acceleration,
                  component_of(sound_knet).acceleration);
    }
}

TEST(Knet, MayHaveColumnsOfAnyWidthAndAnyNumberPerLine)
{
    const std::string data = sound_knet.substr(sound_knet.find("     103"));
    EXPECT_EQ(component_of(with(sound_knet, data, "103 104 105\n97 100\n99\n101 100 109 91 100 91"))
                  .acceleration,
              component_of(sound_knet).acceleration);
}

TEST(Knet, MayHaveItsHeaderInAnotherOrder)
{
    const std::string direction = "Dir.              E-W\n";
    EXPECT_EQ(component_of(direction + with(sound_knet, direction, "")).acceleration,
              component_of(sound_knet).acceleration);
    EXPECT_EQ(component_of(with(sound_knet, "Memo.             \n", "")).name, "E-W");
}

// clang-format off
TEST(Knet, IsRefusedWithFileLineAndReason)
{
    const UntrappedFloatingPoint overflows;
    expect_refused({
        {"FewerSamples", with(sound_knet, "109       91", "109         "),
            "a.txt:19: the file ends after 11 samples, but the product of Duration Time(s) and Sampling Freq(Hz) "
            "announces 12 in line 12. Give the complete file."},
        {"MoreSamples", sound_knet + "100\n",
            "a.txt:20: \"100\" follows the last of the 12 samples that the product of Duration Time(s) and Sampling "
            "Freq(Hz) announces in line 12. Correct the product of Duration Time(s) and Sampling Freq(Hz) or remove "
            "the rest."},
        {"AnotherTimeStep", with(sound_knet, "4Hz", "8Hz"),
            "a.txt:19: the file ends after 12 samples, but the product of Duration Time(s) and Sampling Freq(Hz) "
            "announces 24 in line 12. Give the complete file."},
        {"NoSamples", sound_knet.substr(0, sound_knet.find("     103")),
            "a.txt:17: the file ends after 0 samples, but the product of Duration Time(s) and Sampling Freq(Hz) "
            "announces 12 in line 12. Give the complete file."},
        {"AnEarlyEndInTheHeader", sound_knet.substr(0, sound_knet.find("Scale Factor")),
            "a.txt:13: the header, which ends with this line, has no line that begins with \"Scale Factor\". Give the "
            "file as it was published."},
        {"NoDirection", with(sound_knet, "Dir. ", "     "),
            "a.txt:17: the header, which ends with this line, has no line that begins with \"Dir.\". Give the file as "
            "it was published."},
        {"TwoScaleFactors", with(sound_knet, "Memo.             ", "Scale Factor      1(gal)/1"),
            "a.txt:17: the header states \"Scale Factor\" for the second time; the first is line 14. Remove one of "
            "them."},
        {"AnotherUnit", with(sound_knet, "(gal)", "(cm/s)"),
            "a.txt:14: the scale factor is \"3000(cm/s)/6000\", but must be gal over counts, as in 7845(gal)/8223790. "
            "Give the file as it was published."},
        {"NoCounts", with(sound_knet, "/6000", ""),
            "a.txt:14: the scale factor is \"3000(gal)\", but must be gal over counts, as in 7845(gal)/8223790. Give "
            "the file as it was published."},
        {"NoUnit", with(sound_knet, "(gal)", ""),
            "a.txt:14: the scale factor is \"3000/6000\", but must be gal over counts, as in 7845(gal)/8223790. Give "
            "the file as it was published."},
        {"AScaleFactorOfZero", with(sound_knet, "/6000", "/0"),
            "a.txt:14: both numbers of the scale factor \"3000(gal)/0\" must be above 0. Correct them."},
        {"AnEnormousScaleFactor", with(sound_knet, "3000(gal)", "1e308(gal)"),
            "a.txt:14: with 1e+308 per 6000 counts, the accelerations exceed the range of double precision. Correct "
            "it."},
        {"ARateOfZero", with(sound_knet, "4Hz", "0Hz"),
            "a.txt:11: the number of samples per second is \"0\", but must be above 0, and its inverse finite. Correct it."},
        {"AnotherUnitOfTheRate", with(sound_knet, "4Hz", "4kHz"),
            "a.txt:11: \"4k\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."},
        {"ALongDuration", with(sound_knet, "Duration Time(s)  3", "Duration Time(s)  3e6"),
            "a.txt:12: 3e6 s at 4 Hz are 12000000 samples, but must be from 1 to 10000000. Correct it, or give another "
            "record."},
        {"ADurationOfZero", with(sound_knet, "Duration Time(s)  3", "Duration Time(s)  0"),
            "a.txt:12: 0 s at 4 Hz are 0 samples, but must be from 1 to 10000000. Correct it, or give another record."},
        {"AGap", with(sound_knet, "105", "***"),
            "a.txt:18: \"***\" is not a number. Write numbers as in 0.5, -.5E-01 or -.5D-01."}});
}
// clang-format on

TEST(Knet, RefusesAUnitBecauseItStatesItsOwn)
{
    EXPECT_EQ(refusal_of(sound_knet, in_g),
              "a.txt: units = g was given, but this K-NET file is in gal. Remove units.");
}

} // namespace
} // namespace overturn
