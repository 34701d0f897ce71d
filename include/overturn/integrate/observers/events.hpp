// The events of a single block, in order.
#pragma once

#include "overturn/integrate/observers/observer.hpp"

#include <vector>

namespace overturn {

/// A block just after an event. Until the next event, it rocks on its side or rests.
template <Number T>
struct Event {
    EventKind kind;
    Rocking<T> rocking;
};

template <Number T>
struct Events : Observer {
    void pass_event(EventKind kind, const Rocking<T>& now, bool happened)
    {
        if (happened) {
            all.push_back({kind, now});
        }
    }

    std::vector<Event<T>> all;
};

} // namespace overturn
