// Prints what a bug report should contain: program, libraries, processor, Python, and the file
// system of results.
#include "commands.hpp"
#include "human_units.hpp"
#include "output_lines.hpp"
#include "overturn/text/quoting.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/text/error.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>
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

/// A word of a command of the shell.
std::string shell_word(const std::string& word)
{
    std::string text = "'";
    for (const char letter : word) {
        text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    }
    return text + "'";
}

struct Interpreter {
    std::string path;     ///< empty if it cannot be started
    std::string contents; ///< its version, and what it can import
};

/// Asks an interpreter, a path or a name, whether it can import the module and other packages.
Interpreter interpreter_of(const std::string& python)
{
    const fs::path program = fs::read_symlink("/proc/self/exe");
    fs::path tools = program.parent_path() / "../share/overturn/tools";
    if (!fs::exists(tools)) {
        tools = program.parent_path() / "../tools"; // of a checkout
    }
    const std::string command = fmt::format(
        "OVERTURN={} {} -B -c 'import sys; sys.path.insert(0, sys.argv[1]); from overturn import "
        "importable; importable.main()' {} 2>/dev/null",
        shell_word(program.string()), shell_word(python),
        shell_word(tools.lexically_normal().string()));
    std::array<std::string, 2> lines;
    if (std::FILE* const output = popen(command.c_str(), "r")) {
        std::size_t line = 0;
        for (int letter = std::fgetc(output); letter != EOF; letter = std::fgetc(output)) {
            if (letter == '\n') {
                ++line;
            } else if (line < lines.size()) {
                lines[line] += char(letter);
            }
        }
        pclose(output);
    }
    return {lines[0], lines[1]};
}

/// The Python that the compiled module was built for, and `python3`, if that is another.
void print_pythons()
{
    std::string built_for;
#ifdef OVERTURN_PYTHON
    built_for = OVERTURN_PYTHON;
    const Interpreter own = interpreter_of(built_for);
    print_row("Python", fmt::format("{}, for which overturn._core was built: {}", built_for,
                                    own.path.empty() ? "cannot be started" : own.contents));
    built_for = own.path;
#else
    print_row("Python", "overturn._core was not built: evaluate and read_record are not available");
#endif
    const Interpreter first = interpreter_of("python3");
    if (first.path.empty()) {
        print_row("python3", "cannot be started");
    } else if (first.path != built_for) {
        print_row("python3", fmt::format("{}: {}", first.path, first.contents));
    }
}

} // namespace

int doctor(const std::string& folder)
{
    std::error_code failure;
    const fs::path path = fs::canonical(folder, failure);
    if (failure || !fs::is_directory(path)) {
        throw Error(exit_code::usage, "{} is not a folder. Give the folder of the result files.",
                    printable(folder));
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
    print_pythons();
    print_row("folder", printable(path.string()));
    print_row("file system", file_system_of(path));
    const fs::space_info space = fs::space(path, failure);
    print_row("free space", failure ? failure.message() : human_bytes(double(space.available)));
    return exit_code::complete;
}

} // namespace overturn
