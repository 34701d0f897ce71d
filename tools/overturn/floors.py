"""Accelerations of the floors of buildings."""

from __future__ import annotations

import bisect
import dataclasses
import os
import warnings
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from scipy.linalg import expm
from scipy.signal import lfilter

from overturn.accelerations import accelerations_of
from overturn.arguments import ArgumentError, number, numbers
from overturn.motion_words import FLOOR
from overturn.output_file import write_text

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from overturn.accelerations import Motion, Stream, Trace

TITLE = "# time [s], acceleration [g]"  # of a text
MOST_SAMPLES = 10_000_000  # of a floor: 80 MB
USUAL_PERIODS = 0.01, 20  # of buildings [s]
LARGEST_TOTAL = 2  # of the shapes; that of the first mode alone is up to 1.6 at the top of a building
SHORTEST_PERIOD = 1e-6  # over the time step: the phase after a step is then known to 1e-9 rad


@dataclasses.dataclass(frozen=True, eq=False)
class FloorMotion:
    """The motion of a floor, a record for evaluate()."""

    acceleration: NDArray[np.float64]  #: absolute, over g [1]
    time_step: float  #: between two samples [s]
    error: float  #: bound of the error of linear interpolation between the samples, over g [1]
    remaining: float  #: bound of the acceleration after the last sample, over g [1]
    ground_pga: float | None = None  #: peak acceleration of the ground, over g [1]
    motion_of: ClassVar[str] = FLOOR

    def to_text(self, path: str | os.PathLike[str]) -> None:
        """Writes a text of two columns, times [s] and accelerations over g, as a record of a job. Its comments state the
        unit, that it is the motion of a floor, and the PGA of the ground.

        Raises OutputError if the file cannot be written, or another one exists."""
        ground = [] if self.ground_pga is None else [f"# ground_pga = {self.ground_pga!r}"]
        times = self.time_step * np.arange(self.acceleration.size)
        rows = [f"{time!r} {value!r}" for time, value in zip(times.tolist(), self.acceleration.tolist())]
        write_text(path, "\n".join([TITLE, "# units = g", f"# motion_of = {FLOOR}", *ground, *rows, ""]), "a motion of a floor",
                   lambda beginning: beginning.startswith(TITLE.encode()))


@dataclasses.dataclass(frozen=True)
class _Modes:
    """Arrays (modes,)."""

    angle: NDArray[np.float64]  # w times the time step of the ground [rad]
    root: NDArray[np.complex128]  # of r^2 + 2 damping r + 1 = 0: -damping + i sqrt(1 - damping^2)
    shape: NDArray[np.float64]


def floor_motion(record: ArrayLike | Motion | Trace | Stream, time_step: float | None = None, *, periods: ArrayLike,
                 damping: ArrayLike, shape: ArrayLike, tolerance: float = 1e-4, units: str | None = None,
                 gravity: float = 9.81) -> FloorMotion:
    """Returns the horizontal acceleration of a floor of a linear building, by superposition of its modes.

    record, time_step, units, gravity: the motion of the ground, (n,), as in evaluate(). It is linear between the
        samples and at rest before the first one; after the last one, it falls linearly to 0 within one step.
    periods: (modes,), of the modes [s]; at least SHORTEST_PERIOD times the time step.
    damping: (modes,) or one number, ratio to the critical damping [1], above 0 and below 1.
    shape: (modes,), participation factor times mode shape at the floor [1]. Its sum over all modes of a building is 1.
        Modes that are left out move with the ground.
    tolerance: of `error` and `remaining`, over the peak acceleration of the floor [1].

    With the acceleration a of the ground and the displacements x_i of oscillators relative to it, the floor has

        a + sum of shape_i x_i'',    x_i'' + 2 damping_i w_i x_i' + w_i^2 x_i = -a,    w_i = 2 pi / period_i

    which is a (1 - sum of shape_i) + sum of shape_i (x_i'' + a). The samples are exact (Nigam and Jennings, Bull.
    Seism. Soc. Am. 59 (1969) 909-922). Their time step is that of the ground, or a whole fraction of it, chosen by
    `error`. They continue after the ground until the bound of the free vibration is `remaining`.

    Warns of periods and shapes that are probably in another unit, or not normalised.

    Raises ValueError if a value is not allowed, or if more than MOST_SAMPLES samples are needed; ArgumentError if an
    argument is missing or contradicts a Trace.
    """
    components, step = accelerations_of({"record": record}, None if time_step is None else
                                        number("time_step", time_step), units, number("gravity", gravity))
    if step is None:
        raise ArgumentError("a record needs time_step, unless it is a Record, a FloorMotion or a Trace.")
    _expect("time_step", step, 0 < step < np.inf, "(0, inf)", "It is a time in seconds.")
    tolerance = number("tolerance", tolerance)
    _expect("tolerance", tolerance, 0 < tolerance < 1, "(0, 1)", "It is a part of the peak acceleration of the floor.")
    modes = _modes(periods, damping, shape, step)
    _warn(np.atleast_1d(numbers("periods", periods)), modes.shape.sum())
    ground = np.append(components["record"], 0.0)
    floor, bounds, end = _response(ground, modes)
    allowed = tolerance * abs(floor).max()
    most_parts = MOST_SAMPLES // ground.size
    parts = 1 + bisect.bisect_left(range(1, most_parts), -allowed, key=lambda each: -_error(modes, bounds, each))
    while_shaking = parts * (ground.size - 1) + 1
    free = bisect.bisect_left(range(MOST_SAMPLES), -allowed, key=lambda each: -_remaining(modes, end, each / parts))
    if parts >= most_parts or while_shaking + free > MOST_SAMPLES:
        what = "steps so short" if parts >= most_parts else "so long until the floor is at rest"
        raise ValueError(f"tolerance = {tolerance:g} needs {what} that there are more than {MOST_SAMPLES} samples. "
                         "Give a larger tolerance or more damping, or leave out the modes of the shortest periods.")
    if parts > 1 or free:
        times = np.arange(while_shaking + free) / parts
        fine = np.interp(times, np.arange(ground.size), ground)
        floor = _response(fine, dataclasses.replace(modes, angle=modes.angle / parts))[0]
    is_on_a_floor = getattr(record, "motion_of", None) == FLOOR
    return FloorMotion(floor, step / parts, _error(modes, bounds, parts), _remaining(modes, end, free / parts),
                       record.ground_pga if is_on_a_floor else float(abs(ground).max()))


