// For a test that provokes overflow or what is not a number: while the object lives, floating-point
// exceptions stop nothing, also with OVERTURN_TRAP.
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
