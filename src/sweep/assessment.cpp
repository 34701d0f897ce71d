#include "overturn/sweep/assessment.hpp"

#include "toppling_strengths.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/given.hpp"
#include "overturn/sweep/in_threads.hpp"
#include "overturn/sweep/toppling.hpp"
#include "overturn/text/mapped.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <tuple>

namespace overturn {

namespace {

/// The place of a point of a grid along its dimensions, of which the last one is the fastest.
Shape place_of(std::int64_t point, const Shape& shape)
{
    Shape place(shape.size());
    for (std::size_t i = shape.size(); i-- > 0;) {
        place[i] = point % shape[i];
        point /= shape[i];
    }
    return place;
}

/// Sets the verdicts at the asked strength. points: of the cases; sizes: R of each row [m].
void judge(const Problem& problem, const std::vector<std::size_t>& points,
           const std::vector<double>& sizes, int threads, std::vector<ObjectCase>& cases)
{
    const std::vector<double> peaks = accurate_values(problem, Field::peak, threads);
    const std::vector<double> slides = problem.grid.may_slip()
                                           ? accurate_values(problem, Field::slide_peak, threads)
                                           : std::vector<double>(peaks.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        ObjectCase& each = cases[i];
        each.peak = peaks[points[i]];
        each.verdict = verdict_of_peak(each.peak);
        const double slide = slides[points[i]];
        each.slide = slide == 0 ? 0 : slide * sizes[std::size_t(each.row)];
    }
}

std::optional<double> lesser_of(const std::optional<double>& one, const std::optional<double>& two)
{
    return one && two ? std::min(*one, *two) : one ? one : two;
}

double lowest_not_safe(const ObjectCase& each)
{
    return lesser_of(each.toppling_pga, each.undecided_pga).value_or(infinity);
}

/// Less for weaker ones.
std::tuple<int, double> weakness(const ObjectCase& each)
{
    return {-int(each.verdict.value_or(Verdict::safe)), lowest_not_safe(each)};
}

ObjectCase worst_of(std::span<const ObjectCase> cases)
{
    ObjectCase worst = *std::ranges::min_element(cases, {}, weakness);
    for (const ObjectCase& each : cases) {
        worst.lifting_pga = std::min(worst.lifting_pga, each.lifting_pga);
        worst.moving_pga = std::min(worst.moving_pga, each.moving_pga);
        worst.toppling_pga = lesser_of(worst.toppling_pga, each.toppling_pga);
        worst.undecided_pga = lesser_of(worst.undecided_pga, each.undecided_pga);
        worst.end_of_search = std::min(worst.end_of_search, each.end_of_search);
        worst.pga = std::max(worst.pga, each.pga);
        worst.factor_below = std::max(worst.factor_below, each.factor_below);
        worst.factor_above = std::min(worst.factor_above, each.factor_above);
        worst.peak = worst.peak < each.peak ? each.peak : worst.peak; // NaN and infinity remain
        worst.slide = std::isnan(each.slide) ? unknown_value : std::max(worst.slide, each.slide);
    }
    return worst;
}

/// The cases of objects of several rows, which are azimuths.
std::vector<ObjectCase> joined(const std::vector<ObjectCase>& cases,
                               std::span<const PartOfObject> parts, std::size_t table)
{
    std::map<std::tuple<PartOfObject, Shape>, std::vector<ObjectCase>> azimuths;
    for (const ObjectCase& each : cases) {
        Shape motion = each.place;
        motion[table] = 0;
        azimuths[{parts[std::size_t(each.row)], motion}].push_back(each);
    }
    return mapped(azimuths, [](const auto& of_motion) { return worst_of(of_motion.second); });
}

} // namespace

std::vector<ObjectCase> cases_of(const Problem& problem, const AssessmentQuestion& question)
{
    const Scene& scene = problem.scene;
    const Coordinates coordinates(scene, problem.grid);
    const auto table = std::size_t(problem.grid.table() - problem.grid.dimensions.data());
    const char* const size = coordinates.has("size") ? "size" : "size_plus";
    const std::vector<double> sizes =
        coordinates.has(size)
            ? coordinates.along({table}, size)
            : std::vector<double>(std::size_t(problem.grid.table()->size()), unknown_value);
    const std::vector<Point> points = coordinates.points();
    const Shape shape = problem.grid.shape();
    std::vector<std::size_t> chosen;
    std::vector<ObjectCase> cases;
    std::vector<bool> has_original(points.size(), false); // of each row
    const auto row_of = [&](std::size_t point) {
        return std::size_t(place_of(std::int64_t(point), shape)[table]);
    };
    const auto is_mirror_image = [&](const Point& point) {
        return std::signbit(point.amplitude) && !scene.has_two_components();
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        has_original[row_of(i)] = has_original[row_of(i)] || !is_mirror_image(points[i]);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point& point = points[i];
        const std::size_t row = row_of(i);
        const bool is_repeated =
            is_mirror_image(point) && point.block.is_symmetric() && has_original[row];
        if (is_repeated && question.parts.empty()) {
            continue;
        }
        chosen.push_back(i);
        cases.push_back(
            {.object = question.parts.empty() ? std::int64_t(row) : question.parts[row].object,
             .row = std::int64_t(row),
             .place = place_of(std::int64_t(i), shape)});
    }
    if (question.has_strength) {
        judge(problem, chosen, sizes, question.threads, cases);
    }
    in_threads(
        cases.size(), question.threads,
        [&](std::size_t i) {
            ObjectCase& each = cases[i];
            const Point& point = points[chosen[i]];
            const double unit = pga_of_unit(scene, point);
            each.pga = std::abs(point.amplitude) * unit;
            each.lifting_pga = lifting_pga(scene, point);
            each.moving_pga = moving_pga(scene, point);
            const bool topples = each.verdict == Verdict::topples;
            const TopplingStrengths found =
                toppling_strengths(scene, {point, std::signbit(point.amplitude) ? -unit : unit},
                                   {.lifting = each.lifting_pga,
                                    .end = std::max(question.pga_max, each.pga),
                                    .asked = each.pga,
                                    .topples_at_asked = topples,
                                    .is_fine = question.is_fine});
            each.toppling_pga = found.lowest;
            each.undecided_pga = found.undecided;
            each.end_of_search = found.end;
            if (topples && !(found.lowest && *found.lowest <= each.pga)) {
                each.toppling_pga = each.pga; // the search missed a narrow range
            }
            if (question.has_strength && !topples) {
                each.factor_below = found.below.value_or(0) / each.pga;
                each.factor_above = found.above.value_or(infinity) / each.pga;
            }
        },
        [&](std::size_t done) {
            if (question.progress) {
                question.progress(done, cases.size());
            }
        });
    if (!question.parts.empty()) {
        cases = joined(cases, question.parts, table);
    }
    std::ranges::stable_sort(cases, {}, &ObjectCase::object);
    return cases;
}

namespace {

/// The smallest strength up to which this share of the ascending strengths lies; nullopt if it is
/// infinite.
std::optional<double> order_statistic(const std::vector<double>& ascending, double share)
{
    const auto count = std::size_t(std::ceil(share * double(ascending.size()) - 1e-9));
    const double value = ascending[std::max<std::size_t>(count, 1) - 1];
    return std::isinf(value) ? std::nullopt : std::optional(value);
}

ObjectAnswer answer_of_cases(std::span<const ObjectCase> cases)
{
    ObjectAnswer answer{worst_of(cases)};
    std::vector<double> not_safe;
    for (const ObjectCase& each : cases) {
        not_safe.push_back(lowest_not_safe(each));
        answer.toppling += each.verdict == Verdict::topples;
        answer.undecided += each.verdict == Verdict::undecided;
        ++answer.cases;
    }
    if (answer.toppling_pga && answer.undecided_pga >= answer.toppling_pga) {
        answer.undecided_pga.reset();
    }
    std::ranges::sort(not_safe);
    answer.median = order_statistic(not_safe, 0.5);
    answer.percentile_16 = order_statistic(not_safe, 0.16);
    return answer;
}

} // namespace

std::vector<ObjectAnswer> answers_of(const std::vector<ObjectCase>& cases)
{
    std::vector<ObjectAnswer> answers;
    for (std::size_t first = 0; first < cases.size();) {
        std::size_t next = first;
        while (next < cases.size() && cases[next].object == cases[first].object) {
            ++next;
        }
        answers.push_back(answer_of_cases({cases.data() + first, next - first}));
        first = next;
    }
    const auto rank = [](const ObjectAnswer& answer) {
        return std::tuple(weakness(answer), answer.moving_pga, answer.object);
    };
    std::ranges::sort(answers, {}, rank);
    return answers;
}

std::optional<LeastWidths> least_widths_of(const Problem& problem,
                                           std::span<const ObjectCase> cases, int threads)
{
    const Quantity& width = quantity("width");
    const Column* const widths = problem.grid.find("width");
    if (widths == nullptr) {
        return std::nullopt;
    }
    std::vector<QuantityLine> lines;
    for (const ObjectCase& each : cases) {
        lines.push_back(line_along(width, problem.grid, each.place));
    }
    const auto is_possible = [&](double value) {
        std::vector<Given> given{{&width, "width", Axis(AxisList{value}), GivenAs::number}};
        for (const Column& number : lines.front().others.numbers) {
            given.push_back({number.quantity, "", number.values, GivenAs::number});
        }
        try {
            grid_of(problem.scene, std::move(given));
            return true;
        } catch (const GivenError&) {
            return false;
        }
    };
    const bool is_number = widths->values.size() == 1;
    const double own = widths->values[is_number ? 0 : cases.front().object];
    LeastWidths least{.object = cases.front().object,
                      .width = own,
                      .end = 3 * own,
                      .safe_from = std::vector<double>(cases.size())};
    while (!is_possible(least.end) && least.end > 1.01 * own) {
        least.end = std::midpoint(own, least.end);
    }
    if (!is_possible(least.end)) {
        return std::nullopt;
    }
    in_threads(lines.size(), threads, [&](std::size_t i) {
        const auto safe_between = [&](double first, double last) {
            return verdict_ranges(problem.scene, lines[i], first, last).safe_from().value_or(last);
        };
        double from = safe_between(own, least.end);
        while (from < least.end) { // some above may topple in ranges narrower than the steps
            const double last = std::min(from * (1 + range_of_finer_search), least.end);
            const double finer = safe_between(from, last);
            if (!(finer > from)) {
                break;
            }
            from = finer;
        }
        least.safe_from[i] = from < least.end ? from : infinity;
    });
    std::ranges::sort(least.safe_from);
    return least;
}

} // namespace overturn
