#include "operating_system.hpp"

#include <cctype>
#include <cerrno>
#include <cstring>
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
    // Some file systems cannot sync a folder, and return EINVAL.
    return result == 0 || (reason == EINVAL && std::filesystem::is_directory(path));
}

std::string in_sentence(std::string message)
{
    if (message.size() > 1 && std::islower(static_cast<unsigned char>(message[1]))) {
        message[0] = char(std::tolower(static_cast<unsigned char>(message[0])));
    }
    return message;
}

std::string system_reason(int error_number)
{
    return in_sentence(std::strerror(error_number));
}

} // namespace overturn
