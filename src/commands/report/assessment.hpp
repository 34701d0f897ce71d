// The answer of `overturn assess` as text: one row per object.
#pragma once

#include "commands/commands.hpp"

namespace overturn {

/// The motions and the table of the objects, for people.
void print_assessment(const Assessment& assessment, const AssessOptions& options);

} // namespace overturn
