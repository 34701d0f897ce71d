// The rounding mode of the processor may change the last bits, but no certain verdict.
#include "overturn/mechanics/region.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "support/given_values.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>

namespace overturn {
namespace {

class RoundingMode {
public:
    explicit RoundingMode(int mode) { std::fesetround(mode); }
    ~RoundingMode() { std::fesetround(FE_TONEAREST); }
    RoundingMode(const RoundingMode&) = delete;
    RoundingMode& operator=(const RoundingMode&) = delete;
};

struct Swept {
    std::vector<std::uint8_t> region;
    std::vector<double> margin, error;
};

Swept sweep(const Scene& scene, const Numerics& numerics, int mode)
{
    const Problem problem{
        .scene = scene,
        .grid = grid_of(scene, {number("slenderness", 0.1745716), number("restitution", 0.8),
                                axis("amplitude", AxisRange{0.9, 12.0, 64}),
                                axis("frequency", AxisRange{0.3, 9.0, 64})}),
        .numerics = numerics,
        .fields = {Field::region, Field::margin, Field::error}};
    const RoundingMode rounding(mode);
    const TileFields fields = compute_tile(problem, tiling_of(problem)[0], widest_kernel());
    return {std::get<std::vector<std::uint8_t>>(fields.values[0]),
            std::get<std::vector<double>>(fields.values[1]),
            std::get<std::vector<double>>(fields.values[2])};
}

TEST(RoundingModes, ChangeNoCertainVerdict)
{
    for (std::size_t pulse = 0; pulse < names_of<PulseKind>.size(); ++pulse) {
        const Scene scene{.motion = Pulse{PulseKind(pulse)}};
        for (const Numerics& numerics :
             {Numerics{Method::rk45, 1e-9}, Numerics{Method::taylor, 1e-6},
              Numerics{Method::taylor, 1e-9}}) {
            const Swept nearest = sweep(scene, numerics, FE_TONEAREST);
            int moved = 0;
            for (const int mode : {FE_UPWARD, FE_DOWNWARD}) {
                const Swept other = sweep(scene, numerics, mode);
                for (std::size_t i = 0; i < other.region.size(); ++i) {
                    const bool same =
                        is_safe(Region(nearest.region[i])) == is_safe(Region(other.region[i]));
                    EXPECT_TRUE(same || std::abs(nearest.margin[i]) < nearest.error[i])
                        << name_of(scene.pulse()->kind) << " point " << i << " margin "
                        << nearest.margin[i];
                    moved += nearest.margin[i] != other.margin[i];
                }
            }
            EXPECT_GT(moved, 0) << "the rounding mode has no effect on the kernel";
        }
    }
}

TEST(RoundingModes, LeaveNoPointUndecided)
{
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        for (const std::uint8_t region : sweep({}, {}, mode).region) {
            EXPECT_LE(region, std::uint8_t(Region::F_minus));
        }
    }
}

} // namespace
} // namespace overturn
