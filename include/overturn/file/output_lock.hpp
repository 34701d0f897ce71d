// The lock of a result file. Without it, two runs could create the same file, or compute every tile
// twice.
#pragma once

#include <string>

namespace overturn {

/// Held by rank 0 during a run. The file OUT.h5.lock is locked, not the result file: over NFS, a
/// lock on the latter would prevent the other ranks from writing. The lock is released when the
/// process ends, even if it is killed.
class OutputLock {
public:
    /// Throws Error if another run holds the lock. Does nothing where files cannot be locked.
    explicit OutputLock(const std::string& path);
    ~OutputLock();
    OutputLock(const OutputLock&) = delete;
    OutputLock& operator=(const OutputLock&) = delete;

    /// The path of the locked file; empty if there is none.
    std::string path() const { return descriptor_ >= 0 ? lock_ : ""; }

private:
    std::string lock_;
    int descriptor_ = -1;
};

} // namespace overturn
