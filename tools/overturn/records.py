"""Files of recorded ground motions."""

from __future__ import annotations

import dataclasses
import operator
import os
import warnings
from typing import TYPE_CHECKING

from overturn import core

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

RecordError = core.RecordError  #: a ValueError with the place, what was found and what is allowed


@dataclasses.dataclass(frozen=True, eq=False)
class Record:
    """One component of a recorded ground motion."""

    acceleration: NDArray[np.float64]  #: over g [1]
    time_step: float  #: between two samples [s]
    name: str  #: of the component, as in the file; may be empty
    format: str  #: "AT2", "V2A", "SMC", "K-NET", "KiK-net", "COSMOS", "CSMIP", "ESM" or "text"
    is_uncorrected: bool  #: whether the file states that it was not corrected
    header: list[str]  #: lines of the file before the samples
    motion_of: str = "ground"  #: or "floor", as a text may state (docs/floors.md)
    ground_pga: float | None = None  #: over g, of the ground that caused the motion of a floor, if it is stated [1]


def read_record(path: str | os.PathLike, component: int | str = 1, *, time_step: float | None = None,
                units: str | None = None, gravity: float = 9.81) -> Record:
    """Reads one component of a recorded ground motion, as jobs do (docs/records.md).

    component: its number, counted from 1, or its name, unless several components have this name.
    time_step [s] and units ("g", "m/s2", "cm/s2", "mm/s2" or "gal"): of files of text, which do not state
        them; units also of AT2 files whose header does not state a unit that is understood.
    gravity: g [m/s2], by which accelerations that are not in g are divided.

    Warns of numbers of the header that differ from the samples by little (docs/records.md).

    Raises RecordError if the file cannot be read; ValueError if an argument is not allowed.
    """
    try:
        choice = component if isinstance(component, str) else operator.index(component)
    except TypeError:
        raise ValueError(f"component = {component!r} is neither a number nor a name.") from None
    found = core.component_of(os.fspath(path), choice, time_step, units, gravity)
    for remark in found.pop("remarks"):
        warnings.warn(f"{remark}.", stacklevel=2)
    return Record(**found)
