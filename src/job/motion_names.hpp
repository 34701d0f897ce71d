// Names by which results, tables and pictures tell the motions of a suite apart.
#pragma once

#include "overturn/job/job.hpp"
#include "overturn/record/read_record.hpp"

#include <string>
#include <vector>

namespace overturn {

/// The name of a component, or its number if it has none, or none of its own, or one that looks
/// like a path.
std::string label_of(const RecordFile& file, const RecordComponent& component);

/// Sets the name of every motion: its file; if several motions are of one file, the file and the
/// component, as in "WTMC.V2A:N28W"; if these have several vertical motions, also that. labels: of
/// the component of each motion in its file.
void name_motions(std::vector<Motion>& motions, const std::vector<std::string>& labels);

/// The numbers of the motions that have this name, in order: as in Motion::name, or with the file
/// without its folder or also without its ending, or that of the file alone.
std::vector<std::int64_t> motions_named(const std::string& name,
                                        const std::vector<Motion>& motions);

} // namespace overturn
