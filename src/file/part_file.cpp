#include "part_file.hpp"

#include "sync.hpp"
#include "system_reason.hpp"
#include "working_file.hpp"

#include "overturn/file/file_error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <sys/statvfs.h>
#include <unistd.h>

namespace overturn {

namespace {

std::string folder_of(const std::string& path)
{
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    return folder.empty() ? std::string(".") : folder.string();
}

/// The file that is to be replaced, if the path is a link to one.
std::string behind_links(const std::string& path)
{
    std::error_code none;
    const auto file = std::filesystem::canonical(path, none);
    return none || !std::filesystem::is_symlink(path) ? path : file.string();
}

} // namespace

PartFile::PartFile(const std::string& path)
    : target_(behind_links(path)), folder_(folder_of(target_)), part_(target_ + ".part")
{
    if (!std::filesystem::is_directory(folder_)) {
        throw FileError(
            fmt::format("cannot create \"{}\": there is no folder \"{}\". Create it, or "
                        "choose another name with -o.",
                        target_, folder_));
    }
    if (access(folder_.c_str(), W_OK | X_OK) != 0) {
        throw FileError(fmt::format("cannot create \"{}\": the folder \"{}\" is not writable: {}. "
                                    "Choose another name with -o.",
                                    target_, folder_, system_reason(errno)));
    }
    std::error_code none;
    if (std::filesystem::is_symlink(target_, none) && !std::filesystem::exists(target_, none)) {
        throw FileError(fmt::format("cannot create \"{}\": it is a link to a file that does not "
                                    "exist. Remove the link, or choose another name with -o.",
                                    target_));
    }
    int created = create_working_file(part_);
    if (created < 0 && errno == EEXIST && is_left_over(part_)) {
        unlink(part_.c_str());
        created = create_working_file(part_);
    }
    if (created < 0) {
        throw FileError(fmt::format("cannot create \"{}\": {}. Choose another name with -o.", part_,
                                    system_reason(errno)));
    }
    close(created);
}

PartFile::~PartFile()
{
    if (!in_place_) {
        unlink(part_.c_str());
    }
}

std::uint64_t PartFile::available_bytes() const
{
    struct statvfs disk = {};
    if (statvfs(folder_.c_str(), &disk) != 0) {
        throw FileError(fmt::format("cannot see how much space is left in \"{}\": {}.", folder_,
                                    system_reason(errno)));
    }
    return std::uint64_t(disk.f_bavail) * disk.f_frsize;
}

void PartFile::move_into_place()
{
    if (!sync(part_) || std::rename(part_.c_str(), target_.c_str()) != 0 || !sync(folder_)) {
        throw FileError(fmt::format("cannot create \"{}\": {}.", target_, system_reason(errno)));
    }
    in_place_ = true;
    unmark_working_file(target_);
}

} // namespace overturn
