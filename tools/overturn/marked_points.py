"""Points of spectra that an option marks and counts: safe blocks that published practice calls overturned, because
|theta| reaches alpha, and verdicts that need more friction than there is, so that the block may slip."""

import numpy as np
from matplotlib import colors
from matplotlib.patches import Patch
from overturn.captions import spectrum_words
from overturn.result_file import unfinished_words
from overturn.regions import SAFE, UNSAFE

COLOUR = "#1f5fe0"  # of misjudged blocks
STRIPES = 48  # across a panel


def slips(region, friction, coefficient):
    """Whether a verdict needs more friction than this coefficient, or an unknown one."""
    return np.isin(region, SAFE + UNSAFE) & ~(friction <= coefficient)


class Marks:
    """The marked points of some spectra: by a field, among the points of some regions."""

    def add(self, planes):
        """Counts the points of some spectra."""
        self.names = [",  ".join(spectrum_words(plane)) for plane in planes]
        self.counts = [self.count(plane) for plane in planes]
        self.total = self.share_text(*map(sum, zip(*self.counts)))
        self.unfinished = unfinished_words(planes[0].file)

    def count(self, plane):
        """Returns the numbers of marked points and of points of these regions."""
        marked = among = 0
        for rows in plane.tiles():
            region = plane.read("region", rows)
            marked += np.count_nonzero(self.are_marked(region, plane.read(self.FIELD, rows)))
            among += np.count_nonzero(np.isin(region, self.REGIONS))
        return marked, among

    def share_text(self, marked, among):
        share = f" ({100 * marked / among:.3g} %)" if among else ""
        return f"{marked} of {among} {self.KIND}{share}"


class Misjudged(Marks):
    FIELD, REGIONS, KIND = "peak", SAFE, "safe points"

    def are_marked(self, region, peak):
        """`peak` is the largest |theta| / alpha."""
        return np.isin(region, SAFE) & (peak >= 1)

    def picture(self, plane, codes, up, across):
        """Returns RGBA of a picture of the plane with these codes, transparent except at marked points."""
        peak = plane.read_cells("peak", up.cells(len(codes)), across.cells(len(codes)))
        rgba = np.zeros((*codes.shape, 4))
        rgba[self.are_marked(codes, peak)] = colors.to_rgba(COLOUR)
        return rgba

    def report(self):
        lines = [f"  {name}:  {self.share_text(*each)}" for name, each in zip(self.names, self.counts)]
        return "\n".join([f"safe, although |theta| reaches alpha: {self.total}", *lines * (len(lines) > 1),
                          *self.unfinished])

    def legend_entry(self):
        return Patch(facecolor=COLOUR, edgecolor="black", linewidth=0.5, label="safe, although |θ| reaches α:\n"
                     + self.total.replace(" safe points", "\nsafe points"))


class Slipping(Marks):
    FIELD, REGIONS, KIND = "friction_demand", SAFE + UNSAFE, "points with a verdict"

    def __init__(self, coefficient):
        self.coefficient = coefficient

    def are_marked(self, region, friction):
        return slips(region, friction, self.coefficient)

    def picture(self, plane, codes, up, across):
        """The same; a pixel of several points shows the worst."""
        pixels = len(codes)
        slipping = plane.highest(lambda rows: self.are_marked(
            plane.read("region", rows), plane.read("friction_demand", rows)).astype(np.uint16), up, across, pixels) > 0
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
        return "\n".join([f"may slip with a friction coefficient of {self.coefficient:g}: {self.total}", *self.unfinished])

    def legend_entry(self):
        return Patch(facecolor="white", edgecolor="black", hatch="\\\\\\\\", linewidth=0.5,
                     label=f"may slip with a friction\ncoefficient of {self.coefficient:g}")
