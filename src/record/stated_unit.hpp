// Units of acceleration that the header of a file states in words.
#pragma once

#include "overturn/record/read_record.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// A unit as it is spelled. Unknown spellings and multiples, such as G/10, have no value.
struct StatedUnit {
    std::string text;
    std::optional<AccelerationUnit> unit;
    bool is_time; ///< a unit of time other than the second
};

/// Where a unit is looked for in a line.
enum class UnitPlaces {
    after_units, ///< after "unit" or "units", as in UNITS OF G
    title,       ///< also after "in", ":" or "=", in brackets, and CM/S/S and the like anywhere
    comment,     ///< also a G anywhere, alone or in a name such as acc_g, and the whole line
};

/// The units that a line states. Words that are no units, such as places, are skipped; a "G" counts
/// only where a unit is expected, but in a comment everywhere except in "0.3 g", "g = 9.81",
/// "component G" and before a name, "G. Miller". Understood are g, gal, and m, cm or mm per square
/// second, in any case and in the usual spellings: CM/S/S, cm/sec^2, CM/S**2, cm s-2, cm per sec
/// per sec.
std::vector<StatedUnit> stated_units(std::string_view line, UnitPlaces places);

/// How to state what a file does not, for messages. option: "units" or "time_step".
std::string how_to_state(std::string_view option);

} // namespace overturn
