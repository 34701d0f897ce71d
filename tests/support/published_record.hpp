// Records as they were published. They are not part of the sources.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace overturn {

/// The path of a record in the folder $OVERTURN_RECORDS; empty if it does not exist.
inline std::string published_record(const std::string& name)
{
    const char* folder = std::getenv("OVERTURN_RECORDS");
    const std::string path = (std::filesystem::path(folder ? folder : "") / name).string();
    return folder != nullptr && std::filesystem::exists(path) ? path : "";
}

} // namespace overturn
