// Prints what a bug report should contain: program, libraries, processor, and the file system of
// results.
#include "commands.hpp"
#include "exit_code.hpp"
#include "human_units.hpp"
#include "output_lines.hpp"
#include "printable.hpp"

#include "overturn/farm/mpi_session.hpp"
#include "overturn/file/provenance.hpp"
#include "overturn/sweep/kernel.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <thread>

namespace overturn {

namespace {

namespace fs = std::filesystem;

std::string kernels_text()
{
    std::string text;
    for (const Kernel kernel : {Kernel::one_lane, Kernel::avx2, Kernel::avx512}) {
        text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", name_of(kernel),
                            !is_compiled(kernel)      ? "not in this build"
                            : !processor_runs(kernel) ? "not supported by this processor"
                                                      : "yes");
    }
    return text;
}

/// The value of the first line "NAME : VALUE" of a file; "unknown" if there is none.
std::string value_in(const char* path, std::string_view name, char separator = ':')
{
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        const std::size_t end = line.find(separator);
        if (line.starts_with(name) && end != line.npos) {
            const std::size_t begin = line.find_first_not_of(" \t\"", end + 1);
            const std::size_t last = line.find_last_not_of(" \t\"");
            return begin == line.npos ? "" : line.substr(begin, last + 1 - begin);
        }
    }
    return "unknown";
}

std::string launcher_text()
{
    for (const auto& [variable, launcher] :
         {std::pair{"OMPI_COMM_WORLD_SIZE", "mpirun of Open MPI"},
          {"PMI_SIZE", "PMI"},
          {"SLURM_NTASKS", "Slurm"}}) {
        if (const char* ranks = std::getenv(variable)) {
            return fmt::format("{}, {} ranks", launcher, ranks);
        }
    }
    return "none";
}

/// The type of the file system that contains a folder, and where it is mounted.
std::string file_system_of(const fs::path& folder)
{
    std::ifstream mounts("/proc/self/mounts");
    std::string type = "unknown";
    std::string place;
    for (std::string line; std::getline(mounts, line);) {
        std::istringstream words(line);
        std::string device, mounted_on, mounted_type;
        words >> device >> mounted_on >> mounted_type;
        const fs::path inside = folder.lexically_relative(mounted_on);
        if (!inside.empty() && *inside.begin() != ".." && mounted_on.size() >= place.size()) {
            place = mounted_on;
            type = mounted_type;
        }
    }
    return place.empty() ? type : fmt::format("{}, mounted on {}", type, place);
}

} // namespace

int doctor(const std::string& folder)
{
    std::error_code failure;
    const fs::path path = fs::canonical(folder, failure);
    if (failure || !fs::is_directory(path)) {
        throw UsageError(fmt::format("{} is not a folder. Give the folder of the result files.",
                                     printable(folder)));
    }
    print_row("overturn", fmt::format("{} (commit {})", program_version(), program_commit()));
    print_row("compiler", compiler_version());
    print_row("kernels", kernels_text());
    print_row("MPI", mpi_library());
    print_row("launcher", launcher_text());
    print_row("HDF5", hdf5_version());
    print_row("processor", fmt::format("{}; {} threads", value_in("/proc/cpuinfo", "model name"),
                                       std::thread::hardware_concurrency()));
    print_row("memory", value_in("/proc/meminfo", "MemTotal"));
    print_row("system", value_in("/etc/os-release", "PRETTY_NAME", '='));
    print_row("folder", printable(path.string()));
    print_row("file system", file_system_of(path));
    const fs::space_info space = fs::space(path, failure);
    print_row("free space", failure ? failure.message() : human_bytes(double(space.available)));
    return exit_code::complete;
}

} // namespace overturn
