// What happened to a block on its way through the forced stage, for those who want to see it all.
#pragma once

#include "overturn/integrate/rocking_step.hpp"

#include <vector>

namespace overturn {

enum class Happening { uplift, step, impact, rest };

/// A block just after something has happened to it. Between a milestone and the next it rocks on
/// its side, or rests.
template <Number T>
struct Milestone {
    Happening what;
    Rocking<T> rocking;
};

/// Milestones of a single block, in order.
template <Number T>
class Milestones : public std::vector<Milestone<T>> {
public:
    void note(Happening what, const Rocking<T>& rocking, const mask_t<T>& happened)
    {
        static_assert(lanes_v<T> == 1);
        if (happened) {
            this->push_back({what, rocking});
        }
    }
};

} // namespace overturn
