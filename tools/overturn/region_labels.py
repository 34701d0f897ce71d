"""Labels in a map of regions: each stands where its connected piece of a region is widest."""

import argparse
import re

import numpy as np
from overturn.regions import CODES

PATTERN = re.compile(r"(?P<text>[^=]+)=(?P<region>[^@]+)@(?P<frequency>[^,]+),(?P<amplitude>.+)")
MOST_CELLS = 400  # to a side: pieces are followed cell by cell


class Label:
    """A text for the piece of a region that lies nearest to a point of the plane."""

    def __init__(self, words):
        match = PATTERN.fullmatch(words)
        if not match or match["region"] not in CODES:
            raise argparse.ArgumentTypeError(
                f"\"{words}\" should be like III=S+@5,10, with one of {', '.join(CODES)}")
        self.text, self.code = match["text"], CODES[match["region"]]
        try:
            self.frequency, self.amplitude = float(match["frequency"]), float(match["amplitude"])
        except ValueError as error:
            raise argparse.ArgumentTypeError(f"\"{words}\": {error}") from error

    def piece(self, codes, across, up):
        """The cells that it stands for, or none if the region is not there."""
        found = np.argwhere(codes == self.code)
        if not len(found):
            return np.zeros(codes.shape, bool)
        aim = np.array([up.share(self.amplitude), across.share(self.frequency)])
        distance = np.linalg.norm((found + 0.5) / codes.shape - aim, axis=1)
        return connected(codes == self.code, found[np.argmin(distance)])


def add_label_argument(parser):
    parser.add_argument("--label", type=Label, action="append", default=[],
                        metavar="TEXT=REGION@FREQUENCY,AMPLITUDE",
                        help="write TEXT into the connected piece of REGION (S+, U0-, ...) that is "
                             "nearest to the point; may be given again")


def thinned(cells):
    """Evenly spread rows or columns, few enough to follow pieces in."""
    return cells[::-(-len(cells) // MOST_CELLS)]


def widened(mask):
    """With all neighbours, diagonal ones too."""
    wide = mask.copy()
    wide[1:] |= mask[:-1]
    wide[:-1] |= mask[1:]
    wider = wide.copy()
    wider[:, 1:] |= wide[:, :-1]
    wider[:, :-1] |= wide[:, 1:]
    return wider


def connected(mask, start):
    """The part of the mask that hangs together with a cell of it."""
    piece = np.zeros(mask.shape, bool)
    piece[tuple(start)] = True
    while True:
        grown = widened(piece) & mask
        if (grown == piece).all():
            return piece
        piece = grown


def pieces(mask, least):
    """The connected parts of at least so many cells."""
    rest = mask.copy()
    while np.count_nonzero(rest) >= least:
        piece = connected(rest, np.argwhere(rest)[0])
        rest &= ~piece
        if np.count_nonzero(piece) >= least:
            yield piece


def roomiest_cell(mask):
    """The row and column farthest from what is not in the mask; of several, one in the middle."""
    core = mask
    while core.any():
        last = core
        core = ~widened(~np.pad(core, 1))[1:-1, 1:-1]
    cells = np.argwhere(last)
    return cells[np.argmin(np.linalg.norm(cells - np.median(cells, axis=0), axis=1))]


def off_the_edge(mask):
    """Without a rim as high as a label, if that leaves anything."""
    rim = -(-max(mask.shape) // 40)
    inner = np.zeros(mask.shape, bool)
    inner[rim:-rim, rim:-rim] = mask[rim:-rim, rim:-rim]
    return inner if inner.any() else mask


def write_label(panel, mask, text, size):
    """At the roomiest place of a mask that covers the panel; with serifs, without them an I is a
    stroke. The plate behind it is seen through; a halo would turn text into outlines."""
    row, column = roomiest_cell(off_the_edge(mask))
    panel.text((column + 0.5) / mask.shape[1], (row + 0.5) / mask.shape[0], text, fontsize=size,
               transform=panel.transAxes, ha="center", va="center", family="serif", zorder=5,
               bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "alpha": 0.75,
                     "linewidth": 0})
