// Texts that are installed beside the program, made of the options and words that --help shows.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace overturn {

/// The manual page, for man to read (roff).
std::string manual_page(const CLI::App& program);

/// What makes bash complete subcommands, options and file names.
std::string bash_completion(const CLI::App& program);

} // namespace overturn
