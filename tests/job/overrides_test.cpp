#include "overturn/job/job.hpp"

#include "job_file.hpp"
#include "support/scratch_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <ostream>
#include <vector>

namespace overturn {

namespace {

using testing::AllOf;
using testing::Gt;
using testing::HasSubstr;
using testing::Lt;
using testing::SizeIs;

Job job_with(const std::vector<std::string>& overrides)
{
    return job_of(sound_job, overrides);
}

TEST(AnOverride, ReplacesAValueOfTheFile)
{
    const Job job = job_with({"numerics.tolerance=1e-6", "title=\"Another\""});
    EXPECT_EQ(job.problem.numerics.tolerance, 1e-6);
    EXPECT_EQ(job.title, "Another");
    EXPECT_EQ(job.problem.fields.size(), 2u) << "other values are unchanged";
}

TEST(AnOverride, IsStoredAsGiven)
{
    const std::vector<std::string> overrides{" scene.theory = linear", "title=x"};
    EXPECT_EQ(job_with(overrides).overrides, overrides);
    EXPECT_EQ(job_with(overrides).given, sound_job);
}

TEST(AnOverride, IsReplacedByALaterOne)
{
    EXPECT_EQ(
        job_with({"numerics.tolerance=1e-6", "numerics.tolerance=1e-7"}).problem.numerics.tolerance,
        1e-7);
}

TEST(AnOverride, CreatesTablesMissingInTheFile)
{
    const std::string text = "[scene]\npulse = 'one_sine'\n";
    const Job job = job_of(text, {"plane.frequency.values=[1]", "plane.amplitude.values=[2]",
                                  "plane.restitution.values=[1]", "block.half_width=1",
                                  "block.half_height=5", "output.fields=['margin']"});
    EXPECT_EQ(axis(job, "amplitude")[0], 2);
    EXPECT_EQ(job.problem.fields, std::vector<Field>{Field::margin});
}

TEST(AnOverride, MayBeANumberForAWholeAxis)
{
    for (const std::string& text : {std::string(sound_job), older_job()}) {
        const Job job = job_of(text, {"plane.restitution=0.9"});
        EXPECT_EQ(axis(job, "restitution").values(), AxisList{0.9})
            << "r itself: restitution_of_maximum, or of = \"maximum\", is removed";
    }
    const Job job = job_with({"plane.frequency=3"});
    EXPECT_EQ(axis(job, "frequency").values(), std::vector<double>{3});
}

TEST(AnOverride, ExtendsAnAxisThatIsANumber)
{
    const std::string text = sound_job_with(7, "restitution = 0.9");
    const Job share = job_of(text, {"plane.restitution.of=maximum"});
    EXPECT_EQ(axis(share, "restitution_of_maximum").values(), AxisList{0.9});
    const Job list = job_of(text, {"plane.restitution.values=[0.5, 0.6]"});
    EXPECT_EQ(axis(list, "restitution").size(), 2);
    const Job range = job_of(text, {"plane.restitution.first=0.5", "plane.restitution.last=0.6",
                                    "plane.restitution.count=3"});
    EXPECT_EQ(axis(range, "restitution").size(), 3);
}

TEST(AnOverride, OfAnAxisThatIsANumberIsRefusedAtTheNumberIfItIsWrong)
{
    const std::string text = sound_job_with(7, "restitution = -0.9");
    const std::string message = refusal_of(text, {"plane.restitution.of=maximum"});
    EXPECT_TRUE(message.starts_with("job.toml:7:15: plane.restitution.values[0]")) << message;
}

TEST(AnOverride, AcceptsABareWordAsAString)
{
    EXPECT_EQ(job_with({"scene.pulse=one_cosine"}).problem.scene.pulse()->kind,
              PulseKind::one_cosine);
    EXPECT_EQ(job_with({"title=Two words, and Ω (omega)"}).title, "Two words, and Ω (omega)");
}

TEST(AnOverride, AcceptsListsOverSeveralLines)
{
    EXPECT_EQ(axis(job_with({"plane.frequency.values=[1,\n 2]"}), "frequency").size(), 2);
}

TEST(AnOverride, OfValuesReplacesTheRange)
{
    const Job job = job_with({"plane.frequency.values=[0.2]"});
    EXPECT_EQ(std::get<AxisList>(axis(job, "frequency").definition()), AxisList{0.2});
}

TEST(AnOverride, OfValuesReplacesALogarithmicRange)
{
    const std::string text =
        sound_job_with(5, "frequency = { first = 1, last = 4, count = 3, spacing = \"log\" }");
    const Job job = job_of(text, {"plane.frequency.values=[0.2, 0.3]"});
    EXPECT_EQ(axis(job, "frequency").values(), (AxisList{0.2, 0.3}));
}

TEST(AnOverride, OfARangeReplacesTheValues)
{
    const Job job =
        job_with({"plane.amplitude.first=1", "plane.amplitude.last=4", "plane.amplitude.count=4"});
    EXPECT_EQ(axis(job, "amplitude").values(), (AxisList{1, 2, 3, 4}));
}

TEST(AnOverride, OfTheRestitutionValuesKeepsTheKeyOf)
{
    const Job job = job_of(older_job(), {"plane.restitution.values=[1.0]"});
    EXPECT_EQ(axis(job, "restitution_of_maximum").values(), AxisList{1});
}

TEST(AnOverride, OfAWholeAxisReplacesAllOfIt)
{
    const Job job = job_of(older_job(), {"plane.restitution={values=[0.5]}"});
    EXPECT_FALSE(gives(job, "restitution_of_maximum"));
    EXPECT_EQ(axis(job, "restitution")[0], 0.5);
}

TEST(AnOverride, OfTheBlockReplacesTheSlenderness)
{
    const Job job = job_with({"block.half_width=1", "block.half_height=2"});
    EXPECT_FALSE(gives(job, "slenderness"));
    EXPECT_EQ(axis(job, "half_height")[0], 2);
}

TEST(AnOverride, OfTheSlendernessReplacesTheBlock)
{
    const std::string text = sound_job_with(8, "[block]\nhalf_width = 1\nhalf_height = 2");
    const Job job = job_of(text, {"plane.slenderness.values=[0.3]"});
    EXPECT_FALSE(gives(job, "half_width") || gives(job, "half_height"));
    EXPECT_EQ(axis(job, "slenderness")[0], 0.3);
}

TEST(AnOverride, OfAQuantityReplacesThoseThatItExcludes)
{
    EXPECT_FALSE(gives(job_with({"plane.pga=0.4"}), "amplitude"));
    EXPECT_FALSE(gives(job_with({"plane.pulse_period=1", "plane.size=2"}), "frequency"));
    const Job share = job_of(older_job(), {"plane.restitution_of_maximum=1"});
    EXPECT_EQ(axis(share, "restitution_of_maximum").values(), AxisList{1})
        << "the other spelling is dropped";
    const Job size = job_with({"plane.frequency_parameter=1", "block.size=2"});
    EXPECT_EQ(axis(size, "size")[0], 2);
    EXPECT_FALSE(gives(size, "frequency_parameter")) << "also in another table";
}

TEST(AnOverride, OfATableReplacesTheBlockAndItsRestitution)
{
    const ScratchFolder folder;
    write_bytes(folder / "blocks.csv", "width,height,restitution\n1,5,0.9\n");
    const std::string table = fmt::format("blocks.table='{}'", folder / "blocks.csv");
    const Job job = job_with({table});
    EXPECT_FALSE(gives(job, "slenderness") || gives(job, "restitution_of_maximum"));
    EXPECT_EQ(job.problem.grid.table()->columns.size(), 3u);
    const Job again = job_with({table, "plane.slenderness=0.2", "plane.restitution=0.9"});
    EXPECT_EQ(again.problem.grid.table(), nullptr) << "a shape of the block replaces the table";
}

TEST(AnOverride, OfATableKeepsWhatNoColumnContradicts)
{
    const ScratchFolder folder;
    write_bytes(folder / "blocks.csv", "width,height,amplitude\n1,5,2\n");
    const std::string table = fmt::format("blocks.table='{}'", folder / "blocks.csv");
    const std::string text = sound_job_with(8, "slenderness = 0.1745716\nfriction = 0.3\nsize = 2");
    const Job job = job_of(text, {table, "output.fields=[\"region\"]"});
    EXPECT_EQ(axis(job, "restitution_of_maximum").values(), (AxisList{0.7, 0.85}));
    EXPECT_EQ(axis(job, "friction").values(), AxisList{0.3});
    EXPECT_EQ(axis(job, "amplitude").values(), AxisList{2});
    EXPECT_FALSE(gives(job, "slenderness") || gives(job, "size"));
    EXPECT_THAT(refusal_of(text, {table, "plane.amplitude=3"}),
                HasSubstr("amplitude cannot be combined with plane.amplitude"))
        << "what an argument gives is not dropped";
}

TEST(AnOverride, OfTheMotionRemovesTheQuantitiesThatDoNotApply)
{
    const ScratchFolder folder;
    write_bytes(folder / "a.AT2", "PEER\nA, 1\nIN UNITS OF G\nNPTS= 3, DT= .1\n0 1 0\n");
    const std::vector<std::string> record{fmt::format("scene.record='{}'", folder / "a.AT2"),
                                          "plane.scale=2", "plane.size=1"};
    const Job recorded = job_with(record);
    EXPECT_FALSE(gives(recorded, "amplitude") || gives(recorded, "frequency"));
    std::vector<std::string> pulse = record;
    pulse.insert(pulse.end(), {"scene.pulse=one_cosine", "plane.pga=1", "plane.frequency=2"});
    EXPECT_FALSE(gives(job_with(pulse), "scale"));
}

TEST(AnOverride, OfThePulseRemovesAWindowThatDoesNotApply)
{
    const std::string text = sound_job_with(3, "pulse = \"symmetric_ricker\"\nwindow = 2");
    EXPECT_EQ(job_of(text, {"scene.pulse=half_sine"}).problem.scene.pulse()->kind,
              PulseKind::half_sine);
    EXPECT_EQ(
        job_of(text, {"scene.pulse=antisymmetric_ricker"}).problem.scene.pulse()->shape.window, 2);
}

TEST(AnOverride, OfThePulseRemovesTheNumbersOfTheOther)
{
    const std::string text =
        sound_job_with(3, "pulse = \"mavroeidis_papageorgiou\"\ngamma = 2\nnu = 0.3");
    const Job job = job_of(text, {"scene.pulse=sine", "scene.cycles=2.5"});
    EXPECT_EQ(job.problem.scene.pulse()->kind, PulseKind::sine);
    EXPECT_EQ(job.problem.scene.pulse()->shape.cycles, 2.5);
    EXPECT_EQ(job.resolved.find("gamma"), std::string::npos);
}

/// An override that must be refused, and parts of the message.
struct Unusable {
    std::string name;
    std::string argument;
    std::vector<std::string> words;

