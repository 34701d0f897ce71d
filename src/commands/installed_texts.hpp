// The texts that are installed with the program. Both follow from its options.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace overturn {

/// The manual page (roff).
std::string manual_page(const CLI::App& program);

/// The script with which bash completes subcommands, options and file names.
std::string bash_completion(const CLI::App& program);

} // namespace overturn
