#include "overturn/answers/ranges_text.hpp"

#include "overturn/answers/job_lines.hpp"
#include "overturn/text/mapped.hpp"
#include "overturn/text/parse_number.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace overturn {

namespace {

/// One interval of both; each may be a single acceleration.
VerdictInterval joined(const VerdictInterval& one, const VerdictInterval& next)
{
    const auto width = [](const VerdictInterval& each) { return each.last - each.first; };
    VerdictInterval both{one.first, next.last};
    if (width(both) > 0) {
        both.share = (one.share * width(one) + next.share * width(next)) / width(both);
    }
    return both;
}

/// Rounded outwards; intervals that touch or overlap then are one.
std::vector<VerdictInterval> rounded(const std::vector<VerdictInterval>& intervals, int decimals)
{
    std::vector<VerdictInterval> all;
    for (VerdictInterval interval : intervals) {
        interval.first = rounded_down(interval.first, decimals);
        interval.last = rounded_up(interval.last, decimals);
        if (!all.empty() && interval.first <= all.back().last) {
            all.back() = joined(all.back(), interval);
        } else {
            all.push_back(interval);
        }
    }
    return all;
}

/// "above 2.1300 g" if the interval reaches the end of the ranges, "below 0.4000 m" if it reaches
/// their beginning, and "all" if it reaches both; otherwise "1.1110 to 1.6440 g", or "34 %
/// of 1.1110 to 1.6440 g" if only a part of it has the verdict.
std::string text_of(const VerdictInterval& interval, const std::vector<VerdictRange>& ranges,
                    int decimals, std::string_view unit)
{
    constexpr double whole = 0.995; // rounded to per cent
    const auto& [first, last, share] = interval;
    const bool is_whole = share >= whole;
    const bool is_at_end = is_whole && last >= ranges.back().last;
    const bool is_at_begin = is_whole && first <= ranges.front().first;
    if (is_at_end && is_at_begin) {
        return "all";
    }
    if (is_at_end || is_at_begin) {
        return fmt::format("{} {:.{}f}{}", is_at_end ? "above" : "below", is_at_end ? first : last,
                           decimals, unit);
    }
    if (first == last) {
        return fmt::format("{:.{}f}{}", first, decimals, unit);
    }
    return fmt::format("{}{:.{}f} to {:.{}f}{}",
                       is_whole ? "" : fmt::format("{:.0f} % of ", std::max(100 * share, 1.0)),
                       first, decimals, last, decimals, unit);
}

std::string_view text_of(Verdict verdict)
{
    return verdict == Verdict::safe ? "does not topple" : name_of(verdict);
}

/// The asked strength, in g or as a factor on the record.
struct Asked {
    double value;
    double pga;
    double unit; ///< the acceleration of the strength 1, over g
    bool is_scale;

    std::string_view unit_text() const { return is_scale ? "times the record" : "g"; }
};

/// A strength on one side of the asked one.
struct NearStrength {
    double pga;
    bool is_above;

