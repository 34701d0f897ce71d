// What a run says while it works. Where nobody reads it any more, the run goes on.
#pragma once

#include <cstdio>
#include <string>

namespace overturn {

/// A line for whoever watches, at once: a log should have it before the progress that follows.
inline void say(const std::string& line)
{
    std::puts(line.c_str());
    std::fflush(stdout);
}

} // namespace overturn
