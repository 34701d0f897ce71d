// What makes bash complete subcommands, options and file names, from the options that --help shows.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace overturn {

/// For bash to read.
std::string bash_completion(const CLI::App& app);

} // namespace overturn
