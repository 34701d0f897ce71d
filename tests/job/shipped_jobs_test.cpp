// Every job shipped with the program is valid.
#include "overturn/job/job.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/plausibility.hpp"

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
    EXPECT_EQ(implausible_values(job.problem.scene, job.problem.grid), "");
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
            const Grid& grid = job.problem.grid;
            const Coordinates coordinates(job.problem.scene, grid);
            EXPECT_TRUE(coordinates.has("size")) << name;
            EXPECT_NEAR(coordinates.of("slenderness").first(), 0.1745716, 5e-8) << name;
            EXPECT_NE(grid.find("restitution_of_maximum"), nullptr) << name;
            EXPECT_EQ(grid.points(), 1000 * 1000) << name;
        }
    }
    EXPECT_EQ(figures, 9) << "figures 7a, 9a, 9b and both of 11, 14 and 16";
}

} // namespace

} // namespace overturn
