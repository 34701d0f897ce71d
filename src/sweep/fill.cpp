#include "overturn/sweep/fill.hpp"

#include "point_run.hpp"

#include "overturn/mechanics/energy_criteria.hpp"
#include "overturn/problem/coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace overturn {

namespace {

// Whether a cell of a spectrum is uniform, as far as nine of its points show. The nodes of a cell
// are its corners, the middles of its sides and its middle.

/// The switch functions: a code or a number of impacts changes only where one of them is zero.
/// Only their ratios to their own differences matter. c, u, q_min: see energy_criteria.hpp. If the
/// sides of the block differ, those that bound safe states are scaled to 1 at rest on both sides.
enum class Switch {
    outward,    ///< c - u: overturning on the side of the tilt
    inward,     ///< u + sqrt(c^2 - q_min): overturning on the other side after one impact; if the
                ///< sides differ, q0 - q_min
    back,       ///< q0 - q_min: overturning after two impacts, only if the sides differ
    impact,     ///< u + c: an impact after the pulse
    rebound,    ///< sqrt(r) c - u: if positive, an impact at the end of the pulse leaves a safe
                ///< block in region S; if the sides differ: c - u of the other side, before it
    end_tilt,   ///< tilt at the end of the pulse: an impact just before or after the end
    room,       ///< pi/2 - tilt at the end of the pulse: a fall just before the end
    time_left,  ///< phase from the fall to the end of the pulse
    fall_speed, ///< rate at the fall
    turn,       ///< lowest tilt at which the block turned outward: an impact could appear
    softest,    ///< speed of the softest impact before which it could turn: one could vanish
    last,       ///< speed of the last impact: it depends on all others
};
constexpr std::size_t switches = std::size_t(Switch::last) + 1;
constexpr std::size_t switches_of_safety = std::size_t(Switch::rebound) + 1;

/// An integrated point, as far as the test of a cell needs it.
struct Node {
    Region region;
    std::uint16_t flags; ///< see outcome_flag
    std::uint32_t lobes; ///< bit set of those that lift a block at rest
    int side;            ///< +1 or -1, at the end; 0 if the sides of the block are equal
    double impacts;      ///< counted
    double peak;         ///< largest tilt times exp(pi / Omega), see docs/filling.md [alpha]
    std::array<double, switches> values;
};

/// The outputs from which nodes are made.
inline constexpr Outputs node_outputs{
    .impacts = true, .peak = true, .region = true, .phase = true, .grazes = true};

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

/// The node at a point of a run with this outcome.
Node node_of(const PointRun& run, int point, const Outcome& outcome)
{
    const Block<double> block = run.block_at_end(point, outcome);
    const double slenderness = std::min(block.slenderness, block.other.slenderness);
    // Over p of the faster side.
    const double frequency = run.point(point).frequency /
                             std::max(block.frequency_parameter, block.other.frequency_parameter);
    Node node{outcome.region,
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

/// The nodes of a cell, row by row, with their places on both axes.
struct CellNodes {
    std::array<const Node*, 9> nodes;
    std::array<int, 3> rows;
    std::array<int, 3> columns;
};

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

/// Whether all points of a cell have the code of its nodes, and their number of impacts if it is
/// stored.
bool is_uniform(const CellNodes& cell, const FillRule& rule, bool with_impacts)
{
    const Node& first = *cell.nodes[0];
    const auto all = [&](const auto& holds) {
        return std::all_of(cell.nodes.begin(), cell.nodes.end(),
                           [&](const Node* node) { return holds(*node); });
    };
    const Region region = first.region;
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

/// The points from `begin` to `end` on both axes of a tile, ends included.
struct Cell {
    std::array<int, 2> begin;
    std::array<int, 2> end;

    std::array<int, 3> places(std::size_t axis) const
    {
        return {begin[axis], (begin[axis] + end[axis]) / 2, end[axis]};
    }
    int length(std::size_t axis) const { return end[axis] - begin[axis]; }
    bool is_smallest() const { return length(0) <= 2 && length(1) <= 2; }
};

/// The parts of a cell, as many along each axis; neighbours share a side.
std::vector<Cell> parts_of(const Cell& cell, const std::array<int, 2>& count)
{
    const auto place = [&](std::size_t axis, int part) {
        return cell.begin[axis] + cell.length(axis) * part / count[axis];
    };
    std::vector<Cell> parts;
    for (int i = 0; i < count[0]; ++i) {
        for (int j = 0; j < count[1]; ++j) {
            parts.push_back({{place(0, i), place(1, j)}, {place(0, i + 1), place(1, j + 1)}});
        }
    }
    return parts;
}

/// The longest side of a cell along the dimension of this role [points]: 1/32 of the axis, but at
/// least 64 and at most 256.
int longest_cell(const Grid& grid, Role role)
{
    const auto dimension = grid.dimension_of(role);
    const std::int64_t size = dimension ? grid.dimensions[*dimension].size() : 1;
    return int(std::clamp<std::int64_t>(size / 32, 64, 256));
}

/// The points of a tile along its strengths or rates, at the first value of the other.
std::vector<Point> points_along(const Problem& problem, Tile tile, Role role)
{
    const Role other = role == Role::strength ? Role::rate : Role::strength;
    if (const auto dimension = problem.grid.dimension_of(other)) {
        tile.count[*dimension] = 1;
    }
    return Coordinates(problem.scene, problem.grid, tile).points();
}

/// The finalizer of SplitMix64: every bit of the result depends on every bit of the number.
std::uint64_t hashed(std::uint64_t number)
{
    number += 0x9e3779b97f4a7c15U;
    number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9U;
    number = (number ^ (number >> 27)) * 0x94d049bb133111ebU;
    return number ^ (number >> 31);
}

/// Calls visit(column) for the columns in [begin, end) that the audit of a row may check.
/// Each column is among them with the probability `share`, by a hash of its index and that of the
/// row: at most one in a group of columns, as hashing every point would take as long as the rest.
template <class Visitor>
void for_each_audited(double share, std::int64_t row, std::int64_t begin, std::int64_t end,
                      const Visitor& visit)
{
    if (!(share > 0)) {
        return;
    }
    std::int64_t length = 1;
    while (length < 64 && 2 * double(length) * share <= 1) {
        length *= 2;
    }
    const double in_group = share * double(length);
    const std::uint64_t limit =
        in_group < 1 ? std::uint64_t(std::ldexp(in_group, 64)) : ~std::uint64_t(0);
    for (std::int64_t group = begin / length; group * length < end; ++group) {
        const std::uint64_t hash = hashed(hashed(std::uint64_t(row)) + std::uint64_t(group));
        const std::int64_t column =
            group * length + std::int64_t(hashed(hash) % std::uint64_t(length));
        if (hash <= limit && column >= begin && column < end) {
            visit(column);
        }
    }
}

/// The points of a tile, filled cell by cell. Its rows are strengths, its columns are rates.
class Filler {
public:
    Filler(const Problem& problem, const Tile& tile, Kernel kernel, DropRequested drop_requested,
           const FillRule& rule)
        : problem_(problem), kernel_(kernel), drop_requested_(std::move(drop_requested)),
          rule_(rule), of_row_(points_along(problem, tile, Role::strength)),
          of_column_(points_along(problem, tile, Role::rate)),
          node_at_(new int[std::size_t(tile.points())])
    {
        const bool with_impacts = std::ranges::count(problem.fields, Field::impacts) > 0;
        const auto count = std::size_t(tile.points());
        filled_.region.resize(count);
        filled_.evaluated.resize(count);
        filled_.impacts.resize(with_impacts ? count : 0);
    }

    void fill()
    {
        std::vector<Cell> cells = largest_cells();
        while (!cells.empty()) {
            cells = pass(cells);
        }
    }

    /// Integrates a share of the filled points; if any of them is wrong, also all others, so that
    /// none remains filled. first: the row and the column of the first point among all points of
    /// the grid.
    void audit(std::array<std::int64_t, 2> first)
    {
        const std::vector<int> checked = audited(first);
        filled_.audit = {std::int64_t(checked.size()),
                         store(checked, integrate(checked, {.impacts = true}).outcomes)};
        if (filled_.audit.wrong > 0) {
            std::vector<int> others;
            for (int place = 0; place < rows() * columns(); ++place) {
                if (!is_integrated(place)) {
                    others.push_back(place);
                }
            }
            store(others, integrate(others, {.impacts = true}).outcomes);
        }
    }

    FilledTile result() { return std::move(filled_); }

private:
    struct Integrated {
        PointRun run;
        Outcomes outcomes;
    };

    int rows() const { return int(of_row_.size()); }
    int columns() const { return int(of_column_.size()); }
    Point point(int place) const
    {
        Point point = of_column_[std::size_t(place % columns())];
        point.amplitude = of_row_[std::size_t(place / columns())].amplitude;
        return point;
    }
    int place(int row, int column) const { return row * columns() + column; }
    bool is_integrated(int place) const { return filled_.evaluated[std::size_t(place)] != 0; }
    bool with_impacts() const { return !filled_.impacts.empty(); }

    /// The filled points that the audit checks.
    std::vector<int> audited(std::array<std::int64_t, 2> first) const
    {
        std::vector<int> places;
        for (int row = 0; row < rows(); ++row) {
            for_each_audited(*problem_.product.audit(), first[0] + row, first[1],
                             first[1] + columns(), [&](std::int64_t column) {
                                 const int at = place(row, int(column - first[1]));
                                 if (!is_integrated(at)) {
                                     places.push_back(at);
                                 }
                             });
        }
        return places;
    }

    std::vector<Cell> largest_cells() const
    {
        const auto parts = [&](int points, Role role) {
            const int longest = longest_cell(problem_.grid, role);
            return std::max(1, (points - 2 + longest) / longest);
        };
        return parts_of({{0, 0}, {rows() - 1, columns() - 1}},
                        {parts(rows(), Role::strength), parts(columns(), Role::rate)});
    }

    /// Integrates the nodes of the cells, fills the uniform cells and returns the parts of the
    /// others.
    std::vector<Cell> pass(const std::vector<Cell>& cells)
    {
        integrate_nodes(missing_nodes(cells));
        std::vector<Cell> parts;
        for (const Cell& cell : cells) {
            if (cell.is_smallest()) { // all of its points are nodes
                continue;
            }
            const CellNodes nodes = nodes_of(cell);
            if (is_uniform(nodes, rule_, with_impacts())) {
                fill(cell);
                continue;
            }
            const auto halves = [&](std::size_t axis) { return cell.length(axis) > 2 ? 2 : 1; };
            std::ranges::copy(parts_of(cell, {halves(0), halves(1)}), std::back_inserter(parts));
        }
        return parts;
    }

    /// The nodes that have not been integrated yet, row by row: points of a row share their scaled
    /// pulse.
    std::vector<int> missing_nodes(const std::vector<Cell>& cells) const
    {
        std::vector<int> places;
        for (const Cell& cell : cells) {
            for (const int row : cell.places(0)) {
                for (const int column : cell.places(1)) {
                    if (!is_integrated(place(row, column))) {
                        places.push_back(place(row, column));
                    }
                }
            }
        }
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
        return places;
    }

    Integrated integrate(const std::vector<int>& places, Outputs outputs) const
    {
        outputs.region = true;
        std::vector<Point> points;
        points.reserve(places.size());
        for (const int place : places) {
            points.push_back(point(place));
        }
        PointRun run(problem_.scene, std::move(points), kernel_, drop_requested_,
                     !problem_.grid.has_two_sides());
        Outcomes outcomes = outcomes_of(run, problem_.numerics, outputs);
        return {std::move(run), std::move(outcomes)};
    }

    void integrate_nodes(const std::vector<int>& places)
    {
        const auto [run, outcomes] = integrate(places, node_outputs);
        store(places, outcomes);
        for (std::size_t i = 0; i < places.size(); ++i) {
            node_at_[std::size_t(places[i])] = int(nodes_.size());
            nodes_.push_back(node_of(run, int(i), outcomes[i]));
        }
    }

    /// Returns the number of points whose value has changed.
    std::int64_t store(const std::vector<int>& places, const Outcomes& outcomes)
    {
        std::int64_t changed = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const auto place = std::size_t(places[i]);
            const auto region = std::uint8_t(outcomes[i].region);
            bool is_new = region != std::exchange(filled_.region[place], region);
            if (with_impacts()) {
                constexpr bool recorded = false; // see reason_not_to_fill()
                const std::uint16_t impacts = outcomes[i].stored_impacts(recorded);
                is_new = impacts != std::exchange(filled_.impacts[place], impacts) || is_new;
            }
            filled_.evaluated[place] = 1;
            changed += is_new;
        }
        return changed;
    }

    CellNodes nodes_of(const Cell& cell) const
    {
        CellNodes nodes{{}, cell.places(0), cell.places(1)};
        for (std::size_t i = 0; i < 9; ++i) {
            const int at = place(nodes.rows[i / 3], nodes.columns[i % 3]);
            nodes.nodes[i] = &nodes_[std::size_t(node_at_[std::size_t(at)])];
        }
        return nodes;
    }

    void fill(const Cell& cell)
    {
        const auto corner = std::size_t(place(cell.begin[0], cell.begin[1]));
        const auto fill_row = [&](int row, auto& values) {
            const auto value = values[corner];
            const int first = place(row, cell.begin[1]);
            const int last = place(row, cell.end[1]);
            const auto fill_unless_integrated = [&](int at) {
                if (!is_integrated(at)) {
                    values[std::size_t(at)] = value;
                }
            };
            if (first < last && row > cell.begin[0] && row < cell.end[0]) {
                fill_unless_integrated(first);
                // The nodes inside the cell have this value, too.
                std::fill(values.begin() + first + 1, values.begin() + last, value);
                fill_unless_integrated(last);
            } else { // neighbours may have nodes of their own on the sides
                for (int at = first; at <= last; ++at) {
                    fill_unless_integrated(at);
                }
            }
        };
        for (int row = cell.begin[0]; row <= cell.end[0]; ++row) {
            fill_row(row, filled_.region);
            if (with_impacts()) {
                fill_row(row, filled_.impacts);
            }
        }
    }

    const Problem& problem_;
    const Kernel kernel_;
    const DropRequested drop_requested_;
    const FillRule rule_;
    const std::vector<Point> of_row_;    // at the first column
    const std::vector<Point> of_column_; // in the first row
    FilledTile filled_;
    std::vector<Node> nodes_;
    std::unique_ptr<int[]> node_at_; // index into nodes_; set only where a node is
};

} // namespace

FilledTile fill_tile(const Problem& problem, const Tile& tile, Kernel kernel,
                     DropRequested drop_requested, const FillRule& rule)
{
    Filler filler(problem, tile, kernel, std::move(drop_requested), rule);
    filler.fill();
    // Rows are numbered through all planes of the grid.
    const auto rate = problem.grid.dimension_of(Role::rate);
    const Shape shape = problem.grid.shape();
    std::int64_t row = 0;
    for (std::size_t i = 0; i < shape.size(); ++i) {
        row = i == rate ? row : row * shape[i] + tile.begin[i];
    }
    filler.audit({row, rate ? tile.begin[*rate] : 0});
    return filler.result();
}

} // namespace overturn
