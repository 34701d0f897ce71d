// What makes bash complete subcommands, options and file names, from the options that --help shows.
#pragma once

#include "command_words.hpp"

#include <string>

namespace overturn {

/// For bash to read.
std::string bash_completion(const CommandWords& program);

} // namespace overturn
