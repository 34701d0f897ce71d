#include "system_reason.hpp"

#include <cctype>
#include <cstring>

namespace overturn {

std::string in_sentence(std::string message)
{
    if (message.size() > 1 && std::islower(static_cast<unsigned char>(message[1]))) {
        message[0] = char(std::tolower(static_cast<unsigned char>(message[0])));
    }
    return message;
}

std::string system_reason(int error_number)
{
    return in_sentence(std::strerror(error_number));
}

} // namespace overturn
