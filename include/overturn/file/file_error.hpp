// Errors of result files: disk, permission, a file of another job, a damaged file.
#pragma once

#include <stdexcept>

namespace overturn {

/// The message names the file, the failed operation, the reason, and what to do.
class FileError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace overturn
