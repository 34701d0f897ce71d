#include "overturn/sweep/assessment.hpp"

#include "point_run.hpp"

#include "overturn/problem/coordinates.hpp"
#include "overturn/problem/given.hpp"
#include "overturn/sweep/in_threads.hpp"
#include "overturn/sweep/toppling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <tuple>

namespace overturn {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Verdicts close to a flip need more digits. Of a block that may slip, of which there are none,
/// only the verdict at the asked strength is confirmed.
Numerics numerics_of_search(const Point& point)
{
    const bool may_slip = std::isfinite(point.friction);
    Numerics numerics;
    numerics.method = Method::taylor;
    numerics.resolve = !may_slip;
    numerics.tolerance = may_slip ? numerics.tolerance : tolerance_to_resolve_from;
    return numerics;
}

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

/// Sets the verdicts at the asked strength.
/// sizes: R of each case [m].
void judge(const Problem& problem, const std::vector<std::size_t>& points,
           const std::vector<double>& sizes, int threads, std::vector<ObjectCase>& cases)
{
    const std::vector<double> peaks = accurate_values(problem, Field::peak, threads);
    const std::vector<double> slides = problem.grid.may_slip()
                                           ? accurate_values(problem, Field::slide_peak, threads)
                                           : std::vector<double>();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        ObjectCase& each = cases[i];
        each.peak = peaks[points[i]];
        each.verdict = verdict_of_peak(each.peak);
        const double slide = slides.empty() ? 0 : slides[points[i]];
        each.slide = slide == 0 ? 0 : slide * sizes[i];
    }
}

using VerdictsAt = std::function<std::vector<Verdict>(std::span<const double> accelerations)>;

/// The first acceleration of a scan, which ascends or descends, at which the block topples.
struct FirstToppling {
    std::optional<double> pga;       ///< at most `width_of_lowest` before it, the block is safe
    std::optional<double> undecided; ///< the first one before it that could not be settled
};

/// safe: an acceleration before those of the scan.
FirstToppling first_toppling(const VerdictsAt& verdicts_at, std::span<const double> scan,
                             double safe)
{
    FirstToppling first;
    constexpr std::size_t at_once = 32;
    for (std::size_t begin = 0; begin < scan.size() && !first.pga; begin += at_once) {
        const auto part = scan.subspan(begin, std::min(at_once, scan.size() - begin));
        const std::vector<Verdict> verdicts = verdicts_at(part);
        for (std::size_t i = 0; i < part.size() && !first.pga; ++i) {
            if (verdicts[i] == Verdict::topples) {
                first.pga = part[i];
            } else if (verdicts[i] == Verdict::safe) {
                safe = part[i];
            } else if (!first.undecided) {
                first.undecided = part[i];
            }
        }
    }
    // In steps of a ninth, as many as a pack has lanes at once.
    while (first.pga &&
           std::abs(*first.pga - safe) > width_of_lowest * std::min(*first.pga, safe)) {
        std::vector<double> between;
        for (int i = 1; i <= 8; ++i) {
            between.push_back(safe + (*first.pga - safe) * i / 9);
        }
        const std::vector<Verdict> verdicts = verdicts_at(between);
        bool has_settled = false;
        for (std::size_t i = 0; i < between.size(); ++i) {
            if (verdicts[i] == Verdict::topples) {
                first.pga = between[i];
                has_settled = true;
                break;
            }
            if (verdicts[i] == Verdict::safe) {
                safe = between[i];
                has_settled = true;
            }
        }
        if (!has_settled) {
            first.undecided = first.undecided.value_or(between.front());
            break;
        }
    }
    return first;
}

/// In steps of at most `toppling_step`.
TopplingStrengths strengths_in_steps(const Scene& scene, const BoundaryLine& line,
                                     const StrengthSearch& search, double end)
{
    const double lifting = search.lifting;
    std::vector<double> scan = scanned_accelerations(scene, lifting, end, search.asked);
    const double steps = std::ceil(std::log(end / lifting) / toppling_step);
    for (double i = 1; i < steps; ++i) {
        scan.push_back(lifting * std::pow(end / lifting, i / steps));
    }
    std::ranges::sort(scan);
    const Numerics numerics = numerics_of_search(line.point);
    const VerdictsAt verdicts_at = [&](std::span<const double> accelerations) {
        std::vector<Point> points(accelerations.size(), line.point);
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i].amplitude = accelerations[i] / line.unit;
        }
        const PointRun run(scene, std::move(points), widest_kernel());
        const Outcomes outcomes = outcomes_of(run, numerics, {.region = true}, 0);
        std::vector<Verdict> verdicts(accelerations.size());
        for (std::size_t i = 0; i < verdicts.size(); ++i) {
            verdicts[i] = verdict_of(outcomes[i].region);
        }
        return verdicts;
    };
    TopplingStrengths strengths{.end = end};
    const FirstToppling lowest = first_toppling(verdicts_at, scan, lifting);
    strengths.lowest = lowest.pga;
    strengths.undecided = lowest.undecided;
    if (search.topples_at_asked || !lowest.pga || *lowest.pga > search.asked) {
        strengths.above = lowest.pga;
        return strengths;
    }
    const std::span<const double> all(scan);
    const auto place = std::size_t(std::ranges::lower_bound(scan, search.asked) - scan.begin());
    std::vector<double> downwards(scan.rend() - std::ptrdiff_t(place), scan.rend());
    strengths.below = first_toppling(verdicts_at, downwards, search.asked).pga;
    strengths.above = first_toppling(verdicts_at, all.subspan(place), search.asked).pga;
    return strengths;
}

