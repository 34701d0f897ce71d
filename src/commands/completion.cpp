#include "completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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

/// What is between the braces of "{auto,double}", with spaces; of any other value nothing.
std::string choices_of(std::string value)
{
    if (!value.starts_with('{')) {
        return "";
    }
    std::replace(value.begin(), value.end(), ',', ' ');
    return value.substr(1, value.size() - 2);
}

} // namespace

std::string bash_completion(const CommandWords& program)
{
    std::string commands, by_command;
    std::set<std::string> by_option; // an option means the same to every subcommand
    for (const CommandWords& command : program.subcommands) {
        std::string words, ending;
        for (const OptionWords& option : command.options) {
            if (option.names.empty()) {
                ending = option.value == "JOB" ? "toml" : "h5";
                continue;
            }
            words += fmt::format("{} ", fmt::join(option.names, " "));
            if (!option.value.empty()) {
                by_option.insert(fmt::format(
                    "        *\\ {}) words='{}' ending='{}' ;;\n", fmt::join(option.names, "|*\\ "),
                    choices_of(option.value), option.value.ends_with(".h5") ? "h5" : ""));
            }
        }
        commands += command.name + " ";
        by_command += fmt::format("        *\\ {}\\ *) words='{}' ending='{}' ;;\n", command.name,
                                  words, ending);
    }
    return fmt::format(script, commands, fmt::join(by_option, ""), by_command);
}

} // namespace overturn
