#include "overturn/job/job.hpp"

#include "job_file.hpp"

#include <vector>

namespace overturn {

namespace {

void expect_equal(const Column& column, const Column& other)
{
    EXPECT_EQ(column.quantity, other.quantity);
    EXPECT_EQ(column.values.is_range(), other.values.is_range());
    EXPECT_EQ(column.values.values(), other.values.values());
}

void expect_equal(const Grid& grid, const Grid& other)
{
    ASSERT_EQ(grid.numbers.size(), other.numbers.size());
    for (std::size_t i = 0; i < grid.numbers.size(); ++i) {
        expect_equal(grid.numbers[i], other.numbers[i]);
    }
    ASSERT_EQ(grid.dimensions.size(), other.dimensions.size());
    for (std::size_t i = 0; i < grid.dimensions.size(); ++i) {
        EXPECT_EQ(grid.dimensions[i].name, other.dimensions[i].name);
        expect_equal(grid.dimensions[i].columns.at(0), other.dimensions[i].columns.at(0));
    }
}

TEST(TheResolvedJob, ContainsEveryDefault)
{
    const Job job =
        job_of("[scene]\npulse = 'symmetric_ricker'\n"
               "[plane]\n"
               "slenderness = { values = [0.2] }\n"
               "restitution.values = [1] # of = absolute\n"
               "amplitude = { count = 3, last = 2, first = 0 }\n"
               "frequency = { first = 0.1, last = 1e22, count = 7, spacing = 'log' }\n");
    EXPECT_EQ(job.resolved, R"(title = ""

[scene]
pulse = "symmetric_ricker"
theory = "nonlinear"
window = 1.0

[plane]
frequency = { first = 0.1, last = 1e+22, count = 7, spacing = "log" }
amplitude = { first = 0.0, last = 2.0, count = 3, spacing = "linear" }
restitution = { values = [1.0] }
slenderness = { values = [0.2] }

[numerics]
method = "rk45"
tolerance = 1e-09

[output]
fields = ["region"]
)");
}

TEST(TheResolvedJob, HasAWindowOnlyIfThePulseHasOne)
{
    EXPECT_EQ(job_of(sound_job).resolved.find("window"), std::string::npos);
}

class ResolvingAgain : public testing::TestWithParam<const char*> {};

TEST_P(ResolvingAgain, ChangesNothing)
{
    const Job once = job_of(GetParam());
    const Job twice = job_of(once.resolved);
    EXPECT_EQ(once.resolved, twice.resolved);
    EXPECT_EQ(once.title, twice.title);
    EXPECT_EQ(once.problem.scene.pulse()->kind, twice.problem.scene.pulse()->kind);
    EXPECT_EQ(once.problem.scene.theory, twice.problem.scene.theory);
    for (const auto& [name, number] : shape_numbers) {
        EXPECT_EQ(once.problem.scene.pulse()->shape.*number,
                  twice.problem.scene.pulse()->shape.*number)
            << name;
    }
    expect_equal(once.problem.grid, twice.problem.grid);
    EXPECT_EQ(once.problem.numerics.tolerance, twice.problem.numerics.tolerance);
    EXPECT_EQ(once.problem.fields, twice.problem.fields);
}

INSTANTIATE_TEST_SUITE_P(
    Jobs, ResolvingAgain,
    testing::Values(sound_job,
                    R"(title = "Quotes \" and \\, a tab \t, an end\n, a bell \u0007, Ω"
[scene]
pulse = "antisymmetric_ricker"
theory = "linear"
window = 0.7
[plane]
frequency = { values = [5e-324, 0.1, 0.30000000000000004, 1e22, 1.7976931348623157e308] }
amplitude = { first = 1e-3, last = 3, count = 5, spacing = "log" }
restitution = { first = 0.1, last = 1, count = 4 }
[block]
half_width = 1
half_height = 5.67
[numerics]
tolerance = 3.3e-14
[output]
fields = ["status", "region", "impacts", "velocity", "margin", "angle"]
)",
                    R"([scene]
pulse = "mavroeidis_papageorgiou"
gamma = 2.3000000000000003
nu = -0.1
[plane]
frequency = 1
amplitude = 2
restitution = 0.9
slenderness = 0.2
)",
                    R"([scene]
pulse = "cosine"
cycles = 3
[plane]
frequency = 1
amplitude = 2
restitution = 0.9
slenderness = 0.2
)"));

TEST(TheResolvedJob, HasTheNumbersOfItsPulseOnly)
{
    const Job job = job_of("[scene]\npulse = 'mavroeidis_papageorgiou'\ngamma = 2\nnu = 0.5\n"
                           "[plane]\nfrequency = 1\namplitude = 2\nrestitution = 0.9\n"
                           "slenderness = 0.2\n");
    EXPECT_NE(job.resolved.find("gamma = 2.0\nnu = 0.5\n"), std::string::npos) << job.resolved;
    EXPECT_EQ(job.resolved.find("window"), std::string::npos);
    EXPECT_EQ(job.resolved.find("cycles"), std::string::npos);
}

TEST(TheResolvedJob, IsTheSameForTheSameJobWrittenDifferently)
{
    const std::string plain = job_of(sound_job).resolved;
    EXPECT_EQ(job_of(sound_job_with(10, "tolerance = 0.000_000_001 # the default")).resolved,
              plain);
    EXPECT_EQ(job_of(sound_job_with(3, "pulse = 'rectangular'"), {"scene.pulse=one_sine"}).resolved,
              plain);
}

TEST(TheResolvedJob, DiffersForAnotherJob)
{
    const std::string plain = job_of(sound_job).resolved;
    // One unit in the last place of one value is another job.
    EXPECT_NE(job_of(sound_job, {"plane.slenderness.values=[0.17457160000000003]"}).resolved,
              plain);
    EXPECT_NE(job_of(sound_job, {"output.fields=['angle', 'region']"}).resolved, plain);
}

} // namespace

} // namespace overturn
