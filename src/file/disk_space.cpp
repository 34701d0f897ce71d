#include "overturn/file/disk_space.hpp"

#include "working_file.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fcntl.h>
#include <fstream>
#include <limits>
#include <sstream>
#include <sys/quota.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/sysmacros.h>
#include <unistd.h>
#include <vector>

namespace overturn {

namespace {

double left_of(const Quota& quota)
{
    return std::max(quota.limit - quota.used, 0.0);
}

/// What is mounted as the file system with this number, of which quotactl() knows local devices;
/// empty if it is not found. The format of a line is described in proc(5).
std::string device_of(dev_t number)
{
    const std::string wanted = std::to_string(major(number)) + ":" + std::to_string(minor(number));
    std::ifstream mounts("/proc/self/mountinfo");
    for (std::string line; std::getline(mounts, line);) {
        std::istringstream words(line);
        std::string mount, parent, device, word, type, source;
        words >> mount >> parent >> device;
        while (words >> word && word != "-") {
        }
        words >> type >> source;
        if (device == wanted) {
            return source;
        }
    }
    return "";
}

std::optional<Quota> quota_on(const std::string& device, int type, unsigned id)
{
    constexpr double block = 1024; // bytes of a unit of the limits
    struct dqblk found = {};
    if (device.empty() || quotactl(QCMD(Q_GETQUOTA, type), device.c_str(), int(id),
                                   reinterpret_cast<char*>(&found)) != 0) {
        return {};
    }
    // A soft limit may be exceeded for some days.
    const auto blocks = found.dqb_bhardlimit > 0 ? found.dqb_bhardlimit : found.dqb_bsoftlimit;
    return Quota{.limit =
                     blocks > 0 ? block * double(blocks) : std::numeric_limits<double>::infinity(),
                 .used = double(found.dqb_curspace)};
}

} // namespace

std::optional<Quota> DiskSpace::quota() const
{
    if (of_user && of_group) {
        return left_of(*of_user) <= left_of(*of_group) ? of_user : of_group;
    }
    return of_user ? of_user : of_group;
}

std::optional<double> DiskSpace::available() const
{
    const auto limiting = quota();
    if (!limiting || !std::isfinite(limiting->limit)) {
        return free;
    }
    return free ? std::min(*free, left_of(*limiting)) : left_of(*limiting);
}

DiskSpace space_in(const std::string& folder)
{
    DiskSpace space;
    struct statvfs system = {};
    // Systems such as /proc have no blocks.
    if (statvfs(folder.c_str(), &system) == 0 && system.f_blocks > 0) {
        space.free = double(system.f_bavail) * double(system.f_frsize);
    }
    struct stat status = {};
    if (stat(folder.c_str(), &status) == 0) {
        const std::string device = device_of(status.st_dev);
        const bool gives_its_group = (status.st_mode & S_ISGID) != 0;
        space.of_user = quota_on(device, USRQUOTA, geteuid());
        space.of_group = quota_on(device, GRPQUOTA, gives_its_group ? status.st_gid : getegid());
    }
    return space;
}

std::optional<double> speed_of_creation_in(const std::string& folder, double bytes)
{
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds longest{500};
    if (!(bytes >= 1)) {
        return {};
    }
    const int descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, S_IRUSR);
    if (descriptor < 0) {
        return {};
    }
    const std::vector<char> block(std::size_t(std::min(bytes, double(most_unsynced_bytes))), 'x');
    std::vector<double> seconds; // of each block
    const auto start = Clock::now();
    auto end = start;
    do {
        const auto begin = end;
        if (write(descriptor, block.data(), block.size()) != ssize_t(block.size()) ||
            fsync(descriptor) != 0) {
            close(descriptor);
            return {};
        }
        end = Clock::now();
        seconds.push_back(std::chrono::duration<double>(end - begin).count());
    } while (double(seconds.size() + 1) * double(block.size()) <= bytes && end - start < longest);
    close(descriptor);
    // The median: a sync may have to wait for what others have written.
    std::ranges::sort(seconds);
    return double(block.size()) / seconds[seconds.size() / 2];
}

} // namespace overturn
