// The keys of a job: one table, from which reading, --set, completion and the documentation follow.
#pragma once

#include "overturn/problem/fields.hpp"
#include "overturn/problem/quantity.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// A key of a job file.
struct Key {
    std::string_view table; ///< empty: at the top
    std::string_view name;
    Under motion; ///< that it describes
    std::string_view type;
    std::string standard; ///< the value of a missing key; empty: none
    std::string meaning;
    std::string allowed{}; ///< range or words; empty: any
    std::string units{};   ///< of a number; empty: dimensionless

    std::string dotted() const; ///< such as "scene.pulse"
};
inline constexpr std::string_view table_type = "table";

/// All keys; those of [block] are in [plane], too.
const std::vector<Key>& all_keys();

/// The fields of a job that does not list them.
inline const std::vector<Field> default_fields{Field::region};

/// The names of the keys of a table; of the job if it is empty. motion: only those that belong to
/// a pulse, or to a record.
std::vector<std::string_view> keys_of(std::string_view table, std::optional<Under> motion = {});

/// The keys that an override of read_job() may replace, such as "scene.pulse" and
/// "plane.frequency.count".
std::vector<std::string> override_keys();

/// The quantities along which flips of the verdict are searched: strengths, and those of the block
/// and of its loss at impacts.
std::vector<std::string_view> scanned_quantities();

/// The keys of an axis that is a table; that of the restitution also has `of`, which says of what
/// its values are a share.
inline constexpr std::array<std::string_view, 5> axis_keys{"values", "first", "last", "count",
                                                           "spacing"};
inline constexpr std::array<std::string_view, 2> shares_of{"absolute", "maximum"};

/// The tables whose keys are coordinates of points. Those that describe a block are keys of both.
inline constexpr std::string_view coordinate_tables[] = {"plane", "block"};

} // namespace overturn
