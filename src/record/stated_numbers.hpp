// Numbers of a header that the samples state as well. A header that contradicts its samples has a
// wrong unit, scale or time step.
#pragma once

#include "lines.hpp"
#include "overturn/record/read_record.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// What a number is.
enum class Stated {
    count,
    time_step,
    duration, ///< of all samples, or between the first and the last one
    peak,
    root_mean_square,
    time_of_peak ///< after the first sample
};

/// The largest absolute acceleration, or that of one sign.
enum class Peak { absolute, highest, lowest };

/// A number of a header, or what stands in its place.
struct StatedNumber {
    Stated what;
    Lines lines;                               ///< at its line
    std::string_view name;                     ///< for messages, such as "DURATION_S"
    std::string_view word;                     ///< as printed
    std::optional<AccelerationUnit> unit = {}; ///< of a peak, if it is not that of the samples
    double least_rounding = 0;                 ///< of a number that is called approximate
    double start = 0; ///< time of the first sample, if that of a peak counts from another one [s]
    Peak peak = Peak::absolute; ///< that is stated, or of which the time is
};

/// Samples as the file contains them.
struct Samples {
    const Lines& lines; ///< of the file
    const std::vector<double>& values;
    std::optional<AccelerationUnit> unit; ///< nullopt: counts
    double time_step;                     ///< [s]
    double rounding;                      ///< of the time step, as printed [s]
    bool may_have_offset = false;         ///< whether a stated peak may be that without the mean
};

/// Compares the numbers with the samples. Refuses samples that are marks of missing values and more
/// than twice as large as all others; another count; intervals and durations
/// that differ by more than their digits allow; peaks that differ by more than 5 %; and times of
/// peaks, unless another number confirms the time step. Returns a remark on each acceleration that
/// differs by more than 1 %, and on each other difference that is not refused. Words that are not
/// numbers, 0, and marks of unknown numbers are skipped.
std::vector<std::string> compare(const std::vector<StatedNumber>& stated, const Samples& samples);

/// The same with the samples of a component, which takes the remarks. rounding: of the time step.
void compare(const std::vector<StatedNumber>& stated, RecordComponent& component,
             const Lines& lines, double rounding);

/// The peak after some words, as in `peak  -9733.1 mm/s/s at  44.88 sec`. Nothing, that is an empty
/// word, if another unit follows than one that is understood, or counts.
StatedNumber peak_after(const Lines& lines, std::string_view words, std::string_view name);

/// The word after some words, ignoring case, and after blanks, = and :, as 27.114 in `Peak
/// acceleration =  27.114 cm/sec/sec`. Empty if there is none.
std::string_view word_after(std::string_view line, std::string_view words);

} // namespace overturn
