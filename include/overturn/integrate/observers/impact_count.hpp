// The number of impacts, but those of a series that dies out.
#pragma once

#include "overturn/integrate/observers/observer.hpp"

namespace overturn {

template <Number T>
struct ImpactCount : Observer {
    void pass_event(EventKind kind, const Rocking<T>&, const mask_t<T>& lanes)
    {
        if (kind == EventKind::impact) {
            count = select<T>(lanes, count + 1, count);
        }
    }

    void complete(ForcedEnd<T>& end, const auto&...) const { end.impacts = count; }

    T count = T(0);
};

} // namespace overturn
