#include "overturn/integrate/sliding_motion.hpp"

namespace overturn {

template class SlidingMotion<double, PulseExcitation<double>>;
template class SlidingMotion<double, RecordExcitation<double, Directions::both>>;
template class SlidingMotion<long double, PulseExcitation<long double>>;
template class SlidingMotion<long double, RecordExcitation<long double, Directions::both>>;

} // namespace overturn
