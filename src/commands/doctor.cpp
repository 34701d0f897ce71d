#include "commands.hpp"
#include "report/print.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/text/quoting.hpp"

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
    for (int i = 0; i < int(names_of<Kernel>.size()); ++i) {
        const auto kernel = Kernel(i);
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

/// What a command of the shell prints; nothing if it cannot be started.
std::istringstream output_of(const char* command)
{
    std::string output;
    if (std::FILE* const pipe = popen(command, "r")) {
        for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe)) {
            output += char(letter);
        }
        pclose(pipe);
    }
    return std::istringstream(output);
}

/// The type of the file system that contains a folder, and where it is mounted.
std::string file_system_of(const fs::path& folder)
{
    setenv("OVERTURN_FOLDER", folder.c_str(), 1); // a variable needs no quoting
    auto words = output_of("df --output=fstype,target -- \"$OVERTURN_FOLDER\" | tail -n 1");
    std::string type = "unknown";
    std::string place;
    words >> type >> std::ws;
    std::getline(words, place);
    return place.empty() ? type : fmt::format("{}, mounted on {}", type, place);
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
    setenv("OVERTURN", program.c_str(), 1);
    setenv("OVERTURN_INTERPRETER", python.c_str(), 1);
    setenv("OVERTURN_TOOLS", tools.lexically_normal().c_str(), 1);
    auto lines = output_of("\"$OVERTURN_INTERPRETER\" -B -c 'import os, sys; sys.path.insert(0, "
                           "os.environ[\"OVERTURN_TOOLS\"]); from overturn import importable; "
                           "importable.main()' 2>/dev/null");
    Interpreter found;
    std::getline(lines, found.path);
    std::getline(lines, found.contents);
    return found;
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
