"""The compiled module; evaluation.py and records.py call it with checked arguments."""

from collections.abc import Mapping, Sequence
from typing import Any, TypedDict

from numpy import float64
from numpy.typing import ArrayLike, NDArray

__version__: str

class Pulse: ...
class TabulatedPulse: ...
class Suite: ...
class Scene: ...
class Numerics: ...

class GivenError(ValueError):
    """A value that is not allowed; arguments: row or -1, name of the quantity, message."""

class RecordError(ValueError): ...

class _Field(TypedDict):
    type: str
    long_name: str
    units: str
    comment: str

class _Coordinate(TypedDict):
    long_name: str
    units: str
    allowed: str
    same_as: str
    default: str
    role: str
    motion: str

class _Component(TypedDict):
    name: str
    acceleration: NDArray[float64]
    time_step: float
    format: str
    is_uncorrected: bool
    header: list[str]
    motion_of: str
    ground_pga: float | None
    remarks: list[str]

supports_numpy_2: bool
fields: dict[str, _Field]
coordinates: dict[str, _Coordinate]
safe_regions: dict[str, int]
unsafe_regions: dict[str, int]

def pulse(kind: str, numbers: Mapping[str, float], /) -> Pulse: ...
def pulse_of_rows(times: ArrayLike, values: ArrayLike, /) -> TabulatedPulse: ...
def record(horizontal: ArrayLike, second: ArrayLike, upwards: ArrayLike, time_step: float, /) -> Suite: ...
def scene(motion: Pulse | TabulatedPulse | Suite, theory: str, gravity: float, motion_of: str, /) -> Scene: ...
def numerics(scene: Scene, method: str, tolerance: float | None, resolve: bool, /) -> Numerics: ...
def evaluate(scene: Scene, numerics: Numerics, columns: Mapping[str, Sequence[float] | NDArray[float64]],
             fields: Sequence[str], /) -> dict[str, Any]: ...
def component_of(path: str, choice: int | str, time_step: float | None, units: str | None, gravity: float,
                 /) -> _Component: ...
