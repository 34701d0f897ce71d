// A small job with four axes and every field, and artificial values for its tiles.
#pragma once

#include "overturn/file/result_writer.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "support/given_values.hpp"

#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// Tiles of 64 x 64 points do not divide the plane evenly: 67 = 64 + 3 rows, 131 = 64 + 64 + 3
/// columns.
inline Job sample_job()
{
    Job job;
    job.title = "Sample: r = r_max, α = 10°";
    Problem& problem = job.problem;
    problem.scene = {.motion = Pulse{PulseKind::symmetric_ricker, {.window = 1.25}},
                     .theory = Theory::nonlinear};
    problem.grid =
        grid_of(problem.scene, {axis("frequency", AxisRange{0.5, 12, 131, Spacing::linear}),
                                axis("amplitude", AxisRange{0.25, 16, 67, Spacing::linear}),
                                axis("restitution_of_maximum", {0.7, 0.85, 1}),
                                axis("slenderness", {0.1745716, 0.25})});
    problem.numerics = {.method = Method::rk45, .tolerance = 1e-9};
    problem.fields = {Field::region, Field::angle,   Field::velocity,
                      Field::margin, Field::impacts, Field::status};
    job.given = "title = \"Sample: r = r_max, α = 10°\"\n";
    job.overrides = {"plane.slenderness.values=[0.1745716, 0.25]", "output.fields=[\"region\"]"};
    job.resolved = "pulse = \"symmetric_ricker\"\nwindow = 1.25\ntolerance = 1e-09\n";
    return job;
}

/// The values of an axis of the job.
inline Axis& axis_of(Job& job, std::string_view name)
{
    Grid& grid = job.problem.grid;
    return grid.dimensions[*grid.dimension_of(name)].columns.front().values;
}

/// Every point has a unique value, computed from its position in the plane.
inline TileFields sample_values(const Job& job, const Tile& tile)
{
    const Shape shape = job.problem.grid.shape();
    const auto position_of = [&](std::int64_t point) {
        std::int64_t position = 0;
        std::int64_t stride = 1;
        for (std::size_t i = shape.size(); i-- > 0;) {
            position += stride * (tile.begin[i] + point % tile.count[i]);
            stride *= shape[i];
            point /= tile.count[i];
        }
        return position;
    };
    TileFields result;
    for (const Field field : job.problem.fields) {
        const auto number = double(&traits_of(field) - all_fields().data());
        FieldValues values = not_computed(field, tile.points());
        std::visit(
            [&](auto& list) {
                using Value = typename std::decay_t<decltype(list)>::value_type;
                for (std::int64_t i = 0; i < tile.points(); ++i) {
                    const std::int64_t position = position_of(i);
                    list[std::size_t(i)] = Value(position % 251);
                    if constexpr (std::is_floating_point_v<Value>) {
                        list[std::size_t(i)] = Value(double(position) + number / 8);
                    }
                }
            },
            values);
        result.values.push_back(std::move(values));
    }
    return result;
}

inline void write_tiles(ResultWriter& file, const Job& job,
                        const std::vector<std::int64_t>& numbers)
{
    const Tiling tiling = tiling_of(job.problem);
    for (const std::int64_t number : numbers) {
        file.write(tiling[number], sample_values(job, tiling[number]));
    }
}

/// 0, 1, ..., count - 1.
inline std::vector<std::int64_t> first_tiles(std::int64_t count)
{
    std::vector<std::int64_t> numbers(static_cast<std::size_t>(count));
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

/// Creates the file and writes the first tiles.
inline void write_spectrum(const std::string& path, const Job& job, std::int64_t tiles)
{
    create_result(path, job);
    ResultWriter file(path, MPI_COMM_SELF, job.problem);
    write_tiles(file, job, first_tiles(tiles));
    file.close();
}

} // namespace overturn
