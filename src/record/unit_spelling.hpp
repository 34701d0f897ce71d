// Spellings of units of acceleration, word by word, in lower case.
#pragma once

#include "overturn/record/read_record.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace overturn {

/// In lower case, with superscripts of UTF-8 and Latin-1 as digits and minus signs, and without the
/// dots of products.
std::string simplified(std::string_view line);

/// A unit or a part of one in a normal form: "sec**2" becomes "s2".
std::string normal_form(std::string_view word);

/// The unit of this normal form, such as "cm/s/s"; nullopt if it is none.
std::optional<AccelerationUnit> unit_of(std::string_view normal);

/// Whether a word multiplies or divides the unit that precedes it.
bool is_operator(std::string_view word);

/// Whether a word begins like a unit: with the name of a length, of an acceleration, of a system of
/// units or of raw data, alone or before something other than a letter.
bool resembles_unit(std::string_view word);

/// Whether a word can only be a unit, wherever it is: that of a force over a mass, or a system.
bool is_always_unit(std::string_view word);

/// Whether a word is a unit of time other than the second.
bool is_time(std::string_view word);

/// Whether a word is like CM/SEC: a length over a second.
bool is_length_over_time(std::string_view word);

bool is_number_like(std::string_view word);

/// What follows a factor at the beginning of a word: "g" in milli-g and in 0.01g; nullopt: it does
/// not begin with a factor.
std::optional<std::string_view> after_factor(std::string_view word);

} // namespace overturn
