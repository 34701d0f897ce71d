// The method of Taylor series, under pulses and under records.
#pragma once

#include "overturn/integrate/record_stepper.hpp"
#include "overturn/integrate/taylor_stepper.hpp"

namespace overturn {

/// Selects Taylor series of this order.
template <int order>
struct Taylor {
    template <Theory theory, Number T, Outputs outputs, class Excitation>
    using Stepper = std::conditional_t<std::same_as<Excitation, PulseExcitation<T>>,
                                       TaylorStepper<order, theory, T, outputs>,
                                       RecordStepper<order, theory, T, outputs, Excitation>>;
};

} // namespace overturn
