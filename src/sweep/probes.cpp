#include "probes.hpp"

#include "overturn/sweep/boundary.hpp"

#include <algorithm>
#include <cmath>

namespace overturn {

bool is_narrow(double below, double above, double width)
{
    return above - below <= width * above || std::nextafter(below, above) >= above;
}

double middle_of(const Probe& below, const Probe& above)
{
    return below.amplitude + (above.amplitude - below.amplitude) / 2;
}

bool is_flip(const Probe& below, const Probe& above)
{
    return is_safe(below.region) != is_safe(above.region);
}

bool is_rough(const Probe& left, const Probe& middle, const Probe& right)
{
    const auto [nearest, farthest] =
        std::minmax({std::abs(left.margin), std::abs(middle.margin), std::abs(right.margin)});
    const bool differ = left.impacts != middle.impacts || middle.impacts != right.impacts;
    if (differ && farthest - nearest > nearest / 64) {
        return true;
    }
    const double share = (middle.amplitude - left.amplitude) / (right.amplitude - left.amplitude);
    const double straight = left.margin + share * (right.margin - left.margin);
    return std::abs(middle.margin - straight) > nearest / 4;
}

bool may_reach_zero(const Probe& left, const Probe& middle, const Probe& right)
{
    const double nearest = std::abs(middle.margin);
    const double before = std::abs(left.margin) - nearest;
    const double after = std::abs(right.margin) - nearest;
    return before >= 0 && after >= 0 && nearest < 32 * std::max(before, after);
}

void sort_by_amplitude(std::vector<Probe>& probes)
{
    std::stable_sort(probes.begin(), probes.end(), [](const Probe& one, const Probe& other) {
        return one.amplitude < other.amplitude;
    });
}

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

void add_undecided(const std::vector<Probe>& undecided, std::vector<Probe>& probes)
{
    probes.insert(probes.end(), undecided.begin(), undecided.end());
    sort_by_amplitude(probes); // stable: for equal amplitudes, the settled one remains first
    const auto is_same = [](const Probe& one, const Probe& other) {
        return one.amplitude == other.amplitude;
    };
    probes.erase(std::unique(probes.begin(), probes.end(), is_same), probes.end());
}

} // namespace overturn
