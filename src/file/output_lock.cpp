#include "overturn/file/output_lock.hpp"

#include "overturn/text/error.hpp"

#include "working_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace overturn {

namespace {

/// Whether the open file still has this name: the run that held the lock may have removed it.
bool is_in_place(int descriptor, const std::string& path)
{
    struct stat open_file = {};
    struct stat named_file = {};
    return fstat(descriptor, &open_file) == 0 && stat(path.c_str(), &named_file) == 0 &&
           open_file.st_dev == named_file.st_dev && open_file.st_ino == named_file.st_ino;
}

/// The path of the lock file, next to the file itself even if `path` is a link to it.
std::string lock_of(const std::string& path)
{
    std::error_code reported_by_open_lock;
    const auto file = std::filesystem::weakly_canonical(path, reported_by_open_lock);
    return (reported_by_open_lock ? path : file.string()) + ".lock";
}

/// Creates the lock file, or opens that of another run. Returns -1 if the folder is not writable;
/// the first attempt to create a file there reports that.
int open_lock(const std::string& lock)
{
    for (;;) {
        int descriptor = create_working_file(lock);
        if (descriptor >= 0 || errno != EEXIST) {
            return descriptor;
        }
        if (!is_left_over(lock)) {
            continue; // the other run has removed it
        }
        descriptor = open(lock.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
        if (descriptor >= 0) {
            return descriptor;
        }
        if (errno != ENOENT) {
            throw Error(exit_code::output,
                        "cannot open the lock \"{}\": {}. Remove it if no other user's run "
                        "is using it, or choose another name with -o.",
                        lock, system_reason(errno));
        }
    }
}

} // namespace

OutputLock::OutputLock(const std::string& path) : lock_(lock_of(path))
{
    do {
        if (descriptor_ >= 0) {
            ::close(descriptor_);
        }
        descriptor_ = open_lock(lock_);
        if (descriptor_ < 0) {
            return;
        }
        if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            ::close(descriptor_);
            throw Error(exit_code::output,
                        "\"{}\" is being written by another run. Wait until it has "
                        "ended, or choose another name with -o. After a kill, the "
                        "last ranks end within a few seconds; then repeat the "
                        "command.",
                        path);
        }
    } while (!is_in_place(descriptor_, lock_));
}

OutputLock::~OutputLock()
{
    if (descriptor_ >= 0) {
        unlink(lock_.c_str());
        ::close(descriptor_);
    }
}

} // namespace overturn
