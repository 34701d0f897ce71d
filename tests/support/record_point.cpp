#include "support/record_point.hpp"

#include "overturn/integrate/forced_stage.hpp"

namespace overturn {

template <Theory theory, bool upwards, int order>
ForcedEnd<double> run_record(const RecordPoint& point, double tolerance)
{
    return run_forced_stage<Taylor<order>, theory, Records{.impacts = true, .error = true}>(
        point.block, excitation_of<theory, upwards>(point), tolerance);
}

template <Theory theory, bool upwards>
double peak_under_record(const RecordPoint& point, double tolerance)
{
    return run_forced_stage<Taylor<14>, theory, Records{.peak = true}>(
               point.block, excitation_of<theory, upwards>(point), tolerance)
        .peak;
}

template <Theory theory, bool upwards>
std::vector<double> tilts_at_samples(const RecordPoint& point, double tolerance)
{
    const auto excitation = excitation_of<theory, upwards>(point);
    ForcedStage<Taylor<14>, theory, Records{.events = true}, double,
                RecordExcitation<double, upwards>>
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

#define OVERTURN_INSTANTIATE(theory, upwards)                                                      \
    template ForcedEnd<double> run_record<theory, upwards, 8>(const RecordPoint&, double);         \
    template ForcedEnd<double> run_record<theory, upwards, 14>(const RecordPoint&, double);        \
    template ForcedEnd<double> run_record<theory, upwards, 20>(const RecordPoint&, double);        \
    template double peak_under_record<theory, upwards>(const RecordPoint&, double);                \
    template std::vector<double> tilts_at_samples<theory, upwards>(const RecordPoint&, double);
OVERTURN_INSTANTIATE(Theory::nonlinear, false)
OVERTURN_INSTANTIATE(Theory::nonlinear, true)
OVERTURN_INSTANTIATE(Theory::linear, false)
OVERTURN_INSTANTIATE(Theory::linear, true)

} // namespace overturn
