#include "overturn/integrate/sliding_motion.hpp"
#include "overturn/number/digits50.hpp"

namespace overturn {

template SlidingEnd<Digits50> run_sliding(const Block<Digits50>&, const Digits50&, const Digits50&,
                                          const PulseExcitation<Digits50>&, const Digits50&,
                                          Follow);
template SlidingEnd<Digits50> run_sliding(const Block<Digits50>&, const Digits50&, const Digits50&,
                                          const RecordExcitation<Digits50, Directions::both>&,
                                          const Digits50&, Follow);

} // namespace overturn
