// Common parts of both SUNDIALS integrators: the right-hand side, the gaps whose roots are events,
// and the context and state vector.
#pragma once

#include "rocking_point.hpp"

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include <algorithm>

namespace overturn::benchmarks {

/// A context and a vector of two; must outlive the integrators created from it.
class SundialsState {
public:
    SundialsState()
    {
        SUNContext_Create(nullptr, &context_);
        vector_ = N_VNew_Serial(2, context_);
        N_VEnableFusedOps_Serial(vector_, SUNTRUE); // off by default; saves a fifth with ARKODE
    }
    ~SundialsState()
    {
        N_VDestroy(vector_);
        SUNContext_Free(&context_);
    }
    SundialsState(const SundialsState&) = delete;
    SundialsState& operator=(const SundialsState&) = delete;

    SUNContext context() const { return context_; }
    N_Vector vector() const { return vector_; }

    void set(const RockingState<double>& state)
    {
        std::copy(state.begin(), state.end(), NV_DATA_S(vector_));
    }
    RockingState<double> get() const { return {NV_Ith_S(vector_, 0), NV_Ith_S(vector_, 1)}; }

private:
    SUNContext context_ = nullptr;
    N_Vector vector_ = nullptr;
};

/// rocking: the address of a pointer to the current point.
template <class RockingBlock>
int rocking_derivative(double time, N_Vector state, N_Vector derivative, void* rocking)
{
    const double* y = NV_DATA_S(state);
    double* change = NV_DATA_S(derivative);
    change[0] = y[1];
    const void* current = *static_cast<const void* const*>(rocking);
    change[1] = static_cast<const RockingBlock*>(current)->acceleration(y[0], time);
    return 0;
}

/// The right-hand side for the ground motion of a problem.
inline auto* rocking_derivative_of(const PeerProblem& problem)
{
    return problem.scene.is_under(Under::record)
               ? rocking_derivative<Rocking<
                     double, RecordExcitation<double, Directions::horizontal>, Sines::library>>
               : rocking_derivative<Rocking<double, PulseExcitation<double>, Sines::library>>;
}

/// The gaps to the ground and to pi/2; each closes at an event.
inline int rocking_gaps(double, N_Vector state, double* gaps, void*)
{
    gaps[0] = NV_Ith_S(state, 0);
    gaps[1] = pi<double>() / 2 - NV_Ith_S(state, 0);
    return 0;
}
inline constexpr int closing_gaps[2] = {-1, -1};

/// The outcome at a root: determines which of the two gaps has closed.
inline Outcome outcome_at_root(const RockingState<double>& state)
{
    return state[0] > pi<double>() / 4 ? Outcome::fall : Outcome::impact;
}

} // namespace overturn::benchmarks
