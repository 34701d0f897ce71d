// Verdicts and the ranges of the peak ground acceleration, or of another quantity, in which a block
// topples, in words. Ranges are rounded outwards: what is in none of them is safe.
#pragma once

#include "overturn/sweep/toppling.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace overturn {

/// The largest number of this many decimals that is at most the value; the printed number is never
/// above the value.
double rounded_down(double value, int decimals);
inline double rounded_up(double value, int decimals)
{
    return -rounded_down(-value, decimals);
}

/// Ranges of a verdict that are shown as one interval.
struct VerdictInterval {
    double first; ///< peak ground acceleration over g, or value of another quantity
    double last;
    double share = 1; ///< of the interval that has the verdict [1]
};

inline constexpr std::size_t most_intervals = 6;

/// The ranges of a verdict, ascending. Of more than `most`, those that are closest to each other
/// are joined, but not the one that ends the search.
std::vector<VerdictInterval> intervals_of(const VerdictRanges& ranges, Verdict verdict,
                                          std::size_t most = most_intervals);

/// Such as "1.1110 to 1.6440 g, 34 % of 1.7000 to 1.8000 g, above 2.1300 g, searched up to 5 g"; at
/// most `most` intervals of each kind. Those that touch when rounded are joined. unit: follows a
/// value.
std::string text_of(const VerdictRanges& ranges, int decimals, std::size_t most = most_intervals,
                    std::string_view unit = " g");

/// The number of decimals that tells all ends of the shown intervals from a value; at least 4, and
/// up to 7 to tell them from each other.
int decimals_of(const VerdictRanges& ranges, double value);

/// Such as "does not topple at 0.95 g; topples at 0.9889 g (4.1 % more)", because a verdict alone
/// hides a near miss. Of the other restitutions, the worst one is named if it is worse than the
/// requested one. Strengths are rounded towards the asked one. scale: the asked strength if it is a
/// factor on the record. place: follows the strength, such as " in direction 180". The answer must
/// have a verdict.
std::string verdict_sentence(const ToppleAnswer& answer, const std::optional<double>& scale,
                             std::string_view place = "");

/// peak: |theta| / alpha; infinite if the block overturns, NaN if that is undecided.
std::string peak_text(double peak, const Problem& problem);

/// How far a block slides. slide, slide_peak: over R, NaN if unknown; size: R [m], if it is known.
std::string slide_text(double slide, double slide_peak, const std::optional<double>& size);

} // namespace overturn
