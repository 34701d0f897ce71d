#include "exit_code.hpp"

#include "printable.hpp"

#include "overturn/farm/mpi_session.hpp"
#include "overturn/file/file_error.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/kernel.hpp"

#include <cstdio>

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
    return exit_code::internal;
}

int complain(const std::exception& error)
{
    std::fflush(stdout);
    std::fprintf(stderr, "overturn: %s\n", printable(error.what()).c_str());
    return exit_code_of(error);
}

} // namespace overturn
