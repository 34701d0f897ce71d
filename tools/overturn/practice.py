"""Blocks that published practice misjudges: it calls a block overturned when |theta| >= alpha, but
some of these blocks come back."""

import numpy as np
from matplotlib import colors
from matplotlib.patches import Patch
from overturn.captions import spectrum_words, unfinished_words
from overturn.regions import SAFE

COLOUR = "#1f5fe0"


def came_back(region, peak):
    """Whether a block is safe although it passed alpha; peak is the largest |theta| / alpha."""
    return np.isin(region, SAFE) & (peak >= 1)


def count(plane):
    """Returns the number of blocks that came back and of all safe blocks of a spectrum."""
    wrong = safe = 0
    for rows in plane.tiles():
        region, peak = (plane.read(name, rows) for name in ("region", "peak"))
        wrong += np.count_nonzero(came_back(region, peak))
        safe += np.count_nonzero(np.isin(region, SAFE))
    return wrong, safe


def share_text(wrong, safe):
    share = f" ({100 * wrong / safe:.3g} %)" if safe else ""
    return f"{wrong} of {safe} safe points{share}"


class Misjudged:
    """The blocks of some spectra that came back, counted."""

    def __init__(self, planes):
        self.names = [",  ".join(spectrum_words(plane)) for plane in planes]
        self.counts = [count(plane) for plane in planes]
        self.total = share_text(*map(sum, zip(*self.counts)))
        self.unfinished = unfinished_words(planes[0].file)

    def report(self):
        lines = [f"safe, although |theta| reaches alpha: {self.total}"]
        if len(self.names) > 1:
            lines += [f"  {name}:  {share_text(*each)}"
                      for name, each in zip(self.names, self.counts)]
        return "\n".join(lines + self.unfinished)

    def legend_entry(self):
        return Patch(facecolor=COLOUR, edgecolor="black", linewidth=0.5,
                     label="safe, although |θ| reaches α:\n"
                     + self.total.replace(" safe points", "\nsafe points"))


def picture(region, peak):
    """Returns RGBA, transparent except at blocks that came back."""
    rgba = np.zeros((*region.shape, 4))
    rgba[came_back(region, peak)] = colors.to_rgba(COLOUR)
    return rgba
