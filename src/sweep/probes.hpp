// Probes: the computed amplitudes of a line, and criteria for other verdicts between neighbours.
#pragma once

#include "overturn/mechanics/region.hpp"

#include <cstddef>
#include <vector>

namespace overturn {

/// The outcome of a block at one amplitude.
struct Probe {
    double amplitude;
    Region region;
    double margin;
    double impacts;
    int halving = 0; ///< the halving of the scan that added it

    bool is_settled() const { return is_safe(region) || is_unsafe(region); }
    bool falls_to_plus() const
    {
        return region == Region::U0_plus || region == Region::U1_plus || region == Region::F_plus;
    }
};

/// Whether the two amplitudes are within this width, relative to them, or adjacent doubles.
bool is_narrow(double below, double above, double width);

double middle_of(const Probe& below, const Probe& above);

/// Whether the verdict changes between neighbours.
bool is_flip(const Probe& below, const Probe& above);

/// Whether the margin may turn back towards 0 between three neighbours: it is far from linear, or
/// the numbers of impacts differ and it changes by more than 1/64. For a thousand flips at low
/// frequencies, 1/16 instead of 1/64 loses two in a hundred. Without this limit, the same flips are
/// found in three times the time, because all steps of a block that bounces to rest are halved.
bool is_rough(const Probe& left, const Probe& middle, const Probe& right);

/// Whether the margin is nearest to 0 in the middle, and so near that it may reach 0 between its
/// neighbours. A parabola falls below the lowest of three values by at most an eighth of their
/// differences. Next to a strip, the margin bends more sharply: a limit of 4 instead of 32 loses
/// six of a thousand flips.
bool may_reach_zero(const Probe& left, const Probe& middle, const Probe& right);

/// Removes probes that are not settled, and those above the first flip that exceeds most_flips.
void forget_the_useless(std::vector<Probe>& probes, std::size_t most_flips);

/// Adds the undecided probes at amplitudes that were not settled later.
void add_undecided(const std::vector<Probe>& undecided, std::vector<Probe>& probes);

void sort_by_amplitude(std::vector<Probe>& probes);

} // namespace overturn
