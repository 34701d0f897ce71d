#include "command_line.hpp"

#include "commands.hpp"
#include "help_texts.hpp"
#include "installed_texts.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/problem/quantity.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/text/error.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/nearest_name.hpp"
#include "overturn/text/parse_number.hpp"

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <concepts>
#include <limits>
#include <memory>
#include <span>
#include <sstream>
#include <string_view>
#include <vector>

namespace overturn {

namespace {

std::string version_text()
{
    std::string kernel;
    try {
        kernel =
            fmt::format("{}, the widest that this processor supports", name_of(widest_kernel()));
    } catch (const Error& error) {
        kernel = fmt::format("none: {}", error.what());
    }
    return fmt::format("overturn {} (commit {})\n"
                       "kernel   {}\n"
                       "MPI      {}\n"
                       "HDF5     {}",
                       program_version(), program_commit(), kernel, mpi_library(), hdf5_version());
}

void add_count(CLI::App& command, const char* name, int& count, const CLI::Range& allowed,
               const char* text)
{
    command.add_option(name, count, text)->check(allowed)->capture_default_str();
}

CLI::Option* add_text(CLI::App& command, const char* name, auto& value, const char* type,
                      const std::string& text)
{
    return command.add_option(name, value, text)->type_name(type);
}

/// CLI::Range would print the largest double as the upper limit.
std::function<std::string(const std::string&)> positive_up_to(double largest)
{
    return [largest](const std::string& text) -> std::string {
        double value = 0;
        if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value) || value <= 0) {
            return fmt::format("{} is not a positive, finite number.", text);
        }
        return value <= largest ? "" : fmt::format("{} is above {} g.", text, largest);
    };
}

/// CLI::IsMember makes no suggestion.
CLI::Validator one_of(const std::vector<std::string_view>& names)
{
    const auto refusal_of = [names](const std::string& given) -> std::string {
        return std::ranges::count(names, given) > 0
                   ? ""
                   : fmt::format("{} is unknown.{} Allowed: {}.", given, suggestion(given, names),
                                 fmt::join(names, ", "));
    };
    return CLI::Validator(refusal_of, fmt::format("{{{}}}", fmt::join(names, ",")), "");
}

void add_job_arguments(CLI::App& command, JobSource& job)
{
    command.add_option("JOB", job.path, "Job file (TOML)")->required();
    add_text(command, "--set", job.overrides, "KEY=VALUE",
             "Override KEY with VALUE (TOML); repeatable")
        ->allow_extra_args(false);
}

/// text: I/N.
JobPart part_named(const std::string& text)
{
    constexpr std::int64_t most = 100000;
    JobPart part;
    const std::size_t slash = text.find('/');
    if (slash == text.npos || !CLI::detail::lexical_cast(text.substr(0, slash), part.number) ||
        !CLI::detail::lexical_cast(text.substr(slash + 1), part.count) || part.number < 1 ||
        part.number > part.count || part.count > most) {
        throw CLI::ValidationError(fmt::format(
            "--part: {} is no part. Give I/N with I from 1 to N, such as 3/16; N is at most {}.",
            text, most));
    }
    return part;
}

void add_output(CLI::App& command, RunOptions& options)
{
    add_text(command, "-o,--output", options.output, "OUT.h5",
             fmt::format("Result file; default: JOB{}.h5 in the working directory",
                         options.boundary ? "_boundary" : ""));
}

void add_run_arguments(CLI::App& command, RunOptions& options)
{
    add_job_arguments(command, options.job);
    add_output(command, options);
    command
        .add_option_function<std::string>(
            "--part", [&options](const std::string& text) { options.part = part_named(text); },
            fmt::format("Compute part I of N only, in a file of its own for overturn merge;\n"
                        "default: JOB{}.part-I-of-N.h5",
                        options.boundary ? "_boundary" : ""))
        ->type_name("I/N");
    std::vector<std::string_view> kernels{"auto"};
    kernels.insert(kernels.end(), names_of<Kernel>.begin(), names_of<Kernel>.end());
    command
        .add_option("--kernel", options.kernel, "SIMD kernel; changes the speed, not the result")
        ->check(one_of(kernels))
        ->capture_default_str();
    command.add_flag("--durable", options.durable,
                     "Sync each tile to disk, so that it survives a power failure; slower");
    add_count(command, "--patience", options.patience, CLI::Range(1, 1000000),
              "Stop the run if a rank is silent for this long [s]; rerun to resume");
}

void add_boundary_arguments(CLI::App& command, RunOptions& options)
{
    options.boundary = true;
    add_run_arguments(command, options);
}

