#include "completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <regex>
#include <set>

namespace overturn {

namespace {

/// The cases tell what may stand at a place in the line, given the place, the subcommand and the
/// word before: words, and files by their ending.
constexpr const char* script = R"(# Bash completion for overturn.
_overturn()
{{
    local word=${{COMP_WORDS[COMP_CWORD]}} words='' ending=''
    case "$COMP_CWORD ${{COMP_WORDS[1]}} ${{COMP_WORDS[COMP_CWORD - 1]}}" in
        1\ *) words='{}--help --version' ;;
{}{}    esac
    if [[ -n $ending && $word != -* ]]; then
        compopt -o filenames
        mapfile -t COMPREPLY < <(compgen -f -X "!*.$ending" -- "$word"; compgen -d -- "$word")
    else
        mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
    fi
}}
complete -F _overturn overturn
)";

} // namespace

std::string bash_completion(const CLI::App& app)
{
    const std::regex comma(",");
    std::string commands, by_command;
    std::set<std::string> by_option; // an option means the same to every subcommand
    for (const CLI::App* command : app.get_subcommands({})) {
        std::string words, ending;
        for (const CLI::Option* option : command->get_options()) {
            const std::string names = option->get_name(false, true); // "-o,--output"
            const std::string type = option->get_type_name();
            if (option->get_positional()) {
                ending = option->get_name(true) == "JOB" ? "toml" : "h5";
                continue;
            }
            words += std::regex_replace(names, comma, " ") + " ";
            if (option->get_expected_max() > 0) { // a value follows, perhaps one of {auto,double}
                std::smatch choices;
                std::regex_search(type, choices, std::regex("\\{(.*)\\}"));
                by_option.insert(fmt::format("        *\\ {}) words='{}' ending='{}' ;;\n",
                                             std::regex_replace(names, comma, "|*\\ "),
                                             std::regex_replace(choices.str(1), comma, " "),
                                             type.ends_with(".h5") ? "h5" : ""));
            }
        }
        commands += command->get_name() + " ";
        by_command += fmt::format("        *\\ {}\\ *) words='{}' ending='{}' ;;\n",
                                  command->get_name(), words, ending);
    }
    return fmt::format(script, commands, fmt::join(by_option, ""), by_command);
}

} // namespace overturn
