// Files that exist beside a result while overturn works: a lock, and parts that are renamed when
// they are whole. Other files of such a name are never reused or removed.
#pragma once

#include <cstdint>
#include <string>

namespace overturn {

/// Returns the descriptor of a new one; -1, with errno, if it cannot be created.
int create_working_file(const std::string& path);

/// Whether there is one, of a run that was killed or still works. Throws FileError if another file
/// has the name.
bool is_left_over(const std::string& path);

/// A file under construction: it is written under another name, OUT.part, and takes its own in one
/// step when it is whole and on the disk. If that never comes, it disappears again.
class PartFile {
public:
    /// Throws FileError if the folder of `path` is missing or not writable, if `path` is a link to
    /// nothing, or if the part's name is taken. The part of a run that was killed is replaced. A
    /// link to a file stays: the part becomes that file.
    explicit PartFile(const std::string& path);
    ~PartFile();
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;

    /// Where to write.
    const std::string& path() const { return part_; }

    /// Bytes that the disk still takes from a user without privileges.
    std::uint64_t available_bytes() const;

    /// The writer has closed the file: sync it and rename it. Throws FileError.
    void move_into_place();

private:
    std::string target_;
    std::string folder_;
    std::string part_;
    bool in_place_ = false;
};

} // namespace overturn
