#include "fill_cell.hpp"

#include "overturn/mechanics/energy_criteria.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace overturn {

namespace {

/// The switch functions of these names.
struct SafetySwitches {
    double outward, inward, back, rebound;
};

SafetySwitches of_symmetric(const SafeRates<double>& safe, double rate, double restitution)
{
    return {safe.outward - rate, safe.inward().distance(rate), 1,
            std::sqrt(restitution) * safe.outward - rate};
}

template <Theory theory>
SafetySwitches of_two_sides(const SafeRates<double>& safe, double tilt, double rate,
                            const Block<double>& block)
{
    const double q_max = safe.largest * safe.largest;
    const double q0 = (safe.outward - rate) * (safe.outward + rate);
    const auto above = [&](const ImpactLimit<double>& limit) {
        return (q0 + limit.minus_q_min) / (q_max + limit.minus_q_min);
    };
    const Block<double> before = block.turned();
    const double outward_before = separatrix_rate<theory>(tilt, before.slenderness);
    const double largest_before = separatrix_rate<theory>(0.0, before.slenderness);
    return {(safe.outward - rate) / safe.largest, above(safe.one), above(safe.two),
            (outward_before - rate / before.rate_ratio()) / largest_before};
}

} // namespace

template <Theory theory>
Node node_of(const PointRun& run, const Outcomes& outcomes, int point)
{
    const auto i = std::size_t(point);
    const Point& at = run.point(point);
    const Block<double> block = run.block_at_end(i, outcomes);
    const bool is_symmetric = block.is_symmetric();
    const SafeRates<double> safe = safe_rates<theory>(outcomes.tilt[i], block);
    const double u = outcomes.rate[i];
    const double slenderness = std::min(block.slenderness, block.other.slenderness);
    const double frequency = at.frequency / std::max(block.pace, block.other.pace); // over p
    Node node{outcomes.region[i],
              outcomes.flags[i],
              0,
              is_symmetric ? 0 : int(outcomes.side[i]),
              outcomes.impacts[i],
              outcomes.peak[i] / slenderness * std::exp(pi<double>() / frequency),
              {}};
    const PerLobe<double>& uplifts = run.pulse_of(point).uplifts;
    for (int lobe = 0; lobe < uplifts.count; ++lobe) {
        node.lobes |= std::uint32_t(std::isfinite(uplifts.values[std::size_t(lobe)])) << lobe;
    }
    const auto put = [&](Switch f, double value) { node.values[std::size_t(f)] = value; };
    const SafetySwitches safety = is_symmetric
                                      ? of_symmetric(safe, u, block.restitution)
                                      : of_two_sides<theory>(safe, outcomes.tilt[i], u, block);
    put(Switch::outward, safety.outward);
    put(Switch::inward, safety.inward);
    put(Switch::back, safety.back);
    put(Switch::impact, (u + safe.outward) / (is_symmetric ? 1 : safe.largest));
    put(Switch::end_tilt, outcomes.tilt[i]);
    put(Switch::room, pi<double>() / 2 - outcomes.tilt[i]);
    put(Switch::time_left, run.end_of_pulse() - outcomes.phase[i]);
    put(Switch::fall_speed, u);
    put(Switch::turn, std::min(outcomes.lowest_turn[i], slenderness));
    put(Switch::softest, outcomes.softest_impact[i]);
    put(Switch::last, outcomes.last_impact[i]);
    put(Switch::rebound, safety.rebound);
    return node;
}

template Node node_of<Theory::nonlinear>(const PointRun&, const Outcomes&, int);
template Node node_of<Theory::linear>(const PointRun&, const Outcomes&, int);

