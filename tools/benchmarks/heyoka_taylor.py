"""heyoka.py in batch mode, with terminal events, on points of the peer benchmark under a pulse. The compilation of
the integrator is not timed. All quantities are dimensionless, as in rocking_point.hpp; the theory is nonlinear."""

import functools
import math
import time

import heyoka
import numpy
from scipy_rk45 import OneSine, Rocking

SLENDERNESS, ACCELERATION, FREQUENCY, SIDE, MOVES = range(5)  # parameters; MOVES is 0 in lanes that have ended
heyoka.set_nthreads(1)  # the benchmark is on one core
START = 1e-4  # of a unit of the phase, after uplift: an impact at the very beginning of a step would be found


class Batch:
    """As many points at a time as fit into a register."""

    def __init__(self, tolerance):
        tilt, rate = heyoka.make_vars("tilt", "rate")
        slenderness, acceleration, frequency, side, moves = (heyoka.par[i] for i in range(5))
        y = slenderness - tilt
        push = side * acceleration * heyoka.sin(frequency * heyoka.time)
        lanes = heyoka.recommended_simd_size()
        downwards = heyoka.event_direction.negative
        self.integrator = heyoka.taylor_adaptive_batch(
            [(tilt, moves * rate), (rate, -moves * (heyoka.sin(y) + push * heyoka.cos(y)))],
            state=numpy.ones((2, lanes)), pars=numpy.ones((5, lanes)), tol=tolerance,
            # heyoka copies callbacks, but not what a function refers to.
            t_events=[heyoka.t_event_batch(tilt, callback=lambda *event: self.impact(*event), direction=downwards),
                      heyoka.t_event_batch(math.pi / 2 - tilt, callback=lambda *event: self.fall(*event),
                                           direction=downwards)])
        self.size = lanes

    def impact(self, integrator, _, lane):
        slenderness, restitution, amplitude, frequency = self.points[lane]
        rate = -integrator.state[1, lane] * math.sqrt(restitution)
        integrator.state[:, lane] = 0, rate
        integrator.pars[SIDE, lane] *= -1
        ground = OneSine(slenderness, amplitude)
        phase = integrator.time[lane] * frequency
        if Rocking(slenderness, restitution, ground, frequency).bounces_die_out(phase, rate):
            integrator.state[:, lane] = 1, 0  # not 0: there is no event in a lane that has ended
            integrator.pars[MOVES, lane] = 0
            self.next_uplift[lane] = ground.next_uplift(phase)
        return True

    def fall(self, integrator, _, lane):
        integrator.pars[MOVES, lane] = 0
        return True

    def follow(self, points, uplift):
        """Follows the points of a batch from these phases to the end of the pulse or to the fall. Returns theta and
        theta', and the phase of the next uplift of those that came to rest, NaN of the others."""
        slenderness, _, amplitude, frequency = points.T
        acceleration = amplitude * numpy.tan(slenderness)
        side = numpy.where(numpy.sin(uplift) < 0, 1.0, -1.0)
        # The third derivative of theta at uplift, where the second is 0; the next term is of the fifth order.
        jolt = -side * acceleration * numpy.cos(slenderness) * numpy.cos(uplift) * frequency
        after = START / frequency
        self.points, self.next_uplift = points, numpy.full(self.size, math.nan)
        integrator = self.integrator
        integrator.state[:] = jolt * after ** 3 / 6, jolt * after ** 2 / 2
        integrator.pars[:] = slenderness, acceleration, frequency, side, numpy.ones(self.size)
        integrator.set_time(uplift / frequency + after)
        integrator.reset_cooldowns()
        integrator.propagate_until(2 * math.pi / frequency)
        ends = integrator.pars[SIDE] * integrator.state
        ends[:, ~numpy.isnan(self.next_uplift)] = 0
        return ends, self.next_uplift

    def ends_of(self, points):
        """theta and theta' of each point at the end of the ground motion, or at the fall [rad]: (2, points)."""
        ends = numpy.zeros((2, len(points)))
        with numpy.errstate(invalid="ignore"):
            uplift = numpy.where(points[:, 2] > 1, numpy.arcsin(1 / points[:, 2]), math.inf)
        waiting = numpy.flatnonzero(uplift < 2 * math.pi)
        while waiting.size:
            for first in range(0, waiting.size, self.size):
                rows = waiting[first:first + self.size]
                lanes = numpy.resize(rows, self.size)  # the last batch repeats points
                ends[:, lanes], uplift[lanes] = self.follow(points[lanes], uplift[lanes])
            waiting = waiting[uplift[waiting] < 2 * math.pi]
        return ends


batch_of = functools.cache(Batch)


def measure(points, reference, _, unit, tolerance):
    """As scipy_rk45.measure()."""
    batch = batch_of(tolerance)
    points = numpy.array(points)
    begin = time.process_time()
    ends = batch.ends_of(points)
    elapsed = time.process_time() - begin
    errors = sorted(max(abs(end[0] - truth[0]), abs(end[1] - truth[1])) / unit
                    for end, truth in zip(ends.T, reference) if truth[3] and truth[2] <= 2)
    if not errors or any(math.isnan(error) for error in errors):
        return math.inf, 1e6 * elapsed / len(points)
    return errors[(len(errors) * 99 + 99) // 100 - 1], 1e6 * elapsed / len(points)
