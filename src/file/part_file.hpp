// A file under construction: it is written under another name, OUT.part, and takes its own in one
// step when it is whole and on the disk. If that never comes, it disappears again.
#pragma once

#include <cstdint>
#include <string>

namespace overturn {

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
