#include "overturn/sweep/boundary.hpp"

#include "resolve.hpp"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace overturn {

namespace {

/// Verdicts must be right: cheap where that is clear, fine where it is not.
constexpr Numerics scanning{.method = Method::taylor, .tolerance = 1e-6, .resolve = true};
constexpr Numerics searching{.method = Method::taylor, .tolerance = 1e-13, .resolve = true};

/// A line is incomplete with the first verdict that stays in doubt, which may take a second; after
/// so many the scan is not refined any more.
constexpr int most_doubts = 16;

/// What becomes of a block at one amplitude.
struct Probe {
    double amplitude;
    Region region;
    double margin;
    double impacts;
    int halving = 0; ///< of the scan, that brought it in

    bool is_settled() const { return is_safe(region) || is_unsafe(region); }
    bool falls_to_plus() const
    {
        return region == Region::U0_plus || region == Region::U1_plus || region == Region::F_plus;
    }
};

class Line {
public:
    Line(const Scene& scene, const BoundaryLine& line, Kernel kernel, DropRequested drop_requested)
        : scene_(scene), line_(line), kernel_(kernel), drop_requested_(std::move(drop_requested))
    {}

    std::vector<Probe> at(const std::vector<double>& amplitudes, const Numerics& numerics)
    {
        std::vector<PlanePoint> points;
        for (const double amplitude : amplitudes) {
            points.push_back({line_.slenderness, line_.restitution, amplitude, line_.frequency});
        }
        const PointRun run(scene_, std::move(points), kernel_, drop_requested_);
        const Ends ends = ends_of(run, numerics, {.impacts = true, .region = true, .margin = true});
        std::vector<Probe> probes;
        for (std::size_t i = 0; i < amplitudes.size(); ++i) {
            probes.push_back(
                {amplitudes[i], Region(ends.region[i]), ends.margin[i], ends.impacts[i]});
            doubts_ += !probes.back().is_settled();
        }
        return probes;
    }

    Probe at(double amplitude) { return at(std::vector{amplitude}, searching)[0]; }

