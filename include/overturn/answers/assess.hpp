// Which objects of a list topple, and at which strengths: from a request, through a job, to a table
// and JSON. The verdicts are those of `topple`.
#pragma once

#include "overturn/answers/motion_request.hpp"
#include "overturn/job/job.hpp"
#include "overturn/sweep/assessment.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// A table of objects, their motions, and what is asked for.
struct AssessRequest : MotionRequest {
    std::string objects;              ///< path of a table of blocks
    std::vector<std::string> records; ///< paths; empty: a pulse
    std::vector<double> periods;      ///< of the pulse [s]
    std::vector<double> directions;   ///< [degree]
    bool fine = false;                ///< whether strengths are searched as by topple
};

/// The job whose blocks are the objects. If no strength is asked for, its motions are 0. Throws
/// Error.
Job job_of(const AssessRequest& request);

struct Assessment {
    Job job;
    std::vector<ObjectCase> cases;     ///< object by object
    std::vector<ObjectAnswer> answers; ///< the most vulnerable object first
    std::optional<LeastWidths>
        widths; ///< see least_widths_of(), which may take as long as the rest
};

/// progress: called again and again, with the numbers of cases that are computed, and of all.
Assessment assessment_of(Job job, const AssessRequest& request, int threads,
                         const std::function<void(std::size_t done, std::size_t all)>& progress);

/// Of the first object, if it topples, or may, and has one row.
std::optional<LeastWidths> least_widths_of(const Assessment& assessment, int threads);

/// The value of a row, as a text.
std::string text_in(const TableColumn& column, std::size_t row);

/// A name for the rows that people read: the column of objects, the column `name`, the first column
/// of texts, or the number of the row.
std::string name_of_object(const BlockTable& blocks, std::int64_t object);

/// What becomes of an object, in a word: "topples", "undecided", "rocks", "slides", "rocks and
/// slides" or "stands"; empty if no strength is asked for.
std::string outcome_word(const ObjectAnswer& answer);

/// What the numbers of a row do not say: how near the strength is to one that topples, and what
/// is not known.
std::string note_on(const Job& job, const ObjectAnswer& answer);

/// The columns of the table of the objects, then those of the answer.
std::string csv_of(const Assessment& assessment);

/// `objects`: a list of the same columns; `motions`; and what was asked. Strengths that are above
/// the search are null.
std::string json_of(const Assessment& assessment, const AssessRequest& request,
                    std::string_view program_version);

} // namespace overturn
