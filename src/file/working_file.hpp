// Files that exist beside a result while overturn works: a lock, and parts that are renamed when
// they are whole. Other files of such a name are never reused or removed.
#pragma once

#include <string>

namespace overturn {

/// Returns the descriptor of a new one; -1, with errno, if it cannot be created.
int create_working_file(const std::string& path);

/// Removes the mark of a working file, where the file system allows it.
void unmark_working_file(const std::string& path);

/// Whether there is one, of a run that was killed or still works. Throws FileError if another file
/// has the name.
bool is_left_over(const std::string& path);

} // namespace overturn
