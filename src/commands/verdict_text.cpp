#include "verdict_text.hpp"

#include "overturn/text/mapped.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace overturn {

namespace {

/// In the order of the enumerators of Verdict.
constexpr std::array<std::string_view, 3> verdict_texts{"does not topple", "topples", "undecided"};

std::string_view text_of(Verdict verdict)
{
    return verdict_texts[std::size_t(verdict)];
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

std::string verdict_sentence(const ToppleAnswer& answer, const std::optional<double>& scale,
                             std::string_view place)
{
    const bool is_scale = scale.has_value();
    const Asked asked{scale.value_or(answer.pga), answer.pga, is_scale ? answer.unit : 1, is_scale};
    std::string text =
        fmt::format("{} at {} {}", text_of(*answer.verdict), asked.value, asked.unit_text());
    if (is_scale) {
        text +=
            fmt::format(", {:.{}f} g", answer.pga, answer.requested().ranges.decimals(answer.pga));
    }
    text += place;
    if (answer.verdict == Verdict::topples) {
        return text;
    }
    const bool is_end = answer.pga >= answer.requested().ranges.end_of_search();
    return text + text_of_nearest(answer, asked) +
           (is_end ? "; larger accelerations are not searched" : "") +
           text_of_worst_restitution(answer, asked);
}

} // namespace overturn
