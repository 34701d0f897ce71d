#include "overturn/integrate/sliding_motion.hpp"

namespace overturn {

template <Number S, class Excitation>
SlidingEnd<S> run_sliding(const Block<S>& block, const S& gyration, const S& friction,
                          const Excitation& excitation, const S& tolerance, Follow follow)
{
    SlidingMotion<S, Excitation> motion(block, gyration, friction, excitation, tolerance, follow);
    while (!motion.is_over()) {
        motion.advance();
    }
    return motion.end();
}

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