    friend std::ostream& operator<<(std::ostream& stream, const Unusable& unusable)
    {
        return stream << unusable.argument;
    }
};

class AnOverrideIsRefused : public testing::TestWithParam<Unusable> {};

TEST_P(AnOverrideIsRefused, WithTheArgumentAsLocation)
{
    const std::string message = refusal_of(sound_job, {GetParam().argument});
    std::string place = "--set " + GetParam().argument + ": ";
    std::replace(place.begin(), place.end(), '\n', ' '); // a message is one line
    EXPECT_TRUE(message.starts_with(place)) << message;
    for (const std::string& words : GetParam().words) {
        EXPECT_THAT(message, HasSubstr(words));
    }
}

// clang-format off
INSTANTIATE_TEST_SUITE_P(Arguments, AnOverrideIsRefused, testing::ValuesIn(std::vector<Unusable>{
    {"WithoutEquals", "plane.frequency.count", {"not TOML", "key.path=value"}},
    {"WithoutKey", "=3", {"not TOML", "key.path=value"}},
    {"WithAGapInTheKey", "plane..count=3", {"not TOML", "key.path=value"}},
    {"WithAnUnusableKey", "plane.frequency.values[0]=3", {"not TOML", "key.path=value"}},
    {"WithoutValue", "title=", {"not TOML", "key.path=value"}},
    {"WithABrokenValue", "plane.frequency.values=[1,", {"not TOML"}},
    {"WithAMalformedNumber", "numerics.tolerance=1e-6x", {"not TOML"}},
    {"WithATruncatedWord", "title=i\n", {"not TOML"}},
    {"WithInvalidUtf8", "title=a\xff", {"not TOML", "utf-8"}},
    {"WithoutAnything", "", {"not exactly one value"}},
    {"WithAComment", "#title=x", {"not exactly one value"}},
    {"WithAnEmptyTable", "[scene]", {"not exactly one value"}},
    {"WithTwoValues", "numerics.tolerance=1e-6\nmethod='rk45'", {"not exactly one value"}},
    {"WithASecondTable", "title='x'\n[scene]\npulse='one_sine'", {"not exactly one value"}},
    {"ThroughANumber", "plane.frequency.first.deep=1", {"plane.frequency.first is not a table"}},
    {"ThroughTheTitle", "title.x=1", {"title is not a table"}},
    {"WithAnUnknownKey", "plane.frequency.cuont=3", {"unknown key \"plane.frequency.cuont\"", "\"plane.frequency.count\"?"}},
    {"WithAnUnknownTable", "plan.frequency.count=3", {"unknown key \"plan\"", "\"plane\"?"}},
    {"WithAValueOutOfRange", "plane.frequency.first=-1", {"plane.frequency.first = -1 is outside (0, inf)"}},
    {"WithAWrongType", "plane.frequency.count=many", {"plane.frequency.count is the string \"many\"", "integer"}},
    {"WithANumberForATable", "scene=3", {"scene is the integer 3", "a table"}},
    {"WithAnUnknownPulse", "scene.pulse=one_sin", {"scene.pulse = \"one_sin\" is unknown", "\"one_sine\"?"}},
    {"WithAWindowForAPulseThatEnds", "scene.window=2.0", {"scene.window has no meaning"}},
    {"WithHalfABlock", "block.half_width=2", {"block.height is missing"}},
    {"WithACountForASingleValue", "plane.frequency.count=1", {"count = 1 needs first = last"}}}),
    [](const testing::TestParamInfo<Unusable>& unusable) { return unusable.param.name; });
// clang-format on

TEST(AnOverride, IsShortenedInMessages)
{
    std::string argument = "plane.frequency.values=[";
    for (int i = 1; i < 1000; ++i) {
        argument += std::to_string(i) + ", ";
    }
    EXPECT_THAT(refusal_of(sound_job, {argument + "1]"}), AllOf(SizeIs(Gt(0u)), SizeIs(Lt(300u))));
}

TEST(Axes, ExcludeEachOtherIfTheyGiveOneQuantity)
{
    for (const auto& [axis, other] :
         {std::pair("size", "size"), std::pair("size", "frequency_parameter"),
          std::pair("pga", "scale"), std::pair("pulse_period", "frequency")}) {
        EXPECT_TRUE(exclude_each_other(axis, other)) << axis;
        EXPECT_TRUE(exclude_each_other(other, axis)) << axis;
    }
    EXPECT_FALSE(exclude_each_other("size", "pulse_period"));
    EXPECT_FALSE(exclude_each_other("restitution", "slenderness"));
}

} // namespace

} // namespace overturn
