// What words of comments mean, in lower case and in few spellings (stated_unit.hpp).
#pragma once

#include <string_view>

namespace overturn {

bool begins_with_number(std::string_view word);

/// "in", "units" and the like
bool introduces_unit(std::string_view word);

/// Whether a word names accelerations.
bool is_acceleration(std::string_view word);

/// Whether a word is a length, or something over one, where a unit is expected.
bool is_length(std::string_view word);

/// Whether a number is like g in one of its units.
bool has_size_of_gravity(std::string_view number);

/// Whether a word names what a file contains.
bool is_contents(std::string_view word);

bool is_velocity_or_displacement(std::string_view word);

/// Whether a word names a column, without the words around it.
bool is_column(std::string_view word);

/// Whether a word says that a value is one of the whole record.
bool is_peak(std::string_view word);

/// Whether a word says that a value is one of the instrument.
bool is_of_instrument(std::string_view word);

/// Whether a word says that a velocity or displacement is not that of the samples.
bool is_of_wave_or_fault(std::string_view word);

/// Whether a word is the unit of what an instrument gives, such as v/g.
bool is_sensitivity(std::string_view word);

/// Whether a word changes a unit, as in "percent of g" and "scaled by 10".
bool is_factor(std::string_view word);

/// Whether a word is a unit of acceleration or of velocity wherever it is: a known name, alone or
/// before a factor, such as g/10, or a length over something.
bool is_unit(std::string_view word);

/// The unit in a word: "g" of 0.35g, accg and acc/g, "m/s2" of a/m/s2; the word if it has none.
std::string_view unit_of_word(std::string_view word);

/// Whether a word is a unit such as km and m/s, but not m/s2.
bool is_length_or_velocity(std::string_view word);

} // namespace overturn
