"""Sheets of several planes."""

import numpy as np
from matplotlib import pyplot
from matplotlib.cm import ScalarMappable
from overturn.plot.bands import BandTicks
from overturn.plot.headings import LINE, POINTS, Heading, wrapped

MOST_PANELS = 100
SIDES = {1: 20 / 3, 2: 4.4, 3: 3.4, 4: 2.8, 5: 2.3, 6: 2.0, 7: 1.75, 8: 1.6, 9: 1.5, 10: 1.4}  # by the columns [inches]
MOST_HEIGHT = 32  # of the panels [inches]
MOST_LENGTH = 3.0  # of a colour bar [inches]


class Sheet:
    """A figure of equal square panels; lengths in inches fix the number of pixels of a panel. Panels
    with the same axis share the numbers beside it."""

    LEFT, RIGHT, BOTTOM, GAP, EDGE = 0.85, 3.25, 0.7, 0.45, 0.1

    def __init__(self, heading, titles, columns, dpi, axes, above=0):
        """`heading` is a pair, the title of the sheet and the line below it; `titles` are those of the panels, and
        `axes` pairs of Axis of each, the horizontal and the vertical one. `above` is the height of what is drawn
        between a panel and its title, over that of the panel."""
        count = len(titles)
        rows = -(-count // columns)
        side = min(SIDES[columns], max(MOST_HEIGHT / rows, SIDES[10]))
        self.pixels = round(side * dpi)
        shares = [all(np.array_equal(axis.edges, of_kind[0].edges) and np.array_equal(axis.values, of_kind[0].values)
                      for axis in of_kind) for of_kind in zip(*axes)]
        below, beside = (max((BandTicks(axis.ticks()[1], side, name).extent() for axis in of_kind if axis.ticks()),
                                  default=0.0) for of_kind, name in zip(zip(*axes), "xy"))
        self.left, self.bottom = self.LEFT + beside, self.BOTTOM + below
        across = self.GAP + (0 if shares[1] else beside)
        self.width = self.left + columns * (side + across) - across + self.RIGHT
        heading = Heading(*heading, self.width - self.left - self.EDGE, (14, 11))
        size = 9 if side >= SIDES[4] else 7
        titles = ["\n".join(line for words in title.split("\n")
                            for line in wrapped(words, size, side + self.GAP / 2, ",")) for title in titles]
        further = max(title.count("\n") for title in titles)  # lines above a panel
        line = size * LINE * 1.3 / POINTS
        above *= side
        gap = self.GAP + above + line * max(0, further - 1) + (0 if shares[0] else below + 0.2)
        self.top = 1 + above + line * further + heading.extra
        self.explained = self.top - above
        self.height = self.top + rows * (side + gap) - gap + self.bottom
        self.figure, self.panels = pyplot.subplots(rows, columns, squeeze=False, dpi=dpi,
                                                   sharex=shares[0], sharey=shares[1],
                                                   figsize=(self.width, self.height))
        heading.write(self.figure, self.left, (0.4, 0.67))
        for panel, title in zip(self.panels.flat, titles):
            panel.set_title(title, fontsize=size)
        self.figure.subplots_adjust(self.left / self.width, self.bottom / self.height,
                                    1 - self.RIGHT / self.width, 1 - self.top / self.height,
                                    across / side, gap / side)
        for unused in self.panels.flat[count:]:
            unused.set_visible(False)
        for lowest in self.panels.flat[max(count - columns, 0):count]:
            lowest.tick_params(labelbottom=True)

    def name_axes(self, across, up):
        self.figure.supxlabel(across, fontsize=12, y=0.15 / self.height,
                              x=(self.left + self.width - self.RIGHT) / 2 / self.width)
        self.figure.supylabel(up, fontsize=12, x=0.15 / self.width,
                              y=(self.bottom + self.height - self.top) / 2 / self.height)

    def add_colour_bar(self, field):
        """Adds the colours of a Field, above the legend."""
        length = min(self.height - self.top - self.bottom, MOST_LENGTH)
        axes = self.figure.add_axes(((self.width - self.RIGHT + 0.25) / self.width, 1 - (self.top + length) / self.height,
                                     0.2 / self.width, length / self.height))
        self.figure.colorbar(ScalarMappable(field.norm, field.colours), cax=axes, extend=field.extend)
        axes.set_ylabel("\n".join(wrapped(field.label, 10.5, length)), fontsize=10.5)
        self.explained = self.top + length + 0.35

    def explain(self, **entries):
        """Adds the legend; the figure grows downward if it is too short for it."""
        legend = self.figure.legend(
            loc="upper left", borderaxespad=0, frameon=False, fontsize=10.5,
            handlelength=1.6, handleheight=1.2, labelspacing=0.7, alignment="left", **entries)
        legend.get_title().set_fontsize(10.5)
        corner = 1 - (self.RIGHT - 0.2) / self.width
        legend.set_bbox_to_anchor((corner, 1 - self.explained / self.height), self.figure.transFigure)
        missing = self.EDGE - legend.get_window_extent().y0 / self.figure.dpi
        if missing > 0:
            self._lengthen(missing)
            legend.set_bbox_to_anchor((corner, 1 - self.explained / self.height), self.figure.transFigure)

    def _lengthen(self, more):
        """Adds a margin at the bottom [inches]."""
        share = self.height / (self.height + more)
        grid = self.figure.subplotpars
        self.figure.subplots_adjust(bottom=1 - (1 - grid.bottom) * share, top=1 - (1 - grid.top) * share)
        for text in self.figure.texts:
            text.set_y(1 - (1 - text.get_position()[1]) * share)
        for bar in {*self.figure.axes} - {*self.panels.flat}:
            box = bar.get_position()
            bar.set_position((box.x0, 1 - (1 - box.y0) * share, box.width, box.height * share))
        self.height += more
        self.figure.set_size_inches(self.width, self.height)
