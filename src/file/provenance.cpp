#include "overturn/file/provenance.hpp"

#include "program_identity.hpp"
#include "working_file.hpp"

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

namespace {

constexpr OwnText sidecar{
    .kind = "the sidecar file of this run",
    .is_own = [](std::string_view beginning) { return beginning.starts_with(sidecar_beginning); },
    .option = "-o"};

} // namespace

void expect_place_for_sidecar(const std::string& spectrum_path)
{
    expect_place_for_text(spectrum_path + ".json", sidecar);
}

void write_sidecar(const std::string& spectrum_path, std::string_view text, Syncing syncing)
{
    write_text(
        spectrum_path + ".json", sidecar, text,
        fmt::format(" The computed tiles are in \"{0}\" nevertheless: overturn info {0} says "
                    "whether some are missing.",
                    spectrum_path),
        syncing);
}

} // namespace overturn
