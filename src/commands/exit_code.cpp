#include "exit_code.hpp"

#include "printable.hpp"

#include "overturn/farm/mpi_session.hpp"
#include "overturn/file/file_error.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/kernel.hpp"

#include <cstdio>
#include <new>

namespace overturn {

namespace {

template <class Kind>
bool is(const std::exception& error)
{
    return dynamic_cast<const Kind*>(&error) != nullptr;
}

} // namespace

int exit_code_of(const std::exception& error)
{
    if (is<UsageError>(error) || is<LaunchError>(error) || is<ProcessorError>(error)) {
        return exit_code::usage;
    }
    if (is<JobError>(error)) {
        return exit_code::job;
    }
    if (is<FileError>(error)) {
        return exit_code::output;
    }
    return is<Stopped>(error) ? exit_code::stopped : exit_code::internal;
}

std::string message_of(const std::exception& error)
{
    if (is<std::bad_alloc>(error)) {
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

} // namespace overturn
