#include "support/record_point.hpp"

#include "overturn/integrate/forced_stage.hpp"

namespace overturn {

template <Directions directions>
ForcedEnd<Digits50> run_record_in_digits(const RecordPoint& point, double tolerance)
{
    const Block<Digits50> block{point.block.slenderness, point.block.restitution};
    return run_forced_stage<Taylor<20>, Theory::nonlinear>(
        block, excitation_of<Theory::nonlinear, directions, Digits50>(point), Digits50(tolerance));
}

template ForcedEnd<Digits50> run_record_in_digits<Directions::horizontal>(const RecordPoint&,
                                                                          double);
template ForcedEnd<Digits50> run_record_in_digits<Directions::both>(const RecordPoint&, double);

} // namespace overturn
