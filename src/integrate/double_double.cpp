// Compiled for the instruction set of the kernel `double`, which has fma, and with more
// optimisation than other files of this folder.
#include "overturn/integrate/more_digits.hpp"

namespace overturn {

OVERTURN_MORE_DIGITS(template, DoubleDouble, RecordExcitation<DoubleDouble, Directions::both>)

} // namespace overturn