    double ratio(const Asked& asked) const { return is_above ? pga / asked.pga : asked.pga / pga; }
};

/// Such as "at 0.9889 g (4.1 % more)": rounded towards the asked strength, with enough decimals to
/// tell it from that.
std::string text_of(const NearStrength& near, const Asked& asked)
{
    const double value = near.pga / asked.unit;
    for (int decimals = asked.is_scale ? 3 : 4; decimals < std::numeric_limits<double>::digits10;
         ++decimals) {
        const double shown =
            near.is_above ? rounded_down(value, decimals) : rounded_up(value, decimals);
        if (near.is_above ? shown > asked.value : shown < asked.value) {
            const double percent = 100 * std::abs(shown / asked.value - 1);
            return fmt::format("at {:.{}f} {} ({} % {})", shown, decimals, asked.unit_text(),
                               percent < 10 ? fmt::format("{:.2g}", percent)
                                            : fmt::format("{:.0f}", percent),
                               near.is_above ? "more" : "less");
        }
    }
    return near.is_above ? "just above" : "just below";
}

/// The nearest strengths with this verdict on both sides; the nearer one first.
std::vector<NearStrength> nearest(const VerdictRanges& ranges, Verdict verdict, const Asked& asked)
{
    std::vector<NearStrength> all;
    if (const auto above = ranges.nearest_above(verdict, asked.pga)) {
        all.push_back({*above, true});
    }
    if (const auto below = ranges.nearest_below(verdict, asked.pga)) {
        all.push_back({*below, false});
    }
    std::ranges::sort(all, {}, [&](const NearStrength& each) { return each.ratio(asked); });
    return all;
}

/// Such as "; topples at 0.9889 g (4.1 % more) and at 0.9 g (5.3 % less)". Undecided strengths are
/// named only if they are nearer than those that topple the block.
std::string text_of_nearest(const ToppleAnswer& answer, const Asked& asked)
{
    const auto clause = [&](Verdict verdict, const std::vector<NearStrength>& all) {
        const auto texts =
            mapped(all, [&](const NearStrength& each) { return text_of(each, asked); });
        return texts.empty() ? ""
                             : fmt::format("; {} {}", text_of(verdict), fmt::join(texts, " and "));
    };
    const VerdictRanges& ranges = answer.requested().ranges;
    const auto toppling = nearest(ranges, Verdict::topples, asked);
    auto undecided = nearest(ranges, Verdict::undecided, asked);
    std::erase_if(undecided, [&](const NearStrength& each) {
        return answer.verdict == Verdict::undecided ||
               (!toppling.empty() && toppling.front().ratio(asked) < each.ratio(asked));
    });
    return clause(Verdict::topples, toppling) + clause(Verdict::undecided, undecided);
}

/// Such as "r = 0.85 and 0.9 r_max".
std::string text_of(const std::vector<const RestitutionAnswer*>& answers)
{
    const auto shares = mapped(
        answers, [](const RestitutionAnswer* each) { return fmt::format("{:.4g}", each->share); });
    return shares == std::vector<std::string>{"1"}
               ? "r = r_max"
               : fmt::format("r = {} r_max", fmt::join(shares, ", "));
}

/// What is worse with other restitutions of the table, such as "; with r = r_max, it topples at
/// 0.9889 g (4.1 % more)"; empty if nothing is.
std::string text_of_worst_restitution(const ToppleAnswer& answer, const Asked& asked)
{
    for (const Verdict verdict : {Verdict::topples, Verdict::undecided}) {
        std::vector<const RestitutionAnswer*> worse;
        for (const RestitutionAnswer& each : answer.by_restitution) {
            if (each.ratio != answer.requested().ratio && answer.verdict != verdict &&
                each.ranges.verdict_at(asked.pga) == verdict) {
                worse.push_back(&each);
            }
        }
        if (!worse.empty()) {
            return fmt::format("; with {}, {}", text_of(worse),
                               verdict == Verdict::topples ? "it topples at this strength"
                                                           : "this strength is undecided");
        }
    }
    std::optional<NearStrength> worst;
    const RestitutionAnswer* its_answer = &answer.requested();
    for (const RestitutionAnswer& each : answer.by_restitution) {
        const auto near = nearest(each.ranges, Verdict::topples, asked);
        if (!near.empty() && (!worst || near.front().ratio(asked) < worst->ratio(asked))) {
            worst = near.front();
            its_answer = &each;
        }
    }
    return worst && its_answer->ratio != answer.requested().ratio
               ? fmt::format("; with {}, it topples {}", text_of({its_answer}),
                             text_of(*worst, asked))
               : "";
}

} // namespace

double rounded_down(double value, int decimals)
{
    const auto nearest_to = [&](double number) {
        return parse_number(fmt::format("{:.{}f}", number, decimals)).value;
    };
    const double nearest = nearest_to(value);
    return nearest <= value ? nearest : nearest_to(nearest - std::pow(10, -decimals));
}

std::vector<VerdictInterval> intervals_of(const VerdictRanges& ranges, Verdict verdict,
                                          std::size_t most)
{
    std::vector<VerdictInterval> shown =
        mapped(ranges.with(verdict), [](const VerdictRange& range) {
            return VerdictInterval{range.first, range.last};
        });
    const bool reaches_end = !shown.empty() && shown.back().last == ranges.end_of_search();
    const auto gap_after = [&](std::size_t i) { return shown[i + 1].first / shown[i].last; };
    while (shown.size() > most) {
        std::size_t closest = 0;
        for (std::size_t i = 1; i + 1 + std::size_t(reaches_end) < shown.size(); ++i) {
            closest = gap_after(i) < gap_after(closest) ? i : closest;
        }
        shown[closest] = joined(shown[closest], shown[closest + 1]);
        shown.erase(shown.begin() + std::ptrdiff_t(closest) + 1);
    }
    return shown;
}

