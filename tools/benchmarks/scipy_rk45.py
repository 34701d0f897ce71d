"""SciPy's solve_ivp (RK45, with events) on points of the peer benchmark, as used in a script.
All quantities are dimensionless, as in rocking_point.hpp; the pulse is one_sine, the theory
nonlinear."""

import math
import time

import numpy
from scipy.integrate import solve_ivp

SMALLEST_RELATIVE = 100 * numpy.finfo(float).eps  # below this, SciPy warns and uses this value


class Rocking:
    """One point: the equation of motion on the side on which the block rocks (Eq. 47)."""

    def __init__(self, slenderness, restitution, amplitude, frequency):
        self.slenderness = slenderness
        self.restitution = restitution
        self.acceleration = amplitude * math.tan(slenderness)
        self.frequency = frequency
        self.side = 1.0
        first = math.asin(1 / amplitude) if amplitude > 1 else math.inf
        self.uplifts = [first, first + math.pi]

    def ground(self, phase):
        return self.acceleration * math.sin(phase)

    def derivative(self, tau, state):
        y = self.slenderness - state[0]
        push = self.side * self.ground(self.frequency * tau)
        return state[1], -(math.sin(y) + push * math.cos(y))

    def bounces_die_out(self, phase, rate):
        """As mechanics/bounce_series.hpp."""
        if rate == 0:
            return True
        sine, cosine = math.sin(self.slenderness), math.cos(self.slenderness)
        ground = self.ground(phase)
        plus, minus = sine + ground * cosine, sine - ground * cosine
        weaker = min(plus, minus)
        if weaker <= 0 or 10 * rate**2 * (1 + abs(ground)) > weaker**2:
            return False
        series = rate / (1 - math.sqrt(self.restitution))
        duration = 3 * series / weaker
        over = phase + duration * self.frequency
        peaks = math.pi / 2, 3 * math.pi / 2
        if over > 2 * math.pi or any(phase < peak < over for peak in peaks):
            return False
        then = self.ground(over)
        plus_then, minus_then = sine + then * cosine, sine - then * cosine
        if plus_then >= plus:
            rise, rise_then, fall_then = plus, plus_then, minus_then
        else:
            rise, rise_then, fall_then = minus, minus_then, plus_then
        return (2 * series <= duration * rise
                and 2 * series * math.sqrt(rise_then / rise) <= duration * fall_then)


def touches_ground(_, state):
    return state[0]


def lies_flat(_, state):
    return math.pi / 2 - state[0]


for event in (touches_ground, lies_flat):
    event.terminal, event.direction = True, -1


def end_of_point(point, tolerance):
    """theta and theta' at the end of the pulse, or at the fall [rad]."""
    rocking = Rocking(*point)
    end = 2 * math.pi / rocking.frequency
    phase = 0.0
    while True:
        lifting = [uplift for uplift in rocking.uplifts if uplift >= phase]
        if not lifting:
            return 0.0, 0.0
        tau, state = lifting[0] / rocking.frequency, (0.0, 0.0)
        rocking.side = 1.0 if rocking.ground(lifting[0]) < 0 else -1.0
        step = tolerance**0.2 / max(1.0, rocking.frequency)
        while True:
            flight = solve_ivp(rocking.derivative, (tau, end), state, method="RK45",
                               rtol=max(tolerance, SMALLEST_RELATIVE),
                               atol=tolerance * rocking.slenderness,
                               first_step=min(step, end - tau),
                               events=(touches_ground, lies_flat))
            tau, (tilt, rate) = flight.t[-1], flight.y[:, -1]
            if flight.status < 0:
                return math.nan, math.nan
            if flight.status == 0 or flight.t_events[1].size:
                return rocking.side * tilt, rocking.side * rate
            step = flight.t[-2] - flight.t[-3] if flight.t.size > 2 else step
            rate *= -math.sqrt(rocking.restitution)
            rocking.side = -rocking.side
            phase, state = tau * rocking.frequency, (0.0, rate)
            if tau >= end:
                return 0.0, rocking.side * rate
            if rocking.bounces_die_out(phase, rate):
                break


def measure(points, reference, tolerance):
    """The 99th percentile of the error over the safe points of a reference, and microseconds per
    point. points: (slenderness, restitution, amplitude, frequency); reference: (angle, velocity,
    region)."""
    begin = time.process_time()
    ends = [end_of_point(point, tolerance) for point in points]
    elapsed = time.process_time() - begin
    errors = sorted(max(abs(end[0] - truth[0]), abs(end[1] - truth[1]))
                    for end, truth in zip(ends, reference) if truth[2] <= 2)
    if any(math.isnan(error) for error in errors):
        return math.inf, 1e6 * elapsed / len(points)
    return errors[(len(errors) * 99 + 99) // 100 - 1], 1e6 * elapsed / len(points)
