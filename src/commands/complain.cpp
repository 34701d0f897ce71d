#include "complain.hpp"

#include "overturn/text/quoting.hpp"

#include <cstdio>
#include <new>

namespace overturn {

int exit_code_of(const std::exception& error)
{
    const auto* of_user = dynamic_cast<const Error*>(&error);
    return of_user != nullptr ? of_user->code() : exit_code::internal;
}

std::string message_of(const std::exception& error)
{
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
        return "out of memory. Each rank stores the values of the axes, and rank 0 a few bytes for "
               "each tile. Give the axes fewer points, or use a machine with more memory.";
    }
    return printable(error.what());
}

int complain(const std::exception& error)
{
    std::fflush(stdout);
    std::fprintf(stderr, "overturn: %s\n", message_of(error).c_str());
    return exit_code_of(error);
}

Error stopped_by_signal(const std::string& when)
{
    return {exit_code::stopped,
            "stopped by a signal" + when + ". Run the same command again to resume."};
}

} // namespace overturn
