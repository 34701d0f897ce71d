// Formats jobs and their values as TOML.
#pragma once

#include "overturn/text/quoting.hpp"

#include <string>

namespace overturn {

struct Job;

/// The canonical text of a job: in fixed order, with all defaults.
std::string resolved_text(const Job& job);

/// The shortest text from which the same double is read, always with the syntax of a float.
std::string float_text(double value);

} // namespace overturn
