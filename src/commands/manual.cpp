#include "manual.hpp"

#include "overturn/file/provenance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace overturn {

namespace {

/// Of the words in this file. The day of the build would make equal sources give other bytes.
constexpr const char* date_of_words = "2026-11-21";

constexpr const char* description =
    R"(A rigid block standing free on the ground rocks when the ground shakes, and may overturn. An
overturning spectrum shows, for every pulse frequency and amplitude, what becomes of the block.
overturn computes such spectra, alone or under mpirun, into one HDF5 file that h5py and xarray open as
it is. What to compute is said by a job file, in TOML.)";

constexpr const char* files = R"(Beside the folder of the program:

  ../share/overturn/jobs        jobs to begin with
  ../share/overturn/jobs/slurm  batch scripts that go on until a file is complete
  ../share/overturn/tools       the Python tools
  ../share/doc/overturn         documentation: job files, result files, accuracy
  ../include/overturn           the physics for C++ programs: find_package(overturn)

OUT.h5.json beside a result file OUT.h5 tells of hosts, times and libraries.)";

constexpr const char* tools =
    R"(In the examples tools/plot_history stands for overturn-plot-history, and so on. Each has --help.

  overturn-plot-spectrum   draws a spectrum: which region each block ends in
  overturn-plot-boundary   draws where verdicts flip
  overturn-plot-history    draws one block over time
  overturn-plot-accuracy   draws what accuracy costs in time
  overturn-plot-landing    draws where each pulse lands its block in phase space
  overturn-plot-phase      draws the regions in phase space
  overturn-join-spectra    joins spectra that differ in slenderness
  overturn-to-csv          writes a spectrum as a table
  overturn-to-xdmf         writes what ParaView needs to open a result file)";

constexpr const char* environment =
    R"(Open MPI starts ranks as root only if OMPI_ALLOW_RUN_AS_ROOT and OMPI_ALLOW_RUN_AS_ROOT_CONFIRM
are 1. The batch scripts look for the program and for each other in the folder that OVERTURN_CHECKOUT names;
of an installed overturn that is ../share/overturn.)";

/// roff takes some letters for its own, and dresses others up.
std::string escaped(std::string_view text)
{
    std::string result;
    for (const char letter : text) {
        switch (letter) {
        case '\\': result += "\\e"; break;
        case '-': result += "\\-"; break;
        case '\'': result += "\\(aq"; break;
        case '`': result += "\\(ga"; break;
        case '^': result += "\\(ha"; break;
        case '~': result += "\\(ti"; break;
        default: result += letter;
        }
    }
    return result.starts_with('.') ? "\\&" + result : result;
}

/// Prose, which is filled; indented lines stay as they are.
std::string paragraphs(const std::string& text)
{
    std::string result;
    bool is_verbatim = false;
    bool is_new = false;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const bool is_indented = line.starts_with("  ");
        if (line.empty()) {
            is_new = true;
            continue;
        }
        if (is_new || is_indented != is_verbatim) {
            result += is_verbatim ? ".fi\n" : "";
            result += result.empty() ? "" : ".PP\n";
            result += is_indented ? ".nf\n" : "";
        }
        result += escaped(line) + "\n";
        is_verbatim = is_indented;
        is_new = false;
    }
    return result + (is_verbatim ? ".fi\n" : "");
}

std::string section(std::string name, const std::string& text)
{
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char letter) { return char(std::toupper(letter)); });
    return fmt::format(".SH {}\n{}", name, paragraphs(text));
}

std::string bold(const std::string& text)
{
    return fmt::format("\\fB{}\\fR", escaped(text));
}

std::string italic(const std::string& text)
{
    return fmt::format("\\fI{}\\fR", escaped(text));
}

/// "-o, --output OUT.h5"
std::string heading_of(const OptionWords& option)
{
    std::string names;
    for (const std::string& name : option.names) {
        names += (names.empty() ? "" : ", ") + bold(name);
    }
    return names + (names.empty() || option.value.empty() ? "" : " ") +
           (option.value.empty() ? "" : italic(option.value));
}

std::string options_of(const CommandWords& command)
{
    std::string result;
    for (const OptionWords& option : command.options) {
        result += fmt::format(
            ".TP\n{}\n{}{}.\n", heading_of(option), escaped(option.description),
            option.standard.empty() ? "" : fmt::format(" (default: {})", option.standard));
    }
    return result;
}

std::string subcommand(const CommandWords& command)
{
    std::string arguments;
    for (const OptionWords& option : command.options) {
        if (option.names.empty()) {
            arguments += " " + heading_of(option);
        } else if (option.required) {
            arguments += " " + bold(option.names[0]) + " " + italic(option.value);
        }
    }
    return fmt::format(".SS \"overturn {}{}\"\n{}.\n{}.PP\n{}", escaped(command.name), arguments,
                       escaped(command.description), options_of(command),
                       paragraphs(command.footer));
}

/// The paragraphs of the footer begin with what they are about: "Examples: ...".
std::string sections_of_footer(const std::string& footer)
{
    std::string result;
    std::size_t begin = 0;
    while (begin < footer.size()) {
        const std::size_t end = std::min(footer.find("\n\n", begin), footer.size());
        const std::string paragraph = footer.substr(begin, end - begin);
        const std::size_t colon = paragraph.find(':');
        result += section(paragraph.substr(0, colon), paragraph.substr(colon + 2));
        begin = end + 2;
    }
    return result;
}

} // namespace

std::string manual_page(const CommandWords& program)
{
    std::string page = fmt::format(".TH OVERTURN 1 {} \"overturn {}\" \"User Commands\"\n"
                                   ".SH NAME\noverturn \\- overturning spectra of rocking blocks\n"
                                   ".SH SYNOPSIS\n"
                                   "\\fBoverturn\\fR \\fISUBCOMMAND\\fR [\\fIOPTIONS\\fR]\n"
                                   ".br\n\\fBoverturn\\fR \\fISUBCOMMAND\\fR \\fB\\-\\-help\\fR\n",
                                   date_of_words, program_version());
    page += section("Description", description);
    page += ".SH OPTIONS\n" + options_of(program) + ".SH SUBCOMMANDS\n";
    for (const CommandWords& command : program.subcommands) {
        page += subcommand(command);
    }
    return page + sections_of_footer(program.footer) + section("Tools", tools) +
           section("Environment", environment) + section("Files", files) +
           ".SH SEE ALSO\n\\fBmpirun\\fR(1), \\fBh5dump\\fR(1)\n";
}

} // namespace overturn
