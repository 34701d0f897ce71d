#include "command_line.hpp"

#include "commands.hpp"
#include "exit_code.hpp"
#include "help_texts.hpp"
#include "installed_texts.hpp"

#include "overturn/farm/mpi_session.hpp"
#include "overturn/file/provenance.hpp"
#include "overturn/job/nearest_name.hpp"
#include "overturn/sweep/kernel.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <sstream>
#include <string_view>
#include <vector>

namespace overturn {

namespace {

std::string kernel_text()
{
    try {
        return fmt::format("{}, the widest that this processor runs", name_of(widest_kernel()));
    } catch (const ProcessorError& error) {
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
    command.add_option("JOB", job.path, "The job file (TOML)")->required();
    command
        .add_option("--set", job.overrides,
                    "Lay KEY=VALUE, in TOML, over the job file; may be given again")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

void add_run_arguments(CLI::App& command, RunOptions& options, const std::string& output)
{
    add_job_arguments(command, options.job);
    command
        .add_option("-o,--output", options.output,
                    fmt::format("The result file; without it {} in the working directory", output))
        ->type_name("OUT.h5");
    command
        .add_option("--kernel", options.kernel,
                    "Lanes to compute with; changes the speed, but no byte of the result")
        ->check(CLI::IsMember({"auto", "double", "avx2", "avx512"}))
        ->capture_default_str();
    command.add_flag("--durable", options.durable,
                     "Bring each tile to the disk before it counts as done, so that it outlasts a "
                     "loss of power; slower");
    command
        .add_option("--patience", options.patience,
                    "End the run, resumable, if a rank does not respond for so long [s]")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
}

/// Everything that the options are parsed into: it must live as long as the parser.
struct Arguments {
    RunOptions run;
    RunOptions boundary;
    JobSource check;
    AccuracyOptions accuracy;
    HistoryOptions history;
    std::string info;
    std::string verify;
};

[[noreturn]] void refuse_subcommand(const CLI::App& app, const char* word)
{
    std::vector<std::string_view> names{"help"};
    for (const CLI::App* command : app.get_subcommands({})) {
        names.push_back(command->get_name());
    }
    const std::string_view meant = nearest_name(word, names);
    throw UsageError(fmt::format("unknown subcommand \"{}\".{} Run with --help for a list.", word,
                                 meant.empty() ? "" : fmt::format(" Did you mean \"{}\"?", meant)));
}

} // namespace

Command read_command_line(int argc, const char* const* argv)
{
    CLI::App app{"Overturning spectra of rocking blocks."};
    app.require_subcommand(1);
    app.footer(help::overview);
    app.set_version_flag("--version", version_text);
    const auto arguments = std::make_shared<Arguments>();

    CLI::App* const run_command = app.add_subcommand(
        "run", "Compute a spectrum, alone or under mpirun; resume an unfinished one");
    run_command->footer(help::run);
    add_run_arguments(*run_command, arguments->run, "JOB.h5");

    CLI::App* const boundary_command = app.add_subcommand(
        "boundary", "Find all amplitudes at which verdicts flip, alone or under mpirun");
    boundary_command->footer(help::boundary);
    arguments->boundary.boundary = true;
    add_run_arguments(*boundary_command, arguments->boundary, "JOB_boundary.h5");

    CLI::App* const check_command = app.add_subcommand(
        "check", "Validate a job; tell its points, bytes and time; write nothing");
    check_command->footer(help::check);
    add_job_arguments(*check_command, arguments->check);

    CLI::App* const accuracy_command =
        app.add_subcommand("accuracy", "Measure what accuracy costs in time on a job's plane");
    accuracy_command->footer(help::accuracy);
    add_job_arguments(*accuracy_command, arguments->accuracy.job);
    accuracy_command->add_option("-o,--output", arguments->accuracy.output, "The result file")
        ->type_name("OUT.h5")
        ->required();
    accuracy_command
        ->add_option("--points", arguments->accuracy.points,
                     "Points of the sample, at most: times and verdicts")
        ->check(CLI::Range(16, 10000000))
        ->capture_default_str();
    accuracy_command
        ->add_option("--digits", arguments->accuracy.digits,
                     "Points of the sample in 50 digits: errors")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();

    CLI::App* const history_command = app.add_subcommand(
        "history", "Follow one block, forced and free: angle, velocity, impacts over time");
    history_command->footer(help::history);
    add_job_arguments(*history_command, arguments->history.job);
    history_command
        ->add_option("--at", arguments->history.at,
                     "The point, where the job's axes have several values; any value will do")
        ->type_name("AXIS=VALUE,...")
        ->delimiter(',')
        ->allow_extra_args(false);
    history_command->add_option("-o,--output", arguments->history.output, "The result file")
        ->type_name("OUT.h5")
        ->required();
    history_command
        ->add_option("--until", arguments->history.until,
                     "Last time to show [1/p]; without it until the block rests or lies, or 60/p "
                     "after the pulse")
        ->check(CLI::PositiveNumber);
    history_command
        ->add_option("--samples", arguments->history.samples, "Evenly spread times, beside events")
        ->check(CLI::Range(2, 10000000))
        ->capture_default_str();

    CLI::App* const info_command = app.add_subcommand("info", "Tell what a result file holds");
    info_command->footer(help::info);
    info_command->add_option("FILE", arguments->info, "The result file")->required();

    CLI::App* const verify_command =
        app.add_subcommand("verify", "Tell whether a result file is as it was written");
    verify_command->footer(help::verify);
    verify_command->add_option("FILE", arguments->verify, "The result file")->required();

    // For the build, which installs what they print; --help does not tell of them.
    const std::string_view only = argc == 2 ? argv[1] : "";
    if (only == "--manual" || only == "--bash-completion") {
        return {.execute = [text = only == "--manual" ? manual_page(app) : bash_completion(app)] {
            fmt::print("{}", text);
            return exit_code::complete;
        }};
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
        return {.execute = [text = answer.str()] {
            fmt::print("{}", text);
            return exit_code::complete;
        }};
    } catch (const CLI::ParseError& error) {
        throw UsageError(fmt::format("{}\nRun with --help for more information.", error.what()));
    }
    if (run_command->parsed()) {
        return {.execute = [arguments] { return run(arguments->run); }, .on_every_rank = true};
    }
    if (boundary_command->parsed()) {
        return {.execute = [arguments] { return run(arguments->boundary); }, .on_every_rank = true};
    }
    if (check_command->parsed()) {
        return {.execute = [arguments] { return check(arguments->check); }};
    }
    if (accuracy_command->parsed()) {
        return {.execute = [arguments] { return accuracy(arguments->accuracy); }};
    }
    if (history_command->parsed()) {
        return {.execute = [arguments] { return history(arguments->history); }};
    }
    if (verify_command->parsed()) {
        return {.execute = [arguments] { return verify(arguments->verify); }};
    }
    return {.execute = [arguments] { return info(arguments->info); }};
}

} // namespace overturn
