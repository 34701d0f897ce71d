#include "overturn/file/provenance.hpp"

#include "overturn/text/error.hpp"

#include "program_identity.hpp"
#include "working_file.hpp"

#include <hdf5.h>
#include <mpi.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

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

void expect_place_for_sidecar(const std::string& spectrum_path)
{
    const std::string path = spectrum_path + ".json";
    const PartFile place(path);
    std::error_code none;
    if (!std::filesystem::exists(path, none)) {
        return;
    }
    std::string beginning(sidecar_beginning.size(), '\0');
    if (std::filesystem::is_regular_file(path)) { // opening a pipe would wait for its other end
        std::ifstream(path, std::ios::binary).read(beginning.data(), int(beginning.size()));
    }
    if (beginning != sidecar_beginning) {
        throw Error(exit_code::output,
                    "\"{}\" exists but is not the sidecar file of an overturn run. Move it "
                    "away, or choose another name with -o.",
                    path);
    }
}

void write_sidecar(const std::string& spectrum_path, std::string_view text)
{
    expect_place_for_sidecar(spectrum_path); // a file may have appeared during the run
    PartFile part(spectrum_path + ".json");
    errno = 0;
    std::ofstream stream(part.path(), std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) {
        throw Error(exit_code::output,
                    "cannot write \"{0}.json\", the sidecar file of this run: {1}. The "
                    "computed tiles are in \"{0}\" nevertheless.",
                    spectrum_path, system_reason(errno));
    }
    part.move_into_place();
}

} // namespace overturn
