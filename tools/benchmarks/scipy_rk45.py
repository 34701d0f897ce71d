"""SciPy's solve_ivp (RK45, with events) on points of the peer benchmark, as used in a script.
All quantities are dimensionless, as in rocking_point.hpp; the theory is nonlinear."""

import math
import time

import numpy
from scipy.integrate import solve_ivp

SMALLEST_RELATIVE = 100 * numpy.finfo(float).eps  # below this, SciPy warns and uses this value
RATES_PER_STEP = 6  # evaluations of the derivative in a step of RK45


class OneSine:
    """The pulse over its phase [rad]; accelerations over g."""

    end = 2 * math.pi

    def __init__(self, slenderness, amplitude):
        self.acceleration = amplitude * math.tan(slenderness)
        first = math.asin(1 / amplitude) if amplitude > 1 else math.inf
        self.uplifts = [first, first + math.pi]

    def at(self, phase):
        return self.acceleration * math.sin(phase)

    def end_of_piece(self, _):
        return self.end

    def is_monotone(self, first, last):
        return not any(first < peak < last for peak in (math.pi / 2, 3 * math.pi / 2))

    def next_uplift(self, phase):
        return min((uplift for uplift in self.uplifts if uplift >= phase), default=math.inf)

    def fastest(self, frequency):
        return max(1.0, frequency)


class Record:
    """A record over its phase [samples]; accelerations over g."""

    def __init__(self, samples, slenderness, scale):
        self.samples = [scale * sample for sample in samples]
        self.end = len(samples) - 1
        self.threshold = math.tan(slenderness)
        self.lifting = numpy.flatnonzero(numpy.abs(self.samples) > self.threshold)

    def at(self, phase):
        before = min(int(phase), self.end - 1)
        here = self.samples[before]
        return here + (phase - before) * (self.samples[before + 1] - here)

    def end_of_piece(self, phase):
        return min(int(phase), self.end - 1) + 1

    def is_monotone(self, first, last):
        return last <= self.end_of_piece(first)

    def next_uplift(self, phase):
        number = numpy.searchsorted(self.lifting, math.ceil(phase))
        if number == len(self.lifting):
            return math.inf
        there = int(self.lifting[number])
        side = math.copysign(1, self.samples[there])
        low = side * self.samples[max(there - 1, 0)] - self.threshold
        high = side * self.samples[there] - self.threshold
        return max(phase, there - 1 + low / (low - high) if low < 0 else max(there - 1, 0))

    def fastest(self, _):
        return 1.0


class Rocking:
    """One point: the equation of motion on the side on which the block rocks (Eq. 47)."""

    def __init__(self, slenderness, restitution, ground, frequency):
        self.slenderness = slenderness
        self.restitution = restitution
        self.ground = ground
        self.frequency = frequency
        self.side = 1.0

    def derivative(self, tau, state):
        y = self.slenderness - state[0]
        push = self.side * self.ground.at(self.frequency * tau)
        return state[1], -(math.sin(y) + push * math.cos(y))

    def bounces_die_out(self, phase, rate):
        """As mechanics/bounce_series.hpp."""
        if rate == 0:
            return True
        sine, cosine = math.sin(self.slenderness), math.cos(self.slenderness)
        ground = self.ground.at(phase)
        plus, minus = sine + ground * cosine, sine - ground * cosine
        weaker = min(plus, minus)
        if weaker <= 0 or 10 * rate**2 * (1 + abs(ground)) > weaker**2:
            return False
        series = rate / (1 - math.sqrt(self.restitution))
        duration = 3 * series / weaker
        over = phase + duration * self.frequency
        if over > self.ground.end or not self.ground.is_monotone(phase, over):
            return False
        then = self.ground.at(over)
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


def next_step(flight, step):
    """The first step after a flight that began with `step`, or with a shorter one that reached its
    end: grows if no step was rejected."""
    steps = numpy.diff(flight.t)
    if flight.nfev > 1 + RATES_PER_STEP * len(steps):
        return steps.max() or step / 2
    return max(step, 2 * steps.max())


def end_of_point(point, samples, tolerance):
    """theta and theta' at the end of the ground motion, or at the fall [rad]."""
    slenderness, restitution, amplitude, frequency = point
    ground = Record(samples, slenderness, amplitude) if samples else OneSine(slenderness, amplitude)
    rocking = Rocking(slenderness, restitution, ground, frequency)
    phase = 0.0
    while True:
        phase = ground.next_uplift(phase)
        if phase >= ground.end:
            return 0.0, 0.0
        tau, tilt, rate = phase / frequency, 0.0, 0.0
        rocking.side = 1.0 if ground.at(phase) < 0 else -1.0
        step = tolerance**0.2 / ground.fastest(frequency)
        while True:
            end_of_piece = ground.end_of_piece(phase)
            end = end_of_piece / frequency
            strikes = False
            if tau < end:
                flight = solve_ivp(rocking.derivative, (tau, end), (tilt, rate), method="RK45",
                                   rtol=max(tolerance, SMALLEST_RELATIVE),
                                   atol=tolerance * slenderness, first_step=min(step, end - tau),
                                   events=(touches_ground, lies_flat))
                tau, (tilt, rate) = flight.t[-1], flight.y[:, -1]
                if flight.status < 0:
                    return math.nan, math.nan
                if flight.t_events[1].size:
                    return rocking.side * tilt, rocking.side * rate
                step = next_step(flight, step)
                strikes = flight.status == 1
            if not strikes:
                if end_of_piece >= ground.end:
                    return rocking.side * tilt, rocking.side * rate
                tau, phase = end, float(end_of_piece)
                continue
            tilt, rate = 0.0, -rate * math.sqrt(restitution)
            rocking.side = -rocking.side
            phase = tau * frequency
            if rocking.bounces_die_out(phase, rate):
                break


def measure(points, reference, samples, unit, tolerance):
    """The 99th percentile of the error over the points of a reference that are compared and safe,
    and microseconds per point. points: (slenderness, restitution, amplitude, frequency); reference:
    (angle, velocity, region, compared); samples: of a record over g, none for a pulse; unit: of
    errors [rad]."""
    begin = time.process_time()
    ends = [end_of_point(point, samples, tolerance) for point in points]
    elapsed = time.process_time() - begin
    errors = sorted(max(abs(end[0] - truth[0]), abs(end[1] - truth[1])) / unit
                    for end, truth in zip(ends, reference) if truth[3] and truth[2] <= 2)
    if not errors or any(math.isnan(error) for error in errors):
        return math.inf, 1e6 * elapsed / len(points)
    return errors[(len(errors) * 99 + 99) // 100 - 1], 1e6 * elapsed / len(points)
