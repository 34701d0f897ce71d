"""The share of the points that exceed in bins of two intensity measures."""

import dataclasses

import numpy as np

from overturn.fragility_curve import measure_of, name_of_measure, units_of
from overturn.fragility_points import edges_of, is_measurable, points_of


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
        return np.histogramdd(self.place, [np.arange(len(self.motions) + 1) - 0.5, *self.edges], weights=kind[self.kept])[0]

    def totals(self):
        """Returns the numbers of points with a verdict, of those that exceed, and of those without a verdict."""
        cells = self.cells[0]
        return (self.total(cells["points"]), self.total(cells["exceeding"]),
                self.total(cells["undecided"] + cells["not_computed"]))


def points_of_plane(dataset, x, y, exceedance, friction_demand, together, bins):
    """x, y: measures, or ratios of two, such as "pgv/pga". bins: their numbers. Raises ValueError if no point has a verdict."""
    words = [each.split("/") for each in (x, y)]
    measures = {name: measure_of(dataset, name) for each in words for name in each}
    cells, blocks, notes = points_of(dataset, measures, exceedance, friction_demand, together)
    values = dict(zip(measures, cells["measures"]))

    def ratio(first, second=None):
        with np.errstate(divide="ignore", invalid="ignore"):
            return values[first] / values[second] if second else values[first]
    by_measure = tuple({**cells, "measure": ratio(*each)} for each in words)
    edges = [edges_of(each, number) for each, number in zip(by_measure, bins)]
    if not (len(edges[0]) and len(edges[1])):
        raise ValueError("no point of this result has a verdict. Compute the missing points.")
    kept = is_measurable(by_measure[0]) & is_measurable(by_measure[1])
    motions, number = np.unique(cells["motion"][kept], return_inverse=True)
    named = [[name_of_measure(dataset, name) for name in each] for each in words]
    units = ["/".join(units_of(measures[name], im) for name, im in zip(*each)) for each in zip(words, named)]
    return PointsOfPlane(["/".join(each) for each in named], units, by_measure, blocks, notes, edges, motions, kept,
                         (number, *(each["measure"][kept] for each in by_measure)))
