// Which runs the outcomes of points need: with more digits, with the contact, or with slip.
#include "point_run.hpp"

#include <algorithm>

namespace overturn {

namespace {

/// What the contact bears is unknown without a verdict.
void judge_contact(Outcome& outcome, bool is_known)
{
    outcome.friction_demand = is_known ? outcome.friction_demand : unknown_value;
    outcome.normal = is_known ? outcome.normal : unknown_value;
    outcome.to_stick = is_known ? outcome.to_stick : unknown_value;
    if (outcome.normal <= 0) {
        outcome.flags |= status::lifts_off;
    }
}

/// Sets what the contact must bear during the ground motion and after it, by a run of its own; the
/// normal force over that at rest, and status::lifts_off. NaN for points without a verdict, and
/// where this run has another region than these outcomes. Only in the nonlinear theory.
void add_contact(const PointRun& points, Outcomes& outcomes)
{
    const bool is_sensitive = points.scene().motion_traits().is_sensitive;
    Outcomes watched(points.size(), {.error = is_sensitive,
                                     .contact = true,
                                     .region = true,
                                     .margin = is_sensitive,
                                     .slide = points.has_friction()});
    points.run(most_accurate, watched, points.all());
    if (is_sensitive) {
        std::vector<int> in_doubt = points.all();
        std::erase_if(in_doubt, [&](int i) { return !watched[i].has(outcome_flag::in_doubt); });
        points.run_in_31_digits(watched, in_doubt);
    }
    for (int i = 0; i < points.size(); ++i) {
        outcomes[i].friction_demand = watched[i].friction_demand;
        outcomes[i].normal = watched[i].normal;
        outcomes[i].to_stick = watched[i].to_stick;
        // The motion may be so sensitive that this run has another end than the one of the verdict.
        judge_contact(outcomes[i], watched[i].region == outcomes[i].region &&
                                       watched[i].region != Region::undecided);
    }
}

} // namespace

Outcomes outcomes_of(const PointRun& points, const Numerics& numerics, const Outputs& outputs,
                     int most_in_50_digits)
{
    Outputs computed = outputs;
    computed.error = outputs.error || numerics.resolve;
    computed.margin = outputs.margin || numerics.resolve;
    computed.steps = outputs.steps || numerics.resolve; // see is_short()
    const bool wants_contact = outputs.contact || points.has_friction();
    computed.slide = points.has_friction();
    computed.region = outputs.region || wants_contact;
    // More digits may give another verdict, and do not see the contact.
    computed.contact = wants_contact && !numerics.resolve;
    // An integration that is accurate enough for a verdict may be inaccurate for a peak, whose
    // error has no bound. Filling, which alone asks for grazes, only compares the peaks of nodes.
    const bool stores_peaks = outputs.peak && !outputs.grazes;
    computed.peak = outputs.peak && (stores_peaks || !numerics.resolve);
    Outcomes outcomes(points.size(), computed);
    std::vector<int> chosen = points.all();
    if (points.has_friction() && !outputs.contact) {
        std::erase_if(chosen, [&](int point) {
            outcomes[point] = at_rest;
            return stays_flat(points.point(point));
        });
    }
    points.run(numerics.resolve && stores_peaks ? most_accurate : numerics, outcomes, chosen,
               numerics.resolve ? UncertainImpact::stop : UncertainImpact::go_on);
    if (numerics.resolve) {
        resolve(points, most_in_50_digits, outcomes);
        if (wants_contact) {
            add_contact(points, outcomes);
        }
        if (outputs.grazes) { // of nodes of one accuracy
            Outcomes of_nodes(points.size(), {.peak = true, .grazes = true});
            points.run(numerics, of_nodes, points.all());
            for (int i = 0; i < points.size(); ++i) {
                outcomes[i].peak = of_nodes[i].peak;
                outcomes[i].lowest_turn = of_nodes[i].lowest_turn;
                outcomes[i].softest_impact = of_nodes[i].softest_impact;
                outcomes[i].last_impact = of_nodes[i].last_impact;
            }
        }
    } else if (wants_contact) {
        for (int i = 0; i < points.size(); ++i) {
            judge_contact(outcomes[i], outcomes[i].region != Region::undecided);
        }
    }
    if (points.has_friction()) {
        points.let_slip(numerics, outputs, outcomes);
    }
    return outcomes;
}

} // namespace overturn
