#include "overturn/file/sole_writer.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace overturn {

namespace {

/// Whether the open file is still the one of that name: its last holder may have removed it.
bool is_in_place(int descriptor, const std::string& path)
{
    struct stat open_file = {};
    struct stat named_file = {};
    return fstat(descriptor, &open_file) == 0 && stat(path.c_str(), &named_file) == 0 &&
           open_file.st_dev == named_file.st_dev && open_file.st_ino == named_file.st_ino;
}

/// Beside the file itself, whichever link to it was named.
std::string lock_of(const std::string& path)
{
    std::error_code said_when_it_is_opened;
    const auto file = std::filesystem::weakly_canonical(path, said_when_it_is_opened);
    return (said_when_it_is_opened ? path : file.string()) + ".lock";
}

/// A lock of ours is an empty file. What has been opened instead is closed.
void demand_lock(int descriptor, const std::string& lock)
{
    struct stat file = {};
    const bool opened = descriptor >= 0;
    const bool is_another_thing = !opened && (errno == EISDIR || errno == ELOOP);
    const bool has_content =
        opened && fstat(descriptor, &file) == 0 && (!S_ISREG(file.st_mode) || file.st_size > 0);
    if (is_another_thing || has_content) {
        if (opened) {
            ::close(descriptor);
        }
        throw FileError(fmt::format("\"{}\" stands where the lock of this run would be, and is "
                                    "none. Move it away, or choose another name with -o.",
                                    lock));
    }
}

} // namespace

SoleWriter::SoleWriter(const std::string& path) : lock_(lock_of(path))
{
    constexpr mode_t for_all_to_lock = 0666;
    do {
        if (descriptor_ >= 0) {
            ::close(descriptor_);
        }
        // Children get it as well: one that makes the file, and outlives us, still holds the lock.
        descriptor_ = open(lock_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW, for_all_to_lock);
        demand_lock(descriptor_, lock_);
        if (descriptor_ < 0) {
            return; // a folder that cannot be written: whoever needs to write there says so
        }
        if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            ::close(descriptor_);
            throw FileError(fmt::format("\"{}\" is being written by another run. Wait until it has "
                                        "ended, or choose another name with -o.",
                                        path));
        }
    } while (!is_in_place(descriptor_, lock_));
}

SoleWriter::~SoleWriter()
{
    if (descriptor_ >= 0) {
        unlink(lock_.c_str());
        ::close(descriptor_);
    }
}

} // namespace overturn
