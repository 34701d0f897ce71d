"""What becomes of single blocks, computed in this process."""

from __future__ import annotations

import enum
import inspect
import warnings

import numpy as np

from overturn import core
from overturn.accelerations import accelerations_of, motion_of_components
from overturn.arguments import ArgumentError, expect_word, given, number, numbers, refuse


class Verdict(enum.IntEnum):
    """The codes of `verdict`. An undecided point counts neither as safe nor as overturning."""

    SAFE = 0
    OVERTURNS = 1
    UNDECIDED = 2


_VERDICT_OF_REGION = np.full(256, Verdict.UNDECIDED, np.uint8)
_VERDICT_OF_REGION[list(core.safe_regions.values())] = Verdict.SAFE
_VERDICT_OF_REGION[list(core.unsafe_regions.values())] = Verdict.OVERTURNS


# The type of what becomes of every block: the verdict and the requested fields, all of the broadcast shape.
Outcome = dict


def evaluate(*, fields=("region", "status", "peak", "margin"),
             pulse=None, window=None, cycles=None, gamma=None, nu=None, shape=None,
             record=None, second_component=None, vertical=None, time_step=None, units=None, motion_of=None,
             theory="nonlinear", method="taylor", tolerance=None, resolve=False, gravity=9.81, **coordinates):
    """Computes what becomes of blocks, each under its own pulse, or all under one record.

    The arguments marked with * are numbers or arrays and broadcast by the rules of NumPy. The values
    are those of `overturn run`, bit for bit. Threads may call this function at the same time: it does
    not hold the interpreter's lock.

    The points; each quantity is given once, in one way, see docs/jobs.md and docs/two_sides.md:
{coordinates}
    A pulse:
        pulse: its kind, by default "one_sine"; window, cycles, gamma, nu: numbers that complete some kinds, see
            docs/jobs.md.
        shape: instead of these, the rows (time over the period, value) of a pulse that is linear between them, of the
            shape (n, 2); the values are divided by the largest absolute one.
    Or a record:
        record: horizontal accelerations, one-dimensional, linear between samples; an array, what read_record() or
            floor_motion() returns, or a Trace of ObsPy or a Stream of one.
        second_component: accelerations at a right angle to these, at the same times. The motion is then
            record * cos(direction) + second_component * sin(direction), of any direction*.
        vertical: vertical accelerations at the same times, positive upwards.
        units: of these accelerations: "g", the default of arrays, "m/s2", "cm/s2", "mm/s2" or "gal". Required of
            Traces.
        time_step: between two samples [s]; of arrays.
    Either:
        motion_of: "ground" or "floor", for the words of warnings; pga* is the peak acceleration of this. By default
            that of the record, which floor_motion() and read_record() state, or "ground".
    The computation:
        theory: "nonlinear" or "linear".
        method: "taylor", or "rk45" under pulses other than a shape.
        tolerance: local error per step [1]; by default 1e-9, with resolve 1e-4.
        resolve: settle verdicts in doubt with up to 50 digits.
        gravity: g [m/s2].
        fields: names of what is returned beside the verdict:
{fields}

    Warns, once a call, of values that are probably in another unit. Raises ValueError if a value is not
    allowed, with its index in the broadcast shape, or if arrays do not broadcast; ArgumentError, which is a
    TypeError and a ValueError, if arguments are missing or contradict each other.
    """
    if unknown := coordinates.keys() - core.coordinates.keys():
        raise TypeError(f"evaluate() got an unexpected keyword argument {min(unknown)!r}")
    if isinstance(fields, str):
        raise ValueError(f"fields = {fields!r} is a word. Give a list of names.")
    columns = given(**{name: coordinates.get(name) for name in core.coordinates})
    of_pulse, of_record = ({name: columns.pop(name) for name, row in core.coordinates.items()
                            if name in columns and row["motion"] == motion} for motion in ("pulse", "record"))
    shape_numbers = given(window=window, cycles=cycles, gamma=gamma, nu=nu)
    single = {name: number(name, value) for name, value in given(
        **shape_numbers, time_step=time_step, gravity=gravity, tolerance=tolerance).items()}
    for name, value in {**given(pulse=pulse, motion_of=motion_of), "theory": theory, "method": method}.items():
        expect_word(name, value)
    if record is None:
        refuse({**given(second_component=second_component, vertical=vertical, time_step=time_step, units=units),
                **of_record}, "has no meaning without record")
        if not of_pulse.keys() - {"amplitude"} or not {"amplitude", "pga"} & {*of_pulse, *columns}:
            raise ArgumentError("the ground motion is incomplete. Give pulse_period (or pulse_frequency or "
                                "frequency) and pga (or amplitude), or a record.")
        columns |= of_pulse
        if pulse == "table" or (pulse is None and shape is not None):
            refuse(shape_numbers, "has no meaning for a shape")
            motion = _pulse_of_shape(shape)
        else:
            refuse(given(shape=shape), "is for the pulse \"table\"")
            motion = core.pulse("one_sine" if pulse is None else pulse, {name: single[name] for name in shape_numbers})
    else:
        refuse({**given(pulse=pulse, shape=shape), **of_pulse, **shape_numbers}, "cannot be combined with record")
        motions = given(record=record, second_component=second_component, vertical=vertical)
        motion_of = motion_of_components(motions, motion_of)
        components, step = accelerations_of(motions, single.get("time_step"), units, single["gravity"])
        if step is None or len(of_record) + ("pga" in columns) != 1:
            raise ArgumentError("a record needs time_step, unless it is a Record, a FloorMotion or a Trace, and either "
                                "scale or pga.")
        columns |= of_record
        motion = core.record(components["record"], components.get("second_component", []),
                             components.get("vertical", []), step)
    if not isinstance(resolve, (bool, np.bool_)):
        raise ArgumentError(f"resolve = {resolve!r} is neither True nor False.")
    scene = core.scene(motion, theory, single["gravity"], motion_of or "ground")
    numerics = core.numerics(scene, method, single.get("tolerance"), bool(resolve))
    return _evaluated(scene, numerics, columns, list(fields))