namespace {

/// Twice the distance of the middle of three values from the straight line through the others,
/// f0 - 2 f1 + f2 if the middle is in the middle.
double bend(const std::array<int, 3>& places, double first, double middle, double last)
{
    if (places[0] == places[2]) {
        return 0;
    }
    const double share = double(places[1] - places[0]) / (places[2] - places[0]);
    return 2 * std::abs(first + share * (last - first) - middle);
}

/// The largest differences of f between the nodes: Mx + My + Mxy of second and mixed differences.
double differences(const CellNodes& cell, const std::array<double, 9>& f)
{
    double along_rows = 0;
    double along_columns = 0;
    double mixed = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t row = 3 * i;
        along_rows = std::max(along_rows, bend(cell.columns, f[row], f[row + 1], f[row + 2]));
        along_columns = std::max(along_columns, bend(cell.rows, f[i], f[i + 3], f[i + 6]));
    }
    for (const std::size_t i : {0, 1, 3, 4}) {
        mixed = std::max(mixed, std::abs(f[i] - f[i + 1] - f[i + 3] + f[i + 4]));
    }
    return along_rows + along_columns + mixed;
}

/// Whether a switch function has no zero in the cell.
bool is_clear(const CellNodes& cell, Switch which, double kappa)
{
    std::array<double, 9> f{};
    double least = std::numeric_limits<double>::infinity();
    int infinite = 0;
    int positive = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        f[i] = cell.nodes[i]->values[std::size_t(which)];
        least = std::min(least, std::abs(f[i]));
        infinite += std::isinf(f[i]);
        positive += f[i] > 0;
    }
    if (infinite > 0) { // softest, last: at a node without such an impact
        return infinite == 9;
    }
    return (positive == 0 || positive == 9) && least > kappa / 2 * differences(cell, f);
}

/// The switch functions that matter for a region; is_uniform() adds those of the path and of the
/// end of the pulse.
std::vector<Switch> relevant_to(Region region, bool is_symmetric)
{
    using enum Switch;
    switch (region) {
    case Region::S:
        return is_symmetric ? std::vector{outward, impact}
                            : std::vector{outward, inward, back, impact};
    case Region::S_plus:
    case Region::S_minus: return {outward, inward, back, impact, end_tilt};
    case Region::U0_plus:
    case Region::U0_minus: return {outward, room, end_tilt};
    case Region::U1_plus:
    case Region::U1_minus:
        return is_symmetric ? std::vector{inward, end_tilt}
                            : std::vector{outward, inward, end_tilt};
    case Region::U2_plus:
    case Region::U2_minus: return {outward, inward, back, end_tilt};
    default: return {time_left, fall_speed};
    }
}

} // namespace

bool is_uniform(const CellNodes& cell, const FillRule& rule, bool with_impacts)
{
    const Node& first = *cell.nodes[0];
    const auto all = [&](const auto& holds) {
        return std::all_of(cell.nodes.begin(), cell.nodes.end(),
                           [&](const Node* node) { return holds(*node); });
    };
    const auto region = Region(first.region);
    if (region == Region::undecided || !all([&](const Node& node) {
            return node.region == first.region && node.lobes == first.lobes;
        })) {
        return false;
    }
    const bool is_s = region == Region::S;
    const bool low =
        is_s && !with_impacts && all([&](const Node& node) { return node.peak < rule.low; });
    const double after_impacts = first.impacts > 3 ? 2 * (first.impacts - 2) : 1;
    const double kappa = rule.kappa * (low ? 1 : after_impacts);
    const auto clear = [&](Switch which) { return is_clear(cell, which, kappa); };
    const std::vector<Switch> relevant = relevant_to(region, first.side == 0);
    if (!std::all_of(relevant.begin(), relevant.end(), clear)) {
        return false;
    }
    if (low && clear(Switch::rebound)) {
        return true;
    }
    const bool one_path = all([&](const Node& node) {
        return node.impacts == first.impacts && node.flags == first.flags &&
               node.side == first.side;
    });
    const bool end_is_clear =
        !is_s || (!with_impacts && clear(Switch::rebound)) || clear(Switch::end_tilt);
    return one_path && end_is_clear &&
           (!rule.grazes || (clear(Switch::turn) && clear(Switch::softest) && clear(Switch::last)));
}

} // namespace overturn
