#include "uniform_cell.hpp"

#include "overturn/mechanics/energy_criteria.hpp"
#include "overturn/mechanics/theory/theories.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace overturn {

namespace {

constexpr std::size_t switches_of_safety = std::size_t(Switch::rebound) + 1;

/// The first switch functions, up to `rebound`.
template <Theory theory>
std::array<double, switches_of_safety> safety_at(const State<double>& end,
                                                 const Block<double>& block)
{
    const SafeRates<double> safe = safe_rates<theory>(end.tilt, block);
    const double u = end.rate;
    if (block.is_symmetric()) {
        return {safe.outward - u, safe.inward().distance(u), 1, u + safe.outward,
                std::sqrt(block.restitution) * safe.outward - u};
    }
    const double q_max = safe.largest * safe.largest;
    const double q0 = (safe.outward - u) * (safe.outward + u);
    const auto above = [&](const ImpactLimit<double>& limit) {
        return (q0 + limit.minus_q_min) / (q_max + limit.minus_q_min);
    };
    const Block<double> before = block.turned();
    const double outward_before = Equations<theory>::separatrix_rate(before, end.tilt);
    const double largest_before = Equations<theory>::separatrix_rate(before, 0.0);
    return {(safe.outward - u) / safe.largest, above(safe.one), above(safe.two),
            (u + safe.outward) / safe.largest,
            (outward_before - u / before.rate_ratio()) / largest_before};
}

} // namespace

CellNode node_of(const PointRun& run, int point, const Outcome& outcome)
{
    const Block<double> block = seen_from(outcome.side, run.point(point).block);
    const double slenderness = std::min(block.slenderness, block.other.slenderness);
    // Over p of the faster side.
    const double frequency = run.point(point).frequency /
                             std::max(block.frequency_parameter, block.other.frequency_parameter);
    CellNode node{outcome.region,
                  outcome.flags,
                  0,
                  block.is_symmetric() ? 0 : int(outcome.side),
                  outcome.impacts,
                  outcome.peak / slenderness * std::exp(pi<double>() / frequency),
                  {}};
    const PerLobe<double>& uplifts = run.pulse_of(point).uplifts;
    for (int lobe = 0; lobe < uplifts.count; ++lobe) {
        node.lobes |= std::uint32_t(std::isfinite(uplifts.values[std::size_t(lobe)])) << lobe;
    }
    const auto put = [&](Switch f, double value) { node.values[std::size_t(f)] = value; };
    with_theory(run.scene().theory, [&]<Theory theory>() {
        std::ranges::copy(safety_at<theory>(outcome.end(), block), node.values.begin());
    });
    put(Switch::end_tilt, outcome.tilt);
    put(Switch::room, pi<double>() / 2 - outcome.tilt);
    put(Switch::time_left, run.end_of_pulse() - outcome.phase);
    put(Switch::fall_speed, outcome.rate);
    put(Switch::turn, std::min(outcome.lowest_turn, slenderness));
    put(Switch::softest, outcome.softest_impact);
    put(Switch::last, outcome.last_impact);
    return node;
}

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
    double least = infinity;
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
    const CellNode& first = *cell.nodes[0];
    const auto all = [&](const auto& holds) {
        return std::all_of(cell.nodes.begin(), cell.nodes.end(),
                           [&](const CellNode* node) { return holds(*node); });
    };
    const Region region = first.region;
    if (region == Region::undecided || !all([&](const CellNode& node) {
            return node.region == first.region && node.lobes == first.lobes;
        })) {
        return false;
    }
    const bool is_s = region == Region::S;
    const bool low =
        is_s && !with_impacts && all([&](const CellNode& node) { return node.peak < rule.low; });
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
    const bool one_path = all([&](const CellNode& node) {
        return node.impacts == first.impacts && node.flags == first.flags &&
               node.side == first.side;
    });
    const bool end_is_clear =
        !is_s || (!with_impacts && clear(Switch::rebound)) || clear(Switch::end_tilt);
    return one_path && end_is_clear &&
           (!rule.grazes || (clear(Switch::turn) && clear(Switch::softest) && clear(Switch::last)));
}

} // namespace overturn
