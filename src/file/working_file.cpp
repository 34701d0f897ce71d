#include "working_file.hpp"

#include "overturn/text/error.hpp"

#include <cctype>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace overturn {

namespace {

/// The permission bit that marks working files; it has no meaning for files under Linux. On a file
/// system that does not store it, the files left by killed runs look like files of other programs:
/// they are refused, and must be removed by hand.
constexpr mode_t mark = S_ISVTX;

std::string folder_of(const std::string& path)
{
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    return folder.empty() ? std::string(".") : folder.string();
}

/// The file to replace: the target if the path is a link to a file, else the path.
std::string behind_links(const std::string& path)
{
    std::error_code none;
    const auto file = std::filesystem::canonical(path, none);
    return none || !std::filesystem::is_symlink(path) ? path : file.string();
}

} // namespace

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

int create_working_file(const std::string& path)
{
    constexpr mode_t for_all_but_umask = 0666;
    return open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mark | for_all_but_umask);
}

bool is_left_over(const std::string& path)
{
    struct stat file = {};
    if (lstat(path.c_str(), &file) != 0) {
        return false;
    }
    if (!S_ISREG(file.st_mode) || (file.st_mode & mark) == 0) {
        throw Error(exit_code::output,
                    "\"{}\" exists but is not an overturn {} file. Move it away, or "
                    "choose another name with -o.",
                    path, path.ends_with(".lock") ? "lock" : "temporary");
    }
    return true;
}

void expect_space(const std::string& path, long double needed, std::string_view advice)
{
    std::error_code unknown; // then it is the largest number
    const auto available = std::filesystem::space(folder_of(behind_links(path)), unknown).available;
    if (needed > static_cast<long double>(available)) {
        throw Error(exit_code::output,
                    "cannot create \"{}\": it takes {:.0f} bytes, but {} are available. {}", path,
                    needed, available, advice);
    }
}

PartFile::PartFile(const std::string& path)
    : target_(behind_links(path)), folder_(folder_of(target_)), part_(target_ + ".part")
{
    const auto refuse = [](const std::string& path_to_create, const std::string& reason) {
        throw Error(exit_code::output, "cannot create \"{}\": {} another name with -o.",
                    path_to_create, reason);
    };
    if (!std::filesystem::is_directory(folder_)) {
        refuse(target_, fmt::format("there is no folder \"{}\". Create it, or choose", folder_));
    }
    if (access(folder_.c_str(), W_OK | X_OK) != 0) {
        refuse(target_, fmt::format("the folder \"{}\" is not writable: {}. Choose", folder_,
                                    system_reason(errno)));
    }
    std::error_code none;
    if (std::filesystem::is_symlink(target_, none) && !std::filesystem::exists(target_, none)) {
        refuse(target_, "it is a link to a file that does not exist. Remove the link, or choose");
    }
    int created = create_working_file(part_);
    if (created < 0 && errno == EEXIST && is_left_over(part_)) {
        unlink(part_.c_str());
        created = create_working_file(part_);
    }
    if (created < 0) {
        refuse(part_, fmt::format("{}. Choose", system_reason(errno)));
    }
    close(created);
}

PartFile::~PartFile()
{
    if (!in_place_) {
        unlink(part_.c_str());
    }
}

void PartFile::move_into_place(Syncing syncing)
{
    const auto is_synced = [&](const std::string& path) {
        return syncing == Syncing::no || sync(path);
    };
    if (!is_synced(part_) || std::rename(part_.c_str(), target_.c_str()) != 0 ||
        !is_synced(folder_)) {
        throw Error(exit_code::output, "cannot create \"{}\": {}.", target_, system_reason(errno));
    }
    in_place_ = true;
    namespace fs = std::filesystem;
    std::error_code ignored; // some file systems do not allow it
    fs::permissions(target_, fs::perms::sticky_bit, fs::perm_options::remove, ignored);
}

} // namespace overturn