    /// How often something on it could not be found out.
    int doubts() const { return doubts_; }
    void add_doubt() { ++doubts_; }

private:
    Scene scene_;
    BoundaryLine line_;
    Kernel kernel_;
    DropRequested drop_requested_;
    int doubts_ = 0;
};

bool is_narrow(double below, double above)
{
    return above - below <= flip_width * above || std::nextafter(below, above) >= above;
}

/// Narrows a bracket of one flip; nothing if a verdict within it cannot be settled. The margin
/// changes its sign there, but may jump.
std::optional<Flip> narrowed(Line& line, const Probe& below, const Probe& above)
{
    Probe low = below;
    Probe high = above;
    bool settled = true;
    const auto margin = [&](double amplitude) {
        const Probe probe = line.at(amplitude);
        settled = settled && probe.is_settled();
        if (!settled) {
            return 0.0; // which ends the search
        }
        (is_safe(probe.region) == is_safe(below.region) ? low : high) = probe;
        return probe.margin;
    };
    std::uintmax_t most_looks = 100;
    boost::math::tools::toms748_solve(margin, below.amplitude, above.amplitude, below.margin,
                                      above.margin, is_narrow, most_looks);
    while (settled && !is_narrow(low.amplitude, high.amplitude)) { // a margin of 0 ends it early
        margin(low.amplitude + (high.amplitude - low.amplitude) / 2);
    }
    return settled ? std::optional(Flip{low.amplitude, high.amplitude, low.region, high.region})
                   : std::nullopt;
}

/// A safe amplitude between two that overturn to different sides: by halving.
std::optional<Probe> safe_between(Line& line, Probe below, Probe above)
{
    while (!is_narrow(below.amplitude, above.amplitude)) {
        const Probe middle = line.at(below.amplitude + (above.amplitude - below.amplitude) / 2);
        if (!is_unsafe(middle.region)) {
            return is_safe(middle.region) ? std::optional(middle) : std::nullopt;
        }
        (middle.falls_to_plus() == below.falls_to_plus() ? below : above) = middle;
    }
    line.add_doubt(); // it is there, but thinner than that
    return std::nullopt;
}

/// An amplitude of the other verdict near `nearest`, whose margin is nearest to 0 of three: by
/// Brent's method, which ends once one is found.
std::optional<Probe> other_verdict_near(Line& line, const Probe& before, const Probe& nearest,
                                        const Probe& after)
{
    std::optional<Probe> found;
    const bool safe = is_safe(nearest.region);
    const auto distance = [&](double amplitude) {
        if (found) {
            return 0.0;
        }
        const Probe probe = line.at(amplitude);
        if (probe.is_settled() && is_safe(probe.region) != safe) {
            found = probe;
        }
        return probe.is_settled() ? std::abs(probe.margin) : 1.0;
    };
    std::uintmax_t most_looks = 60;
    constexpr int bits = 26; // half of a double's: a minimum is no better known
    boost::math::tools::brent_find_minima(distance, before.amplitude, after.amplitude, bits,
                                          most_looks);
    return found;
}

void sort_by_amplitude(std::vector<Probe>& probes)
{
    std::sort(probes.begin(), probes.end(),
              [](const Probe& one, const Probe& other) { return one.amplitude < other.amplitude; });
}

/// Whether the margin may turn back towards 0 between three neighbours: it is far from a straight
/// line, or they had unlike impacts and it changes by more than a 64th. Of a thousand flips at low
/// frequencies, a 16th instead of a 64th loses two in a hundred; nothing at all finds the same ones
/// in three times the time, because it halves all steps of a block that bounces to rest.
bool is_rough(const Probe& left, const Probe& middle, const Probe& right)
{
    const auto [nearest, farthest] =
        std::minmax({std::abs(left.margin), std::abs(middle.margin), std::abs(right.margin)});
    const bool unlike = left.impacts != middle.impacts || middle.impacts != right.impacts;
    if (unlike && farthest - nearest > nearest / 64) {
        return true;
    }
    const double share = (middle.amplitude - left.amplitude) / (right.amplitude - left.amplitude);
    const double straight = left.margin + share * (right.margin - left.margin);
    return std::abs(middle.margin - straight) > nearest / 4;
}

/// Where the verdict changes between neighbours.
bool is_flip(const Probe& below, const Probe& above)
{
    return is_safe(below.region) != is_safe(above.region);
}

/// Leaves out what is not settled, and what lies beyond the first flip too many.
void forget_the_useless(std::vector<Probe>& probes, std::size_t most_flips)
{
    probes.erase(std::remove_if(probes.begin(), probes.end(),
                                [](const Probe& probe) { return !probe.is_settled(); }),
                 probes.end());
    std::size_t flips = 0;
    for (std::size_t i = 1; i < probes.size(); ++i) {
        flips += is_flip(probes[i - 1], probes[i]);
        if (flips > most_flips) {
            probes.resize(i + 1);
        }
    }
}

/// Halves the steps of the scan where it is rough, and those again, down to finest_step.
std::vector<Probe> looked_at_more_closely(Line& line, std::vector<Probe> probes,
                                          std::size_t most_flips)
{
    forget_the_useless(probes, most_flips);
    for (int time = 0; line.doubts() <= most_doubts; ++time) {
        std::vector<double> middles;
        std::size_t halved = 0; // the step that ends at this probe
        for (std::size_t i = 1; i + 1 < probes.size(); ++i) {
            if (!is_rough(probes[i - 1], probes[i], probes[i + 1])) {
                continue;
            }
            for (const std::size_t end : {i, i + 1}) {
                const Probe& below = probes[end - 1];
                const Probe& above = probes[end];
                // Others were looked at before.
                const bool is_new = below.halving == time || above.halving == time;
                const bool is_wide =
                    above.amplitude - below.amplitude > finest_step * above.amplitude;
                if (end > halved && is_new && is_wide) {
                    middles.push_back(below.amplitude + (above.amplitude - below.amplitude) / 2);
                    halved = end;
                }
            }
        }
        if (middles.empty()) {
            break;
        }
        for (Probe& probe : line.at(middles, scanning)) {
            probe.halving = time + 1;
            probes.push_back(probe);
        }
        sort_by_amplitude(probes);
        forget_the_useless(probes, most_flips);
    }
    return probes;
}

/// Whether the margin is nearest to 0 in the middle, and so near that it may reach 0 between its
/// neighbours. A parabola falls below its lowest of three values by an eighth of their differences
/// at most; beside a strip the margin bends more sharply: of a thousand flips, a limit of 4 instead
/// of 32 loses six.
bool may_reach_zero(const Probe& left, const Probe& middle, const Probe& right)
{
    const double nearest = std::abs(middle.margin);
    const double before = std::abs(left.margin) - nearest;
    const double after = std::abs(right.margin) - nearest;
    return before >= 0 && after >= 0 && nearest < 32 * std::max(before, after);
}

/// Adds what two neighbours of one verdict tell of another between them.
void find_what_hides_between(Line& line, std::vector<Probe>& probes)
{
    std::vector<Probe> found;
    for (std::size_t i = 0; i + 1 < probes.size(); ++i) {
        const Probe& now = probes[i];
        const Probe& next = probes[i + 1];
        if (is_flip(now, next)) {
            continue;
        }
        std::optional<Probe> other;
        if (is_unsafe(now.region) && now.falls_to_plus() != next.falls_to_plus()) {
            other = safe_between(line, now, next);
        } else if (i > 0 && !is_flip(probes[i - 1], now) &&
                   may_reach_zero(probes[i - 1], now, next)) {
            other = other_verdict_near(line, probes[i - 1], now, next);
        }
        if (other) {
            found.push_back(*other);
        }
    }
    probes.insert(probes.end(), found.begin(), found.end());
    sort_by_amplitude(probes);
}

} // namespace