void add_merge_arguments(CLI::App& command, MergeOptions& options)
{
    command.add_option("PART", options.parts, "Result files of all parts of a job")->required();
    add_text(command, "-o,--output", options.output, "OUT.h5", "Result file")->required();
}

constexpr const char* for_programs = "Print JSON for programs";

void add_check_arguments(CLI::App& command, CheckOptions& options)
{
    add_job_arguments(command, options.run.job);
    add_output(command, options.run);
    command.add_flag("--boundary", options.run.boundary,
                     "Estimate overturn boundary, not overturn run");
    add_count(command, "--ranks", options.ranks, CLI::Range(1, 1000000),
              "Number of ranks, each on a core of its own");
    command.add_flag("--json", options.json, for_programs);
}

void add_accuracy_arguments(CLI::App& command, AccuracyOptions& options)
{
    add_job_arguments(command, options.job);
    add_text(command, "-o,--output", options.output, "OUT.h5", "Result file")->required();
    add_count(command, "--points", options.points, CLI::Range(16, 10000000),
              "Maximum number of sample points, for times and verdicts");
    add_count(command, "--digits", options.digits, CLI::Range(1, 1000000),
              "Approximate number of points computed in 50 digits, for errors");
}

void add_history_arguments(CLI::App& command, HistoryOptions& options)
{
    add_job_arguments(command, options.job);
    add_text(command, "--at", options.at, "AXIS=VALUE,...",
             "A value for each axis on which the job has several values;\n"
             "it need not be one of them")
        ->delimiter(',')
        ->allow_extra_args(false);
    add_text(command, "-o,--output", options.output, "OUT.h5", "Result file")->required();
    command
        .add_option("--until", options.until,
                    "Last time [1/p]; default: until the block comes to rest or overturns,\n"
                    "at most 60/p after the pulse")
        ->check(positive_up_to(std::numeric_limits<double>::infinity()));
    add_count(command, "--samples", options.samples, CLI::Range(2, 10000000),
              "Number of evenly spaced times, at least as many as the record has\n"
              "samples; events are added");
}

/// The value of a quantity. option: as the user spells it.
double allowed_value(const Quantity& quantity, const std::string& option, const std::string& given)
{
    double value = 0;
    if (!CLI::detail::lexical_cast(given, value)) {
        throw CLI::ValidationError(fmt::format("{}: {} is not a number.", option, given));
    }
    if (!quantity.allows(value)) {
        throw CLI::ValidationError(std::string(quantity.name) + quantity.refusal_of(value));
    }
    return value;
}

/// Whether the quantity describes a block in metres or radians, or its contact.
bool has_option_of_block(const Quantity& quantity)
{
    const bool is_ratio = quantity.units == "1" && quantity.scope.shapes != 0;
    return quantity.role == Role::block && !is_ratio && quantity.units != "s-1";
}

/// An option for each quantity of a block.
void add_block(CLI::App& command, std::map<std::string, double>& block)
{
    for (const Quantity& quantity : all_quantities()) {
        if (!has_option_of_block(quantity)) {
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
                [&block, &quantity, name, option](const std::string& given) {
                    block[name] = allowed_value(quantity, option, given);
                },
                fmt::format("{} [{}]", text, quantity.units))
            ->type_name(quantity.units == "m"   ? "M"
                        : quantity.units == "1" ? "NUMBER"
                                                : "RAD");
    }
}

/// Of a quantity of the block, or of its loss at impacts; words: its name, and two values.
VariedQuantity varied_quantity(std::vector<std::string> words)
{
    std::ranges::replace(words[0], '-', '_');
    std::vector<std::string_view> names;
    for (const Quantity& quantity : all_quantities()) {
        if (has_option_of_block(quantity) || quantity.role == Role::loss) {
            names.push_back(quantity.name);
        }
    }
    const auto name = std::ranges::find(names, words[0]);
    if (name == names.end()) {
        throw CLI::ValidationError(
            fmt::format("--vary: there is no quantity \"{}\".{} Allowed: {}.", words[0],
                        suggestion(words[0], names), fmt::join(names, ", ")));
    }
    const Quantity& varied = quantity(*name);
    const double first = allowed_value(varied, "--vary", words[1]);
    const double last = allowed_value(varied, "--vary", words[2]);
    if (!(first < last)) {
        throw CLI::ValidationError(fmt::format(
            "--vary: the first {}, {}, is not below the last one, {}. Give an ascending "
            "range.",
            varied.name, first, last));
    }
    return {&varied, first, last};
}

