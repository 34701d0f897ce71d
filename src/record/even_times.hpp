// The step of a column of printed times.
#pragma once

#include "lines.hpp"

#include <cstddef>
#include <limits>
#include <string_view>

namespace overturn {

/// Collects printed times t_i, i = 0, 1, ..., that must be evenly spaced: with h_i half a unit of
/// the last printed digit of t_i, each must satisfy
///
///     |t_i - (t_0 + i step)| <= h_i
///
/// for one step. Each time bounds the step on both sides; the intersection of these ranges is kept.
class EvenTimes {
public:
    /// Refuses a word of the current line that is not a number, and a time that is not after the
    /// previous one or is not evenly spaced with the previous ones.
    void add(const Lines& lines, std::string_view word);

    /// The step with the fewest decimal digits; of several, the one nearest to the mean step [s].
    /// Requires two times.
    double step() const;

    std::size_t size() const { return size_; }

private:
    double first_ = 0;                                      ///< [s]
    double last_ = 0;                                       ///< [s]
    double least_ = 0;                                      ///< lower bound of the step [s]
    double most_ = std::numeric_limits<double>::infinity(); ///< upper bound of the step [s]
    std::size_t size_ = 0;
};

} // namespace overturn
