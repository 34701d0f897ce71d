// SUNDIALS CVODE: Adams methods of variable order, fixed-point corrector, CVODE's root finding. It
// restarts at order 1 after an impact; CVODE's choice of the first step was the fastest.
#include "sundials_handles.hpp"

#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <new>

namespace overturn::benchmarks {

std::vector<PeerEnd<double>> solve_by_cvode_adams(const PeerProblem& problem, double tolerance)
{
    SundialsState state;
    const void* current = nullptr;
    void* memory = CVodeCreate(CV_ADAMS, state.context());
    if (memory == nullptr) {
        throw std::bad_alloc();
    }
    CVodeInit(memory, rocking_derivative_of(problem), 0, state.vector());
    SUNNonlinearSolver corrector = SUNNonlinSol_FixedPoint(state.vector(), 0, state.context());
    CVodeSetNonlinearSolver(memory, corrector);
    CVodeSetUserData(memory, &current);
    CVodeSStolerances(memory, tolerance, tolerance * problem.points.front().block.slenderness);
    CVodeSetMaxNumSteps(memory, 1 << 20);
    CVodeRootInit(memory, 2, rocking_gaps);
    CVodeSetRootDirection(memory, const_cast<int*>(closing_gaps));
    CVodeSetNoInactiveRootWarn(memory);

    const auto fly = [&](const auto& rocking, Moment<double>& now, Start start) {
        current = &rocking;
        if (start != Start::sample) { // at a sample, it continues: order 1 would cost more
            state.set(now.state);
            CVodeReInit(memory, now.time, state.vector());
        }
        CVodeSetStopTime(memory, rocking.end());
        const int result = CVode(memory, rocking.end(), state.vector(), &now.time, CV_NORMAL);
        now.state = state.get();
        if (result == CV_ROOT_RETURN) {
            return outcome_at_root(now.state);
        }
        return result >= 0 ? Outcome::piece_end : Outcome::failure;
    };
    std::vector<PeerEnd<double>> ends = run_points<double>(problem, fly);
    SUNNonlinSolFree(corrector);
    CVodeFree(&memory);
    return ends;
}

} // namespace overturn::benchmarks
