// JSON for programs. Numbers that are not finite are null.
#pragma once

#include "sidecar.hpp"

#include "../estimate.hpp"

#include "overturn/file/disk_space.hpp"
#include "overturn/file/stored_result.hpp"

#include <optional>
#include <string>
#include <vector>

namespace overturn {

/// The answer of `overturn check`. path: of the result file. space: in its folder.
std::string json_of(const Job& job, const std::string& path, const DiskSpace& space,
                    const RunEstimate& estimate, const std::vector<std::string>& warnings);

/// The answer of `overturn info`. run: the last one, if it is known.
std::string json_of(const StoredResult& stored, const std::optional<LastRun>& run);

} // namespace overturn
