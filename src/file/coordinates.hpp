// The coordinate variables of a result file: what the skeleton is given, and what a file is held
// against when it is read back.
#pragma once

#include "netcdf.hpp"

#include "overturn/job/job.hpp"

#include <vector>

namespace overturn {

struct Coordinate : netcdf::Variable {
    /// What the C libraries of two machines may make of it, in units of its last place: where no
    /// function of theirs takes part, nothing.
    double roundings = 0;
};

/// A dimension of every field; it has a coordinate variable of its name.
struct Dimension {
    const char* name;
    const Axis* axis;
    const char* long_name;
    const char* units;
};

/// Slowest first. They point into the job.
std::vector<Dimension> dimensions_of(const Job& job);

/// In the order of the file: dimensions first.
std::vector<Coordinate> coordinates_of(const Job& job);

} // namespace overturn
