#include "overturn/file/provenance.hpp"

#include "overturn/text/error.hpp"
#include "overturn/text/quoting.hpp"

#include "program_identity.hpp"
#include "working_file.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <mpi.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

namespace overturn {

namespace {

std::string mpi_version()
{
    char text[MPI_MAX_LIBRARY_VERSION_STRING] = {};
    int length = 0;
    MPI_Get_library_version(text, &length);
    return text; // not by its length, into which Open MPI counts the terminating zero
}

/// Distinguishes a sidecar from other files called OUT.h5.json.
constexpr std::string_view sidecar_beginning = "{\n  \"program_version\": ";

std::string as_json(const RunInfo& run)
{
    std::vector<std::string> ranks;
    for (const RankInfo& rank : run.ranks) {
        ranks.push_back(fmt::format(
            R"(    {{"host": {}, "tiles": {}, "compute_seconds": {}, "write_seconds": {}}})",
            in_quotes(rank.host), rank.tiles, rank.compute_seconds, rank.write_seconds));
    }
    const auto start = std::chrono::time_point_cast<std::chrono::seconds>(run.start);
    return fmt::format(R"({}{},
  "program_commit": {},
  "start": "{:%Y-%m-%dT%H:%M:%SZ}",
  "wall_seconds": {},
  "kernel": {},
  "compiler": {},
  "hdf5": {},
  "mpi": {},
  "requests": {},
  "dealing_seconds": {},
  "ranks": [
{}
  ]
}}
)",
                       sidecar_beginning, in_quotes(program_version()), in_quotes(program_commit()),
                       fmt::gmtime(start), run.wall_seconds, in_quotes(run.kernel),
                       in_quotes(compiler_version()), in_quotes(hdf5_version()),
                       in_quotes(mpi_version()), run.requests, run.dealing_seconds,
                       fmt::join(ranks, ",\n"));
}

} // namespace

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

void demand_place_for_sidecar(const std::string& spectrum_path)
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

void write_sidecar(const std::string& spectrum_path, const RunInfo& run)
{
    demand_place_for_sidecar(spectrum_path); // a file may have appeared during the run
    PartFile part(spectrum_path + ".json");
    errno = 0;
    std::ofstream stream(part.path(), std::ios::binary);
    stream << as_json(run);
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
