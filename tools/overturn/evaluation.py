"""What becomes of single blocks, computed in this process."""

from __future__ import annotations

import enum
import warnings
from typing import TYPE_CHECKING, TypedDict

import numpy as np

from overturn import core
from overturn.accelerations import accelerations_of, motion_of_components
from overturn.arguments import ArgumentError, expect_word, given, number, numbers, refuse

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from overturn.accelerations import Motion, Stream, Trace


class Verdict(enum.IntEnum):
    """The codes of `verdict`. An undecided point counts neither as safe nor as overturning."""

    SAFE = 0
    OVERTURNS = 1
    UNDECIDED = 2


class Outcome(TypedDict):
    """What becomes of every block; all arrays have the broadcast shape of the arguments."""

    verdict: NDArray[np.uint8]  #: codes of Verdict
    region: NDArray[np.uint8]  #: region codes, as in result files
    peak: NDArray[np.float64]  #: largest |theta| / alpha [1]; infinite: overturns; NaN: undecided
    margin: NDArray[np.float64]  #: distance from the other verdict [1], positive: safe
    status: NDArray[np.uint8]  #: status flags, as in result files


_VERDICT_OF_REGION = np.full(256, Verdict.UNDECIDED, np.uint8)
_VERDICT_OF_REGION[list(core.safe_regions.values())] = Verdict.SAFE
_VERDICT_OF_REGION[list(core.unsafe_regions.values())] = Verdict.OVERTURNS


