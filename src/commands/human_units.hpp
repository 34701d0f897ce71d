// Counts, durations and sizes in readable units.
#pragma once

#include <string>

namespace overturn {

/// Three digits and a prefix: "640", "1.20 k", "3.00 M", "1.00 G".
std::string human_count(double count);

/// "310 ms", "1.25 s", "12 s", "2 min 05 s", "3 h 07 min", "2 d 04 h"; seconds [s] >= 0.
std::string human_duration(double seconds);

/// "640 bytes", "12.0 kB", "3.60 GB": powers of 1000.
std::string human_bytes(double bytes);

} // namespace overturn
