#include "overturn/problem/point.hpp"

#include "overturn/mechanics/pulse_motion.hpp"
#include "overturn/mechanics/sliding.hpp"
#include "overturn/mechanics/theory/theories.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace overturn {

double uplift_threshold(Theory theory, double slenderness)
{
    return with_theory(theory, [&]<Theory known>() {
        return Equations<known>::uplift_acceleration(BlockSide<double>{slenderness});
    });
}

Record directed_record(const Scene& scene, const Point& point)
{
    const Record& record = scene.records()[std::size_t(point.record)];
    return scene.has_two_components()
               ? std::make_shared<const Accelerogram>(record->in_direction(point.direction))
               : record;
}

double pga_of_unit(const Scene& scene, const Point& point)
{
    const double least = std::min(point.block.slenderness, point.block.other.slenderness);
    return scene.is_under(Under::pulse) ? uplift_threshold(scene.theory, least)
                                        : directed_record(scene, point)->peak();
}

double free_fall_amplitude(const Scene& scene, const Point& point)
{
    const auto records = scene.records();
    return records.empty() ? infinity : records[std::size_t(point.record)]->free_fall_scale();
}

namespace {

/// The largest peak ground acceleration over g at which the motion of this point exceeds neither
/// threshold. thresholds: of the ground acceleration over g that pushes to a side, for the block as
/// it stands.
double pga_at(UpliftThresholds thresholds, const Scene& scene, const Point& point)
{
    if (std::signbit(point.amplitude)) { // the mirrored motion
        std::swap(thresholds.plus, thresholds.minus);
    }
    const Pulse* pulse = scene.pulse();
    if (pulse == nullptr) {
        const Record record = directed_record(scene, point);
        return record->peak() * record->lifting_scale(thresholds);
    }
    // A positive ground acceleration pushes the block towards its side minus.
    const LobeAmplitudes<double> lobes =
        largest_lobes(pulse_motion<double>(pulse->kind, pulse->shape));
    const auto lifting = [](double threshold, double lobe) {
        return lobe > 0 ? threshold / lobe : infinity;
    };
    return std::min(lifting(thresholds.minus, lobes.positive),
                    lifting(thresholds.plus, lobes.negative));
}

} // namespace

double lifting_pga(const Scene& scene, const Point& point)
{
    const auto threshold = [&](const BlockSide<double>& side, const SlidingSide<double>& on) {
        return on.friction > on.friction_to_lift()
                   ? uplift_threshold(scene.theory, side.slenderness)
                   : infinity;
    };
    const Block<double>& block = point.block;
    const auto plus = sliding_side(block, point.gyration, point.friction);
    if (scene.is_under(Under::pulse) && block.is_symmetric()) {
        return threshold(block, plus);
    }
    return pga_at({threshold(block, plus), threshold(block.other, plus.turned())}, scene, point);
}

bool may_slip(const Point& point)
{
    return std::isfinite(point.friction);
}

bool stays_flat(const Point& point)
{
    const auto plus = sliding_side(point.block, point.gyration, point.friction);
    return point.friction <= std::min(plus.friction_to_lift(), plus.turned().friction_to_lift());
}

double moving_pga(const Scene& scene, const Point& point)
{
    const auto plus = sliding_side(point.block, point.gyration, point.friction);
    const double moving =
        pga_at({plus.acceleration_to_move(), plus.turned().acceleration_to_move()}, scene, point);
    const double lifting = lifting_pga(scene, point); // differs by roundings if it lifts first
    constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
    return moving > lifting * (1 - rounding) ? lifting : moving;
}

} // namespace overturn