Boundary boundary_on(const Scene& scene, const BoundaryLine& where,
                     const std::vector<double>& amplitudes, Kernel kernel, std::size_t most_flips,
                     DropRequested drop_requested)
{
    Line line(scene, where, kernel, drop_requested);
    std::vector<Probe> probes =
        looked_at_more_closely(line, line.at(amplitudes, scanning), most_flips);
    find_what_hides_between(line, probes);
    Boundary boundary;
    for (std::size_t i = 1; i < probes.size() && !boundary.has_more; ++i) {
        if (!is_flip(probes[i - 1], probes[i])) {
            continue;
        }
        boundary.has_more = boundary.flips.size() == most_flips;
        if (boundary.has_more) {
            continue;
        }
        if (const auto flip = narrowed(line, probes[i - 1], probes[i])) {
            boundary.flips.push_back(*flip);
        }
    }
    boundary.complete = line.doubts() == 0;
    return boundary;
}

TileFields boundary_tile(const Scene& scene, const Plane& plane,
                         const std::vector<double>& amplitudes, const Tile& tile, Kernel kernel,
                         DropRequested drop_requested)
{
    const auto points = std::size_t(tile.points());
    std::vector<double> amplitude(points, std::numeric_limits<double>::quiet_NaN());
    std::vector<std::uint8_t> below(points, boundary_code::no_flip);
    std::vector<std::uint8_t> above(points, boundary_code::no_flip);
    const auto rows = std::size_t(tile.amplitude_count);
    const auto columns = std::size_t(tile.frequency_count);
    for (std::size_t column = 0; column < columns; ++column) {
        const BoundaryLine line{
            .slenderness = plane.slenderness[tile.slenderness],
            .restitution = plane.restitution_ratio(tile.slenderness, tile.restitution),
            .frequency = plane.frequency[tile.frequency_begin + std::int64_t(column)]};
        const Boundary boundary =
            boundary_on(scene, line, amplitudes, kernel, rows, drop_requested);
        const bool known = boundary.complete && !boundary.has_more;
        for (std::size_t row = 0; row < rows; ++row) {
            const std::size_t point = row * columns + column;
            if (row < boundary.flips.size()) {
                const Flip& flip = boundary.flips[row];
                amplitude[point] = flip.amplitude();
                below[point] = std::uint8_t(flip.region_below);
                above[point] = std::uint8_t(flip.region_above);
            } else if (!known) {
                below[point] = boundary_code::in_doubt;
                above[point] = boundary_code::in_doubt;
            }
        }
        if (!known && boundary.flips.size() == rows) {
            above[(rows - 1) * columns + column] = boundary_code::in_doubt;
        }
    }
    TileFields fields;
    fields.values = {std::move(amplitude), std::move(below), std::move(above)};
    return fields;
}

} // namespace overturn
