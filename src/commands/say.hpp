// Messages of a run while it works. If their reader is gone, the run continues.
#pragma once

#include <cstdio>
#include <string>

namespace overturn {

/// Prints a line and flushes it, so that a log has it before the progress that follows.
inline void say(const std::string& line)
{
    std::puts(line.c_str());
    std::fflush(stdout);
}

} // namespace overturn