def _modes(periods, damping, shape, step):
    periods, damping, shape = (np.atleast_1d(numbers(name, value)) for name, value in (
        ("periods", periods), ("damping", damping), ("shape", shape)))
    for name, values in (("periods", periods), ("damping", damping), ("shape", shape)):
        if values.shape != (periods.size,) and not (name == "damping" and values.shape == (1,)) or not periods.size:
            raise ValueError(f"{name} has the shape {values.shape}, and periods has {periods.shape}. Give one number "
                             "for each of one or more modes.")
    shortest = SHORTEST_PERIOD * step
    for i, period in enumerate(periods):
        _expect(f"periods[{i}]", period, shortest <= period < np.inf, f"[{shortest:g}, inf)",
                "It is a time in seconds. Leave out a mode that is stiffer: it moves with the ground.")
    for i, ratio in enumerate(damping):
        _expect(f"damping[{i}]", ratio, 0 < ratio < 1, "(0, 1)", "It is a ratio to the critical damping: give 0.05 for "
                "5 %. Without damping, the floor does not come to rest.")
    for i, factor in enumerate(shape):
        _expect(f"shape[{i}]", factor, np.isfinite(factor), "(-inf, inf)", "It is a factor on the motion of a mode.")
    root = -damping + 1j * np.sqrt((1 - damping) * (1 + damping))
    return _Modes(2 * np.pi * step / periods, np.broadcast_to(root, periods.shape), shape)


def _warn(periods, total):
    """Warns of values that are probably in another unit, or not normalised."""
    for i in np.flatnonzero((periods < USUAL_PERIODS[0]) | (periods > USUAL_PERIODS[1]))[:1]:
        warnings.warn(f"periods[{i}] = {periods[i]:g} is outside {USUAL_PERIODS[0]:g} to {USUAL_PERIODS[1]:g}: periods "
                      "are in seconds.", stacklevel=3)
    if abs(total) > LARGEST_TOTAL:
        warnings.warn(f"the values of shape add up to {total:g}: shape is the participation factor times the mode "
                      "shape at the floor; those of all modes add up to 1.", stacklevel=3)


def _expect(name, value, is_allowed, interval, meaning):
    if not is_allowed:
        raise ValueError(f"{name} = {value:g} is outside {interval}. {meaning}")


def _response(ground, modes):
    """Returns of a ground (n,) the acceleration of the floor (n,), bounds (modes, n) of x_i'' from each sample to the
    next one, and the states z_i (modes,) at the last one, after which the ground is at rest.

        z' = w (r z + i a / (2 Im r)),    w^2 x = 2 Re z,    w x' = 2 Re(r z),    x'' = 2 Re(r^2 z) - a

    Between two samples, x'' is a free vibration, whose energy x''^2 + (x''' / w)^2 does not rise.
    """
    rise = np.diff(ground, append=ground[-1])
    floor, bounds, end = ground.copy(), np.empty((modes.root.size, ground.size)), np.empty_like(modes.root)
    for i, (angle, root, factor) in enumerate(zip(modes.angle, modes.root, modes.shape)):
        decay, of_level, of_rise = expm(np.array(
            [[angle * root, angle * 0.5j / root.imag, 0], [0, 0, 1], [0, 0, 0]]))[0]
        state = np.append(0, lfilter([1], [1, -decay], (of_level * ground + of_rise * rise)[:-1]))
        relative = 2 * (root**2 * state).real - ground
        jerk = -rise / angle + 2 * root.real * relative - 2 * (root * state).real
        floor += factor * relative
        bounds[i], end[i] = np.hypot(relative, jerk), state[-1]
    return floor, bounds, end


def _error(modes, bounds, parts):
    """Returns a bound of the error of linear interpolation with `parts` samples per step h of the ground, from

        |x'' - interpolated| <= min(h^2 / 8 max |x''''|, 2 max |x''|),    |x''''| <= w^2 sqrt(1 + 4 damping^2) bound
    """
    curvature = (modes.angle / parts)**2 / 8 * np.hypot(1, 2 * modes.root.real)
    return float((abs(modes.shape) * np.minimum(curvature, 2) @ bounds).max())


def _remaining(modes, end, steps):
    """Returns a bound of the acceleration of the floor from `steps` steps after the end of the ground on."""
    state = 2 * modes.root**2 * end * np.exp(modes.angle * steps * modes.root)
    return float(abs(modes.shape) @ np.hypot(state.real, (modes.root * state).real))
