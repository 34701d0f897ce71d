#include "working_file.hpp"

#include "overturn/file/file_error.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>

namespace overturn {

namespace {

/// Has no meaning for files under Linux, and is set when they are created. On a file system that
/// does not keep it, the files of killed runs look foreign: they are refused, and have to be
/// removed by hand.
constexpr mode_t mark = S_ISVTX;

} // namespace

int create_working_file(const std::string& path)
{
    constexpr mode_t for_all_but_umask = 0666;
    return open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mark | for_all_but_umask);
}

void unmark_working_file(const std::string& path)
{
    namespace fs = std::filesystem;
    std::error_code left_as_it_is;
    fs::permissions(path, fs::perms::sticky_bit, fs::perm_options::remove, left_as_it_is);
}

bool is_left_over(const std::string& path)
{
    struct stat file = {};
    if (lstat(path.c_str(), &file) != 0) {
        return false;
    }
    if (!S_ISREG(file.st_mode) || (file.st_mode & mark) == 0) {
        throw FileError(fmt::format("\"{}\" exists, was not made by overturn, and has the name of "
                                    "a file that overturn needs for a while. Move it away, or "
                                    "choose another name with -o.",
                                    path));
    }
    return true;
}

} // namespace overturn
