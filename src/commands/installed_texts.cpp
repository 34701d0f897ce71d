#include "installed_texts.hpp"

#include "help_texts.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/job/job.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace overturn {

namespace {

/// "-o" and "--output"; empty for a positional argument.
std::vector<std::string> names_of(const CLI::Option& option)
{
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) {
        names.push_back(fmt::format("-{}", name));
    }
    for (const std::string& name : option.get_lnames()) {
        names.push_back(fmt::format("--{}", name));
    }
    return names;
}

/// "OUT.h5", "{auto,double}"; JOB for a positional argument; empty for a flag.
std::string value_of(const CLI::Option& option)
{
    if (option.get_positional()) {
        return option.get_name(true);
    }
    // The type is followed by a colon and the allowed values.
    const std::string type = option.get_type_name();
    return option.get_expected_max() == 0 ? "" : type.substr(type.find(':') + 1);
}

/// Escapes the characters that roff interprets or replaces.
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

/// Paragraphs for roff to fill; indented lines are kept verbatim.
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
std::string heading_of(const CLI::Option& option)
{
    std::vector<std::string> words;
    for (const std::string& name : names_of(option)) {
        words.push_back(bold(name));
    }
    const std::string value = value_of(option);
    return fmt::format("{}{}{}", fmt::join(words, ", "), words.empty() || value.empty() ? "" : " ",
                       value.empty() ? "" : italic(value));
}

std::string options_of(const CLI::App& command)
{
    std::string result;
    for (const CLI::Option* option : command.get_options()) {
        const std::string standard = option->get_default_str();
        result +=
            fmt::format(".TP\n{}\n{}{}.\n", heading_of(*option), escaped(option->get_description()),
                        standard.empty() ? "" : fmt::format(" (default: {})", standard));
    }
    return result;
}

std::string subcommand(const CLI::App& command)
{
    std::string arguments;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_positional()) {
            arguments += " " + heading_of(*option);
        } else if (option->get_required()) {
            arguments += " " + bold(names_of(*option)[0]) + " " + italic(value_of(*option));
        }
    }
    return fmt::format(".SS \"overturn {}{}\"\n{}.\n{}.PP\n{}", escaped(command.get_name()),
                       arguments, escaped(command.get_description()), options_of(command),
                       paragraphs(command.get_footer()));
}

/// A section for each paragraph of the footer, which begins with the title: "Examples: ...".
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

/// The cases list the words and the ending of the files that are allowed at a position of the line,
/// given the position, the subcommand and the previous word.
constexpr const char* completion_script = R"(# Bash completion for overturn.
_overturn()
{{
    local word=${{COMP_WORDS[COMP_CWORD]}} words='' ending=''
    case "$COMP_CWORD ${{COMP_WORDS[1]}} ${{COMP_WORDS[COMP_CWORD - 1]}}" in
        1\ *) words='{}--help --version' ;;
        *\ =) ;; # the value of a key
{}{}    esac
    if [[ -n $ending && $word != -* ]]; then
        compopt -o filenames
        mapfile -t COMPREPLY < <(compgen -f -X "!*.$ending" -- "$word"; compgen -d -- "$word")
    else
        mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
        [[ ${{COMPREPLY[*]}} != *= ]] || compopt -o nospace
    fi
}}
complete -F _overturn overturn
)";

/// "auto double" for "{auto,double}"; the keys, each with "=", for "KEY=VALUE"; otherwise empty.
std::string choices_of(std::string value)
{
    if (value == "AXIS=VALUE,...") {
        return fmt::format("{}=", fmt::join(axis_names(), "= "));
    }
    if (value.ends_with("KEY=VALUE")) {
        const std::string prefix = value.substr(0, value.size() - 9);
        std::string keys;
        for (const std::string& key : override_keys()) {
            keys += key.starts_with(prefix) ? key + "= " : "";
        }
        return keys;
    }
    if (!value.starts_with('{')) {
        return "";
    }
    std::replace(value.begin(), value.end(), ',', ' ');
    return value.substr(1, value.size() - 2);
}

} // namespace

std::string manual_page(const CLI::App& program)
{
    std::string page = fmt::format(".TH OVERTURN 1 {} \"overturn {}\" \"User Commands\"\n"
                                   ".SH NAME\noverturn \\- overturning spectra of rocking blocks\n"
                                   ".SH SYNOPSIS\n"
                                   "\\fBoverturn\\fR \\fISUBCOMMAND\\fR [\\fIOPTIONS\\fR]\n"
                                   ".br\n\\fBoverturn\\fR \\fISUBCOMMAND\\fR \\fB\\-\\-help\\fR\n",
                                   manual::date_of_texts, program_version());
    page += section("Description", manual::description);
    page += ".SH OPTIONS\n" + options_of(program) + ".SH SUBCOMMANDS\n";
    for (const CLI::App* command : program.get_subcommands({})) {
        page += subcommand(*command);
    }
    return page + sections_of_footer(program.get_footer()) + section("Tools", manual::tools) +
           section("Environment", manual::environment) + section("Files", manual::files) +
           ".SH SEE ALSO\n\\fBmpirun\\fR(1), \\fBh5dump\\fR(1)\n";
}

std::string bash_completion(const CLI::App& program)
{
    std::string commands, by_command, by_option;
    for (const CLI::App* command : program.get_subcommands({})) {
        std::string words, ending;
        for (const CLI::Option* option : command->get_options()) {
            const std::string value = value_of(*option);
            if (option->get_positional()) {
                ending = value == "JOB" ? "toml" : "h5";
                continue;
            }
            const std::vector<std::string> names = names_of(*option);
            words += fmt::format("{} ", fmt::join(names, " "));
            if (!value.empty()) {
                const std::string before = fmt::format("*\\ {}\\ ", command->get_name());
                by_option += fmt::format("        {}{}) words='{}' ending='{}' ;;\n", before,
                                         fmt::join(names, "|" + before), choices_of(value),
                                         value.ends_with(".h5") ? "h5" : "");
            }
        }
        commands += command->get_name() + " ";
        by_command += fmt::format("        *\\ {}\\ *) words='{}' ending='{}' ;;\n",
                                  command->get_name(), words, ending);
    }
    return fmt::format(completion_script, commands, by_option, by_command);
}

} // namespace overturn
