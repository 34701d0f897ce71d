// Temporary files next to a result while overturn runs: a lock, and OUT.part, which is renamed when
// it is complete. Files of other programs with such a name are never reused or removed.
// Also syncing to the disk, and the messages of the operating system.
#pragma once

#include "overturn/file/text_outputs.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace overturn {

/// While a file is created, it is synced whenever this much has been written: the amount of
/// unsynced data, and thus each wait for the disk, stays small.
inline constexpr std::int64_t most_unsynced_bytes = 1 << 23;

/// Syncs a file or folder to the disk, so that it survives a power failure, including what other
/// processes of this machine have written to it. Returns false, with errno, on failure.
bool sync(const std::string& path);

/// A message as part of a sentence: "No space left" becomes "no space left"; "MPI_ERR" is kept.
std::string in_sentence(std::string message);

/// The message of a system error number, such as "no space left on device".
std::string system_reason(int error_number);

/// Creates a working file and returns its descriptor; -1, with errno, on failure.
int create_working_file(const std::string& path);

/// Whether a working file of a killed or active run exists. Throws Error if a file of another
/// program has the name.
bool is_left_over(const std::string& path);

/// Throws Error with the advice if the folder of a file has less space than it takes [byte].
void expect_space(const std::string& path, long double needed, std::string_view advice);

/// A file under construction. It is written as OUT.part and renamed atomically when it is complete
/// and synced to the disk. If it is not completed, the destructor removes it.
class PartFile {
public:
    /// Throws Error if the folder of `path` is missing or not writable, if `path` is a dangling
    /// link, or if another program's file is called OUT.part. That of a killed run is
    /// replaced. If `path` is a link to a file, the link is kept and its target is replaced.
    explicit PartFile(const std::string& path);
    ~PartFile();
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;

    const std::string& path() const { return part_; }

    /// Syncs the file, which must be closed, and renames it. Throws Error.
    void move_into_place(Syncing syncing = Syncing::yes);

private:
    std::string target_;
    std::string folder_;
    std::string part_;
    bool in_place_ = false;
};

} // namespace overturn
