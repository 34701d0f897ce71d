// The files that jobs may name.
#pragma once

#include <string>

namespace overturn {

/// Replaces an older file of this name.
void add_file(std::string name, std::string content);

} // namespace overturn
