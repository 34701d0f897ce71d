#include "overturn/job/job.hpp"

#include "job_file.hpp"

#include <cmath>
#include <filesystem>
#include <numbers>

namespace overturn {

namespace {

/// Returns the message of read_job for a path that it cannot read.
std::string refusal_of(const std::string& path)
{
    try {
        read_job(path);
    } catch (const JobError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(ReadingAJob, AcceptsANumberForAnAxisOfOneValue)
{
    const JobFile file(R"([scene]
pulse = "one_sine"
[plane]
frequency = 3
amplitude = 1.5
restitution = 0.9
slenderness = 0.2
)");
    const Job job = read_job(file.path());
    EXPECT_EQ(job.plane.points(), 1);
    EXPECT_EQ(job.plane.frequency[0], 3);
    EXPECT_EQ(job.plane.amplitude[0], 1.5);
    EXPECT_EQ(job.plane.restitution_ratio(0, 0), 0.9);
    EXPECT_EQ(job.plane.slenderness[0], 0.2);
    EXPECT_NE(job.resolved.find("frequency = { values = [3.0] }"), std::string::npos);
}

TEST(ReadingAJob, ReturnsTheValuesOfTheFile)
{
    const JobFile file(R"(title = "Antisymmetric"
[scene]
pulse = "antisymmetric_ricker"
theory = "linear"
window = 1.5
[plane]
frequency = { first = 0.5, last = 8.0, count = 5, spacing = "log" }
amplitude = { first = 0, last = 16, count = 17 }
restitution = { values = [0.5, 1], of = "maximum" }
slenderness = { values = [0.1, 0.2, 0.3] }
[numerics]
method = "rk45"
tolerance = 1e-6
[output]
fields = ["margin", "region"]
)");
    const Job job = read_job(file.path());
    EXPECT_EQ(job.title, "Antisymmetric");
    EXPECT_EQ(job.scene.pulse, PulseKind::antisymmetric_ricker);
    EXPECT_EQ(job.scene.theory, Theory::linear);
    EXPECT_EQ(job.scene.shape.window, 1.5);
    const auto& frequency = std::get<AxisRange>(job.plane.frequency.definition());
    EXPECT_EQ(frequency.first, 0.5);
    EXPECT_EQ(frequency.last, 8);
    EXPECT_EQ(frequency.count, 5);
    EXPECT_EQ(frequency.spacing, Spacing::log);
    const auto& amplitude = std::get<AxisRange>(job.plane.amplitude.definition());
    EXPECT_EQ(amplitude.first, 0);
    EXPECT_EQ(amplitude.count, 17);
    EXPECT_EQ(amplitude.spacing, Spacing::linear);
    EXPECT_EQ(std::get<AxisList>(job.plane.restitution.definition()), (AxisList{0.5, 1}));
    EXPECT_EQ(job.plane.restitution_of, RestitutionOf::maximum);
    EXPECT_EQ(job.plane.slenderness.values(), (AxisList{0.1, 0.2, 0.3}));
    EXPECT_FALSE(job.plane.block);
    EXPECT_EQ(job.numerics.method, Method::rk45);
    EXPECT_EQ(job.numerics.tolerance, 1e-6);
    EXPECT_EQ(job.fields, (std::vector<Field>{Field::margin, Field::region}));
    EXPECT_EQ(job.plane.points(), 5 * 17 * 2 * 3);
}

TEST(ReadingAJob, FillsInTheDefaults)
{
    const JobFile file(R"([scene]
pulse = "symmetric_ricker"
[plane]
frequency = { values = [1] }
amplitude = { values = [1] }
restitution = { values = [1] }
slenderness = { values = [0.2] }
)");
    const Job job = read_job(file.path());
    EXPECT_EQ(job.title, "");
    EXPECT_EQ(job.scene.theory, Theory::nonlinear);
    EXPECT_EQ(job.scene.shape.window, 1);
    EXPECT_EQ(job.plane.restitution_of, RestitutionOf::absolute);
    EXPECT_EQ(job.numerics.method, Method::rk45);
    EXPECT_EQ(job.numerics.tolerance, 1e-9);
    EXPECT_EQ(job.fields, std::vector<Field>{Field::region});
}

TEST(ReadingAJob, FillsInTheDefaultsOfEmptyTables)
{
    const JobFile without_tolerance(sound_job_with(10, ""));
    EXPECT_EQ(read_job(without_tolerance.path()).numerics.tolerance, 1e-9);
    const JobFile without_fields(sound_job_with(12, ""));
    EXPECT_EQ(read_job(without_fields.path()).fields, std::vector<Field>{Field::region});
}

TEST(ReadingAJob, DerivesTheSlendernessFromTheBlock)
{
    const JobFile file(sound_job_with(8, "[block]\nhalf_width = 1.0\nhalf_height = 5.67"));
    const Plane plane = read_job(file.path()).plane;
    ASSERT_TRUE(plane.block);
    EXPECT_EQ(plane.block->half_width, 1);
    EXPECT_EQ(plane.block->half_height, 5.67);
    ASSERT_EQ(plane.slenderness.size(), 1);
    // The paper's block, to its seven known digits; degrees or h/b would be far off.
    EXPECT_NEAR(plane.slenderness[0], 0.1745716, 5e-8);
    EXPECT_NEAR(plane.restitution_ratio(0, 0), 0.7 * 0.911547, 5e-7);
}

TEST(ReadingAJob, AcceptsTheEndsOfEveryInterval)
{
    const JobFile file(R"([scene]
pulse = "symmetric_ricker"
window = 8
[plane]
frequency = { values = [5e-324, 1.7976931348623157e308] }
amplitude = { values = [0] }
restitution = { values = [1] }
slenderness = { values = [1.5707963267948963] }
[numerics]
tolerance = 1e-14
)");
    EXPECT_EQ(read_job(file.path()).plane.frequency.first(), 5e-324);
    EXPECT_EQ(read_job(file.path(), {"numerics.tolerance=1e-2"}).numerics.tolerance, 1e-2);
}

TEST(ReadingAJob, AcceptsTheFinestAscendingRanges)
{
    const JobFile file(sound_job);
    // 4 eps last = 2^-49 apart for last = 2; half of that is refused.
    const std::vector<std::string> fine{"plane.frequency.first=1.9999999999999822",
                                        "plane.frequency.last=2", "plane.frequency.count=11"};
    const Axis axis = read_job(file.path(), fine).plane.frequency;
    for (std::int64_t i = 1; i < axis.size(); ++i) {
        EXPECT_LT(axis[i - 1], axis[i]);
    }
    const std::vector<std::string> finer{fine[0], fine[1], "plane.frequency.count=21"};
    EXPECT_THROW(read_job(file.path(), finer), JobError);
}

TEST(ReadingAJob, ContainsNoNegativeZero)
{
    const JobFile file(sound_job_with(6, "amplitude = { values = [-0.0, 1] }"));
    const Job job = read_job(file.path());
    EXPECT_FALSE(std::signbit(job.plane.amplitude[0]));
}

TEST(ReadingAJob, StoresTheFileByteForByte)
{
    const std::string text = std::string("# a comment\r\n") + sound_job + "\n\n# the end";
    const JobFile file(text);
    EXPECT_EQ(read_job(file.path()).given, text);
}

TEST(ReadingAJob, RefusesAMissingFile)
{
    const JobFile file(sound_job);
    const std::string path = file.directory() + "/other.toml";
    EXPECT_EQ(refusal_of(path), path + ": cannot be read: No such file or directory. Give the path "
                                       "of a job file.");
}

TEST(ReadingAJob, RefusesADirectory)
{
    const JobFile file(sound_job);
    EXPECT_EQ(refusal_of(file.directory()),
              file.directory() + ": cannot be read: Is a directory. Give the path of a job file.");
}

TEST(ReadingAJob, RefusesAFileThatCannotBeOpened)
{
    // A link to itself cannot be opened even by the superuser.
    const JobFile file(sound_job);
    const std::string path = file.directory() + "/loop.toml";
    std::filesystem::create_symlink(path, path);
    EXPECT_NE(refusal_of(path).find(path + ": cannot be read: "), std::string::npos);
}

TEST(ReadingAJob, RefusesAFileThatIsTooLarge)
{
    const JobFile file(sound_job);
    std::filesystem::resize_file(file.path(), (std::uintmax_t(64) << 20) + 1);
    EXPECT_NE(refusal_of(file.path()).find(file.path() + ": is larger than 64 MiB"),
              std::string::npos);
}

TEST(ReadingAJob, RefusesAnEmptyFile)
{
    const JobFile file("");
    EXPECT_EQ(refusal_of(file.path()),
              file.path() + ":1:1: scene is missing. Add [scene] with a pulse or a record.");
}

TEST(ReadingAJob, RefusesAJobWithoutAPlane)
{
    const JobFile file("[scene]\npulse = 'one_sine'\n");
    EXPECT_NE(refusal_of(file.path()).find(":1:1: plane is missing."), std::string::npos);
}

TEST(CutByWindow, IsTheValueOfThePulseAtTheEndsOfItsWindow)
{
    // x = pi: (1 - 2 pi^2) exp(-pi^2) = -9.7e-4; z = 2 pi / sqrt 3: 3.7e-2.
    EXPECT_NEAR(cut_by_window({.pulse = PulseKind::symmetric_ricker}), 9.69e-4, 1e-6);
    EXPECT_NEAR(cut_by_window({.pulse = PulseKind::antisymmetric_ricker}), 3.71e-2, 1e-4);
    EXPECT_LT(cut_by_window({.pulse = PulseKind::antisymmetric_ricker, .shape = {.window = 2}}),
              1e-8);
    EXPECT_EQ(cut_by_window({.pulse = PulseKind::rectangular}), 0);
}

} // namespace

} // namespace overturn
