// Messages of the operating system as part of our sentences.
#pragma once

#include <string>

namespace overturn {

/// "No space left" becomes "no space left"; "MPI_ERR" stays.
std::string in_sentence(std::string message);

/// What an error number of the system means, as in "no space left on device".
std::string system_reason(int error_number);

} // namespace overturn
