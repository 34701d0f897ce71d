#include "installed_texts.hpp"

#include "help_texts.hpp"

#include "overturn/file/provenance.hpp"
#include "overturn/job/job.hpp"
#include "overturn/job/schema.hpp"
#include "overturn/text/mapped.hpp"

#include <CLI/CLI.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace overturn {

namespace {

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
    constexpr std::pair<const char*, const char*> escapes[] = {{"\\", "\\e"},  {"-", "\\-"},
                                                               {"'", "\\(aq"}, {"`", "\\(ga"},
                                                               {"^", "\\(ha"}, {"~", "\\(ti"}};
    std::string result(text);
    for (const auto& [letter, escape] : escapes) {
        boost::algorithm::replace_all(result, letter, escape);
    }
    return result;
}

/// A section whose text, in which no line begins with a dot, is shown as it is.
std::string section(const std::string& name, std::string_view text)
{
    return fmt::format(".SH {}\n.nf\n{}\n.fi\n", escaped(name), escaped(text));
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
        return fmt::format("{}=", fmt::join(keys_of("plane"), "= "));
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
    std::string page = fmt::format(".TH OVERTURN 1 \"\" \"overturn {}\" \"User Commands\"\n"
                                   ".SH NAME\noverturn \\- overturning spectra of rocking blocks\n",
                                   program_version());
    page += section("DESCRIPTION", manual::description) + section("SYNOPSIS", program.help());
    for (const CLI::App* command : program.get_subcommands({})) {
        page += section("overturn " + command->get_name(), command->help("overturn"));
    }
    return page + section("TOOLS", manual::tools) + section("ENVIRONMENT", manual::environment) +
           section("FILES", manual::files) + ".SH SEE ALSO\n\\fBmpirun\\fR(1), \\fBh5dump\\fR(1)\n";
}

std::string bash_completion(const CLI::App& program)
{
    std::string commands, by_command, by_option;
    for (const CLI::App* command : program.get_subcommands({})) {
        std::string words, ending;
        for (const CLI::Option* option : command->get_options()) {
            const std::string value = value_of(*option);
            if (option->get_positional()) {
                ending = value == "JOB" ? "toml" : value == "KEY" ? "" : "h5";
                words += value != "KEY"
                             ? ""
                             : fmt::format("{} ", fmt::join(mapped(all_keys(), &Key::dotted), " "));
                continue;
            }
            const std::vector<std::string> names =
                CLI::detail::split(option->get_name(false, true), ','); // "-o" and "--output"
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
