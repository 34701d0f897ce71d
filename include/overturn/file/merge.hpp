// Joins the files of all parts of a job to the file that one run would have written.
#pragma once

#include "overturn/file/stored_result.hpp"

#include <string>
#include <vector>

namespace overturn {

/// Sorts the files by the numbers of their parts. Throws Error unless they are all parts of one
/// job, each of them once, complete, and computed by this version and commit of the program. Values
/// are not read.
void expect_all_parts(std::vector<StoredResult>& parts);

/// Throws Error unless the file is the complete result of the job of the part.
void expect_merged(const StoredResult& merged, const StoredResult& part);

/// Throws Error if the file of all parts cannot be created: the folder is missing or not writable,
/// or has not enough space.
void expect_room_for_merged(const StoredResult& part, const std::string& path);

/// Writes the file of all tiles under a temporary name, and renames it once it is synced to the
/// disk. Its bytes are those of one run. parts: as expect_all_parts() leaves them, undamaged.
/// on_tile: called for each field and tile; an exception from it ends the work. Throws Error, and
/// leaves no file behind.
void merge_parts(const std::vector<StoredResult>& parts, const std::string& path,
                 const BetweenTiles& on_tile);

} // namespace overturn
