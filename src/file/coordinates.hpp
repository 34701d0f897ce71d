// The coordinate variables of a result file.
#pragma once

#include "netcdf.hpp"

#include "overturn/job/job.hpp"

#include <functional>
#include <string>
#include <vector>

namespace overturn {

/// A variable of numbers whose values are computed when they are needed.
struct Coordinate {
    netcdf::Variable variable; ///< without values
    std::function<std::vector<double>()> values;
};

/// A variable of texts along a dimension; without one, a single text.
struct TextCoordinate {
    std::string name;
    std::string dimension;
    std::vector<std::string> values;
    const char* long_name;
};

/// In the order of the file: those of the dimensions first, then single values, columns of the
/// table and what follows from them, and the measures of the records; the strengths that a boundary
/// computes first.
std::vector<Coordinate> coordinates_of(const Job& job);

/// The names of the motions, and the texts of the table.
std::vector<TextCoordinate> text_coordinates_of(const Job& job);

} // namespace overturn
