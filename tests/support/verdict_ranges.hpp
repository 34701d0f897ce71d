// Ranges of verdicts, and answers with them.
#pragma once

#include "overturn/sweep/toppling.hpp"

#include <random>
#include <vector>

namespace overturn {

inline constexpr auto safe = Verdict::safe;
inline constexpr auto topples = Verdict::topples;
inline constexpr auto undecided = Verdict::undecided;

/// Up to 200 ranges between 0.3 and 3 g, some of them thin, that topple or are undecided, with safe
/// ones between them.
inline VerdictRanges random_ranges(std::mt19937_64& generator)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    VerdictRanges ranges{.all = {{0, 0.3, safe}}, .begin_of_search = 0.3};
    const int count = int(200 * uniform(generator));
    for (int i = 0; i < count; ++i) {
        const double first = ranges.all.back().last;
        const double width = 2.7 / count * uniform(generator);
        ranges.all.push_back({first, first + width * uniform(generator),
                              uniform(generator) < 0.8 ? topples : undecided});
        ranges.all.push_back({ranges.all.back().last, first + width, safe});
    }
    if (uniform(generator) < 0.5) {
        ranges.all.push_back({ranges.all.back().last, 5, topples});
    }
    return ranges;
}

/// Alternating with safe ones, from 0 to 5 g.
inline VerdictRanges ranges_of(const std::vector<VerdictRange>& unsafe)
{
    VerdictRanges ranges{.all = {}, .begin_of_search = 0.3};
    double end = 0;
    for (const VerdictRange& range : unsafe) {
        ranges.all.push_back({end, range.first, safe});
        ranges.all.push_back(range);
        end = range.last;
    }
    if (end < 5) {
        ranges.all.push_back({end, 5, safe});
    }
    return ranges;
}

/// At r = 0.9 r_max, with r_max = 0.8.
inline ToppleAnswer answer_at(double pga, Verdict verdict, const std::vector<VerdictRange>& unsafe)
{
    ToppleAnswer answer;
    answer.verdict = verdict;
    answer.pga = pga;
    answer.unit = 0.5;
    answer.by_restitution = {{0.9, 0.72, ranges_of(unsafe)}};
    return answer;
}

} // namespace overturn
