#include "command_line.hpp"

#include "commands.hpp"
#include "completion.hpp"
#include "exit_code.hpp"
#include "manual.hpp"

#include "overturn/farm/mpi_session.hpp"
#include "overturn/file/provenance.hpp"
#include "overturn/sweep/kernel.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <sstream>
#include <string_view>

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

constexpr const char* overview = R"(Examples:
  overturn check jobs/smoke.toml
  overturn run jobs/smoke.toml
  mpirun -n 8 overturn run jobs/smoke.toml -o smoke.h5
  overturn info smoke.h5
  overturn verify smoke.h5
  overturn history jobs/smoke.toml --at frequency=3,amplitude=1.5 -o history.h5
  overturn boundary jobs/smoke.toml

Exit codes: 0 complete, 2 usage, 65 the job's content is wrong, 70 a fault of overturn,
74 anything about the output, 85 stopped and resumable.)";

constexpr const char* run_help = R"(Example:
  mpirun -n 8 overturn run jobs/smoke.toml -o smoke.h5 --set numerics.tolerance=1e-10

The same command resumes an unfinished run, with any number of ranks. SIGUSR1, SIGTERM, SIGINT and
SIGHUP stop it after the tiles in hand, with exit code 85.)";

constexpr const char* boundary_help = R"(Example:
  mpirun -n 8 overturn boundary jobs/figure_07a.toml --set plane.amplitude.count=200
  tools/plot_boundary figure_07a_boundary.h5

For every slenderness, restitution and frequency, all amplitudes between the job's first and last at which
safe turns to unsafe or back, in order, with the regions on both sides. The job's amplitudes are looked
at first; where they tell of more between them, more closely. Each flip is between two settled verdicts
1e-12 apart, whatever [numerics] says. Resumes an unfinished run, as overturn run does.)";

constexpr const char* check_help = R"(Example:
  overturn check jobs/smoke.toml --set 'plane.slenderness={ values = [0.2, 0.3] }')";

constexpr const char* accuracy_help = R"(Example:
  overturn accuracy jobs/figure_07a.toml -o accuracy.h5
  tools/plot_accuracy accuracy.h5

Runs both methods at tolerances from 1e-2 to 1e-14, and resolved, on a sample of the job's plane, on one
core; the job's own [numerics] and fields do not matter. Its columns, which OUT.h5 has in more detail:
  evaluations      of the acceleration (rk45), or of its series (taylor), per point
  error            of the margin, against 50 digits; inf where a block fell that should not have, or
                   the other way round
  wrong verdicts   share of the points whose true verdict is known
  undecided        points without a verdict
  error > bound    share of the points whose error exceeds what the field "error" says
  bound / error    its median)";

constexpr const char* history_help = R"(Example:
  overturn history jobs/figure_07a.toml --at frequency=3,amplitude=1.5 -o history.h5
  tools/plot_history history.h5

Prints the region, and the events with the velocity before and after each and q after it (Eq. 12);
angles in rad, time tau = p t. OUT.h5 has angle, velocity, acceleration, q and the ground's acceleration
over time. The pulse is integrated as finely as doubles allow, whatever [numerics] says.)";

constexpr const char* info_help = R"(Example:
  overturn info smoke.h5)";

constexpr const char* verify_help = R"(Example:
  overturn verify smoke.h5

Holds the coordinates against the job in the file, and each tile against the checksum that marks it as
done. Exit code 0: all that is done is as it was written; 74: something is not. A run with the same job
computes damaged tiles again.)";

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
                    "End the run, resumable, if nothing is heard of a rank for so long [s]")
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

} // namespace

Command read_command_line(int argc, const char* const* argv)
{
    CLI::App app{"Overturning spectra of rocking blocks."};
    app.require_subcommand(1);
    app.footer(overview);
    app.set_version_flag("--version", version_text);
    const auto arguments = std::make_shared<Arguments>();

    CLI::App* const run_command = app.add_subcommand(
        "run", "Compute a spectrum, alone or under mpirun; resume an unfinished one");
    run_command->footer(run_help);
    add_run_arguments(*run_command, arguments->run, "JOB.h5");

    CLI::App* const boundary_command = app.add_subcommand(
        "boundary", "Find all amplitudes at which verdicts flip, alone or under mpirun");
    boundary_command->footer(boundary_help);
    arguments->boundary.boundary = true;
    add_run_arguments(*boundary_command, arguments->boundary, "JOB_boundary.h5");

    CLI::App* const check_command = app.add_subcommand(
        "check", "Validate a job; tell its points, bytes and time; write nothing");
    check_command->footer(check_help);
    add_job_arguments(*check_command, arguments->check);

    CLI::App* const accuracy_command =
        app.add_subcommand("accuracy", "Measure what accuracy costs in time on a job's plane");
    accuracy_command->footer(accuracy_help);
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
    history_command->footer(history_help);
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
    info_command->footer(info_help);
    info_command->add_option("FILE", arguments->info, "The result file")->required();

    CLI::App* const verify_command =
        app.add_subcommand("verify", "Tell whether a result file is as it was written");
    verify_command->footer(verify_help);
    verify_command->add_option("FILE", arguments->verify, "The result file")->required();

    // For the build, which installs what they print; --help does not tell of them.
    const std::string_view only = argc == 2 ? argv[1] : "";
    if (only == "--manual" || only == "--bash-completion") {
        return {.execute = [text = only == "--manual" ? manual_page(app) : bash_completion(app)] {
            fmt::print("{}", text);
            return exit_code::complete;
        }};
    }
    const auto is_meant = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
    if (argc > 1 && *argv[1] != '-' && app.get_subcommands(is_meant).empty()) {
        throw UsageError(
            fmt::format("unknown subcommand \"{}\". Run with --help for a list.", argv[1]));
    }
    try {
        app.parse(argc, argv);
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
