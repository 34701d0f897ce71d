"""The search for the tolerance at which a solver has a given error."""

import math

PER_DECADE = 16  # tolerances tried
LOOSEST = PER_DECADE * 2  # 1e-2, in steps of the search


def matched_tolerance(solver, target, errors):
    """The loosest tolerance whose error is within the target, and that error; (None, None) if there
    is none. Tolerances are 10^(-k/16); `errors` caches errors by k. The error is not quite monotone
    in k, so four tolerances looser than the first that fails are tried as well."""
    def error(k):
        if k not in errors:
            errors[k] = solver.error(10.0 ** (-k / PER_DECADE))
        return errors[k]

    def decades_off(k):
        return math.log10(error(k) / target) if 0 < error(k) < math.inf else 1.0

    best = min(solver.tightest, round(-PER_DECADE * math.log10(target)))
    while error(best) > target:
        if best == solver.tightest:
            return None, None
        best = min(solver.tightest, best + max(1, math.ceil(PER_DECADE * decades_off(best))))
    failing = LOOSEST - 1
    while best > failing + 1:
        looser = max(failing + 1, best + min(-1, math.ceil(PER_DECADE * decades_off(best))))
        if error(looser) > target:
            failing = looser
            break
        best = looser
    while best > failing + 1:
        middle = (best + failing) // 2
        if error(middle) > target:
            failing = middle
        else:
            best = middle
    for k in range(max(LOOSEST, best - 5), best):
        if error(k) <= target:
            best = k
            break
    return 10.0 ** (-best / PER_DECADE), error(best)