std::string text_of(const VerdictRanges& ranges, int decimals, std::size_t most,
                    std::string_view unit)
{
    const auto list_of = [&](Verdict verdict) {
        const auto texts = mapped(
            rounded(intervals_of(ranges, verdict, most), decimals),
            [&](const VerdictInterval& each) { return text_of(each, ranges.all, decimals, unit); });
        return fmt::format("{}", fmt::join(texts, ", "));
    };
    std::string text = list_of(Verdict::topples);
    const std::string undecided = list_of(Verdict::undecided);
    text = text.empty() ? "none" : text;
    text += undecided.empty() ? "" : "; undecided: " + undecided;
    const double first = ranges.all.front().first;
    text += fmt::format(", searched {}up to {}{}", first == 0 ? "" : fmt::format("from {} ", first),
                        rounded_down(ranges.end_of_search(), 6), unit);
    if (const auto& coarse = ranges.coarse) {
        text += fmt::format(", from {:.{}f} to {:.{}f}{} only in steps of up to {:.2g} %",
                            rounded_down(coarse->first, decimals), decimals,
                            rounded_up(coarse->last, decimals), decimals, unit, 100 * coarse->step);
    }
    return text;
}

int decimals_of(const VerdictRanges& ranges, double value)
{
    constexpr int most_for_ends = 7; // narrow ranges would need more
    std::vector<double> ends;
    for (const Verdict verdict : {Verdict::topples, Verdict::undecided}) {
        for (const VerdictInterval& interval : intervals_of(ranges, verdict)) {
            ends.insert(ends.end(), {interval.first, interval.last});
        }
    }
    std::ranges::sort(ends);
    int decimals = 4;
    const auto look_the_same = [&](double a, double b) {
        return a != b && rounded_down(a, decimals) == rounded_down(b, decimals);
    };
    const auto are_unclear = [&] {
        return std::ranges::any_of(ends, [&](double end) { return look_the_same(end, value); }) ||
               (decimals < most_for_ends &&
                std::ranges::adjacent_find(ends, look_the_same) != ends.end());
    };
    while (decimals < std::numeric_limits<double>::digits10 && are_unclear()) {
        ++decimals;
    }
    return decimals;
}

std::string verdict_sentence(const ToppleAnswer& answer, const std::optional<double>& scale,
                             std::string_view place)
{
    const bool is_scale = scale.has_value();
    const Asked asked{scale.value_or(answer.pga), answer.pga, is_scale ? answer.unit : 1, is_scale};
    std::string text =
        fmt::format("{} at {} {}", text_of(*answer.verdict), asked.value, asked.unit_text());
    if (is_scale) {
        text += fmt::format(", {:.{}f} g", answer.pga,
                            decimals_of(answer.requested().ranges, answer.pga));
    }
    text += place;
    if (answer.verdict == Verdict::topples) {
        return text;
    }
    const VerdictRanges& ranges = answer.requested().ranges;
    const bool is_end = ranges.are_searched() && answer.pga >= ranges.end_of_search();
    return text + text_of_nearest(answer, asked) +
           (is_end ? "; larger accelerations are not searched" : "") +
           text_of_worst_restitution(answer, asked);
}

std::string peak_text(double peak, const Problem& problem)
{
    const auto slenderness = only_slenderness_of(problem);
    return std::isnan(peak)   ? "undecided"
           : std::isinf(peak) ? "the block overturns"
           : peak == 0        ? (problem.grid.may_slip() ? "0: the block is not lifted"
                                                         : "0: the block is not lifted and stays at rest")
           : slenderness      ? fmt::format("{:.4g} degrees, {:.3g} % of alpha",
                                            in_degrees(peak * *slenderness), 100 * peak)
                              : fmt::format("{:.3g} % of alpha of its side", 100 * peak);
}

std::string slide_text(double slide, double slide_peak, const std::optional<double>& size)
{
    const auto length = [&](double over_size) {
        return size ? fmt::format("{:.3g} mm", 1000 * *size * over_size)
                    : fmt::format("{:.3g} R", over_size);
    };
    if (std::isnan(slide)) {
        return "how far it slides is unknown";
    }
    if (slide_peak == 0) {
        return "does not slip";
    }
    const bool returns = std::abs(slide) < 1e-6 * slide_peak;
    return fmt::format("slides {}, at most {} away",
                       returns ? "and returns" : length(std::abs(slide)), length(slide_peak));
}

} // namespace overturn
