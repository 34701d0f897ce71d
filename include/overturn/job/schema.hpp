// The keys of a job: one table, from which reading, --set, completion and the documentation follow.
#pragma once

#include "overturn/problem/quantity.hpp"
#include "overturn/problem/scene.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace overturn {

/// A key of a table of a job. The coordinates of points are keys of [plane], and those that
/// describe a block also of [block]; they follow from the table of quantities.
struct Key {
    std::string_view table; ///< empty: at the top
    std::string_view name;
    Under motion = Under::any_motion;
};

/// The names of the keys of a table; of the job if it is empty.
std::vector<std::string_view> keys_of(std::string_view table);

/// The keys of [scene] that belong to a pulse, or to a record.
std::vector<std::string_view> scene_keys_of(Under motion);

/// The keys of an axis that is a table.
std::span<const std::string_view> axis_keys();

/// The tables whose keys are coordinates of points.
inline constexpr std::string_view coordinate_tables[] = {"plane", "block"};

} // namespace overturn
