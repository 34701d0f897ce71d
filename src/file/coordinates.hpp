// The coordinate variables of a result file, used to create a file and to check an existing one.
#pragma once

#include "netcdf.hpp"

#include "overturn/job/job.hpp"

#include <vector>

namespace overturn {

struct Coordinate : netcdf::Variable {
    /// How much the values from two C libraries may differ, in units of the last place; 0 if no
    /// library function is involved.
    double roundings = 0;
};

/// A dimension of every field, with a coordinate variable of the same name.
struct Dimension {
    std::string name;
    Axis axis;
    std::string long_name;
    std::string units;
};

/// Slowest first.
std::vector<Dimension> dimensions_of(const Job& job);

/// The coordinate of a boundary that contains the values computed first.
std::string name_of_scan(const Job& job);

/// In the order of the file: those of the dimensions first.
std::vector<Coordinate> coordinates_of(const Job& job);

} // namespace overturn
