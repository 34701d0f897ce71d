// What the user of a result file must know of it.
#pragma once

#include "overturn/file/stored_result.hpp"

#include <string>
#include <vector>

namespace overturn {

/// Of a boundary: the number of lines without a minimum overturning amplitude and of those with
/// undecided verdicts, if there are any; under a record, also the share of the interval in which
/// the block overturns, and a note that the flips depend on the scan. Of a filled spectrum: how
/// many filled points were checked and wrong, with an upper bound of the share of wrong points.
std::vector<std::string> remarks_on(const StoredResult& stored);

/// The command that computes missing and damaged tiles.
std::string command_to_complete(const StoredResult& stored);

/// Throws Error if coordinates or finished tiles of the file do not match their checksums. Reads
/// all data.
void expect_undamaged(
    const StoredResult& stored, const BetweenTiles& between_tiles = [] {});

} // namespace overturn
