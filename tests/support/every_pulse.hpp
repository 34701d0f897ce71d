// Tests over all pulses: class Suite : public EveryPulse {}; INSTANTIATE_TEST_SUITE_P(...,
// every_pulse(), pulse_test_name).
#pragma once

#include "overturn/mechanics/pulse_motion.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace overturn {

/// General values of the numbers other than the window.
inline PulseShape shape_of_test(double window)
{
    return {.window = window, .cycles = 2.5, .gamma = 2.3, .nu = 0.7};
}

class EveryPulse : public testing::TestWithParam<PulseKind> {
protected:
    template <class S>
    static PulseMotion<S> motion(const S& window)
    {
        return pulse_motion<S>(GetParam(), shape_of_test(double(window)));
    }
};

inline auto every_pulse()
{
    std::vector<PulseKind> kinds;
    for (std::size_t kind = 0; kind < pulses.size(); ++kind) {
        kinds.push_back(PulseKind(kind));
    }
    return testing::ValuesIn(kinds);
}

inline std::string pulse_test_name(const testing::TestParamInfo<PulseKind>& pulse)
{
    return std::string(traits_of(pulse.param).name);
}

/// f at one phase [rad].
template <class S>
S value_of_pulse(const PulseMotion<S>& motion, const S& phase)
{
    return motion.with_formula([&](const auto& formula) { return formula.value(phase); });
}

} // namespace overturn
