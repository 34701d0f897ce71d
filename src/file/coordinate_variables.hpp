// The coordinate variables of a result file.
#pragma once

#include "netcdf.hpp"

#include "overturn/job/job.hpp"

#include <functional>
#include <vector>

namespace overturn {

/// A coordinate variable whose values are computed when they are needed.
struct CoordinateVariable {
    netcdf::Variable variable; ///< without values
    std::function<netcdf::Values()> values;
};

/// In the order of the file: those of the dimensions first, then single values, the strengths that
/// a boundary computes first, columns of the table, what follows from all these, and the measures
/// of the records; last, the names of the motions and the texts of the table. The job must outlive
/// the result, which refers to it.
std::vector<CoordinateVariable> coordinate_variables_of(const Job& job);

} // namespace overturn
