// The --set arguments, laid over the job file before anything is checked.
#pragma once

#include <toml++/toml.h>

#include <string>

namespace overturn {

/// Lays `key.path=value` (TOML; a bare word stands for a string) over the job. What it contradicts
/// is dropped: `values` or first/last/count of the same axis, [block] or plane.slenderness, and
/// the window where the new pulse has none. Throws JobError for an unusable argument.
void lay_override(toml::table& job, const std::string& argument);

} // namespace overturn
