"""Reading of overturning spectra by the tools: their planes, cell by cell."""

import numpy as np

from overturn.block_groups import texts_of
from overturn.regions import APART, BETWEEN, ranks, worst
from overturn.tool import USAGE, ToolError

JOB, PHYSICAL = "job", "physical"  # units: those of the job, or seconds, g and degrees
EQUIVALENTS = {"frequency": "pulse_period", "amplitude": "pga", "scale": "pga"}  # in physical units
MOST_REACH = 1 / 16  # of a cell from its value, over the range of the axis: nine even values leave no gaps
FEW = 8  # values that would leave gaps on an axis to scale, however they are spaced
MOST_BANDS = 24  # that have a tick each
LINEAR, LOG, BANDS = "linear", "log", "bands"  # scales of an axis
REACH_OF_BANDS = 0.45  # of a band from its middle, over the distance of two
COUNTED = ("motion", "block")  # dimensions whose values are numbers
RECIPROCALS = {"pulse_period": "pulse_frequency", "pulse_frequency": "pulse_period"}


class Plane:
    """What a picture shows of a spectrum or a boundary: the dimensions along the horizontal and the vertical axis, and
    an index of each of the others. A spectrum of one dimension has no horizontal one, nor has a boundary of one frequency or
    size."""

    def __init__(self, file, index, across, up):
        self.file, self.index, self.across, self.up = file, index, across, up
        self.height = file.sizes[up]

    def lines(self, most):
        """Returns the planes along the axis of many values alone, one for each value of the other; none if that has
        more than so many."""
        if self.across is None:
            return [self]
        (fewer, few), (more, many) = sorted((self.file.sizes[name], name) for name in (self.across, self.up))
        if fewer > most or (fewer > 1 and more <= FEW):
            return []
        return [Plane(self.file, {**self.index, few: place}, None, many) for place in range(fewer)]

    def read(self, name, rows=slice(None)):
        """Reads some rows of a field."""
        dimensions, values = self.file[name].dimensions, self.file[name].at({**self.index, self.up: rows})
        if self.across is None:
            return values[:, None]
        return values.T if dimensions.index(self.across) < dimensions.index(self.up) else values

    def tiles(self):
        """Returns slices of rows to be read one at a time, because a plane may not fit in memory."""
        height = self.file.rows(self.up)
        return [slice(first, first + height) for first in range(0, self.height, height)]

    def read_cells(self, name, rows, columns):
        """Reads a field at given rows and columns."""
        values = np.empty((len(rows), len(columns)), self.file[name].dtype)
        for tiles in self.tiles():
            wanted = (rows >= tiles.start) & (rows < tiles.stop)
            if wanted.any():
                values[wanted] = self.read(name, tiles)[np.ix_(rows[wanted] - tiles.start, columns)]
        return values

    def read_regions(self, up, across, pixels):
        """Reads the regions for a picture. Where a pixel covers several points, it shows the one in its middle, unless
        another one is not computed, undecided or overturns and that one is not."""
        middle = self.read_cells("region", up.cells(pixels), across.cells(pixels))
        highest = self.highest(lambda rows: ranks(self.read("region", rows)), up, across, pixels)
        return without_gaps(worst(middle, highest), up, across)

    def highest(self, rank_of, up, across, pixels):
        """Returns the highest rank among the points that each pixel covers; rank_of(rows) returns those of some
        rows."""
        rows, columns = up.cells(pixels), across.cells(pixels)
        of_row, of_column = up.pixels_of_cells(pixels), across.pixels_of_cells(pixels)
        first = np.flatnonzero(np.diff(of_column, prepend=-1))  # of the cells in each column of pixels
        highest = np.zeros((len(rows), len(columns)), np.uint16)
        for tiles in self.tiles():
            rank = rank_of(tiles)
            by_pixel = rank[:, columns]
            if across.size > pixels:
                place = of_column[first]
                by_pixel[:, place] = np.maximum(by_pixel[:, place], np.maximum.reduceat(rank, first, axis=1))
            wanted = (rows >= tiles.start) & (rows < tiles.stop)
            highest[wanted] = np.maximum(highest[wanted], by_pixel[rows[wanted] - tiles.start])
            if up.size > pixels:
                of_tile = of_row[tiles]
                start = np.flatnonzero(np.diff(of_tile, prepend=-1))
                place = of_tile[start]
                highest[place] = np.maximum(highest[place], np.maximum.reduceat(by_pixel, start, axis=0))
        return highest

    def knows(self, name, along=()):
        """Whether a coordinate is stored and varies in this plane along the given dimensions at most."""
        return name in self.file and {*self.file[name].dimensions} <= {*self.index, *along}

    def values(self, name, dimension):
        """Returns the values of a coordinate along one dimension."""
        if name in RECIPROCALS and name not in self.file:
            return 1 / self.values(RECIPROCALS[name], dimension)
        if not self.knows(name, [dimension]):
            raise ToolError(f"\"{self.file.filename}\" has no {name} along {dimension} alone. Draw it in the units of "
                            "the job, or choose other axes.", USAGE)
        return np.broadcast_to(self.file[name].at(self.index), self.file.sizes[dimension])

    def value(self, name):
        """Returns the only value of a coordinate in this plane, or None."""
        return self.file[name].at(self.index).item() if self.knows(name) else None

    def quantities(self, units=JOB):
        """Returns the quantities on the horizontal and the vertical axis; vertical ones of a boundary are those of
        its flips."""
        shown = EQUIVALENTS if units == PHYSICAL else {}
        names = self.across, scanned_quantity(self.file) if self.up == "crossing" else self.up
        return tuple(shown.get(name, name) for name in names)


