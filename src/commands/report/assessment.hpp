// The answer of `overturn assess`: one row per object, as text, as a table and as JSON.
#pragma once

#include "commands/commands.hpp"

#include "overturn/job/job.hpp"
#include "overturn/sweep/assessment.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// The value of a row, as a text.
std::string text_in(const TableColumn& column, std::size_t row);

/// What becomes of an object, in a word: "topples", "undecided", "rocks", "slides", "rocks and
/// slides" or "stands"; empty if no strength is asked for.
std::string outcome_word(const ObjectAnswer& answer);

/// What the numbers of a row do not say: how near the strength is to one that topples, and what
/// is not known.
std::string note_on(const Job& job, const ObjectAnswer& answer);

/// The motions and the table of the objects, for people. widths: of the first one, if it topples.
void print_assessment(const Job& job, const std::vector<ObjectAnswer>& answers,
                      const std::optional<LeastWidths>& widths, const AssessOptions& options);

/// The columns of the table of the objects, then those of the answer.
std::string csv_of(const Job& job, const std::vector<ObjectAnswer>& answers);

/// `objects`: a list of the same columns; `motions`; and what was asked. Strengths that are above
/// the search are null.
std::string json_of(const Job& job, const std::vector<ObjectAnswer>& answers,
                    const std::optional<LeastWidths>& widths, const AssessOptions& options);

} // namespace overturn