void add_topple_arguments(CLI::App& command, ToppleOptions& options)
{
    const auto number = [&](const char* name, auto& value, const char* unit, const char* text,
                            double largest = std::numeric_limits<double>::infinity()) {
        return add_text(command, name, value, unit, text)->check(positive_up_to(largest));
    };
    add_block(command, options.block);
    add_text(command, "--direction", options.direction, "DEGREES",
             "0, or 180: the mirror image; default: 0, and 180 too if the sides of the block "
             "differ; any angle with --set scene.second_component=...");
    number("--period", options.period, "S", "Period of the pulse [s], unless --record is given");
    number("--pga", options.pga, "G", "Peak ground acceleration over g; without it, only ranges",
           largest_pga);
    add_text(command, "--pulse", options.pulse, "NAME", "Pulse; default: one_sine");
    add_text(command, "--shape", options.shape, "FILE",
             "Table of the pulse `table`: time over the period, value");
    add_text(command, "--record", options.record, "FILE", "Recorded motion instead of a pulse")
        ->excludes("--period", "--pulse", "--shape");
    add_text(command, "--component", options.component, "NAME",
             "Name or number in the record; default: 1")
        ->needs("--record");
    number("--scale", options.scale, "X", "Factor on the record, instead of --pga")
        ->needs("--record")
        ->excludes("--pga");
    number("--restitution", options.restitution, "R",
           "Energy ratio r at an impact, the square of the ratio of velocities");
    number("--velocity-restitution", options.velocity_restitution, "E",
           "Ratio e of the velocities at an impact, instead of r = e^2")
        ->excludes("--restitution");
    number("--restitution-of-maximum", options.restitution_of_maximum, "X",
           "r over r_max (Eq. 17); default: 1")
        ->excludes("--restitution", "--velocity-restitution");
    number("--pga-max", options.pga_max, "G", "Largest peak ground acceleration of the search",
           largest_pga)
        ->capture_default_str();
    command
        .add_flag("--no-search", options.without_search,
                  "Only the verdict at --pga or --scale, without ranges")
        ->excludes("--pga-max");
    add_text(command, "--set", options.overrides, "scene.KEY=VALUE",
             "Set a key of [scene]; repeatable")
        ->allow_extra_args(false);
    command.add_flag("--json", options.json, for_programs);
    add_text(command, "-o,--history", options.history, "OUT.h5",
             "Write the motion at --pga or --scale, as overturn history does");
    command
        .add_option_function<std::vector<std::string>>(
            "--vary",
            [&options](const std::vector<std::string>& words) {
                options.vary = varied_quantity(words);
            },
            "At --pga or --scale, find the values of a quantity of the block, such as width, or\n"
            "restitution_of_maximum, between FIRST and LAST at which it topples")
        ->expected(3)
        ->type_name("QUANTITY FIRST LAST")
        ->excludes("--pga-max", "--history", "--no-search");
}

void add_assess_arguments(CLI::App& command, AssessOptions& options)
{
    const auto positive = positive_up_to(std::numeric_limits<double>::infinity());
    command.add_option("OBJECTS", options.objects, "Table of objects (CSV)")->required();
    add_text(command, "--period", options.periods, "S,...",
             "Periods of the pulse [s], unless --record is given")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(positive);
    add_text(command, "--pga", options.pga, "G",
             "Peak ground acceleration over g of every motion; without it, only strengths")
        ->check(positive_up_to(largest_pga));
    add_text(command, "--pulse", options.pulse, "NAME", "Pulse; default: one_sine");
    add_text(command, "--shape", options.shape, "FILE",
             "Table of the pulse `table`: time over the period, value");
    add_text(command, "--record", options.records, "FILE",
             "Recorded motion, or a pattern of several, instead of a pulse; repeatable")
        ->allow_extra_args(false)
        ->excludes("--period", "--pulse", "--shape");
    add_text(command, "--component", options.component, "NAME",
             "Name or number in the records; default: 1")
        ->needs("--record");
    add_text(command, "--scale", options.scale, "X", "Factor on the records, instead of --pga")
        ->check(positive)
        ->needs("--record")
        ->excludes("--pga");
    add_text(command, "--direction", options.directions, "DEGREES,...",
             "Directions of the motion; default: 0 and 180, its mirror image, which differ for\n"
             "objects whose sides differ")
        ->delimiter(',')
        ->allow_extra_args(false);
    add_text(command, "--pga-max", options.pga_max, "G",
             "Largest peak ground acceleration of the search")
        ->check(positive_up_to(largest_pga))
        ->capture_default_str();
    command.add_flag("--fine", options.fine,
                     "Search the strengths of every case as overturn topple does; slower");
    add_text(command, "--set", options.overrides, "scene.KEY=VALUE",
             "Set a key of [scene]; repeatable")
        ->allow_extra_args(false);
    command.add_flag("--json", options.json, for_programs);
    add_text(command, "--csv", options.csv, "OUT.csv", "Also write a table");
}

void add_result_file(CLI::App& command, std::string& path)
{
    command.add_option("FILE", path, "Result file")->required();
}

