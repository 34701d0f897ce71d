// The manual page, from the options and words that --help shows.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace overturn {

/// For man to read (roff).
std::string manual_page(const CLI::App& app);

} // namespace overturn
