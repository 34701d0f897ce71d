#include "overturn/file/sole_writer.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
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

} // namespace

SoleWriter::SoleWriter(const std::string& path) : lock_(path + ".lock")
{
    constexpr mode_t for_all_to_lock = 0666;
    do {
        if (descriptor_ >= 0) {
            ::close(descriptor_);
        }
        // Children get it as well: one that makes the file, and outlives us, still holds the lock.
        descriptor_ = open(lock_.c_str(), O_RDWR | O_CREAT, for_all_to_lock);
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
