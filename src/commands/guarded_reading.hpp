// Reading of a file that may be damaged. HDF5 1.10 crashes on some of them, and may not end on
// others.
#pragma once

#include <cstdint>
#include <string>

namespace overturn {

/// While it exists, the process ends with a message and exit_code::output if it crashes, or if it
/// uses more processor time than one minute and another per GB of the file. The data of the process
/// can grow by 512 MiB plus twice the size of the file; then allocations fail. One object at a
/// time.
class GuardedReading {
public:
    /// lock: a file that the handler removes as well, because no destructor runs; empty: none.
    /// more_bytes: of other files that are read, too.
    explicit GuardedReading(const std::string& path, const std::string& lock = "",
                            std::uint64_t more_bytes = 0);
    ~GuardedReading();
    GuardedReading(const GuardedReading&) = delete;
    GuardedReading& operator=(const GuardedReading&) = delete;
};

} // namespace overturn
