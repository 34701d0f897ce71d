// What goes wrong with the output: disk, permission, a file of another job, damage.
#pragma once

#include <stdexcept>

namespace overturn {

/// Says what was to be done with which file, what stood in the way, and what to do about it.
class FileError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace overturn