std::optional<double> lesser_of(const std::optional<double>& one, const std::optional<double>& two)
{
    return one && two ? std::min(*one, *two) : one ? one : two;
}

double lowest_not_safe(const std::optional<double>& toppling,
                       const std::optional<double>& undecided)
{
    return lesser_of(toppling, undecided).value_or(infinity);
}

/// NaN if one of them is.
double larger_of(double one, double two)
{
    return one < two || std::isnan(two) ? two : one;
}

/// Less for weaker ones.
std::tuple<int, double> weakness(const ObjectCase& each)
{
    return {-int(each.verdict.value_or(Verdict::safe)),
            lowest_not_safe(each.strengths.lowest, each.strengths.undecided)};
}

/// Adds another azimuth of the same object under the same motion.
void add_azimuth(ObjectCase& all, const ObjectCase& other)
{
    if (weakness(other) < weakness(all)) {
        all.row = other.row;
        all.place = other.place;
        all.point = other.point;
    }
    TopplingStrengths& strengths = all.strengths;
    strengths.lowest = lesser_of(strengths.lowest, other.strengths.lowest);
    strengths.undecided = lesser_of(strengths.undecided, other.strengths.undecided);
    strengths.end = std::min(strengths.end, other.strengths.end);
    all.lifting_pga = std::min(all.lifting_pga, other.lifting_pga);
    all.moving_pga = std::min(all.moving_pga, other.moving_pga);
    all.pga = std::max(all.pga, other.pga);
    all.factor_below = std::max(all.factor_below, other.factor_below);
    all.factor_above = std::min(all.factor_above, other.factor_above);
    all.slide = larger_of(all.slide, other.slide);
    if (all.verdict) {
        all.verdict = std::max(*all.verdict, *other.verdict);
        all.peak = all.verdict == Verdict::topples     ? infinity
                   : all.verdict == Verdict::undecided ? unknown
                                                       : std::max(all.peak, other.peak);
    }
}

/// The cases of objects of several rows.
std::vector<ObjectCase> joined(const std::vector<ObjectCase>& cases,
                               std::span<const PartOfObject> parts, std::size_t table)
{
    std::map<std::tuple<PartOfObject, Shape>, ObjectCase> of_objects;
    for (const ObjectCase& each : cases) {
        Shape motion = each.place;
        motion[table] = 0;
        const PartOfObject part = parts[std::size_t(each.row)];
        const auto [place, is_new] = of_objects.try_emplace({part, motion}, each);
        if (is_new) {
            place->second.object = part.object;
        } else {
            add_azimuth(place->second, each);
        }
    }
    std::vector<ObjectCase> all;
    all.reserve(of_objects.size());
    for (const auto& [key, each] : of_objects) {
        all.push_back(each);
    }
    return all;
}

} // namespace

TopplingStrengths toppling_strengths(const Scene& scene, const BoundaryLine& line,
                                     const StrengthSearch& search)
{
    const double end = std::min(search.end, last_before_free_fall(scene, line));
    if (!(search.lifting < end)) {
        return {.end = end};
    }
    if (!search.is_fine) {
        return strengths_in_steps(scene, line, search, end);
    }
    const VerdictRanges ranges =
        verdict_ranges(scene, line, search.lifting, search.end, search.asked, nullptr);
    return {.lowest = ranges.nearest_above(Verdict::topples, 0),
            .undecided = ranges.nearest_above(Verdict::undecided, 0),
            .end = ranges.end_of_search(),
            .below = ranges.nearest_below(Verdict::topples, search.asked),
            .above = ranges.nearest_above(Verdict::topples, search.asked)};
}

