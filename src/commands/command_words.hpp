// What --help shows of a command, as plain data: for the manual page and the completion.
#pragma once

#include <string>
#include <vector>

namespace overturn {

struct OptionWords {
    std::vector<std::string> names; ///< "-o", "--output"; none of a positional argument
    std::string value; ///< "OUT.h5", "{auto,double}"; JOB of a positional argument; of a flag empty
    std::string description;
    std::string standard; ///< value without the option
    bool required = false;
};

struct CommandWords {
    std::string name, description, footer;
    std::vector<OptionWords> options;
    std::vector<CommandWords> subcommands;
};

} // namespace overturn
