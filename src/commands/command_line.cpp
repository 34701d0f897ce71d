#include "command_line.hpp"

#include "commands.hpp"
#include "help_texts.hpp"
#include "installed_texts.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/job/nearest_name.hpp"
#include "overturn/problem/quantity.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/text/error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <concepts>
#include <memory>
#include <sstream>
#include <string_view>
#include <vector>

namespace overturn {

namespace {

std::string kernel_text()
{
    try {
        return fmt::format("{}, the widest that this processor supports", name_of(widest_kernel()));
    } catch (const Error& error) {
        return fmt::format("none: {}", error.what());
    }
}

std::string version_text()
{
    return fmt::format("overturn {} (commit {})\n"
                       "kernel   {}\n"
                       "MPI      {}\n"
                       "HDF5     {}",
                       program_version(), program_commit(), kernel_text(), mpi_library(),
                       hdf5_version());
}

void add_job_arguments(CLI::App& command, JobSource& job)
{
    command.add_option("JOB", job.path, "Job file (TOML)")->required();
    command.add_option("--set", job.overrides, "Override KEY with VALUE (TOML); repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

void add_run_arguments(CLI::App& command, RunOptions& options, const std::string& output)
{
    add_job_arguments(command, options.job);
    command
        .add_option("-o,--output", options.output,
                    fmt::format("Result file; default: {} in the working directory", output))
        ->type_name("OUT.h5");
    command
        .add_option("--kernel", options.kernel, "SIMD kernel; changes the speed, not the result")
        ->check(CLI::IsMember({"auto", "double", "avx2", "avx512"}))
        ->capture_default_str();
    command.add_flag("--durable", options.durable,
                     "Sync each tile to disk, so that it survives a power failure; slower");
    command
        .add_option("--patience", options.patience,
                    "Stop the run if a rank is silent for this long [s]; rerun to resume")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
}

CLI::Option* add_result_file(CLI::App& command, const char* name, std::string& path)
{
    return command.add_option(name, path, "Result file")->required();
}

/// CLI::PositiveNumber would print the largest double as the upper limit.
std::string refusal_of_number(const std::string& text)
{
    double value = 0;
    const bool is_valid =
        CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0;
    return is_valid ? "" : fmt::format("{} is not a positive, finite number.", text);
}

/// The steps of a search to a much larger acceleration would be too long, or too many.
std::string refusal_of_pga(const std::string& text)
{
    constexpr double largest = 1000; // [g]
    double value = 0;
    return CLI::detail::lexical_cast(text, value) && value <= largest
               ? ""
               : fmt::format("{} is above {} g.", text, largest);
}

/// An option for each quantity in metres or radians that describes a block.
void add_block(CLI::App& command, std::map<std::string, double>& block)
{
    for (const Quantity& quantity : all_quantities()) {
        if (quantity.role != Role::block || quantity.units == "1" || quantity.units == "s-1") {
            continue;
        }
        const std::string name(quantity.name);
        std::string option = "--" + name;
        std::ranges::replace(option, '_', '-');
        std::string text(quantity.long_name);
        text[0] = char(std::toupper(text[0]));
        command
            .add_option_function<std::string>(
                option,
                [&block, &quantity, name](const std::string& given) {
                    double value = 0;
                    if (!CLI::detail::lexical_cast(given, value)) {
                        throw CLI::ValidationError(fmt::format("{} is not a number.", given));
                    }
                    if (!quantity.allows(value)) {
                        throw CLI::ValidationError(name + quantity.refusal_of(value));
                    }
                    block[name] = value;
                },
                fmt::format("{} [{}]", text, quantity.units))
            ->type_name(quantity.units == "m" ? "M" : "RAD");
    }
}

void add_topple_arguments(CLI::App& command, ToppleOptions& options)
{
    const auto number = [&](const char* name, auto& value, const char* unit, const char* text) {
        return command.add_option(name, value, text)->type_name(unit)->check(refusal_of_number);
    };
    const auto text = [&](const char* name, auto& value, const char* type, const char* what) {
        return command.add_option(name, value, what)->type_name(type);
    };
    add_block(command, options.block);
    command
        .add_option("--direction", options.direction,
                    "180: the mirror image of the motion, for blocks with two different sides; any "
                    "angle with --set scene.second_component=...")
        ->type_name("DEGREES");
    number("--period", options.period, "S", "Period of the pulse [s]");
    number("--pga", options.pga, "G", "Peak ground acceleration over g; without it, only ranges")
        ->check(refusal_of_pga);
    text("--pulse", options.pulse, "NAME", "Pulse; default: one_sine");
    text("--record", options.record, "FILE", "Recorded motion instead of a pulse");
    text("--component", options.component, "NAME", "Name or number in the record; default: 1");
    number("--scale", options.scale, "X", "Factor on the record, instead of --pga");
    number("--restitution", options.restitution, "R",
           "Energy ratio r at an impact, the square of the ratio of velocities");
    number("--restitution-of-maximum", options.restitution_of_maximum, "X",
           "r over r_max (Eq. 17); default: 1");
    number("--pga-max", options.pga_max, "G", "Largest peak ground acceleration of the search")
        ->check(refusal_of_pga)
        ->capture_default_str();
    text("--set", options.overrides, "scene.KEY=VALUE", "Set a key of [scene]; repeatable")
        ->allow_extra_args(false);
    command.add_flag("--json", options.json, "Print JSON for programs");
    text("-o,--history", options.history, "OUT.h5",
         "Write the motion at --pga or --scale, as overturn history does");
}

void add_accuracy_arguments(CLI::App& command, AccuracyOptions& options)
{
    add_job_arguments(command, options.job);
    add_result_file(command, "-o,--output", options.output)->type_name("OUT.h5");
    command
        .add_option("--points", options.points,
                    "Maximum number of sample points, for times and verdicts")
        ->check(CLI::Range(16, 10000000))
        ->capture_default_str();
    command
        .add_option("--digits", options.digits,
                    "Approximate number of points computed in 50 digits, for errors")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
}

void add_history_arguments(CLI::App& command, HistoryOptions& options)
{
    add_job_arguments(command, options.job);
    command
        .add_option("--at", options.at,
                    "A value for each axis on which the job has several values;\n"
                    "it need not be one of them")
        ->type_name("AXIS=VALUE,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    add_result_file(command, "-o,--output", options.output)->type_name("OUT.h5");
    command
        .add_option("--until", options.until,
                    "Last time [1/p]; default: until the block comes to rest or overturns,\n"
                    "at most 60/p after the pulse")
        ->check(CLI::PositiveNumber);
    command
        .add_option("--samples", options.samples,
                    "Number of evenly spaced times, at least as many as the record has\n"
                    "samples; events are added")
        ->check(CLI::Range(2, 10000000))
        ->capture_default_str();
}

/// All parsed options; must live as long as the parser.
struct Arguments {
    RunOptions run;
    RunOptions boundary;
    JobSource check;
    AccuracyOptions accuracy;
    HistoryOptions history;
    ToppleOptions topple;
    std::string info;
    std::string verify;
    std::string doctor = ".";
};

/// The parser of the command line, and the subcommand that it found.
class Parser {
public:
    Parser();

    CLI::App app{"Overturning spectra of rocking blocks."};
    Command chosen;

private:
    template <class Options>
    CLI::App& add(const char* name, const char* description, const char* footer,
                  int (*execute)(const Options&), const Options& options)
    {
        CLI::App* const command = app.add_subcommand(name, description);
        command->footer(footer);
        command->callback([this, execute, &options] {
            chosen = {
                .execute = [arguments = arguments_, execute, &options] { return execute(options); },
                // Only `run` and `boundary`, which have these options, use MPI.
                .on_every_rank = std::same_as<Options, RunOptions>};
        });
        return *command;
    }

    std::shared_ptr<Arguments> arguments_ = std::make_shared<Arguments>();
};

Parser::Parser()
{
    app.require_subcommand(1);
    app.footer(help::overview);
    app.set_version_flag("--version", version_text);
    Arguments& to = *arguments_;

    add_run_arguments(
        add("run", "Compute or resume a spectrum, with or without mpirun", help::run, run, to.run),
        to.run, "JOB.h5");
    to.boundary.boundary = true;
    add_run_arguments(add("boundary",
                          "Find the amplitudes at which verdicts flip, with or without mpirun",
                          help::boundary, run, to.boundary),
                      to.boundary, "JOB_boundary.h5");
    add_job_arguments(add("check",
                          "Validate a job; print its points, bytes and time; write nothing",
                          help::check, check, to.check),
                      to.check);
    add_accuracy_arguments(add("accuracy",
                               "Measure error and computing time on a sample of a job's plane",
                               help::accuracy, accuracy, to.accuracy),
                           to.accuracy);
    add_history_arguments(
        add("history", "Compute the motion of one block: angle, velocity and events over time",
            help::history, history, to.history),
        to.history);
    add_topple_arguments(add("topple", "Answer whether one block topples, and at which PGA",
                             help::topple, topple, to.topple),
                         to.topple);
    add_result_file(add("info", "Print a summary of a result file", help::info, info, to.info),
                    "FILE", to.info);
    add_result_file(
        add("verify", "Check a result file for damage", help::verify, verify, to.verify), "FILE",
        to.verify);
    add("doctor", "Print what a bug report should contain about this machine", help::doctor, doctor,
        to.doctor)
        .add_option("FOLDER", to.doctor, "Folder of the result files")
        ->capture_default_str();
}

Command to_print(const std::string& text)
{
    return {.execute = [text] {
        fmt::print("{}", text);
        return exit_code::complete;
    }};
}

[[noreturn]] void refuse_subcommand(const CLI::App& app, const char* word)
{
    std::vector<std::string_view> names{"help"};
    for (const CLI::App* command : app.get_subcommands({})) {
        names.push_back(command->get_name());
    }
    const std::string_view meant = nearest_name(word, names);
    throw Error(exit_code::usage, "unknown subcommand \"{}\".{} Run with --help for a list.", word,
                meant.empty() ? "" : fmt::format(" Did you mean \"{}\"?", meant));
}

} // namespace

Command read_command_line(int argc, const char* const* argv)
{
    Parser parser;
    CLI::App& app = parser.app;
    // For the build, which installs the output; hidden from --help.
    const std::string_view only = argc == 2 ? argv[1] : "";
    if (only == "--manual" || only == "--bash-completion") {
        return to_print(only == "--manual" ? manual_page(app) : bash_completion(app));
    }
    std::vector<const char*> given(argv, argv + argc);
    if (argc > 1 && given[1] == std::string_view("help")) { // "help run" is "run --help"
        given.erase(given.begin() + 1);
        given.push_back("--help");
    }
    const auto is_meant = [&](const CLI::App* command) { return command->get_name() == given[1]; };
    if (given.size() > 1 && *given[1] != '-' && app.get_subcommands(is_meant).empty()) {
        refuse_subcommand(app, given[1]);
    }
    try {
        app.parse(int(given.size()), given.data());
    } catch (const CLI::Success& asked) { // for help or the version
        std::ostringstream answer;
        app.exit(asked, answer);
        return to_print(answer.str());
    } catch (const CLI::ParseError& error) {
        throw Error(exit_code::usage, "{}\nRun with --help for more information.", error.what());
    }
    return parser.chosen;
}

} // namespace overturn