def evaluate(*, width: ArrayLike | None = None, height: ArrayLike | None = None,
             half_width: ArrayLike | None = None, half_height: ArrayLike | None = None,
             center_offset: ArrayLike | None = None, center_height: ArrayLike | None = None,
             radius_of_gyration: ArrayLike | None = None, incline: ArrayLike | None = None,
             slenderness_plus: ArrayLike | None = None, slenderness_minus: ArrayLike | None = None,
             size_plus: ArrayLike | None = None, size_minus: ArrayLike | None = None,
             slenderness: ArrayLike | None = None, aspect_ratio: ArrayLike | None = None,
             size: ArrayLike | None = None,
             frequency_parameter: ArrayLike | None = None,
             restitution: ArrayLike | None = None, restitution_of_maximum: ArrayLike | None = None,
             pulse_period: ArrayLike | None = None, pulse_frequency: ArrayLike | None = None,
             frequency: ArrayLike | None = None,
             pga: ArrayLike | None = None, amplitude: ArrayLike | None = None, direction: ArrayLike | None = None,
             pulse: str | None = None, window: float | None = None, cycles: float | None = None,
             gamma: float | None = None, nu: float | None = None,
             record: ArrayLike | Motion | Trace | Stream | None = None,
             second_component: ArrayLike | Motion | Trace | Stream | None = None,
             vertical: ArrayLike | Motion | Trace | Stream | None = None, time_step: float | None = None,
             units: str | None = None, scale: ArrayLike | None = None,
             motion_of: str | None = None,
             theory: str = "nonlinear", method: str = "taylor", tolerance: float | None = None,
             resolve: bool = False, gravity: float = 9.81) -> Outcome:
    """Computes what becomes of blocks, each under its own pulse, or all under one record.

    The arguments marked with * are numbers or arrays and broadcast by the rules of NumPy. The values
    are those of `overturn run`, bit for bit. Threads may call this function at the same time: it does
    not hold the interpreter's lock.

    The block:
        width*, height*: of the whole block [m]; or half_width*, half_height* [m]; or slenderness* [rad] or
            aspect_ratio* (height / width) [1] with size* (half diagonal R [m]) or frequency_parameter* (p [1/s]);
            or slenderness* alone under a pulse given by frequency.
        center_offset*, center_height*, radius_of_gyration* [m], incline* [rad]: of a block with two different
            sides, beside width and height; or, of one that is not a box, slenderness_plus*, slenderness_minus*
            [rad], size_plus*, size_minus* and radius_of_gyration* [m]; see docs/two_sides.md.
        restitution*: energy ratio r at an impact [1]; or restitution_of_maximum*, r / r_max [1].
    A pulse:
        pulse_period* [s], or pulse_frequency* [Hz], or frequency*, Omega = omega_p / p [1].
        pga*: peak ground acceleration over g [1]; or amplitude*, over the acceleration that lifts the block [1].
        pulse: its kind, by default "one_sine"; window, cycles, gamma, nu: numbers that complete some kinds, see
            docs/jobs.md.
        direction*: 0, the given motion, or 180, its mirror image [degree]; also of a record.
    Or a record:
        record: horizontal accelerations, one-dimensional, linear between samples; an array, what read_record() or
            floor_motion() returns, or a Trace of ObsPy or a Stream of one.
        second_component: accelerations at a right angle to these, at the same times. The motion is then
            record * cos(direction) + second_component * sin(direction), of any direction*.
        vertical: vertical accelerations at the same times, positive upwards.
        units: of these accelerations: "g", the default of arrays, "m/s2", "cm/s2", "mm/s2" or "gal". Required of
            Traces.
        time_step: between two samples [s]; of arrays.
        scale*: factor on all accelerations [1]; or pga*, the peak of the scaled record over g [1].
    Either:
        motion_of: "ground" or "floor", for the words of warnings; pga* is the peak acceleration of this. By default
            that of the record, which floor_motion() and read_record() state, or "ground".
    The computation:
        theory: "nonlinear" or "linear".
        method: "taylor", or "rk45" under pulses.
        tolerance: local error per step [1]; by default 1e-9, with resolve 1e-4.
        resolve: settle verdicts in doubt with up to 50 digits.
        gravity: g [m/s2].

    Warns, once a call, of values that are probably in another unit. Raises ValueError if a value is not
    allowed, with its index in the broadcast shape, or if arrays do not broadcast; ArgumentError, which is a
    TypeError and a ValueError, if arguments are missing or contradict each other.
    """
    columns = given(width=width, height=height, half_width=half_width, half_height=half_height,
                    center_offset=center_offset, center_height=center_height, radius_of_gyration=radius_of_gyration,
                    incline=incline, slenderness_plus=slenderness_plus, slenderness_minus=slenderness_minus,
                    size_plus=size_plus, size_minus=size_minus, direction=direction,
                    slenderness=slenderness, aspect_ratio=aspect_ratio, size=size,
                    frequency_parameter=frequency_parameter,
                    restitution=restitution, restitution_of_maximum=restitution_of_maximum, pga=pga)
    of_pulse = given(pulse_period=pulse_period, pulse_frequency=pulse_frequency, frequency=frequency,
                     amplitude=amplitude)
    shape_numbers = given(window=window, cycles=cycles, gamma=gamma, nu=nu)
    single = {name: number(name, value) for name, value in given(
        **shape_numbers, time_step=time_step, gravity=gravity, tolerance=tolerance).items()}
    for name, value in {**given(pulse=pulse, motion_of=motion_of), "theory": theory, "method": method}.items():
        expect_word(name, value)
    of_record = given(second_component=second_component, vertical=vertical, time_step=time_step, units=units,
                      scale=scale)
    if record is None:
        refuse(of_record, "has no meaning without record")
        if not of_pulse.keys() - {"amplitude"} or not {"amplitude", "pga"} & {*of_pulse, *columns}:
            raise ArgumentError("the ground motion is incomplete. Give pulse_period (or pulse_frequency or "
                                "frequency) and pga (or amplitude), or a record.")
        columns |= of_pulse
        scene = core.scene_of_pulse("one_sine" if pulse is None else pulse, theory, single["gravity"],
                                    {name: single[name] for name in shape_numbers})
    else:
        refuse({**given(pulse=pulse), **of_pulse, **shape_numbers}, "cannot be combined with record")
        motions = given(record=record, second_component=second_component, vertical=vertical)
        motion_of = motion_of_components(motions, motion_of)
        components, step = accelerations_of(motions, single.get("time_step"), units, single["gravity"])
        if step is None or (scale is None) == (pga is None):
            raise ArgumentError("a record needs time_step, unless it is a Record, a FloorMotion or a Trace, and either "
                                "scale or pga.")
        columns |= given(scale=scale)
        scene = core.scene_of_record(components["record"], components.get("second_component", []),
                                     components.get("vertical", []), step, theory, single["gravity"])
    if not isinstance(resolve, (bool, np.bool_)):
        raise ArgumentError(f"resolve = {resolve!r} is neither True nor False.")
    scene = core.with_motion_of(scene, motion_of or "ground")
    numerics = core.numerics(scene, method, single.get("tolerance"), bool(resolve))
    return _evaluated(scene, numerics, columns)


def _evaluated(scene, numerics, columns):
    arrays = {name: numbers(name, value) for name, value in columns.items()}
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {np.shape(value)}" for name, value in columns.items() if np.ndim(value))
        raise ValueError(f"these shapes do not broadcast: {shapes}. Give arrays of one shape, or of lengths that "
                         "are equal or 1 in every dimension.") from None
    flat = {name: np.broadcast_to(array, shape).ravel() for name, array in arrays.items()}
    try:
        computed = core.evaluate(scene, numerics, flat)
    except core.GivenError as error:
        raise _error_of(*error.args, shape) from None
    if warning := computed.pop("warning"):
        warnings.warn(f"{warning}.", stacklevel=3)
    fields = {name: values.reshape(shape) for name, values in computed.items()}
    return Outcome(verdict=np.asarray(_VERDICT_OF_REGION[fields["region"]]), **fields)


def _error_of(row, quantity, message, shape):
    """Returns the error of a quantity with the index of the point."""
    if row < 0:
        return ArgumentError(quantity + message)
    index = tuple(map(int, np.unravel_index(row, shape)))
    return ValueError(f"at index {index}: {quantity}{message}" if shape else quantity + message)
