// For tests that cause overflow or NaN: during the lifetime of the object, floating-point
// exceptions are not trapped, also with OVERTURN_TRAP.
#pragma once

#include <cfenv>

namespace overturn {

class UntrappedFloatingPoint {
public:
    UntrappedFloatingPoint() { std::feholdexcept(&before_); }
    ~UntrappedFloatingPoint() { std::fesetenv(&before_); }
    UntrappedFloatingPoint(const UntrappedFloatingPoint&) = delete;
    UntrappedFloatingPoint& operator=(const UntrappedFloatingPoint&) = delete;

private:
    std::fenv_t before_;
};

} // namespace overturn
