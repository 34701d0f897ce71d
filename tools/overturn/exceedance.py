"""Which points of a result exceed: those that overturn, or those whose value of a field is above a level."""

import dataclasses

import numpy as np

from overturn.arguments import number
from overturn.friction import codes_of, decided_points, slipping_points

OVERTURNING = "overturning"
NO_MEASURES = ("region", "status", "evaluated")  # fields of codes and flags

# Of a point, from safe to exceeding. Of several points, one of which exceeds if any does, the largest is the verdict:
# it is none if none is known to exceed and one has none.
SAFE, UNDECIDED, SLIPPING, NOT_COMPUTED, EXCEEDING = range(5)


@dataclasses.dataclass(frozen=True)
class Exceedance:
    """Raises ValueError if `of` and `above` are no exceedance."""

    of: str = OVERTURNING  # or a field
    above: float | None = None  # of the field, in its unit

    def __post_init__(self):
        if self.of == OVERTURNING:
            if self.above is not None:
                raise ValueError(f"above = {self.above} is the level of a field. Give the field, such as of = "
                                 "\"peak\".")
            return
        if not isinstance(self.of, str):
            raise ValueError(f"of = {self.of!r} is not the name of a field. Give \"{OVERTURNING}\", or \"peak\" and "
                             "above.")
        if self.above is None:
            raise ValueError(f"of = \"{self.of}\" needs above, the level of this field that is exceeded, such as "
                             "above = 0.4.")
        above = number("above", self.above)
        if self.of == "peak" and not 0 < above <= 1:
            raise ValueError(f"above = {self.above} must be in (0, 1]: the peak |theta| / alpha that counts as "
                             "exceeding, not an angle or a percentage.")
        if not np.isfinite(above):
            raise ValueError(f"above = {self.above} is not a finite number.")

    def noun(self):
        return self.of if self.above is None else f"{self.of} above {self.above:g}"

    def verb(self):
        return "overturns" if self.above is None else f"has {self.of} > {self.above:g}"

    def notes(self, dataset):
        """Returns what the verdicts of blocks that may slide leave out."""
        if "friction" not in dataset.coords:
            return []
        if self.of in (OVERTURNING, "peak"):
            return ["the base has no end: a block that slides off its support counts as standing; see the field "
                    "slide_peak"]
        return [f"a block that overturns counts only if its {self.of} is above the level"]

    def verdicts(self, dataset, friction_demand=None):
        """Returns the verdict of each point, with the dimensions of the region. A point has none if its region is not
        known, if the field is NaN, or if it needs more than this friction coefficient. A block that overturns has
        exceeded every peak.

        Raises ValueError if the data set lacks a field."""
        import xarray
        region = dataset["region"]
        decided, codes = decided_points(region), codes_of(region)
        exceeding = ~region.isin([code for name, code in codes.items() if name.startswith("S")])
        if self.of != OVERTURNING:
            field = self._field(dataset)
            overturns = exceeding if self.of == "peak" else False
            decided, exceeding = decided & (overturns | field.notnull()), overturns | (field > self.above)

        def where(condition, *codes):
            return xarray.where(condition, *(code if hasattr(code, "dims") else np.uint8(code) for code in codes))
        verdict = where(decided, where(exceeding, EXCEEDING, SAFE),
                        where(region == codes["not_computed"], NOT_COMPUTED, UNDECIDED))
        if friction_demand is not None:
            verdict = where(slipping_points(dataset, decided, friction_demand), SLIPPING, verdict)
        return verdict.transpose(*region.dims)

    def _field(self, dataset):
        known = [name for name, each in dataset.data_vars.items() if name not in NO_MEASURES
                 and each.dtype.kind in "fiu" and {*each.dims} == {*dataset["region"].dims}]
        if self.of not in known:
            others = f" Those that it has: {', '.join(sorted(known))}." * bool(known)
            raise ValueError(f"this result has no field {self.of} of numbers to be above {self.above:g}. Add it to "
                             f"output.fields.{others}")
        return dataset[self.of]
