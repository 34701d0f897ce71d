// The bound on the error where it is unknown: infinite, never NaN.
#include "verdicts.hpp"

#include <gtest/gtest.h>

namespace overturn {
namespace {

TEST(ErrorField, IsANumberOrInfiniteForStepsAsLongAsThePulse)
{
    // Under a constant push and a loose tolerance a step is longer than an angle of 2.
    expect_right_verdicts({.pulse = PulseKind::rectangular,
                           .slenderness = 0.44,
                           .restitution = 0.51,
                           .frequency = 10,
                           .amplitude = 1.003});
    expect_right_verdicts({.pulse = PulseKind::symmetric_ricker,
                           .slenderness = 0.36457181207979411,
                           .restitution = 0.61988986985170336,
                           .frequency = 9.2186123802826341,
                           .amplitude = 2.9866440246899479,
                           .window = 1.4763967954102055});
}

} // namespace
} // namespace overturn
