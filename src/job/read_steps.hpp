// The steps of read_job: lay the --set arguments over the file, then read table by table.
#pragma once

#include "overturn/job/job.hpp"
#include "toml_reading.hpp"

#include <array>

namespace overturn {

/// Lays `key.path=value` (TOML; a bare word stands for a string) over the job. What it contradicts
/// is dropped: `values` or first/last/count of the same axis, [block] or plane.slenderness, and
/// the window where the new pulse has none. Throws JobError for an unusable argument.
void lay_override(toml::table& job, const std::string& argument);

Scene read_scene(const Entry& job);
Numerics read_numerics(const Entry& job);

/// [output].
std::vector<Field> read_fields(const Entry& job);

/// Refuses a tolerance at which the errors that the job asks for are not known.
void expect_known_errors(const Entry& job, const Numerics& numerics,
                         const std::vector<Field>& fields);

/// [plane] and [block].
Plane read_plane(const Entry& job);

/// The interval, within [0, infinity), in which the values of an axis lie, and the reason for it.
struct AxisRule {
    std::string_view interval;
    bool (*allows)(double);
    std::string_view reason;
};

inline constexpr std::array<std::string_view, 5> axis_keys{"values", "first", "last", "count",
                                                           "spacing"};

/// Reads a number, which is an axis of one value, or a table with no other keys than these:
/// { values = [...] } or { first, last, count, spacing }.
Axis read_axis(const Entry& entry, const AxisRule& rule, Names keys = axis_keys);

} // namespace overturn
