#include "sync.hpp"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <unistd.h>

namespace overturn {

bool sync(const std::string& path)
{
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
        return false;
    }
    const int result = fsync(descriptor);
    const int reason = errno;
    close(descriptor);
    errno = reason;
    // Some file systems cannot sync a folder, and say so with EINVAL.
    return result == 0 || (reason == EINVAL && std::filesystem::is_directory(path));
}

} // namespace overturn
