#include "support/record_point.hpp"

#include "overturn/integrate/forced_stage.hpp"

namespace overturn {

template <Theory theory, Directions directions, int order>
ForcedEnd<double> run_record(const RecordPoint& point, double tolerance)
{
    return run_forced_stage<Taylor<order>, theory, Outputs{.impacts = true, .error = true}>(
        point.block, excitation_of<theory, directions>(point), tolerance);
}

template <Theory theory, Directions directions>
double peak_under_record(const RecordPoint& point, double tolerance)
{
    return run_forced_stage<Taylor<14>, theory, Outputs{.peak = true}>(
               point.block, excitation_of<theory, directions>(point), tolerance)
        .peak;
}

template <Theory theory, Directions directions>
std::vector<double> tilts_at_samples(const RecordPoint& point, double tolerance)
{
    const auto excitation = excitation_of<theory, directions>(point);
    ForcedStage<Taylor<14>, theory, Outputs{.events = true}, double,
                RecordExcitation<double, directions>>
        stage(point.block, excitation, tolerance);
    while (stage.is_active()) {
        stage.advance();
    }
    std::vector<double> tilts{0};
    for (const Event<double>& event : stage.events()) {
        tilts.push_back(event.rocking.tilt);
    }
    return tilts;
}

#define OVERTURN_INSTANTIATE(theory, directions)                                                   \
    template ForcedEnd<double> run_record<theory, directions, 8>(const RecordPoint&, double);      \
    template ForcedEnd<double> run_record<theory, directions, 14>(const RecordPoint&, double);     \
    template ForcedEnd<double> run_record<theory, directions, 20>(const RecordPoint&, double);     \
    template double peak_under_record<theory, directions>(const RecordPoint&, double);             \
    template std::vector<double> tilts_at_samples<theory, directions>(const RecordPoint&, double);
OVERTURN_INSTANTIATE(Theory::nonlinear, Directions::horizontal)
OVERTURN_INSTANTIATE(Theory::nonlinear, Directions::both)
OVERTURN_INSTANTIATE(Theory::linear, Directions::horizontal)
OVERTURN_INSTANTIATE(Theory::linear, Directions::both)

} // namespace overturn
