"""Labels in a map of regions, each placed where its connected piece of a region is widest."""

import argparse
import re

import numpy as np
from overturn.regions import CODES

PATTERN = re.compile(r"(?P<text>[^=]+)=(?P<region>[^@]+)@(?P<across>[^,]+),(?P<up>.+)")
MOST_CELLS = 400  # per side: connected pieces are found cell by cell


class Label:
    """A text for the piece of a region nearest to a point of the plane."""

    def __init__(self, words):
        match = PATTERN.fullmatch(words)
        if not match or match["region"] not in CODES:
            raise argparse.ArgumentTypeError(
                f"\"{words}\" is not of the form III=S+@5,10 with one of {', '.join(CODES)}")
        self.text, self.code = match["text"], CODES[match["region"]]
        try:
            self.across, self.up = float(match["across"]), float(match["up"])
        except ValueError as error:
            raise argparse.ArgumentTypeError(f"\"{words}\": {error}") from error

    def piece(self, codes, across, up):
        """Returns the labelled cells; none if the region does not occur."""
        found = np.argwhere(codes == self.code)
        if not len(found):
            return np.zeros(codes.shape, bool)
        aim = np.array([up.share(self.up), across.share(self.across)])
        distance = np.linalg.norm((found + 0.5) / codes.shape - aim, axis=1)
        return connected(codes == self.code, found[np.argmin(distance)])


def add_label_argument(parser):
    parser.add_argument("--label", type=Label, action="append", default=[],
                        metavar="TEXT=REGION@X,Y",
                        help="write TEXT into the connected piece of REGION (S+, U0-, ...) that is "
                             "nearest to the point with these values on the axes; repeatable")


def thinned(cells):
    """Evenly spaced rows or columns, few enough for a search cell by cell."""
    return cells[::-(-len(cells) // MOST_CELLS)]


def numbered(mask):
    """Returns the number of the connected part of each cell of the mask, in which diagonal neighbours are connected:
    1, 2, ...; 0 outside the mask."""
    from scipy import ndimage  # slow to import, and few pictures need it
    return ndimage.label(mask, np.ones((3, 3)))[0]


def connected(mask, start):
    """Returns the part of the mask that is connected to a given cell."""
    numbers = numbered(mask)
    return numbers == numbers[tuple(start)]


def pieces(mask, least):
    """Yields the connected parts of at least `least` cells."""
    numbers = numbered(mask)
    for number in np.flatnonzero(np.bincount(numbers[mask]) >= max(least, 1)):
        yield numbers == number


def roomiest_cell(mask):
    """Returns the cell farthest from the complement of the mask; among several, a central one."""
    from scipy import ndimage
    distance = ndimage.distance_transform_cdt(np.pad(mask, 1))[1:-1, 1:-1]
    cells = np.argwhere(distance == distance.max())
    return cells[np.argmin(np.linalg.norm(cells - np.median(cells, axis=0), axis=1))]


def off_the_edge(mask):
    """Removes a rim of the height of a label, unless nothing would be left."""
    rim = -(-max(mask.shape) // 40)
    inner = np.zeros(mask.shape, bool)
    inner[rim:-rim, rim:-rim] = mask[rim:-rim, rim:-rim]
    return inner if inner.any() else mask


def write_label(panel, mask, text, size):
    """Writes the label at the roomiest cell of a mask that covers the panel, in a serif font
    because a sans-serif I is a mere stroke. The box is translucent; a halo would obscure text."""
    row, column = roomiest_cell(off_the_edge(mask))
    panel.text((column + 0.5) / mask.shape[1], (row + 0.5) / mask.shape[0], text, fontsize=size,
               transform=panel.transAxes, ha="center", va="center", family="serif", zorder=5,
               bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "alpha": 0.75,
                     "linewidth": 0})
