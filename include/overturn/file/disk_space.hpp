// The space for a result file in a folder, and the speed of its disk. What a file system does not
// report is unknown.
#pragma once

#include <optional>
#include <string>

namespace overturn {

/// What a user or a group may store on a file system. An infinite limit: as much as there is.
struct Quota {
    double limit; ///< [bytes]
    double used;  ///< [bytes]
};

struct DiskSpace {
    std::optional<double> free;    ///< for this user [bytes]
    std::optional<Quota> of_user;  ///< quotactl(2), that network file systems do not answer
    std::optional<Quota> of_group; ///< of the group that a new file in the folder has

    /// The quota that leaves less, if one is known.
    std::optional<Quota> quota() const;

    /// The bytes that can be written, if one of both is known: what is free, within the quota.
    std::optional<double> available() const;
};

DiskSpace space_in(const std::string& folder);

/// Measures how fast a file can be created: writes up to `bytes`, at most for some tenths of a
/// second, to a file without a name, synced as often as when a result is created. The file
/// vanishes when it is closed. Returns [bytes/s]; nullopt where the file system has no such files
/// or the folder is not writable.
std::optional<double> speed_of_creation_in(const std::string& folder, double bytes);

} // namespace overturn
