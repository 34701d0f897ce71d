#include "overturn/problem/problem.hpp"

#include "overturn/mechanics/theory/theories.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/text/is_one_of.hpp"
#include "overturn/text/mapped.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace overturn {

std::vector<StoredDimension> stored_dimensions(const Problem& problem)
{
    return std::visit([&](const auto& product) { return product.dimensions(problem); },
                      problem.product);
}

Shape stored_shape(const Problem& problem)
{
    return mapped(stored_dimensions(problem), &StoredDimension::size);
}

std::vector<Field> boundary_fields(const Scene& scene, const Grid& grid,
                                   const Boundaries& boundaries)
{
    const bool is_strength = boundaries.along == nullptr;
    std::vector<Field> fields{is_strength ? Field::flip_amplitude : Field::flip_value,
                              Field::region_below, Field::region_above};
    const bool is_sensitive = scene.motion_traits().is_sensitive;
    if (is_strength &&
        (is_sensitive || grid.find("pga") != nullptr || Coordinates(scene, grid).has("size"))) {
        fields.push_back(Field::flip_pga);
    }
    if (is_sensitive) {
        fields.insert(fields.end(), {Field::unsafe_share, Field::undecided_share});
    }
    return fields;
}

namespace {

/// The extents of a tile of a spectrum: at most `side` points along each of the last two
/// dimensions. If these are fewer than side x side points, the tile is extended along all
/// dimensions, the fastest first, up to that number.
Shape tile_of(const Grid& grid, std::int64_t side)
{
    const Shape shape = grid.shape();
    Shape tile(shape.size(), 1);
    // Kernels compute points under one record at a time, so a tile of a suite has one. Rows of a
    // table may have records of their own.
    const std::size_t first =
        grid.dimensions.empty() || grid.dimensions[0].name != "motion" ? 0 : 1;
    const std::size_t others = shape.size() - std::min<std::size_t>(2, shape.size());
    for (std::size_t i = std::max(first, others); i < shape.size(); ++i) {
        tile[i] = std::min(shape[i], side);
    }
    for (std::size_t i = shape.size(); i-- > first;) {
        tile[i] = std::min(shape[i], tile[i] * (side * side / count_points(tile)));
    }
    return tile;
}

/// The extents of a tile of a filled spectrum. Large cells need large tiles. A tile of 256 x 256
/// points still takes only a few milliseconds, because few of its points are integrated inside the
/// regions of fine spectra.
Shape filled_tile_of(const Grid& grid)
{
    const auto is_side = [](const Dimension& dimension) {
        const Role role = dimension.columns.front().quantity->role;
        return role == Role::strength || role == Role::rate;
    };
    const bool is_fine = std::ranges::any_of(grid.dimensions, [&](const Dimension& dimension) {
        return is_side(dimension) && dimension.size() >= 1024;
    });
    return mapped(grid.dimensions, [&](const Dimension& dimension) -> std::int64_t {
        return !is_side(dimension) ? 1 : is_fine ? 256 : 128;
    });
}

} // namespace

std::vector<StoredDimension> Spectrum::dimensions(const Problem& problem) const
{
    return mapped(problem.grid.dimensions, [](const Dimension& dimension) {
        return StoredDimension{dimension.name, dimension.size()};
    });
}

// 64 x 64 points take a few milliseconds: long compared with a message (microseconds), short
// compared with a run. A spectrum of 100 x 100 points still provides work for a few ranks. Under a
// record, 16 x 16 points take as long.
Shape Spectrum::tile(const Problem& problem) const
{
    return tile_of(problem.grid, problem.scene.motion_traits().tile_side);
}

Items Spectrum::items(const Problem& problem) const
{
    return {problem.grid.points(), "points"};
}

Shape FilledSpectrum::tile(const Problem& problem) const
{
    return filled_tile_of(problem.grid);
}

std::size_t Boundaries::dimension(const Grid& grid) const
{
    return *(along == nullptr ? grid.dimension_of(Role::strength) : grid.dimension_of(along->name));
}

std::vector<StoredDimension> Boundaries::dimensions(const Problem& problem) const
{
    std::vector<StoredDimension> dimensions = Spectrum().dimensions(problem);
    dimensions[dimension(problem.grid)] = {std::string(flip_dimension),
                                           problem.scene.motion_traits().most_flips};
    return dimensions;
}

// One line, which takes longer than a tile of a spectrum: about 10 ms, and much more for slow
// pulses, under which blocks bounce very often.
Shape Boundaries::tile(const Problem& problem) const
{
    return mapped(dimensions(problem), [](const StoredDimension& dimension) {
        return dimension.name == flip_dimension ? dimension.size : 1;
    });
}

Items Boundaries::items(const Problem& problem) const
{
    return {count_points(stored_shape(problem)) / problem.scene.motion_traits().most_flips,
            "lines"};
}

Tiling tiling_of(const Problem& problem)
{
    return std::visit(
        [&](const auto& product) { return Tiling(stored_shape(problem), product.tile(problem)); },
        problem.product);
}

Items items_of(const Problem& problem)
{
    return std::visit([&](const auto& product) { return product.items(problem); }, problem.product);
}

std::string reason_not_to_compute(Field field, const Scene& scene, bool has_friction)
{
    const auto& needs = traits_of(field).needs;
    if (!has_contact_forces(scene.theory) && is_one_of(&Outputs::contact, needs)) {
        return fmt::format("the {} theory has no forces of the contact", name_of(scene.theory));
    }
    if (!has_friction && is_one_of(&Outputs::slide, needs)) {
        return "without the key friction, no block slips";
    }
    return "";
}

std::string reason_not_to_fill(const Problem& problem)
{
    if (problem.grid.may_slip()) {
        return "where blocks slip, regions have other boundaries";
    }
    if (const auto reason = problem.scene.motion_traits().reason_not_to_fill; !reason.empty()) {
        return std::string(reason);
    }
    if (problem.grid.table() != nullptr) {
        return "the blocks of a list have no neighbours";
    }
    for (const Role role : {Role::strength, Role::rate}) {
        const Column* column = problem.grid.axis_or_number(role);
        if (column->values.size() > 1 && !column->values.is_range()) {
            return fmt::format("plane.{} lists its values, whose spacing is arbitrary; the axes of "
                               "a filled spectrum need first, last and count",
                               column->quantity->name);
        }
    }
    for (const Field field : problem.fields) {
        if (traits_of(field).of != FieldOf::filled_point) {
            return fmt::format("the field \"{}\" cannot be filled; only \"region\" and \"impacts\" "
                               "can",
                               name_of(field));
        }
    }
    return "";
}

} // namespace overturn
