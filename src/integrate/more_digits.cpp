#include "overturn/integrate/more_digits.hpp"

namespace overturn {

OVERTURN_MORE_DIGITS(template, Digits31, PulseExcitation<Digits31>)
OVERTURN_MORE_DIGITS(template, Digits50, PulseExcitation<Digits50>)
OVERTURN_MORE_DIGITS(template, Digits50, RecordExcitation<Digits50, Directions::both>)

} // namespace overturn
