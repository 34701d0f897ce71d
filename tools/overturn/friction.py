"""Friction coefficients that users give, and the verdicts that hold with them."""

from __future__ import annotations

import numbers
from typing import TYPE_CHECKING

from overturn.arguments import OLD_FRICTION, expect_dataset, refuses_old

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable

    import xarray

LARGEST = 2  # rubber on rock has 1


def expect_coefficient(friction_demand):
    """Raises ValueError unless this is a friction coefficient, not an angle."""
    if isinstance(friction_demand, bool) or not isinstance(friction_demand, numbers.Real) or not 0 < friction_demand <= LARGEST:
        raise ValueError(f"friction_demand = {friction_demand!r} is not a number above 0 and up to {LARGEST}. Give the coefficient "
                         "between block and ground, the tangent of the friction angle.")


@refuses_old(OLD_FRICTION)
def supported_share(dataset: xarray.Dataset, friction_demand: float,
                    dim: Hashable | Iterable[Hashable] | None = None) -> xarray.DataArray:
    """Returns the share of the verdicts of a result, see open(), that hold with a friction coefficient [1].

    friction_demand: between block and ground, up to 2. A verdict whose field friction_demand is larger, infinite or unknown does
        not hold.
    dim: dimensions over which points are counted, such as "motion"; by default all. The share is NaN where no point has
        a verdict.

    Raises ValueError if the dataset lacks the field friction_demand.
    """
    expect_coefficient(friction_demand)
    expect_dataset(dataset)
    decided = decided_points(dataset["region"])
    return (decided & ~slipping_points(dataset, decided, friction_demand)).sum(dim) / decided.sum(dim)


def decided_points(region):
    """Returns whether each point has a verdict. NaN, as after where(), and unknown codes are no verdicts."""
    if "flag_meanings" not in region.attrs:
        raise ValueError("region has no flag_meanings: it is not a field of a result as it was opened. Choose points "
                         "by sel() or isel(); do not compute with region codes.")
    if region.dtype.kind == "f" and bool((region.notnull() & (region % 1 != 0)).any()):
        raise ValueError("region has values between the region codes, as after interp(). Choose points by sel() or "
                         "isel().")
    return region.isin([code for name, code in codes_of(region).items() if name not in ("undecided", "not_computed")])


def codes_of(region):
    """Returns the region codes by name."""
    return dict(zip(region.attrs["flag_meanings"].split(), region.attrs["flag_values"]))


def slipping_points(dataset, decided, friction_demand):
    """Returns whether the verdict of each point needs more friction than this coefficient, or an unknown one."""
    if "friction_demand" not in dataset:
        raise ValueError("this result has no field friction_demand. Add it to output.fields.")
    return decided & ~(dataset["friction_demand"] <= friction_demand)
