// A small job with four axes and every field, and artificial values for its tiles.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/sweep/sweep_tile.hpp"

#include <cmath>
#include <limits>

namespace overturn {

inline Job sample_job()
{
    Job job;
    job.title = "Sample: r = r_max, α = 10°";
    job.scene = {.pulse = PulseKind::symmetric_ricker,
                 .theory = Theory::nonlinear,
                 .shape = {.window = 1.25}};
    job.plane.frequency = Axis(AxisRange{0.5, 12, 11, Spacing::linear});
    job.plane.amplitude = Axis(AxisRange{0.25, 16, 7, Spacing::linear});
    job.plane.restitution = Axis(AxisList{0.7, 0.85, 1});
    job.plane.slenderness = Axis(AxisList{0.1745716, 0.25});
    job.plane.restitution_of = RestitutionOf::maximum;
    job.numerics = {.method = Method::rk45, .tolerance = 1e-9};
    job.fields = {Field::region, Field::angle,   Field::velocity,
                  Field::margin, Field::impacts, Field::status};
    job.given = "title = \"Sample: r = r_max, α = 10°\"\n";
    job.overrides = {"plane.slenderness.values=[0.1745716, 0.25]", "output.fields=[\"region\"]"};
    job.resolved = "pulse = \"symmetric_ricker\"\nwindow = 1.25\ntolerance = 1e-09\n";
    return job;
}

/// Tiles that do not divide the plane evenly: 7 = 4 + 3 rows, 11 = 4 + 4 + 3 columns.
inline Tiling sample_tiling(const Job& job)
{
    return Tiling(shape_of(job.plane), {4, 4});
}

/// Every point has a unique value, computed from its position in the plane.
inline TileFields sample_values(const Job& job, const Tile& tile)
{
    TileFields result;
    for (const Field field : job.fields) {
        FieldValues values = make_field_values(field, std::size_t(tile.points()));
        std::visit(
            [&](auto& list) {
                using Value = typename std::decay_t<decltype(list)>::value_type;
                for (std::int64_t i = 0; i < tile.points(); ++i) {
                    const std::int64_t row = tile.begin[2] + i / tile.columns();
                    const std::int64_t column = tile.begin[3] + i % tile.columns();
                    const std::int64_t block =
                        tile.begin[0] * job.plane.restitution.size() + tile.begin[1];
                    const std::int64_t position =
                        (block * job.plane.amplitude.size() + row) * job.plane.frequency.size() +
                        column;
                    list[std::size_t(i)] = Value(position % 251);
                    if constexpr (std::is_floating_point_v<Value>) {
                        list[std::size_t(i)] = double(position) + double(int(field)) / 8;
                    }
                }
            },
            values);
        result.values.push_back(std::move(values));
    }
    return result;
}

} // namespace overturn
