// The manual page, from the options and words that --help shows.
#pragma once

#include "command_words.hpp"

#include <string>

namespace overturn {

/// For man to read (roff).
std::string manual_page(const CommandWords& program);

} // namespace overturn
