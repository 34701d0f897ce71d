#include "overturn/answers/job_lines.hpp"
#include "overturn/answers/json.hpp"
#include "overturn/answers/ranges_text.hpp"
#include "overturn/answers/topple.hpp"

#include <cmath>

namespace overturn {

namespace {

/// The ranges of a verdict, from the first to the last value.
Json all_ranges_with(const VerdictRanges& ranges, Verdict verdict)
{
    Json list = Json::array();
    for (const VerdictRange& range : ranges.with(verdict)) {
        list.push_back({range.first, range.last});
    }
    return list;
}

/// The same of accelerations. Toppling may go on at the end of the search, where null stands.
Json ranges_with(const VerdictRanges& ranges, Verdict verdict)
{
    Json list = all_ranges_with(ranges, verdict);
    if (verdict == Verdict::topples && ranges.all.back().verdict == verdict) {
        list.back()[1] = Json();
    }
    return list;
}

/// The toppling ranges as in the text, not rounded.
Json toppling_intervals(const VerdictRanges& ranges)
{
    Json list = Json::array();
    for (const auto& [first, last, share] : intervals_of(ranges, Verdict::topples)) {
        Json interval;
        interval["first"] = first;
        interval["last"] = last == ranges.end_of_search() ? Json() : Json(last); // it may go on
        interval["share"] = share;
        list.push_back(std::move(interval));
    }
    return list;
}

/// null if it is undecided, or not known.
Json topples(const std::optional<Verdict>& verdict)
{
    return verdict.value_or(Verdict::undecided) == Verdict::undecided
               ? Json()
               : Json(verdict == Verdict::topples);
}

void add_coarse(Json& members, const VerdictRanges& ranges)
{
    Json& coarse = members["coarse_search"];
    if (ranges.coarse) {
        coarse["first"] = ranges.coarse->first;
        coarse["last"] = ranges.coarse->last;
        coarse["step"] = ranges.coarse->step;
    }
}

/// Adds the answer for a restitution. pga: the asked acceleration, if any.
void add(Json& members, const RestitutionAnswer& answer, const std::optional<double>& pga)
{
    const VerdictRanges& ranges = answer.ranges;
    members["restitution"] = answer.ratio;
    members["restitution_of_maximum"] = answer.share;
    if (!ranges.are_searched()) {
        for (const char* name : {"toppling_pga_below", "toppling_pga_above", "toppling_pga",
                                 "safe_pga", "undecided_pga", "toppling_intervals",
                                 "undecided_share", "end_of_search", "coarse_search"}) {
            members[name] = Json();
        }
        return;
    }
    members["toppling_pga_below"] =
        pga ? if_known(ranges.nearest_below(Verdict::topples, *pga)) : Json();
    members["toppling_pga_above"] =
        pga ? if_known(ranges.nearest_above(Verdict::topples, *pga)) : Json();
    members["toppling_pga"] = ranges_with(ranges, Verdict::topples);
    members["safe_pga"] = ranges_with(ranges, Verdict::safe);
    members["undecided_pga"] = ranges_with(ranges, Verdict::undecided);
    members["toppling_intervals"] = toppling_intervals(ranges);
    members["undecided_share"] = ranges.undecided_share();
    members["end_of_search"] = ranges.end_of_search();
    add_coarse(members, ranges);
}

/// Adds the ranges of a varied quantity.
void add(Json& members, const VerdictRanges& ranges)
{
    members["topples"] = all_ranges_with(ranges, Verdict::topples);
    members["safe"] = all_ranges_with(ranges, Verdict::safe);
    members["undecided"] = all_ranges_with(ranges, Verdict::undecided);
    Json& changes = members["changes"] = Json::array();
    for (std::size_t i = 1; i < ranges.all.size(); ++i) {
        changes.push_back(ranges.all[i].first);
    }
    members["safe_from"] = if_known(ranges.safe_from());
    members["safe_up_to"] = if_known(ranges.safe_up_to());
    members["undecided_share"] = ranges.undecided_share();
    add_coarse(members, ranges);
}

/// Adds what depends on the direction. verdict: the sentence, if a strength is asked for.
void add(Json& members, const DirectedAnswer& directed, const std::string* verdict)
{
    const auto& [job, history, answer] = directed;
    const auto alpha = only_slenderness_of(job.problem);
    const auto pga = verdict != nullptr ? std::optional(answer.pga) : std::nullopt;
    members["direction"] = answer.direction;
    members["verdict"] = pga ? Json(*verdict) : Json();
    members["topples"] = topples(answer.verdict);
    members["pga"] = if_known(pga);
    members["peak_of_alpha"] = pga ? Json(answer.peak) : Json();
    members["peak_degrees"] = pga && alpha ? Json(in_degrees(answer.peak * *alpha)) : Json();
    members["friction_demand"] = if_known(answer.friction_demand);
    members["lifts_off"] = answer.friction_demand && std::isinf(*answer.friction_demand);
    const bool is_searched = answer.requested().ranges.are_searched();
    members["friction_to_topple"] = is_searched ? Json(answer.friction_to_topple) : Json();
    members["lifting_pga"] = answer.lifting_pga;
    Json& slip = members["slip"];
    if (answer.slip) {
        slip["friction"] = answer.slip->friction;
        slip["stays_flat"] = answer.slip->stays_flat;
        slip["moving_pga"] = answer.slip->moving_pga;
        slip["slide_over_size"] = pga ? Json(answer.slip->slide) : Json();
        slip["slide_peak_over_size"] = pga ? Json(answer.slip->slide_peak) : Json();
        slip["topples_without_slip"] = topples(answer.slip->without);
    }
    add(members, answer.requested(), pga);
    Json& others = members["by_restitution"] = is_searched ? Json::array() : Json();
    for (std::size_t i = 1; i < answer.by_restitution.size(); ++i) {
        add(others.emplace_back(), answer.by_restitution[i], pga);
    }
}

Json motion_of(const Job& job, const ToppleRequest& request)
{
    Json json;
    if (const auto pulse = job.problem.scene.named_pulse()) {
        json["pulse"] = pulse->name;
        json["period"] = *request.period;
        for (const auto& [name, value] : pulse->numbers) {
            json[name.data()] = value;
        }
        if (job.shape) {
            json["shape"] = job.shape->file;
            json["shape_peak"] = job.shape->peak;
        }
    } else {
        const RecordedMotion& motion = job.motions.front();
        json["record"] = motion.file;
        json["component"] = motion.component;
        json["second_component"] = if_named(motion.second);
        json["vertical"] = if_named(motion.vertical);
        json["uncorrected"] = motion.is_uncorrected;
    }
    return json;
}

/// The block and its motion, whatever the direction.
Json members_of(const Job& job, const ToppleRequest& request)
{
    const Scene& scene = job.problem.scene;
    Json members;
    members["block"] = request.block;
    members["motion"] = motion_of(job, request);
    members["motion_of"] = name_of(scene.motion_of);
    members["theory"] = name_of(scene.theory);
    members["gravity"] = scene.gravity;
    const bool is_searched = !request.without_search;
    members["narrower_ranges_exist"] =
        is_searched && scene.motion_traits().is_sensitive ? Json(true) : Json();
    members["warnings"] = warnings_on(job);
    return members;
}

} // namespace

std::string json_of(const std::vector<DirectedAnswer>& all, const ToppleRequest& request)
{
    const std::vector<std::string> verdicts = verdict_sentences(all, request);
    const auto verdict = [&](std::size_t i) { return verdicts.empty() ? nullptr : &verdicts[i]; };
    const Job& job = all.front().job;
    Json members = members_of(job, request);
    std::vector<const char*> names{"slenderness", "frequency_parameter"};
    if (!only_slenderness_of(job.problem)) {
        names = {"slenderness_plus", "slenderness_minus", "frequency_parameter",
                 "frequency_parameter_minus", "incline"};
    }
    for (const char* name : names) {
        members[name] = extent_of(job, name)->first;
    }
    members["pga_max"] = request.without_search ? Json() : Json(request.pga_max);
    add(members, all.front(), verdict(0));
    Json& directions = members["by_direction"];
    for (std::size_t i = 0; i < all.size(); ++i) {
        add(directions.emplace_back(), all[i], verdict(i));
    }
    return text_of(members);
}

std::string json_of(const std::vector<DirectedRanges>& all, const ToppleRequest& request)
{
    const auto& [quantity, first, last] = *request.vary;
    const VerdictRanges worst = worst_of(all);
    Json members = members_of(all.front().job, request);
    members["pga"] = if_known(request.pga);
    members["scale"] = if_known(request.scale);
    members["vary"] = quantity->name;
    members["units"] = quantity->units;
    members["first"] = first;
    members["last"] = last;
    members["step"] = step_of_search(all.front().job.problem.scene, *request.vary);
    members["verdict"] = sentence_of(worst, request);
    add(members, worst);
    Json& directions = members["by_direction"];
    for (const DirectedRanges& each : all) {
        Json& direction = directions.emplace_back();
        direction["direction"] = each.direction;
        add(direction, each.ranges);
    }
    return text_of(members);
}

} // namespace overturn
