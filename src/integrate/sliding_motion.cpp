#include "overturn/integrate/sliding_motion.hpp"

namespace overturn {

template class SlidingMotion<double, PulseExcitation<double>>;
template class SlidingMotion<double, RecordExcitation<double, Directions::both>>;

} // namespace overturn
