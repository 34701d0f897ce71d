"""Fragility in the plane of two intensity measures, such as PGA and PGV/PGA (M. Purvance, A. Anooshehpoor, J. Brune,
Earthquake Engineering and Structural Dynamics 37 (2008) 791-808): the share of the points that exceed in bins, and

    ln(P / (1 - P)) = a + b ln x + c ln y"""

from __future__ import annotations

import dataclasses
import os
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_array
from scipy.special import expit, logit

from overturn import motion_bootstrap
from overturn.arguments import OLD_FRICTION, OLD_LIMIT, count, refuses_old
from overturn.exceedance import OVERTURNING, Exceedance
from overturn.fragility_curve import measure_of, name_of_measure, no_interval, units_of
from overturn.fragility_points import edges_of, is_measurable, left_out, points_of, share_interval
from overturn.fragility_table import Binned, numbers_text
from overturn.friction import expect_coefficient
from overturn.lognormal_fit import standardized
from overturn.motion_bootstrap import ENDS, LOGISTIC

if TYPE_CHECKING:
    import xarray
    from numpy.typing import ArrayLike, NDArray


@dataclasses.dataclass(frozen=True, eq=False)
class FragilityPlane(Binned):
    """Points in bins of two intensity measures, and the logistic fit to the single points. What a point is and when it
    exceeds: see Fragility. NaN: there is no such number, see `notes`."""

    x: str  #: name of the first measure
    y: str  #: of the second one, such as "pgv/pga"
    x_units: str
    y_units: str
    of: str  #: what is counted: "overturning", or a field such as "peak"
    above: float | None  #: the level of the field that is exceeded, in its unit
    x_edges: NDArray[np.float64]  #: of the bins
    y_edges: NDArray[np.float64]
    points: NDArray[np.int64]  #: with a verdict (bins of x, bins of y)
    exceeding: NDArray[np.int64]
    without_verdict: NDArray[np.int64]  #: undecided or not computed; not in `points`
    fraction_interval: NDArray[np.float64]  #: (2, bins of x, bins of y), 95 % confidence of `fraction`; see Fragility
    undecided: int
    not_computed: int
    motions: int  #: with at least one verdict
    blocks: int
    kind: str  #: what `blocks` counts
    together: str
    coefficients: NDArray[np.float64]  #: a, b, c, of x and y in their units
    samples: NDArray[np.float64]  #: (samples, 3), of the bootstrap over motions; empty if there are none
    notes: tuple[str, ...]
    group: str = ""  #: which blocks of the result these are; empty: all
    pools_samples: bool = False  #: whether an object has several samples, such as of its contacts; risk refuses them

    @property
    def coefficients_interval(self) -> NDArray[np.float64]:
        """(2, 3), of 95 % confidence."""
        return np.quantile(self.samples, ENDS, axis=0) if len(self.samples) else np.full((2, 3), np.nan)

    def probability(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """P at x and y, which broadcast."""
        a, b, c = self.coefficients
        return expit(a + b * np.log(x) + c * np.log(y))

    def of_samples(self, x: NDArray[np.float64], y: NDArray[np.float64]):
        """Yields P at each x and y, (values of x, values of y), first of the fit, then of each sample."""
        for a, b, c in [self.coefficients, *self.samples]:  # without overflow
            of_x, of_y = (np.exp(-np.clip(z, -350, 350)) for z in (a + b * np.log(x), c * np.log(y)))
            odds = np.multiply.outer(of_x, of_y)  # of not exceeding
            odds += 1
            yield np.reciprocal(odds, out=odds)

    def line(self, y: ArrayLike, share: float = 0.5) -> NDArray[np.float64]:
        """The x at which P is this share, at each y."""
        return _line(self.coefficients, y, share)

    def line_interval(self, y: ArrayLike, share: float = 0.5) -> NDArray[np.float64]:
        """Interval of 95 % confidence of line(), (2, *shape of y)."""
        if not len(self.samples):
            return np.full((2, *np.shape(y)), np.nan)
        return np.exp(np.quantile([np.log(_line(each, y, share)) for each in self.samples], ENDS, axis=0))

    def without_verdict_at(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """Share of the points without a verdict in the bin of x and y; outside the bins 1 if there are any there."""
        total = self.points + self.without_verdict
        is_outside = self.undecided + self.not_computed > self.without_verdict.sum()
        share = np.pad(np.divide(self.without_verdict, total, out=np.zeros(total.shape), where=total > 0), 1,
                       constant_values=float(is_outside))
        return share[np.searchsorted(self.x_edges, x), np.searchsorted(self.y_edges, y)]

    def summary(self) -> str:
        """Returns the numbers as a text of several lines."""
        lines = [self.counts_text(f"{self.x} [{self.x_units}] and {self.y} [{self.y_units}]"),
                 *[self.group] * bool(self.group)]
        if np.isfinite(self.coefficients).all():
            middle = np.sqrt(self.y_edges[0] * self.y_edges[-1])
            half = numbers_text([f"P = 1/2 where {self.y} = {middle:.3g}: {self.x} ="], [self.line(middle)],
                                [self.line_interval(middle)])
            lines += [f"ln(P / (1 - P)) = a + b ln({self.x}) + c ln({self.y})",
                      *numbers_text("abc", self.coefficients, self.coefficients_interval.T), *half]
        return "\n".join([*lines, *self.notes])

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Writes one row per bin, y varying fastest, below the summary as comments that begin with #. The fitted
        columns are those of the middle of the bin."""
        x, y = (np.sqrt(edges[:-1] * edges[1:]) for edges in (self.x_edges, self.y_edges))
        probability, *of_samples = self.of_samples(x, y)
        band = np.quantile(of_samples, ENDS, axis=0) if of_samples else np.full((2, *self.points.shape), np.nan)
        edges = {self.x: self.x_edges[:, None], self.y: self.y_edges}
        edges = {name: [np.broadcast_to(ends, self.points.shape).ravel() for ends in (each[:-1], each[1:])]
                 for name, each in edges.items()}
        self.write_table(path, edges, probability, band)


def _line(coefficients, y, share):
    a, b, c = coefficients
    return np.exp((logit(share) - a - c * np.log(y)) / b)


@refuses_old(OLD_FRICTION | OLD_LIMIT)
def fragility_plane(dataset: xarray.Dataset, x: str = "pga", y: str = "pgv/pga", *, of: str = OVERTURNING,
                    above: float | None = None, friction_demand: float | None = None, together: str | None = None,
                    bins: tuple[int, int] = (10, 10), equal_counts: bool = False, samples: int = 1000,
                    seed: int = 1) -> FragilityPlane:
    """Returns the fragility of a result under records in the plane of two intensity measures.

    x, y: measures as for fragility(), or ratios of two, such as "pgv/pga".
    bins: their numbers along x and y; they do not change the fit. equal_counts: in each of both.
    Other arguments: as for fragility().

    Points without a verdict are left out of the fit and counted in their bins; they are never safe. Raises ValueError
    if the dataset lacks what is needed, or no point has a verdict.
    """
    bins, samples, seed = two_counts(bins), count("samples", samples), count("seed", seed, least=0)
    exceedance = Exceedance(of, above)
    if friction_demand is not None:
        expect_coefficient(friction_demand)
    found = points_of_plane(dataset, x, y, exceedance, friction_demand, together, bins, equal_counts)
    points, exceeding, unknown = (each.astype(int) for each in found.totals())
    interval = share_interval(*(each.reshape(len(each), -1) for each in (points, exceeding)))
    x, y = found.names
    fitted, reason = found.fit(exceedance.verb(), samples, seed)
    coefficients, of_samples = np.full(3, np.nan), np.empty((0, 3))
    if fitted:
        coefficients, of_samples = found.coefficients(fitted.estimate[None])[0], found.coefficients(fitted.samples)
    cells = found.cells[0]
    measurable = {**cells, "measure": np.where(found.kept, cells["measure"], np.nan)}
    motions = len(np.unique(cells["motion"][found.kept & (cells["points"] > 0)]))
    points, exceeding, unknown = (each.sum(axis=0) for each in (points, exceeding, unknown))
    return FragilityPlane(
        x, y, *found.units, of, above, *found.edges, points, exceeding, unknown, interval.reshape(2, *points.shape),
        undecided=int(cells["undecided"].sum()), not_computed=int(cells["not_computed"].sum()), motions=motions,
        together=together or "", **found.blocks, coefficients=coefficients, samples=of_samples,
        notes=(*found.notes, *left_out(measurable, f"{x} or {y}", friction_demand), *[reason] * bool(reason),
               *no_interval(fitted, motions, samples)))


def two_counts(bins):
    if not isinstance(bins, (list, tuple)) or len(bins) != 2:
        raise ValueError(f"bins = {bins!r} are not two numbers of bins, of x and of y.")
    return [count("bins", each) for each in bins]


@dataclasses.dataclass(frozen=True, eq=False)
class PointsOfPlane:
    """Points with a finite logarithm of both measures."""

    names: list  # of x and y
    units: list
    cells: tuple  # of all points, by x and by y; see points_of()
    blocks: dict  # fields of a Fragility
    notes: list
    edges: list  # of the bins of x and y
    motions: np.ndarray
    kept: np.ndarray  # cells with a logarithm of both measures
    place: tuple  # of the kept cells: number of the motion, x, y

    def total(self, kind):
        """Returns numbers of points, of each motion in each bin (motions, bins of x, bins of y)."""
        edges = [np.arange(len(self.motions) + 1) - 0.5, *self.edges]
        return np.histogramdd(self.place, edges, weights=kind[self.kept])[0]

    def totals(self):
        """Returns the numbers of points with a verdict, of those that exceed, and of those without a verdict."""
        cells = self.cells[0]
        return (self.total(cells["points"]), self.total(cells["exceeding"]),
                self.total(cells["undecided"] + cells["not_computed"]))


    def fit(self, verb, samples, seed):
        """Returns the fit in standardized logarithms, see motion_bootstrap, or None and the reason."""
        cells, (row, *measures) = self.cells[0], self.place
        points, exceeding = cells["points"][self.kept], cells["exceeding"][self.kept]
        if not exceeding.any() or (exceeding == points).all():
            return None, f"no fit: {'every' if exceeding.any() else 'no'} point {verb}"
        for name, each in zip(self.names, measures):
            if np.ptp(each[points > 0]) == 0:
                return None, f"no fit: all points have the same {name} = {each[points > 0][0]:.4g}"
        values, column = np.unique(np.log(measures), axis=1, return_inverse=True)
        shape = len(self.motions), values.shape[1]
        counts = [coo_array((each.astype(float), (row, column.ravel())), shape).tocsr() for each in (points, exceeding)]
        with_verdict = np.diff(counts[0].indptr) > 0
        design = np.stack([np.ones(shape[1]), *((each - middle) / width for each, (middle, width) in
                                                zip(values, self.standard()))], axis=1)
        found = motion_bootstrap.fit(*(each[with_verdict] for each in counts), design, LOGISTIC, samples, seed)
        return found, "" if found else (f"no fit: the probability that a point {verb} does not rise with "
                                        f"{self.names[0]}, or a line separates the points that do from the others")

    def standard(self):
        """Returns the means and the standard deviations of ln x and ln y of the points with a verdict."""
        points = self.cells[0]["points"][self.kept]
        return [standardized(np.log(each), points) for each in self.place[1:]]

    def coefficients(self, values):
        """Returns a, b and c of values of motion_bootstrap.Fitted, which are of standardized logarithms."""
        (x, x_width), (y, y_width) = self.standard()
        middle, log_scatter, slope = values.T
        b = np.exp(-log_scatter) / x_width
        c = -slope * b * x_width / y_width
        return np.stack([-b * (x + x_width * middle) - c * y, b, c], axis=1)


def points_of_plane(dataset, x, y, exceedance, friction_demand, together, bins, equal_counts=False):
    """Returns the PointsOfPlane of two measures, or ratios of two, such as "pgv/pga". bins: their numbers. Raises
    ValueError if no point has a verdict."""
    words = [each.split("/") for each in (x, y)]
    measures = {name: measure_of(dataset, name) for each in words for name in each}
    cells, blocks, notes = points_of(dataset, measures, exceedance, friction_demand, together)
    values = dict(zip(measures, cells["measures"]))

    def ratio(first, second=None):
        with np.errstate(divide="ignore", invalid="ignore"):
            return values[first] / values[second] if second else values[first]
    by_measure = tuple({**cells, "measure": ratio(*each)} for each in words)
    edges = [edges_of(each, number, equal_counts) for each, number in zip(by_measure, bins)]
    if not (len(edges[0]) and len(edges[1])):
        raise ValueError("no point of this result has a verdict. Compute the missing points.")
    kept = is_measurable(by_measure[0]) & is_measurable(by_measure[1])
    motions, number = np.unique(cells["motion"][kept], return_inverse=True)
    named = [[name_of_measure(dataset, name) for name in each] for each in words]
    units = ["/".join(units_of(measures[name], im) for name, im in zip(*each)) for each in zip(words, named)]
    return PointsOfPlane(["/".join(each) for each in named], units, by_measure, blocks, notes, edges, motions, kept,
                         (number, *(each["measure"][kept] for each in by_measure)))
