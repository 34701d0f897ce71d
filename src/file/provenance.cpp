#include "overturn/file/provenance.hpp"

#include "program_identity.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <mpi.h>

namespace overturn {

std::string compiler_version()
{
#if defined(__clang__)
    return "clang " __clang_version__;
#elif defined(__GNUC__)
    return "GCC " __VERSION__;
#else
    return "unknown";
#endif
}

std::string hdf5_version()
{
    unsigned major = 0;
    unsigned minor = 0;
    unsigned release = 0;
    H5get_libversion(&major, &minor, &release);
    return fmt::format("{}.{}.{}", major, minor, release);
}

std::string mpi_version()
{
    char text[MPI_MAX_LIBRARY_VERSION_STRING] = {};
    int length = 0;
    MPI_Get_library_version(text, &length);
    return text; // not by its length, into which Open MPI counts the terminating zero
}

std::string mpi_library()
{
    const std::string whole = mpi_version();
    return whole.substr(0, whole.find_first_of(",\n"));
}

std::string_view program_version()
{
    return identity::version;
}

std::string_view program_commit()
{
    return identity::commit;
}

} // namespace overturn
