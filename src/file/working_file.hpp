// Files that exist beside a result while overturn works: a lock, and parts that take their own name
// when they are whole. Of what else has such a name nothing is ever reused or removed.
#pragma once

#include <string>

namespace overturn {

/// A descriptor of a new one; -1, with errno, if it cannot be made.
int create_working_file(const std::string& path);

/// Makes it a file like others, where the file system allows it.
void unmark_working_file(const std::string& path);

/// Whether one is there, of a run that was killed or still works. Throws FileError if the name is
/// taken by something else.
bool is_left_over(const std::string& path);

} // namespace overturn