std::vector<ObjectCase> cases_of(const Problem& problem, const AssessmentQuestion& question)
{
    const Scene& scene = problem.scene;
    const Coordinates coordinates(scene, problem.grid);
    const auto table = std::size_t(problem.grid.table() - problem.grid.dimensions.data());
    const char* const size = coordinates.has("size") ? "size" : "size_plus";
    const std::vector<double> sizes =
        coordinates.has(size) ? coordinates.along({table}, size) : std::vector<double>();
    const std::vector<Point> points = coordinates.points();
    const Shape shape = problem.grid.shape();
    std::vector<std::size_t> chosen;
    std::vector<double> size_of_case;
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
        size_of_case.push_back(sizes.empty() ? unknown : sizes[row]);
        cases.push_back({.object = std::int64_t(row),
                         .row = std::int64_t(row),
                         .place = place_of(std::int64_t(i), shape),
                         .point = point});
    }
    if (question.has_strength) {
        judge(problem, chosen, size_of_case, question.threads, cases);
    }
    in_threads(
        cases.size(), question.threads,
        [&](std::size_t i) {
            ObjectCase& each = cases[i];
            const double unit = pga_of_unit(scene, each.point);
            each.pga = std::abs(each.point.amplitude) * unit;
            each.lifting_pga = lifting_pga(scene, each.point);
            each.moving_pga = moving_pga(scene, each.point);
            const double sign = std::signbit(each.point.amplitude) ? -1 : 1;
            each.strengths =
                toppling_strengths(scene, {each.point, sign * unit},
                                   {.lifting = each.lifting_pga,
                                    .end = std::max(question.pga_max, each.pga),
                                    .asked = each.pga,
                                    .topples_at_asked = each.verdict == Verdict::topples,
                                    .is_fine = question.is_fine});
            if (std::optional<double>& lowest = each.strengths.lowest;
                each.verdict == Verdict::topples && !(lowest && *lowest <= each.pga)) {
                lowest = each.pga; // the search missed a narrow range
            }
            if (question.has_strength) {
                each.factor_below = each.strengths.below.value_or(0) / each.pga;
                each.factor_above = each.strengths.above.value_or(infinity) / each.pga;
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
    const auto worst = std::ranges::min_element(cases, {}, weakness);
    ObjectAnswer answer{.object = worst->object,
                        .row = worst->row,
                        .place = worst->place,
                        .lifting_pga = infinity,
                        .moving_pga = infinity,
                        .toppling_pga = {},
                        .undecided_pga = {},
                        .end_of_search = infinity,
                        .median = {},
                        .percentile_16 = {},
                        .verdict = {}};
    std::vector<double> not_safe;
    const bool has_strength = cases.front().verdict.has_value();
    for (const ObjectCase& each : cases) {
        const TopplingStrengths& strengths = each.strengths;
        answer.lifting_pga = std::min(answer.lifting_pga, each.lifting_pga);
        answer.moving_pga = std::min(answer.moving_pga, each.moving_pga);
        answer.toppling_pga = lesser_of(answer.toppling_pga, strengths.lowest);
        answer.undecided_pga = lesser_of(answer.undecided_pga, strengths.undecided);
        answer.end_of_search = std::min(answer.end_of_search, strengths.end);
        not_safe.push_back(lowest_not_safe(strengths.lowest, strengths.undecided));
        ++answer.cases;
        if (has_strength) {
            answer.pga = std::max(answer.pga, each.pga);
            answer.toppling += each.verdict == Verdict::topples;
            answer.undecided += each.verdict == Verdict::undecided;
            if (each.verdict != Verdict::topples) {
                answer.factor_below = std::max(answer.factor_below, each.factor_below);
                answer.factor_above = std::min(answer.factor_above, each.factor_above);
            }
            answer.slides = answer.slides || !(each.slide == 0);
            answer.slide = larger_of(answer.slide, each.slide);
            answer.peak = answer.peak < each.peak ? each.peak : answer.peak;
        }
    }
    if (answer.toppling_pga && answer.undecided_pga &&
        !(*answer.undecided_pga < *answer.toppling_pga)) {
        answer.undecided_pga.reset();
    }
    std::ranges::sort(not_safe);
    answer.median = order_statistic(not_safe, 0.5);
    answer.percentile_16 = order_statistic(not_safe, 0.16);
    if (has_strength) {
        answer.verdict = answer.toppling > 0    ? Verdict::topples
                         : answer.undecided > 0 ? Verdict::undecided
                                                : Verdict::safe;
        answer.peak = answer.verdict == Verdict::undecided ? unknown : answer.peak;
    }
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
        return std::tuple(-int(answer.verdict.value_or(Verdict::safe)),
                          lowest_not_safe(answer.toppling_pga, answer.undecided_pga),
                          answer.moving_pga, answer.object);
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
            return verdict_ranges(problem.scene, lines[i], first, last, nullptr)
                .safe_from()
                .value_or(last);
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
