// Every job shipped with the program is valid.
#include "overturn/job/job.hpp"
#include "overturn/sweep/plausibility.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace overturn {

namespace {

const std::filesystem::path jobs_directory = OVERTURN_JOBS_DIRECTORY;

std::vector<std::string> names_of_shipped_jobs()
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(jobs_directory)) {
        if (entry.path().extension() == ".toml") {
            names.push_back(entry.path().stem());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

class AShippedJob : public testing::TestWithParam<std::string> {};

TEST_P(AShippedJob, IsValid)
{
    const std::string path = jobs_directory / (GetParam() + ".toml");
    const Job job = read_job(path);
    EXPECT_FALSE(job.title.empty());
    EXPECT_TRUE(job.given.starts_with("# ")) << "it begins with a comment";
    EXPECT_EQ(implausible_values(job.scene, job.plane), "");
}

INSTANTIATE_TEST_SUITE_P(Jobs, AShippedJob, testing::ValuesIn(names_of_shipped_jobs()),
                         [](const auto& job) { return job.param; });

TEST(TheJobsOfTheFigures, AreThoseOfThePapersBlock)
{
    int figures = 0;
    for (const std::string& name : names_of_shipped_jobs()) {
        if (name.starts_with("figure_")) {
            const Job job = read_job(jobs_directory / (name + ".toml"));
            ++figures;
            ASSERT_TRUE(job.plane.block) << name;
            EXPECT_NEAR(job.plane.slenderness[0], 0.1745716, 5e-8) << name;
            EXPECT_EQ(job.plane.restitution_of, RestitutionOf::maximum) << name;
            EXPECT_EQ(job.plane.points(), 1000 * 1000) << name;
        }
    }
    EXPECT_EQ(figures, 9) << "figures 7a, 9a, 9b and both of 11, 14 and 16";
}

} // namespace

} // namespace overturn
