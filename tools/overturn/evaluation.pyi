"""What becomes of single blocks. Written by tests/python/stub_test.py --write."""

import enum
from collections.abc import Iterable
from typing import TypedDict

from numpy import float64, uint8, uint16, uint32
from numpy.typing import ArrayLike, NDArray

from overturn.accelerations import Motion, Stream, Trace

class Verdict(enum.IntEnum):
    SAFE = 0
    OVERTURNS = 1
    UNDECIDED = 2

class Outcome(TypedDict, total=False):
    verdict: NDArray[uint8]
    region: NDArray[uint8]  #: region at the end of the ground motion
    angle: NDArray[float64]  #: angle at the end of the ground motion
    velocity: NDArray[float64]  #: velocity at the end of the ground motion
    margin: NDArray[float64]  #: margin, positive where safe
    error: NDArray[float64]  #: bound on the error of the margin
    peak: NDArray[float64]  #: largest |theta| / alpha
    fall_time: NDArray[float64]  #: time p t from uplift to |theta| = pi/2
    friction_demand: NDArray[float64]  #: friction coefficient needed
    normal: NDArray[float64]  #: smallest normal force over that at rest
    slide: NDArray[float64]  #: final slide of the base over R
    slide_peak: NDArray[float64]  #: largest |slide| of the base over R
    impacts: NDArray[uint16]  #: impacts during the ground motion
    steps: NDArray[uint32]  #: integration steps tried
    status: NDArray[uint8]  #: flags set during the integration

def evaluate(*,
             direction: ArrayLike | None = ...,
             width: ArrayLike | None = ...,
             half_width: ArrayLike | None = ...,
             height: ArrayLike | None = ...,
             half_height: ArrayLike | None = ...,
             center_offset: ArrayLike | None = ...,
             center_height: ArrayLike | None = ...,
             slenderness_plus: ArrayLike | None = ...,
             slenderness_minus: ArrayLike | None = ...,
             size_plus: ArrayLike | None = ...,
             size_minus: ArrayLike | None = ...,
             radius_of_gyration: ArrayLike | None = ...,
             incline: ArrayLike | None = ...,
             slenderness: ArrayLike | None = ...,
             aspect_ratio: ArrayLike | None = ...,
             size: ArrayLike | None = ...,
             frequency_parameter: ArrayLike | None = ...,
             friction: ArrayLike | None = ...,
             restitution: ArrayLike | None = ...,
             restitution_of_maximum: ArrayLike | None = ...,
             velocity_restitution: ArrayLike | None = ...,
             amplitude: ArrayLike | None = ...,
             scale: ArrayLike | None = ...,
             pga: ArrayLike | None = ...,
             frequency: ArrayLike | None = ...,
             pulse_period: ArrayLike | None = ...,
             pulse_frequency: ArrayLike | None = ...,
             fields: Iterable[str] = ...,
             pulse: str | None = ...,
             window: float | None = ...,
             cycles: float | None = ...,
             gamma: float | None = ...,
             nu: float | None = ...,
             shape: ArrayLike | None = ...,
             record: ArrayLike | Motion | Trace | Stream | None = ...,
             second_component: ArrayLike | Motion | Trace | Stream | None = ...,
             vertical: ArrayLike | Motion | Trace | Stream | None = ...,
             time_step: float | None = ...,
             units: str | None = ...,
             motion_of: str | None = ...,
             theory: str = ...,
             method: str = ...,
             tolerance: float | None = ...,
             resolve: bool = ...,
             gravity: float = ...,
             ) -> Outcome: ...