void add_info_arguments(CLI::App& command, InfoOptions& options)
{
    add_result_file(command, options.path);
    command.add_flag("--json", options.json, for_programs);
}

void add_folder(CLI::App& command, std::string& folder)
{
    folder = ".";
    command.add_option("FOLDER", folder, "Folder of the result files")->capture_default_str();
}

void add_keys_arguments(CLI::App& command, KeysOptions& options)
{
    command.add_option("KEY", options.name, "Table or key of a job file; default: all");
    command.add_flag("--markdown", options.as_markdown, "Print rows of a table in Markdown");
}

/// The parser of the command line, and the subcommand that it finds.
struct Parser {
    CLI::App app{"Overturning spectra of rocking blocks."};
    Command chosen;

    Parser();

    template <class Options>
    void add(const char* name, const char* description, const char* footer,
             int (*execute)(const Options&), void (*add_arguments)(CLI::App&, Options&))
    {
        CLI::App* const command = app.add_subcommand(name, description);
        const auto options = std::make_shared<Options>();
        add_arguments(*command, *options);
        command->footer(footer);
        command->callback([this, execute, options] {
            chosen = {.execute = [execute, options] { return execute(*options); },
                      // Only `run` and `boundary`, which have these options, use MPI.
                      .on_every_rank = std::same_as<Options, RunOptions>};
        });
    }
};

Parser::Parser()
{
    app.require_subcommand(1);
    app.footer(help::overview);
    app.set_version_flag("--version", version_text);
    add("run", "Compute or resume a spectrum, with or without mpirun", help::run, run,
        add_run_arguments);
    add("boundary",
        "Find the strengths or other values at which verdicts flip, with or without mpirun",
        help::boundary, run, add_boundary_arguments);
    add("merge", "Join the files of all parts of a job, computed by run --part, to one",
        help::merge, merge, add_merge_arguments);
    add("check", "Validate a job; print its points, bytes, time and memory; write nothing",
        help::check, check, add_check_arguments);
    add("accuracy", "Measure error and computing time on a sample of a job's plane", help::accuracy,
        accuracy, add_accuracy_arguments);
    add("history", "Compute the motion of one block: angle, velocity and events over time",
        help::history, history, add_history_arguments);
    add("topple", "Answer whether one block topples, and at which PGA", help::topple, topple,
        add_topple_arguments);
    add("assess", "Answer which objects of a list topple, and at which PGA", help::assess, assess,
        add_assess_arguments);
    add("keys", "Print the keys of job files: type, range, default and meaning", help::keys, keys,
        add_keys_arguments);
    add("info", "Print a summary of a result file, and the progress of its run", help::info, info,
        add_info_arguments);
    add("verify", "Check a result file for damage", help::verify, verify, add_result_file);
    add("doctor", "Print what a bug report should contain about this machine", help::doctor, doctor,
        add_folder);
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
    throw Error(exit_code::usage, "unknown subcommand \"{}\".{} Run with --help for a list.", word,
                suggestion(word, names));
}

/// Whether the message is on an option with a decimal comma, and then what to write instead.
std::string advice_on_commas(std::span<const char* const> words, std::string_view message)
{
    std::string_view option;
    for (std::string_view word : words) {
        if (word.starts_with("--")) {
            option = word.substr(0, word.find('='));
            word = word.substr(std::min(option.size() + 1, word.size()));
        }
        if (!option.empty() && message.find(option) != message.npos &&
            !advice_on_decimal_comma(word).empty()) {
            return (message.ends_with('.') ? "" : ".") + advice_on_decimal_comma(word);
        }
    }
    return "";
}

/// What the first option that the command does not have probably means.
std::string advice_on_unknown_option(const CLI::App& app, std::span<const char* const> words)
{
    for (const CLI::App* command : app.get_subcommands()) {
        const std::vector<std::string> names = mapped(
            command->get_options(), [](const CLI::Option* option) { return option->get_name(); });
        const std::vector<std::string_view> known(names.begin(), names.end());
        for (std::string_view word : words) {
            const std::string_view name = word.substr(0, word.find('='));
            if (name.starts_with("--") && std::ranges::find(known, name) == known.end()) {
                return suggestion(name, known);
            }
        }
    }
    return "";
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
    } catch (const CLI::ExtrasError& error) {
        throw Error(exit_code::usage, "{}.{}\nRun with --help for more information.", error.what(),
                    advice_on_unknown_option(app, given));
    } catch (const CLI::ParseError& error) {
        throw Error(exit_code::usage, "{}{}\nRun with --help for more information.", error.what(),
                    advice_on_commas(given, error.what()));
    }
    return parser.chosen;
}

} // namespace overturn
