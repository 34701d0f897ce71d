"""Fragility curves: the share of the blocks that overturn against an intensity measure."""

from __future__ import annotations

import dataclasses
import os
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_array
from scipy.special import ndtr

from overturn import lognormal_fit
from overturn.arguments import OLD_FRICTION, OLD_LIMIT, count, expect_dataset, refuses_old
from overturn.exceedance import OVERTURNING, Exceedance
from overturn.fragility_points import edges_of, is_measurable, left_out, points_of, share_interval
from overturn.fragility_table import Binned, numbers_text
from overturn.friction import expect_coefficient
from overturn.motion_words import is_of_floor, measure_named, variable_of

if TYPE_CHECKING:
    import xarray
    from numpy.typing import NDArray

# How a measure grows with the scale of the motion: as scale^power.
POWERS = {"pga": 1, "pgv": 1, "arias_intensity": 2, "significant_duration": 0, "pga_rotd50": 1, "pga_rotd100": 1,
          "pgv_rotd50": 1, "pgv_rotd100": 1}
_NAMES = {"pga": "record_pga"}  # of measures in a data set, before scaling
_OVER_G = {peak + of for peak in ("pga", "pfa") for of in ("", "_rotd50", "_rotd100")}  # "1" in a data set
VALUES_OF_CURVE = 100


