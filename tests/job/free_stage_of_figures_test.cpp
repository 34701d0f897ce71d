// The regions of the paper's spectra compared with the analytical free stage of each point.
#include "overturn/job/job.hpp"
#include "overturn/mechanics/free_rocking.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/sweep/compute_tile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace overturn {
namespace {

/// Integrates a block impact by impact until it overturns or can no longer overturn.
Region region_of_free_stage(const State<double>& state, const Block<double>& block)
{
    FreeRocking<Theory::nonlinear, double> rocking(state, block);
    while (rocking.impacts() < 2 && std::isfinite(rocking.impact_time())) {
        rocking.strike();
    }
    if (std::isfinite(rocking.fall_time())) {
        const bool to_plus = rocking.arc().side() > 0;
        return rocking.impacts() == 0 ? (to_plus ? Region::U0_plus : Region::U0_minus)
                                      : (to_plus ? Region::U1_plus : Region::U1_minus);
    }
    // A safe block is in a blade if it would overturn without the loss at its first impact.
    const bool in_blade = conserved_q<Theory::nonlinear>(state, block) < 0;
    return !in_blade ? Region::S : state.side * state.rate > 0 ? Region::S_plus : Region::S_minus;
}

TEST(FreeStageOfThePapersFigures, HasTheOutcomeOfTheRegionAtEveryPoint)
{
    int spectra = 0;
    for (const auto& entry : std::filesystem::directory_iterator(OVERTURN_JOBS_DIRECTORY)) {
        if (entry.path().extension() != ".toml" ||
            entry.path().filename().string().rfind("figure_", 0) != 0) {
            continue;
        }
        ++spectra;
        Problem problem =
            read_job(entry.path(), {"plane.frequency.count=80", "plane.amplitude.count=80"})
                .problem;
        problem.fields = {Field::region, Field::angle, Field::velocity};
        const Tiling tiling = tiling_of(problem);
        const Coordinates coordinates(problem.scene, problem.grid);
        const Block<double> block{coordinates.of("slenderness").first(),
                                  coordinates.of("restitution").first()};
        for (std::int64_t number = 0; number < tiling.size(); ++number) {
            const TileFields fields = compute_tile(problem, tiling[number], widest_kernel());
            const auto& regions = std::get<std::vector<std::uint8_t>>(fields.values[0]);
            const auto& angles = std::get<std::vector<double>>(fields.values[1]);
            const auto& velocities = std::get<std::vector<double>>(fields.values[2]);
            for (std::size_t i = 0; i < regions.size(); ++i) {
                const auto region = Region(regions[i]);
                if (region == Region::F_plus || region == Region::F_minus) {
                    continue;
                }
                const double side = angles[i] < 0 || (angles[i] == 0 && velocities[i] < 0) ? -1 : 1;
                const State<double> state{side * angles[i], side * velocities[i], side};
                EXPECT_EQ(name_of(region_of_free_stage(state, block)), name_of(region))
                    << entry.path() << ": theta " << angles[i] << ", theta' " << velocities[i];
            }
        }
    }
    EXPECT_EQ(spectra, 9);
}

} // namespace
} // namespace overturn
