// What a run says while it works. Where nobody reads it any more, the run goes on.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace overturn {

/// A line for whoever watches, at once: a log should have it before the progress that follows.
inline void say(const std::string& line)
{
    std::puts(line.c_str());
    std::fflush(stdout);
}

/// `when` goes on after "stopped by a signal".
inline void say_stopped(const std::string& when)
{
    const std::string line = fmt::format(
        "overturn: stopped by a signal{}. Run the same command again to resume.\n", when);
    std::fputs(line.c_str(), stderr);
}

} // namespace overturn
