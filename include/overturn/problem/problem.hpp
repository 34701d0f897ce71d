// What is asked: the scene, the points, the numerics and what is to be stored.
#pragma once

#include "overturn/problem/fields.hpp"
#include "overturn/problem/grid.hpp"
#include "overturn/problem/product.hpp"
#include "overturn/problem/scene.hpp"
#include "overturn/problem/tile.hpp"

#include <string>
#include <vector>

namespace overturn {

struct Problem {
    Scene scene{};
    Grid grid{}; ///< of a boundary: the scan begins with its values
    Numerics numerics{};
    Product product{};
    std::vector<Field> fields{}; ///< in the job's order, without duplicates; of a filled spectrum,
                                 ///< `evaluated` is the last one
};

/// The name of the dimension along the flips of a boundary, which replaces that of the strength or
/// of another quantity.
inline constexpr std::string_view flip_dimension = "crossing";

/// Slowest first: those of the grid; of a boundary, `crossing` instead of what is scanned.
std::vector<StoredDimension> stored_dimensions(const Problem& problem);
Shape stored_shape(const Problem& problem);

/// The fields of a boundary: flip_amplitude, region_below, region_above; flip_pga under a record,
/// and if the size of the block is known or the strength is a pga; the fields of a line under a
/// record. Along another quantity, flip_value instead of flip_amplitude and flip_pga.
std::vector<Field> boundary_fields(const Scene& scene, const Grid& grid,
                                   const Boundaries& boundaries = {});

/// The division into tiles.
Tiling tiling_of(const Problem& problem);

/// What the run of a problem counts.
Items items_of(const Problem& problem);

/// Why a field cannot be computed, as a clause; empty if it can. has_friction: of the blocks.
std::string reason_not_to_compute(Field field, const Scene& scene, bool has_friction);

/// Why a spectrum cannot be filled, as a clause; empty if it can.
std::string reason_not_to_fill(const Problem& problem);

} // namespace overturn
