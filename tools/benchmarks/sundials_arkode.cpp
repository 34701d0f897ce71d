// SUNDIALS ARKODE: explicit Dormand-Prince 4(5) with ARKODE's step size control and root finding.
// Controllers and interpolants other than the defaults were no faster at the same error.
#include "sundials_handles.hpp"

#include <arkode/arkode_erkstep.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace overturn::benchmarks {

std::vector<PeerEnd<double>> solve_by_arkode(const PeerProblem& problem, double tolerance)
{
    SundialsState state;
    const void* current = nullptr;
    void* memory =
        ERKStepCreate(rocking_derivative_of(problem), 0, state.vector(), state.context());
    if (memory == nullptr) {
        throw std::bad_alloc();
    }
    const double first_step = std::pow(tolerance, 0.2);
    ERKStepSetUserData(memory, &current);
    ERKStepSetTableNum(memory, ARKODE_DORMAND_PRINCE_7_4_5);
    ERKStepSStolerances(memory, tolerance, tolerance * problem.points.front().block.slenderness);
    ERKStepSetMaxNumSteps(memory, 1 << 20);
    ERKStepRootInit(memory, 2, rocking_gaps);
    ERKStepSetRootDirection(memory, const_cast<int*>(closing_gaps));
    ERKStepSetNoInactiveRootWarn(memory);

    const auto fly = [&](const auto& rocking, Moment<double>& now, Start start) {
        current = &rocking;
        if (start != Start::sample) { // at a sample, it continues
            double h = first_step / rocking.fastest();
            if (start != Start::uplift) {
                ERKStepGetCurrentStep(memory, &h);
            }
            state.set(now.state);
            ERKStepReset(memory, now.time, state.vector());
            ERKStepSetInitStep(memory, std::min(h, rocking.end() - now.time));
        }
        ERKStepSetStopTime(memory, rocking.end());
        const int result =
            ERKStepEvolve(memory, rocking.end(), state.vector(), &now.time, ARK_NORMAL);
        now.state = state.get();
        if (result == ARK_ROOT_RETURN) {
            return outcome_at_root(now.state);
        }
        return result >= 0 ? Outcome::piece_end : Outcome::failure;
    };
    std::vector<PeerEnd<double>> ends = run_points<double>(problem, fly);
    ERKStepFree(&memory);
    return ends;
}

} // namespace overturn::benchmarks
