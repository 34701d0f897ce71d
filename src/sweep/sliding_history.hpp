// The history of a block that slips, and the excitation of a point for histories.
#pragma once

#include "overturn/mechanics/pulse_excitation.hpp"
#include "overturn/mechanics/record_excitation.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/sweep/history.hpp"
#include "overturn/sweep/outcome.hpp"

namespace overturn {

/// outcome: of the point, confirmed, with region, margin, error and slide.
History sliding_history(const Scene& scene, const Point& point, const Outcome& outcome,
                        const HistoryView& view);

/// Calls visit(excitation) with that of a point, under a pulse or the first record of the scene.
template <Theory theory, class Visit>
auto under_motion(const Scene& scene, const Point& point, const Visit& visit)
{
    if (const Pulse* pulse = scene.pulse()) {
        return visit(pulse_excitation<theory>(pulse_motion<double>(pulse->kind, pulse->shape),
                                              point.block, point.amplitude, point.frequency));
    }
    const Record record = directed_record(scene, point);
    return visit(record_excitation<theory>(*record, point.block, point.amplitude, point.frequency));
}

} // namespace overturn