def _pulse_of_shape(shape):
    if shape is None:
        raise ArgumentError("the pulse \"table\" needs shape, an array of rows (time over the period, value).")
    rows = numbers("shape", shape)
    if rows.ndim != 2 or rows.shape[1] != 2:
        raise ValueError(f"shape has the shape {rows.shape}. Give rows (time over the period, value): (n, 2).")
    try:
        return core.pulse_of_rows(rows[:, 0], rows[:, 1])
    except core.GivenError as error:
        row, column, message = error.args
        place = f"[{row}, {('time', 'value').index(column)}]" if column else ""
        raise ValueError(f"shape{place}{message}") from None


def _described(name, row):
    units = f" [{row['units'] or 1}]"
    same = f", in place of {row['same_as']}" * bool(row["same_as"])
    return f"        {name}*: {row['long_name']}{same}{units}" + f"; by default {row['default']}" * bool(row["default"])


def _signature():
    """Returns the arguments of evaluate() with the names of all coordinates."""
    *parameters, _ = inspect.signature(evaluate).parameters.values()
    return inspect.Signature([*(inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None)
                                for name in core.coordinates), *parameters])


evaluate.__signature__ = _signature()
evaluate.__doc__ = (evaluate.__doc__ or "").format(
    coordinates="\n".join(_described(*item) for item in core.coordinates.items()),
    fields="\n".join(f"            {name}: {row['long_name']}" for name, row in core.fields.items()))


def _evaluated(scene, numerics, columns, names):
    arrays = {name: numbers(name, value) for name, value in columns.items()}
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {np.shape(value)}" for name, value in columns.items() if np.ndim(value))
        raise ValueError(f"these shapes do not broadcast: {shapes}. Give arrays of one shape, or of lengths that "
                         "are equal or 1 in every dimension.") from None
    flat = {name: np.broadcast_to(array, shape).ravel() for name, array in arrays.items()}
    try:
        computed = core.evaluate(scene, numerics, flat, list(dict.fromkeys(["region", *names])))
    except core.GivenError as error:
        raise _error_of(*error.args, shape) from None
    if warning := computed.pop("warning"):
        warnings.warn(f"{warning}.", stacklevel=3)
    fields = {name: values.reshape(shape) for name, values in computed.items()}
    return {"verdict": np.asarray(_VERDICT_OF_REGION[fields["region"]]), **{name: fields[name] for name in names}}


def _error_of(row, quantity, message, shape):
    """Returns the error of a quantity with the index of the point."""
    if row < 0:
        return ArgumentError(quantity + message)
    index = tuple(map(int, np.unravel_index(row, shape)))
    return ValueError(f"at index {index}: {quantity}{message}" if shape else quantity + message)
