"""Axes of a panel, to scale or with a band for each of a few values."""

import numpy as np
from overturn.captions import escaped, told_apart
from overturn.plot.headings import LINE, POINTS, width_of
from overturn.spectrum_planes import BANDS
from overturn.ticks import length_of, name_ticks

NUMBERS, SMALLEST = 10, 5  # font sizes [points]
BESIDE = {"x": 0.2, "y": 0.35}  # room of texts between an axis and its label [inches]
MOST_LETTERS = 24  # of a name at a tick


class BandTicks:
    """The texts at the ticks of bands along an axis of some length [inches]: their size [points] and, at the horizontal
    axis, whether they are turned by a right angle because they are too long."""

    def __init__(self, texts, length, name):
        self.name, self.texts = name, [escaped(text) for text in told_apart(texts, MOST_LETTERS)]
        room = length / len(texts)
        self.widest = max(width_of(text, NUMBERS) for text in self.texts)
        self.turned = name == "x" and 1.15 * self.widest > room
        most = NUMBERS if name == "x" and not self.turned else room * POINTS / LINE
        self.size = float(np.clip(most, SMALLEST, NUMBERS))

    def extent(self):
        """Returns the distance that the texts need beside the axis, in excess of that of short numbers [inches]."""
        if self.name == "x" and not self.turned:
            return 0.0
        return max(0.0, self.widest * self.size / NUMBERS - BESIDE[self.name])


def name_bands(axis, bands):
    values, texts = bands
    ticks = BandTicks(texts, length_of(axis), axis.axis_name)
    if any(texts):
        axis.set_ticks(values, ticks.texts, fontsize=ticks.size, rotation=90 if ticks.turned else 0)
    else:
        axis.set_ticks([])
    axis.set_ticks([], minor=True)


def set_axes(panel, across, up):
    """Sets scales, limits and ticks of a panel from two Axis of spectrum_planes. Bands have a tick each: the distances of
    their values have no meaning."""
    for set_scale, axis in ((panel.set_xscale, across), (panel.set_yscale, up)):
        if axis.scale == BANDS:
            set_scale("function", functions=(axis.shown, axis.value_at))
        else:
            set_scale(axis.scale)
    panel.set(xlim=across.limits(), ylim=up.limits())
    for drawn, axis in ((panel.xaxis, across), (panel.yaxis, up)):
        if axis.scale == BANDS:
            name_bands(drawn, axis.ticks())
        else:
            name_ticks(drawn)
