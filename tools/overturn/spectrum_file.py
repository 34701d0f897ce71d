"""Reading of overturning spectra by the tools: the planes of a file, cell by cell."""

import numpy as np

from overturn.fields import read_field
from overturn.result_file import PlotError, open_result


def open_spectrum(path, fields=("region",)):
    """Opens a spectrum that has the given fields."""
    file = open_result(path, "overturning spectrum", "a spectrum written by overturn run")
    if "block" in file:
        raise PlotError(f"\"{path}\" contains a list of blocks, not a plane. Read it with "
                        "xarray.open_dataset().")
    for field in fields:
        if field not in file:
            raise PlotError(f"\"{path}\": this file has no field {field}; add it to output.fields.")
    return file


def are_geometric(values):
    """Whether steps are equal in the logarithm, not in the values; rounding is far below 1e-6."""
    def unevenness(steps):
        return np.ptp(steps) / np.mean(steps)
    return (len(values) > 2 and values[0] > 0
            and unevenness(np.diff(np.log(values))) < 1e-6 < unevenness(np.diff(values)))


class Axis:
    """The cells of one axis, in ascending order of the values, which may descend in the file; each
    extends to the midpoints between its value and its neighbours.

    Midpoints are computed on the scale of the axis, which is logarithmic for geometric values unless
    `scale` is given.
    """

    def __init__(self, values, scale=None):
        self.descends = values[-1] < values[0]
        if self.descends:
            values = values[::-1]
        self.scale = scale or ("log" if are_geometric(values) else "linear")
        self.only_value = values[0] if len(values) == 1 else None
        shown = self.shown(values)
        inner = (shown[1:] + shown[:-1]) / 2
        if len(values) == 1:
            first, last = shown[0] - 0.5, shown[0] + 0.5
        else:
            first, last = 2 * shown[0] - inner[0], 2 * shown[-1] - inner[-1]
        self.edges = np.concatenate([[first], inner, [last]])

    def shown(self, values):
        return np.log(values) if self.scale == "log" else values

    def limits(self):
        ends = self.edges[[0, -1]]
        return np.exp(ends) if self.scale == "log" else ends

    def share(self, values):
        """Returns the positions of values along the axis, from 0 to 1."""
        return (self.shown(values) - self.edges[0]) / (self.edges[-1] - self.edges[0])

    def cells(self, pixels):
        """Returns the cell under the centre of each pixel, as its index in the file."""
        width = (self.edges[-1] - self.edges[0]) / pixels
        middles = self.edges[0] + width * (np.arange(pixels) + 0.5)
        cells = np.searchsorted(self.edges[1:-1], middles)
        return len(self.edges) - 2 - cells if self.descends else cells


def rows_of_tiles(field):
    """Returns slices of rows to be read one at a time, because a plane may not fit in memory."""
    height = field.chunks[-2] if field.chunks else 64
    return [slice(first, first + height) for first in range(0, field.shape[-2], height)]


def read_cells(file, name, outer, rows, columns):
    """Reads a field at given rows and columns."""
    values = np.empty((len(rows), len(columns)), file[name].dtype)
    for tiles in rows_of_tiles(file[name]):
        wanted = (rows >= tiles.start) & (rows < tiles.stop)
        if wanted.any():
            block = read_field(file, name, outer, tiles)
            values[wanted] = block[np.ix_(rows[wanted] - tiles.start, columns)]
    return values
