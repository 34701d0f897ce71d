// Amplitudes of a line that were looked at, and what neighbours tell of the verdicts between them.
#pragma once

#include "overturn/mechanics/region.hpp"

#include <cstddef>
#include <vector>

namespace overturn {

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

/// Whether a flip between the two is known to flip_width.
bool is_narrow(double below, double above);

double middle_of(const Probe& below, const Probe& above);

/// Where the verdict changes between neighbours.
bool is_flip(const Probe& below, const Probe& above);

/// Whether the margin may turn back towards 0 between three neighbours: it is far from a straight
/// line, or they had unlike impacts and it changes by more than a 64th. Of a thousand flips at low
/// frequencies, a 16th instead of a 64th loses two in a hundred; nothing at all finds the same ones
/// in three times the time, because it halves all steps of a block that bounces to rest.
bool is_rough(const Probe& left, const Probe& middle, const Probe& right);

/// Whether the margin is nearest to 0 in the middle, and so near that it may reach 0 between its
/// neighbours. A parabola falls below its lowest of three values by an eighth of their differences
/// at most; beside a strip the margin bends more sharply: of a thousand flips, a limit of 4 instead
/// of 32 loses six.
bool may_reach_zero(const Probe& left, const Probe& middle, const Probe& right);

/// Leaves out what is not settled, and what lies beyond the first flip too many.
void forget_the_useless(std::vector<Probe>& probes, std::size_t most_flips);

/// Adds what was left undecided, where nothing was settled later.
void add_undecided(const std::vector<Probe>& undecided, std::vector<Probe>& probes);

void sort_by_amplitude(std::vector<Probe>& probes);

} // namespace overturn