@dataclasses.dataclass(frozen=True, eq=False)
class Fragility(Binned):
    """Points per bin of the intensity measure, and the lognormal curve fitted to the single points. A
    point is one block, or one object of the table, under one motion at one scale. It exceeds if it overturns, or
    if the field `of` is above a level. NaN: there is no such number, see `notes`."""

    im: str  #: name of the intensity measure; of a floor "pfa", "pfv", "floor_arias_intensity", ...
    units: str  #: of the intensity measure
    of: str  #: what is counted: "overturning", or a field such as "peak"
    above: float | None  #: the level of the field that is exceeded, in its unit
    edges: NDArray[np.float64]  #: of the bins; one more than bins
    points: NDArray[np.int64]  #: with a verdict, per bin
    exceeding: NDArray[np.int64]  #: per bin
    without_verdict: NDArray[np.int64]  #: undecided or not computed, per bin; not in `points`
    mean: NDArray[np.float64]  #: geometric, of the values of the points of a bin with a verdict, or without if none has
    undecided: int  #: points of region 254, or that may slip
    not_computed: int  #: points of region 255
    motions: int  #: with at least one verdict
    blocks: int  #: pooled in the curve, or together at one site; each counts once, in however many directions
    median: float  #: at which half of the points exceed
    beta: float  #: scatter: standard deviation of the logarithm [1]
    median_interval: NDArray[np.float64]  #: (2,), of 95 % confidence
    beta_interval: NDArray[np.float64]  #: (2,)
    value: NDArray[np.float64]  #: values of the intensity measure over the range of the bins
    probability: NDArray[np.float64]  #: fitted, at `value`
    band: NDArray[np.float64]  #: (2, values), of 95 % confidence at each value
    notes: tuple[str, ...]  #: what is missing or extrapolated, and why there is no fit or no band
    group: str = ""  #: which blocks of the result these are; empty: all
    together: str = ""  #: column of the blocks of one site, one of which exceeds; empty: blocks are pooled
    #: (samples, 2), median and beta; their quantiles are the intervals. Empty if there are none
    samples: NDArray[np.float64] = dataclasses.field(default_factory=lambda: np.empty((0, 2)))
    kind: str = "blocks"  #: what `blocks` counts, such as "rows of the table"
    pools_samples: bool = False  #: whether an object has several samples, such as of its contacts; risk refuses them
    #: (2, bins), 95 % confidence of `fraction`, with motions as the independent units; NaN: of fewer than two motions
    fraction_interval: NDArray[np.float64] = dataclasses.field(default_factory=lambda: np.empty((2, 0)))

    def summary(self) -> str:
        """Returns the numbers as a text of several lines."""
        lines = [self.counts_text(f"{self.im} [{self.units}]"), *[self.group] * bool(self.group)]
        if np.isfinite(self.median):
            lines += numbers_text(("median", "beta"), (self.median, self.beta),
                                  (self.median_interval, self.beta_interval))
        return "\n".join([*lines, *self.notes])

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Writes one row per bin, below the summary as comments that begin with #. The fitted columns are
        those of the middle of the bin."""
        middle = np.log(self.edges[:-1] * self.edges[1:]) / 2
        fitted = [np.interp(middle, np.log(self.value), curve) if len(middle) else middle
                  for curve in (self.probability, *self.band)]
        self.write_table(path, {self.im: (self.edges[:-1], self.edges[1:])}, fitted[0], fitted[1:])


@refuses_old(OLD_FRICTION | OLD_LIMIT)
def fragility(dataset: xarray.Dataset, im: str = "pgv", *, of: str = OVERTURNING, above: float | None = None,
              friction_demand: float | None = None,
              together: str | None = None, bins: int = 10, equal_counts: bool = False, samples: int = 1000,
              seed: int = 1) -> Fragility:
    """Returns the fragility curve of a result under records, see open(). All its blocks are pooled and count
    alike: choose some by dataset.isel() or dataset.sel() first.

    im: intensity measure: "pga", "pgv", "arias_intensity", "significant_duration", or another variable of
        numbers over the dimension motion, which is taken to be proportional to the motion. The measures of
        the records are scaled like the motions. Under two horizontal components, they are those of the motion in the
        direction of a point; "pga_rotd50", "pga_rotd100", "pgv_rotd50" and "pgv_rotd100" are those of all directions.
        Under motions of a floor, these are measures of the floor, and the curve names them "pfa", "pfv", ...;
        "ground_pga" is the PGA of the ground that caused them.
    of, above: what is counted: points that overturn or, for the name of a field of the result, those whose value is
        above a level in the unit of the field, such as of="peak", above=0.4. Points whose value is NaN have no verdict.
    friction_demand: coefficient between block and ground, up to 2; points that need more, see the field friction_demand, have no
        verdict.
    together: column or axis that distinguishes the blocks of one site, such as "azimuth_of" or "block". A point is then one
        block of each of its values, under one motion in one direction, and exceeds if one of them does: survival is
        multiplied within each motion. Without a column `azimuth_of`, rows of a table that differ in a column `direction`
        are sides of one block, and also exceed together; a measure that depends on the direction is the largest of
        theirs. An axis `direction` is the unknown direction of the motion, the same for all blocks. Points that differ
        in other dimensions are equally likely variants of a block.
    bins, equal_counts: their number, and whether they have equal numbers of points with a verdict instead of equal
        widths in the logarithm; they do not change the fit. Few different values of the measure give fewer bins.
    samples, seed: of the bootstrap over motions that gives the 95 % confidence.

    Rows of a table with the same value in its column `azimuth_of` are one block, which exceeds if it does in one of its
    rows: a rock in several azimuths. If there is a column `sample`, rows of equal `azimuth_of` and `sample` are one of the
    equally likely variants of an object. A measure that depends on the direction is the largest of those of its rows.

    Points without a verdict are left out and counted; they are never safe. Raises ValueError if the
    dataset lacks what is needed.
    """
    bins, samples, seed = count("bins", bins), count("samples", samples), count("seed", seed, least=0)
    exceedance = Exceedance(of, above)
    if friction_demand is not None:
        expect_coefficient(friction_demand)
    measure, im = measure_of(dataset, im), name_of_measure(dataset, im)
    cells, of_blocks, notes = points_of(dataset, {im: measure}, exceedance, friction_demand, together)
    edges = edges_of(cells, bins, equal_counts)
    counts = _counts(cells)
    value = np.geomspace(edges[0], edges[-1], VALUES_OF_CURVE) if len(edges) else np.empty(0)
    verb = exceedance.verb()
    reason = _why_no_fit(counts, im, verb)
    fit = None if reason else lognormal_fit.fit(counts, np.log(value), samples, seed)
    if not reason and not fit:
        reason = f"no fit: the probability that a point {verb} does not rise with {im}"
    return Fragility(im, units_of(measure, im), of, above, edges, **_histograms(cells, edges),
                     undecided=int(cells["undecided"].sum()), not_computed=int(cells["not_computed"].sum()),
                     motions=counts.points.shape[0], together=together or "", **of_blocks, **_fitted(fit, value),
                     notes=(*notes, *left_out(cells, im, friction_demand), *_without_slipping(fit, cells),
                            *[reason] * bool(reason), *_extrapolated(fit, edges, im),
                            *no_interval(fit, counts.points.shape[0], samples)))


def expect_records(dataset):
    expect_dataset(dataset)
    for name, of in (("region", "field"), ("scale", "scale of a record"), ("motion", "record")):
        if name not in dataset:
            raise ValueError(f"this result has no {of}: {name} is missing. A fragility curve needs the field region of a "
                             "result under records.")


def measure_of(dataset, im):
    """Returns the intensity measure of every motion at every scale."""
    expect_records(dataset)
    variable = variable_of(dataset.attrs, im)
    unscaled = _NAMES.get(variable, variable)
    if not _is_measure(dataset, unscaled):
        known = [name_of_measure(dataset, name) for name in POWERS if _NAMES.get(name, name) in dataset]
        known += ["ground_pga"] * ("ground_pga" in dataset)
        advice = (" The measure of the ground that caused the motions of the floor is a variable such as ground_pga: "
                  "see docs/floors.md." * is_of_floor(dataset.attrs))
        raise ValueError(f"im = {im!r} is not an intensity measure of the motions. This result has {', '.join(known)}; "
                         f"another one must be a variable of numbers over the dimension motion.{advice}")
    if variable == "pga" and variable in dataset:  # of the direction, if there are two horizontal components
        return dataset[variable]
    measure = dataset[unscaled]
    if "of the first horizontal component" in measure.attrs.get("comment", ""):
        raise ValueError(f"im = {im!r} is that of the first of two horizontal components, in whatever direction the "
                         "block is. Give im = \"pga\", which is that of every direction, or compute the result again: "
                         "the measures of its records are then those of every direction.")
    power = POWERS.get(variable, POWERS.get(name_of_measure(dataset, im), 1))
    return (measure * dataset["scale"] ** power).assign_attrs(dataset[unscaled].attrs)


def name_of_measure(dataset, im):
    """Returns the name of an intensity measure in curves."""
    return measure_named(dataset.attrs, variable_of(dataset.attrs, im))


def _is_measure(dataset, name):
    """Whether a variable is a property of the motions. The coordinate motion is their number. If the motions are no
    dimension, only the known measures can be told from properties of the block."""
    if name not in dataset or name == "motion" or dataset[name].dtype.kind not in "fiu":
        return False
    is_known = (not {name, name_of_measure(dataset, name)}.isdisjoint({*POWERS, *_NAMES.values()})
                and {*dataset["motion"].dims} <= {*dataset[name].dims})
    return dataset[name].dims == ("motion",) or is_known


def units_of(measure, im):
    units = str(measure.attrs.get("units", "1"))
    return "g" if im in _OVER_G and units == "1" else units


def _histograms(cells, edges):
    kinds = {"points": cells["points"], "exceeding": cells["exceeding"],
             "without_verdict": cells["undecided"] + cells["not_computed"]}
    if not len(edges):
        return {**dict.fromkeys(kinds, np.zeros(0, int)), "mean": np.zeros(0), "fraction_interval": np.zeros((2, 0))}
    kept = is_measurable(cells)
    measure = cells["measure"][kept]

    def total(weights):
        return np.histogram(measure, edges, weights=weights)[0]

    def mean(weights):
        count = total(weights)
        logs = total(weights * np.log(measure))
        return np.exp(np.divide(logs, count, out=np.full(len(count), np.nan), where=count > 0))
    sums = {name: total(kind[kept]).astype(int) for name, kind in kinds.items()}
    means = (mean(kinds[name][kept]) for name in ("points", "without_verdict"))
    motions, row = np.unique(cells["motion"][kept], return_inverse=True)
    of_motions = (np.histogram2d(row, measure, [np.arange(len(motions) + 1) - 0.5, edges], weights=kinds[name][kept])[0]
                  for name in ("points", "exceeding"))
    return {**sums, "mean": np.where(sums["points"] > 0, *means), "fraction_interval": share_interval(*of_motions)}


def _counts(cells):
    """Returns the numbers of points of each motion at each value of the measure."""
    kept = is_measurable(cells) & (cells["points"] > 0)
    log_measure, column = np.unique(np.log(cells["measure"][kept]), return_inverse=True)
    names, row = np.unique(cells["motion"][kept], return_inverse=True)
    matrices = [coo_array((cells[kind][kept].astype(float), (row, column)), (len(names), len(log_measure))).tocsr()
                for kind in ("points", "exceeding")]
    return lognormal_fit.Counts(log_measure, *matrices)


def _why_no_fit(counts, im, verb):
    """Returns why there is no fit, or an empty text."""
    points, exceeding = (np.asarray(kind.sum(axis=0)).ravel() for kind in (counts.points, counts.exceeding))
    x = np.exp(counts.log_measure)
    if not x.size:
        return "no fit: no point has a verdict"
    if not exceeding.any():
        return f"no fit: no point {verb}, up to {im} = {x[-1]:.4g}"
    if (exceeding == points).all():
        return f"no fit: every point {verb}, down to {im} = {x[0]:.4g}"
    if x.size == 1:
        return f"no fit: all points have the same {im} = {x[0]:.4g}"
    if not lognormal_fit.has_maximum(points[None], exceeding[None])[0]:
        above, below = x[exceeding > 0].min(), x[exceeding < points].max()
        if below > above:
            return f"no fit: the probability that a point {verb} does not rise with {im}"
        others = (f"the only point above, at {above:.4g}, does so" if points[x >= above].sum() == 1
                  else f"every point does so from {above:.4g} on")
        return f"no fit, because there is no scatter: no point {verb} up to {im} = {below:.4g}, and {others}"
    return ""


def _without_slipping(fit, cells):
    """Returns a note if a fit lacks points because the block may slip: these are mostly points of strong shaking."""
    if not fit or not cells["slipping"].any():
        return []
    return [f"median and beta are those of the {int(cells['points'].sum())} points with a verdict; points that need "
            "more friction are mostly those of strong shaking"]


def _extrapolated(fit, edges, im):
    """Returns a note if the median is outside the range of the points with a verdict."""
    if not fit or edges[0] <= fit.median <= edges[-1]:
        return []
    return [f"extrapolated: the median is outside the data, which are from {im} = {edges[0]:.4g} to {edges[-1]:.4g}"]


def no_interval(fit, motions, samples):
    """Returns a note if a fit has no confidence."""
    if fit and motions < lognormal_fit.LEAST_MOTIONS:
        return [f"no confidence band: it needs {lognormal_fit.LEAST_MOTIONS} motions or more, not {motions}"]
    if fit and not len(fit.samples):
        return [f"no confidence band: {fit.samples_without_fit} of {samples} samples of the motions have no fit"]
    return []


def _fitted(fit, value):
    """Returns the fields of Fragility that the fit gives."""
    if not fit:
        unknown, pair = np.full(len(value), np.nan), np.full(2, np.nan)
        return dict(median=np.nan, beta=np.nan, median_interval=pair, beta_interval=pair, value=value,
                    probability=unknown, band=np.stack([unknown, unknown]), samples=np.empty((0, 2)))
    return dict(median=fit.median, beta=fit.beta, median_interval=fit.median_interval,
                beta_interval=fit.beta_interval, value=value, band=fit.band,
                samples=fit.samples, probability=ndtr(np.log(value / fit.median) / fit.beta))
