// Every mistake in a job file is refused with a message that locates it.
#include "job_file.hpp"

#include "support/untrapped_floating_point.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <climits>
#include <ostream>
#include <string>
#include <vector>

namespace overturn {

namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

/// A job that is valid except for one line.
struct Mistake {
    std::string name;
    int line;
    const char* text;
    const char* place; ///< line:column in the message
    std::vector<std::string> words;

    friend std::ostream& operator<<(std::ostream& stream, const Mistake& mistake)
    {
        return stream << "line " << mistake.line << ": " << mistake.text;
    }
};

class ReadingAJobRefuses : public testing::TestWithParam<Mistake> {};

TEST_P(ReadingAJobRefuses, AndLocates)
{
    // Some jobs cause overflow and are refused because of it.
    const UntrappedFloatingPoint overflows;
    const std::string message = refusal_of(sound_job_with(GetParam().line, GetParam().text));
    EXPECT_THAT(message, StartsWith(fmt::format("job.toml:{}: ", GetParam().place)));
    for (const std::string& words : GetParam().words) {
        EXPECT_THAT(message, HasSubstr(words));
    }
    EXPECT_EQ(message.find('\n'), message.npos) << "a message is one line: " << message;
    EXPECT_THAT(message, EndsWith("."));
}

#define MISTAKES(group, ...)                                                                       \
    INSTANTIATE_TEST_SUITE_P(                                                                      \
        group, ReadingAJobRefuses, testing::ValuesIn(std::vector<Mistake>{__VA_ARGS__}),           \
        [](const testing::TestParamInfo<Mistake>& mistake) { return mistake.param.name; })

// clang-format off
MISTAKES(Filling,
    {"ListedValues", 10, "fill = true", "10:8", {"plane.amplitude lists its values", "first, last and count"}},
    {"AuditWithoutFill", 10, "audit = 0.1", "10:9", {"needs fill = true"}},
    {"AuditOutOfRange", 10, "fill = true\naudit = 1.5", "11:9", {"outside [0, 1]", "share"}},
    {"FillThatIsNoBoolean", 10, "fill = 1", "10:8", {"true or false"}});

MISTAKES(Form,
    {"BrokenToml", 3, "pulse = \"one_sine", "3:18", {"not TOML", "Fix"}},
    {"ATruncatedWord", 1, "title = i", "1:10", {"not TOML", "'inf'"}},
    {"AnUnfinishedTable", 5, "frequency = { first = 0.1,", "5:27", {"not TOML"}},
    {"AKeyGivenTwice", 10, "tolerance = 1e-9\ntolerance = 1e-8", "11:13", {"not TOML", "tolerance"}},
    {"InvalidUtf8", 1, "title = \"\xff\"", "1:9", {"not TOML", "utf-8"}},
    {"ATitleWithNul", 1, "title = \"a\\u0000b\"", "1:9", {"title", "NUL"}});

MISTAKES(UnknownKeys,
    {"AtTheTop", 1, "titel = \"x\"", "1:1", {"unknown key \"titel\"", "Did you mean \"title\"?"}},
    {"ATable", 9, "[numeric]", "9:2", {"unknown key \"numeric\"", "Did you mean \"numerics\"?"}},
    {"InTheScene", 3, "pulse = \"one_sine\"\nPulse = \"x\"", "4:1", {"\"scene.Pulse\"", "\"scene.pulse\"?"}},
    {"InThePlane", 8, "slendernes = { values = [0.2] }", "8:1",
     {"unknown key \"plane.slendernes\"", "Did you mean \"plane.slenderness\"?"}},
    {"InAnAxis", 5, "frequency = { first = 0.1, last = 1, cout = 3 }", "5:38",
     {"\"plane.frequency.cout\"", "\"plane.frequency.count\"?"}},
    {"OfOnAnotherAxis", 8, "slenderness = { values = [0.2], of = \"maximum\" }", "8:33",
     {"\"plane.slenderness.of\"", "Allowed here: values, first, last, count, spacing"}},
    {"InTheBlock", 8, "[block]\nhalf_width = 1\nhalf_height = 2\ndepth = 3", "11:1", {"\"block.depth\""}},
    {"InTheNumerics", 10, "tolerence = 1e-9", "10:1", {"\"numerics.tolerance\"?"}},
    {"InTheOutput", 12, "field = [\"region\"]", "12:1", {"\"output.fields\"?"}},
    {"ADeepTable", 12, "[plane.more.and.more]", "12:8", {"unknown key \"plane.more\""}},
    {"WithoutAFarFetchedGuess", 10, "quux = 1", "10:1", {"\"numerics.quux\". Allowed here: method, tolerance, resolve, fill, audit."}});

MISTAKES(WrongTypes,
    {"ANumberAsTitle", 1, "title = 3", "1:9", {"title is the integer 3", "must be a string"}},
    {"ABooleanAsPulse", 3, "pulse = true", "3:9", {"scene.pulse is the boolean true", "string"}},
    {"AStringAsNumber", 5, "frequency = { first = \"0.1\", last = 1, count = 2 }", "5:23",
     {"plane.frequency.first is the string \"0.1\"", "must be a number"}},
    {"AStringAmongNumbers", 6, "amplitude = { values = [1, \"2\"] }", "6:28", {"plane.amplitude.values[1]", "number"}},
    {"AListAsAxis", 6, "amplitude = [1, 2]", "6:13", {"plane.amplitude is an array", "a number, or a table with the keys values"}},
    {"ANumberAsList", 6, "amplitude = { values = 1 }", "6:24", {"plane.amplitude.values", "an array of numbers"}},
    {"ABooleanAsAxis", 6, "amplitude = true", "6:13", {"plane.amplitude is the boolean true", "a table with the keys values"}},
    {"AStringAsAxis", 6, "amplitude = \"1\"", "6:13", {"plane.amplitude is the string \"1\"", "a table with the keys values"}},
    {"AFloatAsCount", 5, "frequency = { first = 1, last = 2, count = 10.0 }", "5:44",
     {"plane.frequency.count is the number 10.0", "must be an integer"}},
    {"AStringAsTolerance", 10, "tolerance = \"low\"", "10:13", {"numerics.tolerance", "number"}},
    {"ADateAsTolerance", 10, "tolerance = 2020-01-01", "10:13", {"a date or time", "number"}},
    {"AStringAsFields", 12, "fields = \"region\"", "12:10", {"output.fields", "an array of strings"}},
    {"ANumberAsField", 12, "fields = [1]", "12:11", {"output.fields[0]", "string"}},
    {"ATableAsField", 12, "fields = [{}]", "12:11", {"output.fields[0] is a table", "string"}},
    {"ATableArrayAsScene", 2, "[[scene]]", "2:1", {"scene is an array", "table"}},
    {"AnArrayAsSpacing", 5, "frequency = { first = 1, last = 2, count = 3, spacing = [] }", "5:57", {"spacing is an array"}});

MISTAKES(MissingKeys,
    {"ThePulse", 3, "", "2:1", {"scene.pulse is missing", "one_sine", "rectangular"}},
    {"TheFrequency", 5, "", "4:1", {"plane.frequency is missing"}},
    {"TheAmplitude", 6, "", "4:1", {"plane.amplitude is missing"}},
    {"TheRestitution", 7, "", "4:1", {"plane.restitution is missing"}},
    {"SlendernessAndBlock", 8, "", "4:1", {"plane.slenderness is missing", "width and height"}},
    {"TheCount", 5, "frequency = { first = 1, last = 2 }", "5:13", {"plane.frequency.count is missing", "or values"}},
    {"TheLast", 5, "frequency = { first = 1, count = 2 }", "5:13", {"plane.frequency.last is missing"}},
    {"EverythingOfAnAxis", 7, "restitution = { of = \"maximum\" }", "7:15", {"plane.restitution.first is missing", "or values"}},
    {"TheHalfHeight", 8, "[block]\nhalf_width = 1", "8:1", {"block.height is missing", "metres"}},
    {"TheBlockOfAPeriod", 5, "pulse_period = 0.5", "5:16", {"plane.pulse_period needs the dimensions of the block", "width and height", "size"}},
    {"TheBlockOfAFrequencyInHz", 5, "pulse_frequency = 2", "5:19", {"plane.pulse_frequency needs the dimensions"}});

MISTAKES(Lists,
    {"NoValues", 6, "amplitude = { values = [] }", "6:24", {"plane.amplitude.values is empty"}},
    {"UnsortedValues", 6, "amplitude = { values = [1, 3, 2] }", "6:31", {"values[2]: 3 is followed by 2", "ascend"}},
    {"RepeatedValues", 6, "amplitude = { values = [1, 2, 2.0] }", "6:31", {"values[2]: 2 is followed by 2", "once"}},
    {"ANanValue", 6, "amplitude = { values = [nan] }", "6:25", {"plane.amplitude.values[0] = nan is not finite"}},
    {"AnInfiniteValue", 6, "amplitude = { values = [1, inf] }", "6:28", {"values[1] = inf is not finite"}},
    {"ListAndRange", 6, "amplitude = { values = [1], first = 1 }", "6:37", {"first cannot be combined with plane.amplitude.values"}},
    {"ListAndCount", 6, "amplitude = { values = [1], count = 1 }", "6:37", {"count cannot be combined with"}},
    {"ListAndSpacing", 6, "amplitude = { values = [1], spacing = \"log\" }", "6:39", {"spacing cannot be combined with"}});

MISTAKES(Ranges,
    {"FirstAboveLast", 5, "frequency = { first = 3, last = 1, count = 2 }", "5:23", {"first = 3 is above last = 1", "Swap first and last"}},
    {"ACountOfZero", 5, "frequency = { first = 1, last = 2, count = 0 }", "5:44", {"count = 0 is outside [1, 10000000]"}},
    {"ANegativeCount", 5, "frequency = { first = 1, last = 2, count = -3 }", "5:44", {"count = -3 is outside [1, 10000000]"}},
    {"ASingleValueWithTwoEnds", 5, "frequency = { first = 1, last = 2, count = 1 }", "5:44", {"count = 1 needs first = last"}},
    {"ManyEqualValues", 5, "frequency = { first = 2, last = 2, count = 5 }", "5:44", {"plane.frequency.count: 2 is followed by 2"}},
    {"AnInfiniteEnd", 5, "frequency = { first = 1, last = inf, count = 2 }", "5:33", {"last = inf is not finite"}},
    {"ANanEnd", 5, "frequency = { first = nan, last = 1, count = 2 }", "5:23", {"first = nan is not finite"}},
    {"AnUnknownSpacing", 5, "frequency = { first = 1, last = 2, count = 3, spacing = \"lin\" }", "5:57",
     {"spacing = \"lin\" is unknown", "Allowed: linear, log"}},
    {"ALogarithmicRangeFromZero", 6, "amplitude = { first = 0, last = 2, count = 3, spacing = \"log\" }", "6:23",
     {"first = 0", "logarithmic", "linear"}},
    {"ALinearRangeTooFine", 5, "frequency = { first = 1, last = 1.0000000000000004, count = 100 }", "5:61",
     {"plane.frequency.count: 1 is followed by 1,", "must ascend in double precision", "lower count"}},
    {"ALogarithmicRangeTooFine", 5, "frequency = { first = 1, last = 1.0000000000000004, count = 100, spacing = \"log\" }", "5:61",
     {"plane.frequency.count: 1 is followed by 1,", "must ascend"}},
    {"ACountBeyondDoublePrecision", 5, "frequency = { first = 1, last = 2, count = 9007199254740993, spacing = \"log\" }", "5:44",
     {"count = 9007199254740993 is outside [1, 10000000]"}},
    {"ALinearRangeTooWide", 6, "amplitude = { first = 0, last = 1e308, count = 100 }", "6:48", {"must ascend in double precision", "inf"}},
    {"ALogarithmicRangeTooWide", 6, "amplitude = { first = 1e-200, last = 1e200, count = 100, spacing = \"log\" }", "6:53",
     {"must ascend in double precision", "inf"}});

MISTAKES(Physics,
    {"AZeroFrequency", 5, "frequency = { values = [0, 1] }", "5:25", {"plane.frequency.values[0] = 0 is outside (0, inf)"}},
    {"ANegativeFrequency", 5, "frequency = { first = -1, last = 2, count = 3 }", "5:23", {"plane.frequency.first = -1 is outside (0, inf)"}},
    {"ANegativeAmplitude", 6, "amplitude = { values = [-0.5] }", "6:25", {"plane.amplitude.values[0] = -0.5 is outside [0, inf)"}},
    {"ARestitutionOfZero", 7, "restitution = { values = [0.0] }", "7:27", {"plane.restitution.values[0] = 0 is outside (0, 1]"}},
    {"ARestitutionAboveOne", 7, "restitution = { values = [0.9, 1.2] }", "7:32",
     {"plane.restitution.values[1] = 1.2 is outside (0, 1]. A block cannot gain energy at an impact"}},
    {"AShareOfZero", 7, "restitution = { values = [0], of = \"maximum\" }", "7:27", {"= 0 is outside (0, inf)", "share"}},
    {"AShareThatGainsEnergy", 7, "restitution = { first = 0.5, last = 1.3, count = 3, of = \"maximum\" }", "7:15",
     {"plane.restitution = 1.3: restitution = 1.", "outside (0, 1]", "cannot gain energy"}},
    {"AnUnknownOf", 7, "restitution = { values = [1], of = \"maximal\" }", "7:36", {"of = \"maximal\" is unknown", "\"maximum\"?", "absolute"}},
    {"AZeroSlenderness", 8, "slenderness = { values = [0] }", "8:27", {"plane.slenderness.values[0] = 0 is outside [1e-100, pi/2)"}},
    {"ASlendernessOfARightAngle", 8, "slenderness = { values = [1.5707963267948966] }", "8:27", {"outside [1e-100, pi/2)"}},
    {"ASlendernessInDegrees", 8, "slenderness = { values = [10] }", "8:27", {"outside [1e-100, pi/2)", "radians"}},
    {"AShareOfNoLargestRestitution", 8, "slenderness = { values = [0.2, 0.96] }", "7:26",
     {"plane.restitution_of_maximum = 0.7: slenderness = 0.96 is outside (0, 0.9553)", "r_max", "give restitution, r itself"}},
    {"AShareForAStoutBlock", 8, "[block]\nhalf_width = 2\nhalf_height = 1", "7:26",
     {"plane.restitution_of_maximum = 0.7: slenderness = 1.107", "r_max", "more slender block"}},
    {"SlendernessAndBlock", 9, "[block]\nhalf_width = 1\nhalf_height = 2\n[numerics]", "8:15",
     {"plane.slenderness cannot be combined with block.half_width", "describes the block in another way. Remove one"}},
    {"AZeroHalfWidth", 8, "[block]\nhalf_width = 0\nhalf_height = 2", "9:14", {"block.half_width = 0 is outside (0, inf)"}},
    {"ANegativeHalfHeight", 8, "[block]\nhalf_width = 1\nhalf_height = -2", "10:15", {"block.half_height = -2 is outside (0, inf)"}},
    {"AnInfiniteHalfHeight", 8, "[block]\nhalf_width = 1\nhalf_height = inf", "10:15", {"block.half_height = inf is not finite"}},
    {"ABlockWithoutAngle", 8, "[block]\nhalf_width = 1e-300\nhalf_height = 1e300", "9:14", {"block.half_width = 1e-300: slenderness = 0 is outside"}},
    {"ABlockLyingFlat", 8, "[block]\nhalf_width = 1e300\nhalf_height = 1e-300", "9:14", {"block.half_width = 1e+300: slenderness = 1.57", "pi/2", "closer to 1"}},
    {"ABlockOfWidth0", 8, "[block]\nwidth = 0\nheight = 1", "9:9", {"block.width = 0 is outside (0, inf)", "metres"}},
    {"AWidthAndItsHalf", 8, "[block]\nwidth = 1\nhalf_width = 0.5\nheight = 3", "10:14", {"block.half_width cannot be combined with block.width"}},
    {"TwoFrequencies", 5, "frequency = 2\npulse_period = 1\nsize = 1", "6:16", {"plane.pulse_period cannot be combined with plane.frequency"}},
    {"TwoStrengths", 6, "amplitude = 2\npga = 1\nsize = 1", "7:7", {"plane.pga cannot be combined with plane.amplitude"}},
    {"TwoWidths", 8, "width = 0.5\n[block]\nwidth = 1\nheight = 3", "10:9", {"block.width cannot be combined with plane.width, which gives the same quantity"}},
    {"AFactorOnAPulse", 6, "scale = 2", "6:9", {"plane.scale has no meaning under a pulse. Remove it"}},
    {"RestitutionInTwoSpellings", 7, "restitution = { values = [1], of = \"maximum\" }\nrestitution_of_maximum = 1", "8:26", {"plane.restitution_of_maximum cannot be combined with plane.restitution", "gives the same quantity"}},
    {"TwoRestitutions", 7, "restitution = 1\nvelocity_restitution = 1", "8:24", {"plane.velocity_restitution cannot be combined with plane.restitution", "gives the same quantity"}},
    {"AShareAndAVelocityRestitution", 7, "restitution_of_maximum = 1\nvelocity_restitution = 1", "8:24", {"plane.velocity_restitution cannot be combined with plane.restitution_of_maximum"}},
    {"AVelocityRestitutionAboveOne", 7, "velocity_restitution = 1.1", "7:24", {"plane.velocity_restitution = 1.1 is outside (0, 1]", "angular velocities"}},
    {"AVelocityRestitutionThatIsTooSmall", 7, "velocity_restitution = 1e-170", "7:24", {"restitution = 0 is outside (0, 1]"}},
    {"ASizeBesideABlock", 8, "size = 1\n[block]\nwidth = 1\nheight = 3", "8:8", {"plane.size cannot be combined with block.width"}});

MISTAKES(Scene,
    {"AnUnknownPulse", 3, "pulse = \"one-sine\"", "3:9", {"scene.pulse = \"one-sine\" is unknown", "Did you mean \"one_sine\"?", "antisymmetric_ricker"}},
    {"APartOfAPulse", 3, "pulse = \"ricker\"", "3:9", {"Did you mean \"symmetric_ricker\"?"}},
    {"AFarFetchedPulse", 3, "pulse = \"earthquake\"", "3:9", {"is unknown. Allowed: one_sine, one_cosine"}},
    {"AnUnknownTheory", 3, "pulse = \"one_sine\"\ntheory = \"non-linear\"", "4:10", {"Did you mean \"nonlinear\"?", "Allowed: nonlinear, linear"}},
    {"AWindowOnAPulseThatEnds", 3, "pulse = \"one_sine\"\nwindow = 1.0", "4:10", {"scene.window has no meaning", "\"one_sine\"", "symmetric_ricker, antisymmetric_ricker"}},
    {"AZeroWindow", 3, "pulse = \"symmetric_ricker\"\nwindow = 0", "4:10", {"scene.window = 0 is outside (0, 8]"}},
    {"AWideWindow", 3, "pulse = \"symmetric_ricker\"\nwindow = 8.5", "4:10", {"scene.window = 8.5 is outside (0, 8]"}},
    {"ANanWindow", 3, "pulse = \"symmetric_ricker\"\nwindow = nan", "4:10", {"scene.window = nan is not finite"}},
    {"ASineWithoutCycles", 3, "pulse = \"sine\"", "2:1", {"scene.cycles is missing", "{0.5, 1, 1.5, ..., 10}"}},
    {"TooManyCycles", 3, "pulse = \"cosine\"\ncycles = 11", "4:10", {"scene.cycles = 11 is outside {0.5, 1, 1.5, ..., 10}"}},
    {"AThirdOfACycle", 3, "pulse = \"cosine\"\ncycles = 1.3", "4:10", {"scene.cycles = 1.3 is outside {0.5, 1, 1.5, ..., 10}", "multiple of 0.5"}},
    {"CyclesOfTheOneSine", 3, "pulse = \"one_sine\"\ncycles = 2", "4:10", {"scene.cycles has no meaning", "only for sine, cosine"}},
    {"MissingGamma", 3, "pulse = \"mavroeidis_papageorgiou\"\nnu = 0", "2:1", {"scene.gamma is missing", "(1, 10]"}},
    {"AGammaOfOne", 3, "pulse = \"mavroeidis_papageorgiou\"\ngamma = 1\nnu = 0", "4:9", {"scene.gamma = 1 is outside (1, 10]"}},
    {"APhaseInDegrees", 3, "pulse = \"mavroeidis_papageorgiou\"\ngamma = 2\nnu = 90", "5:6", {"scene.nu = 90 is outside [-2 pi, 2 pi]", "radians"}},
    {"APhaseOfAWavelet", 3, "pulse = \"symmetric_ricker\"\nnu = 0.5", "4:6", {"scene.nu has no meaning", "only for mavroeidis_papageorgiou"}});

MISTAKES(NumericsAndOutput,
    {"AnUnknownMethod", 10, "method = \"rk4\"", "10:10", {"numerics.method = \"rk4\" is unknown", "Did you mean \"rk45\"?"}},
    {"ATinyTolerance", 10, "tolerance = 9e-15", "10:13", {"numerics.tolerance = 9e-15 is outside [1e-14, 0.01]"}},
    {"AHugeTolerance", 10, "tolerance = 1", "10:13", {"numerics.tolerance = 1 is outside [1e-14, 0.01]"}},
    {"ANanTolerance", 10, "tolerance = nan", "10:13", {"numerics.tolerance = nan is not finite"}},
    {"NoFields", 12, "fields = []", "12:10", {"output.fields is empty", "region, angle"}},
    {"AnUnknownField", 12, "fields = [\"region\", \"angel\"]", "12:21", {"output.fields[1] = \"angel\" is unknown", "Did you mean \"angle\"?", "Allowed: region"}},
    {"ARepeatedField", 12, "fields = [\"region\", \"angle\", \"region\"]", "12:30", {"output.fields[2] = \"region\"", "once"}});
// clang-format on

TEST(ReadingAJob, RefusesAPlaneTooLargeToAddress)
{
    const std::string message = refusal_of(R"([scene]
pulse = "one_sine"
[plane]
frequency   = { first = 0.1, last = 12.0, count = 10000000 }
amplitude   = { first = 0.1, last = 12.0, count = 10000000 }
restitution = { first = 0.1, last = 1.0, count = 10000000 }
slenderness = { first = 0.1, last = 1.0, count = 10000000 }
[output]
fields = ["region", "angle"]
)");
    // 10^28 points of 9 bytes.
    EXPECT_THAT(message,
                AllOf(HasSubstr(":3:1: plane has 1e+28 points"), HasSubstr("9e+28 bytes")));
}

TEST(ReadingAJob, AcceptsTheLargestPlaneThatCanBeAddressed)
{
    // 2^23 x 2^23 x 2^8 x 2^8 points of one byte; one more frequency is one more row than 2^62
    // bytes.
    const std::string job = R"([scene]
pulse = "one_sine"
[plane]
frequency   = { first = 0.1, last = 12.0, count = 8388608 }
amplitude   = { first = 0.1, last = 12.0, count = 8388608 }
restitution = { first = 0.5, last = 1.0, count = 256 }
slenderness = { first = 0.1, last = 0.2, count = 256 }
)";
    EXPECT_EQ(job_of(job).problem.grid.points(), std::int64_t(1) << 62);
    EXPECT_NE(refusal_of(job, {"plane.frequency.count=8388609"}), "");
    EXPECT_NE(refusal_of(job, {"output.fields=['region', 'status']"}), "");
}

TEST(ReadingAJob, RefusesAnAxisThatDoesNotFitIntoMemory)
{
    const std::string job = R"([scene]
pulse = "one_sine"
[plane]
frequency   = { first = 1, last = 2, count = 2 }
amplitude   = { first = 1, last = 2, count = 2 }
restitution = { first = 0.5, last = 1, count = 2 }
slenderness = { first = 0.1, last = 0.2, count = 2 }
)";
    for (const std::string axis : {"frequency", "amplitude", "restitution", "slenderness"}) {
        for (const std::int64_t count :
             {10'000'001L, 1L << 31, (1L << 32) + 1, 1L << 45, LONG_MAX}) {
            const std::string setting = fmt::format("plane.{}.count={}", axis, count);
            EXPECT_THAT(refusal_of(job, {setting}), StartsWith("--set " + setting));
        }
    }
}

} // namespace

} // namespace overturn
