"""Points whose verdict needs more friction than there is: the block may slip."""

import numpy as np
from matplotlib.patches import Patch
from overturn.captions import unfinished_words
from overturn.regions import SAFE, UNSAFE

HATCH = "\\\\\\\\"
STRIPES = 48  # across a panel


def slips(region, friction, coefficient):
    """Whether a verdict needs more friction than this coefficient, or an unknown one."""
    return np.isin(region, SAFE + UNSAFE) & ~(friction <= coefficient)


class Slipping:
    """The points of some spectra that may slip with a friction coefficient."""

    def __init__(self, planes, coefficient):
        self.coefficient = coefficient
        self.unfinished = unfinished_words(planes[0].file)
        self.count = self.verdicts = 0
        for plane in planes:
            for rows in plane.tiles():
                region = plane.read("region", rows)
                self.count += np.count_nonzero(self.of_rows(plane, rows))
                self.verdicts += np.count_nonzero(np.isin(region, SAFE + UNSAFE))

    def of_rows(self, plane, rows):
        return slips(plane.read("region", rows), plane.read("friction", rows), self.coefficient)

    def picture(self, plane, up, across, pixels):
        """Returns RGBA, transparent where the friction suffices. A pixel of several points shows the worst."""
        slipping = plane.highest(lambda rows: self.of_rows(plane, rows).astype(np.uint16), up, across, pixels) > 0
        slipping[up.is_between(pixels)] = False
        slipping[:, across.is_between(pixels)] = False
        row, column = np.indices(slipping.shape)
        period = max(4, pixels // STRIPES)
        stripes = (row + column) % period < max(1, period // 6)
        rgba = np.zeros((*slipping.shape, 4))
        rgba[slipping] = 1, 1, 1, 0.5  # a veil, which also shows what is narrower than the stripes
        rgba[slipping & stripes] = 0, 0, 0, 1
        return rgba

    def report(self):
        share = f" ({100 * self.count / self.verdicts:.3g} %)" if self.verdicts else ""
        return "\n".join([f"may slip with a friction coefficient of {self.coefficient:g}: {self.count} of "
                          f"{self.verdicts} points with a verdict{share}", *self.unfinished])

    def legend_entry(self):
        return Patch(facecolor="white", edgecolor="black", hatch=HATCH, linewidth=0.5,
                     label=f"may slip with a friction\ncoefficient of {self.coefficient:g}")