def scanned_quantity(file):
    """Returns the quantity of the job along which a boundary was scanned."""
    return next(name.removeprefix("scan_") for name in file.run if name.startswith("scan_"))


def are_geometric(values):
    """Whether steps are equal in the logarithm, not in the values; rounding is far below 1e-6."""
    def unevenness(steps):
        return np.ptp(steps) / np.mean(steps)
    return (len(values) > 2 and values[0] > 0
            and unevenness(np.diff(np.log(values))) < 1e-6 < unevenness(np.diff(values)))


def without_gaps(codes, up, across):
    """Returns a picture without colours where nothing was computed: between values that are far from each other, and
    between bands."""
    codes[up.is_between(codes.shape[0])] = APART if up.scale == BANDS else BETWEEN
    codes[:, across.is_between(codes.shape[1])] = APART if across.scale == BANDS else BETWEEN
    return codes


class Axis:
    """The cells of one axis, in ascending order of the values, which may descend in the file.

    To scale, each extends to the midpoints between its value and its neighbours, but not beyond a small part of the
    axis: what is between values far from each other was not computed. Midpoints are computed on the scale of the
    axis, which is logarithmic for geometric values unless `scale` is given.

    Few values have bands of equal width with a tick each, whatever is between them, unless `is_to_scale`: to scale, most
    of the axis would be empty. So have values that are counted, such as blocks, if they are not too many; their names
    may be given.
    """

    def __init__(self, values, scale=None, *, are_counted=False, names=None, is_to_scale=False):
        self.descends = values[-1] < values[0]
        if self.descends:
            values = values[::-1]
        self.values, self.size = values, len(values)
        self.scale = scale or (LOG if are_geometric(values) else LINEAR)
        self._set_cells(self.size == 1 or are_counted)
        has_bands = self.size <= (MOST_BANDS if are_counted else FEW) or (
            self.size <= MOST_BANDS and self._share_of_cells() < 0.5)
        if has_bands and (self.size == 1 or not is_to_scale):
            self.scale = BANDS
            self._set_cells(self.size == 1)
        self.names = names if names is None or not self.descends else names[::-1]

    def _set_cells(self, are_adjacent):
        shown = self.shown(self.values)
        inner = (shown[1:] + shown[:-1]) / 2
        if self.size == 1:
            first, last = shown[0] - 0.5, shown[0] + 0.5
        else:
            first, last = 2 * shown[0] - inner[0], 2 * shown[-1] - inner[-1]
            if self.scale == LINEAR and self.values[0] >= 0:
                first = max(first, 0)  # no block or motion has a negative value
        reach = (np.inf if are_adjacent else REACH_OF_BANDS if self.scale == BANDS
                 else MOST_REACH * (shown[-1] - shown[0]))
        self.starts = np.maximum(np.insert(inner, 0, first), shown - reach)
        self.ends = np.minimum(np.append(inner, last), shown + reach)
        self.edges = np.concatenate([self.starts[:1], inner, self.ends[-1:]])

    def _share_of_cells(self):
        return (self.ends - self.starts).sum() / (self.edges[-1] - self.edges[0])

    def shown(self, values):
        """Returns the places of values on the scale of the axis; of bands, 0, 1, ... are their middles."""
        if self.scale == BANDS:
            return _along(self.values, np.arange(self.size), values)
        return np.log(values) if self.scale == LOG else values

    def value_at(self, shown):
        """Returns the values at places on the scale of the axis."""
        if self.scale == BANDS:
            return _along(np.arange(self.size), self.values, shown)
        return np.exp(shown) if self.scale == LOG else shown

    def limits(self):
        return self.value_at(self.edges[[0, -1]])

    def ticks(self):
        """Returns the values and the texts of the ticks of bands, or None."""
        if self.scale != BANDS:
            return None
        return self.values, texts_of(self.values, 4) if self.names is None else self.names

    def share(self, values):
        """Returns the positions of values along the axis, from 0 to 1."""
        return (self.shown(values) - self.edges[0]) / (self.edges[-1] - self.edges[0])

    def middles(self, pixels):
        """Returns the centres of pixels on the scale of the axis."""
        width = (self.edges[-1] - self.edges[0]) / pixels
        return self.edges[0] + width * (np.arange(pixels) + 0.5)

    def cells(self, pixels):
        """Returns the cell under the centre of each pixel, or the nearest one, as its index in the file."""
        cells = np.searchsorted(self.edges[1:-1], self.middles(pixels))
        return len(self.edges) - 2 - cells if self.descends else cells

    def is_between(self, pixels):
        """Returns whether the centre of each pixel is in no cell."""
        middles = self.middles(pixels)
        cells = np.searchsorted(self.edges[1:-1], middles)
        return (middles < self.starts[cells]) | (middles > self.ends[cells])

    def pixels_of_cells(self, pixels):
        """Returns the pixel under the middle of each cell, in the order of the file."""
        middles = (self.edges[1:] + self.edges[:-1]) / 2
        shares = (middles - self.edges[0]) / (self.edges[-1] - self.edges[0])
        of_cell = np.minimum((shares * pixels).astype(int), pixels - 1)
        return of_cell[::-1] if self.descends else of_cell


def _along(given, wanted, values):
    """Interpolates between corresponding numbers, and beyond both ends with the slope there."""
    values = np.asarray(values, float)
    if len(given) == 1:
        return wanted[0] + values - given[0]
    slopes = (wanted[[1, -1]] - wanted[[0, -2]]) / (given[[1, -1]] - given[[0, -2]])
    return (np.interp(values, given, wanted) + slopes[0] * np.minimum(values - given[0], 0)
            + slopes[1] * np.maximum(values - given[-1], 0))
