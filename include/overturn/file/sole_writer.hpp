// One run at a time writes a result file: two would make it at once, or compute everything twice.
#pragma once

#include "overturn/file/file_error.hpp"

#include <string>

namespace overturn {

/// Held by rank 0 while a run lasts. The lock is on OUT.h5.lock, not on the file: over NFS a lock
/// on the file would keep the other ranks from writing. It goes with the process, however that
/// ends.
class SoleWriter {
public:
    /// Throws FileError if another run holds it. Where files cannot be locked there is no lock.
    explicit SoleWriter(const std::string& path);
    ~SoleWriter();
    SoleWriter(const SoleWriter&) = delete;
    SoleWriter& operator=(const SoleWriter&) = delete;

private:
    std::string lock_;
    int descriptor_ = -1;
};

} // namespace overturn
