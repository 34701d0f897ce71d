"""Ground accelerations as they are given: arrays, motions of this package, or traces of ObsPy, which are recognised by
their attributes."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, Protocol, runtime_checkable

import numpy as np

from overturn.arguments import ArgumentError, numbers
from overturn.motion_words import FLOOR

PER_M_PER_S2 = {"m/s2": 1, "cm/s2": 100, "mm/s2": 1000, "gal": 100}
MOTIONS = "Record or FloorMotion"
MOST_NAMES = 4  # of traces in a message


@runtime_checkable
class Motion(Protocol):
    """The attributes of a Record or a FloorMotion that are used."""

    acceleration: Any  #: (n,) samples over g [1]
    time_step: float  #: between two samples [s]


@runtime_checkable
class Trace(Protocol):
    """The attributes of an obspy.Trace that are used."""

    id: str  #: "network.station.location.channel"
    data: Any  #: (n,) samples
    stats: Any  #: with delta [s], and starttime, whose differences are in seconds


@runtime_checkable
class Stream(Protocol):
    """The attribute of an obspy.Stream that is used."""

    traces: list[Trace]


def accelerations_of(components, time_step=None, units=None, gravity=9.81):
    """Returns checked samples over g [1] of each component, by the names of the arguments, and the time step [s]. It is
    None if it is not given and the components are arrays.

    components: arrays (n,), motions, traces or streams of one trace, by the names of the arguments; the record first.
    units: of their samples, "g" or a key of PER_M_PER_S2; of arrays and motions "g" if it is None.

    Raises ValueError if a component is not allowed or the components do not fit together, ArgumentError if an argument
    is missing or contradicts the traces.
    """
    if any(isinstance(value, Motion) for value in components.values()):
        components = _traces_of_motions(components, units)
        units = "g"
    traces = {name: _trace(name, value) for name, value in components.items()}
    if any(trace is not None for trace in traces.values()):
        time_step = _time_step_of(traces, time_step)
        if units is None:
            raise ArgumentError("a Trace does not state the unit of its samples. Give units, one of "
                                f"g, {', '.join(PER_M_PER_S2)}.")
    samples = {name: _over_g(numbers(name, components[name] if trace is None else trace.data), units, gravity)
               for name, trace in traces.items()}
    _check(samples)
    return samples, time_step


def motion_of_components(components, given):
    """Returns "ground" or "floor": what is given, or what one of the components states. Raises ArgumentError if both
    differ."""
    stated = FLOOR if any(getattr(value, "motion_of", None) == FLOOR for value in components.values()) else None
    if stated and given not in (None, stated):
        raise ArgumentError(f"motion_of = {given!r}, but a component is the motion of a floor. Remove motion_of.")
    return given or stated or "ground"


def _traces_of_motions(components, units):
    for name, value in components.items():
        if not isinstance(value, Motion):
            raise ArgumentError(f"{name} is an array or a Trace, but another component is a {MOTIONS}. Give all "
                                "components alike.")
        if units not in (None, "g"):
            raise ArgumentError(f"units = {units!r}, but {name} is a {MOTIONS}, whose acceleration is in g. Remove "
                                "units.")
    return {name: SimpleNamespace(id=type(value).__name__, data=value.acceleration,
                                  stats=SimpleNamespace(delta=value.time_step, starttime=0.0))
            for name, value in components.items()}


def _trace(name, value):
    """Returns the trace, or None if the value is an array."""
    if isinstance(value, Stream):
        if not value.traces:
            raise ValueError(f"{name} is a Stream without traces. Give one that contains a channel.")
        names = list(dict.fromkeys(trace.id for trace in value.traces))
        shown = ", ".join(names[:MOST_NAMES]) + ", ..." * (len(names) > MOST_NAMES)
        if len(names) != 1:
            raise ValueError(f"{name} is a Stream of {len(names)} channels: {shown}. Choose one, for example by "
                             "stream.select(channel=\"HNE\").")
        if len(value.traces) != 1:
            raise ValueError(f"{name} is a Stream of {len(value.traces)} traces of one channel, {shown}. Join them by "
                             "stream.merge(), or choose one.")
        value = value.traces[0]
    if not isinstance(value, Trace):
        return None
    masked = np.count_nonzero(np.ma.getmaskarray(value.data))
    if masked:
        raise ValueError(f"{name} ({value.id}) has gaps: {masked} of {len(value.data)} samples are masked. Choose a "
                         "time without gaps by trim(), or fill them by stream.merge(fill_value=\"interpolate\").")
    return value


def _time_step_of(traces, time_step):
    """Returns the time step [s] of traces at the same times, up to half a step."""
    (first, record), *others = traces.items()
    for name, trace in traces.items():
        if trace is None:
            raise ArgumentError(f"{name} is an array, but another component is a Trace. Give Traces only, or arrays "
                                "only.")
    step, last = float(record.stats.delta), len(record.data) - 1
    for name, trace in others:
        if abs(trace.stats.delta - step) * last > step / 2:
            raise ValueError(f"{name} ({trace.id}) has a sample every {trace.stats.delta:g} s, but {first} "
                             f"({record.id}) every {step:g} s. Resample one, for example by trace.interpolate().")
        late = float(trace.stats.starttime - record.stats.starttime)
        if abs(late) > step / 2:
            raise ValueError(f"{name} ({trace.id}) begins {abs(late):g} s {'after' if late > 0 else 'before'} {first} "
                             f"({record.id}). Cut both to the same times by stream.trim().")
    if time_step is not None and not abs(time_step - step) * last <= step / 2:
        raise ArgumentError(f"time_step = {time_step:g}, but {first} ({record.id}) has a sample every {step:g} s. "
                            "Remove time_step.")
    return step


def _over_g(samples, units, gravity):
    if units is None or units == "g":
        return samples
    if units not in PER_M_PER_S2:
        raise ValueError(f"units = {units!r} is not one of g, {', '.join(PER_M_PER_S2)}.")
    if not 0 < gravity < np.inf:
        raise ValueError(f"gravity = {gravity:g} is outside (0, inf). It is an acceleration in m/s2.")
    return samples / (gravity * PER_M_PER_S2[units])


def _check(components):
    """Raises ValueError if a component is not a ground motion, or does not fit the record."""
    for name, samples in components.items():
        if samples.ndim != 1:
            raise ValueError(f"{name} has {samples.ndim} dimensions. Give a one-dimensional array of samples.")
        for index in np.flatnonzero(~np.isfinite(samples))[:1]:
            raise ValueError(f"{name}[{index}] = {samples[index]} is not finite. Give finite accelerations.")
    (first, record), *others = components.items()
    if record.size < 2 or not record.any():
        raise ValueError(f"{first} needs two or more samples, not all of them zero.")
    for name, samples in others:
        if samples.size != record.size:
            raise ValueError(f"{name} has {samples.size} samples, but {first} has {record.size}. Give both at "
                             "the same times.")
        if np.array_equal(samples, record):
            raise ValueError(f"{name} has the accelerations of {first}. Give those of the other component.")
