// Units of acceleration that files state, in their usual spellings.
#pragma once

#include "lines.hpp"
#include "overturn/record/read_record.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace overturn {

/// How many of a unit are one m/s2; 0 for g.
double units_per_m_per_s2(AccelerationUnit unit);

/// A text in lower case and with few spellings: CM/SEC**2, cm s-2, cm_s2, CMPS2 and "cm per second
/// squared" become cm/s2.
std::string in_few_spellings(std::string_view text);

/// The unit of this name, in any case: g, gal, and m, cm or mm per square second in the spellings
/// above. nullopt for everything else, such as G/10.
std::optional<AccelerationUnit> unit_named(std::string_view name);

/// The same for the samples of a format that states their unit. Refuses everything else.
AccelerationUnit unit_of_samples(const Lines& lines, std::string_view name);

/// The text after a word, up to a bracket or a comma: cm/sec2 of "70 secs, units=cm/sec2(04)".
std::string_view text_after(std::string_view line, std::string_view word);

/// How to state what a file does not, for messages. option: "units" or "time_step".
std::string how_to_state(std::string_view option);

} // namespace overturn
