#include "overturn/sweep/fill.hpp"

#include "point_run.hpp"
#include "uniform_cell.hpp"

#include "overturn/problem/coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace overturn {

namespace {

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
    std::vector<CellNode> nodes_;
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
