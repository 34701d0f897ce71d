#include "overturn/integrate/sliding_motion.hpp"

namespace overturn {

template class SlidingMotion<double, PulseExcitation<double>>;
template class SlidingMotion<double, RecordExcitation<double, Directions::both>>;
template class SlidingMotion<long double, PulseExcitation<long double>>;
template class SlidingMotion<long double, RecordExcitation<long double, Directions::both>>;

template SlidingEnd<double> run_sliding(const Block<double>&, const double&, const double&,
                                        const PulseExcitation<double>&, const double&, Follow);
template SlidingEnd<double> run_sliding(const Block<double>&, const double&, const double&,
                                        const RecordExcitation<double, Directions::both>&,
                                        const double&, Follow);
template SlidingEnd<long double> run_sliding(const Block<long double>&, const long double&,
                                             const long double&,
                                             const PulseExcitation<long double>&,
                                             const long double&, Follow);
template SlidingEnd<long double> run_sliding(const Block<long double>&, const long double&,
                                             const long double&,
                                             const RecordExcitation<long double, Directions::both>&,
                                             const long double&, Follow);

} // namespace overturn
