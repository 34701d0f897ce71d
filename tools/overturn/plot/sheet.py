"""Sheets of several planes."""

from matplotlib import pyplot
from overturn.plot.headings import Heading, wrapped

MOST_PANELS = 12


class Sheet:
    """A figure of equal square panels; lengths in inches fix the number of pixels of a panel. Panels
    with the same vertical axis share the numbers beside it."""

    LEFT, RIGHT, BOTTOM, GAP, EDGE = 0.85, 3.25, 0.7, 0.45, 0.1

    def __init__(self, heading, titles, columns, dpi, shares_vertical_axis):
        """`heading` is a pair, the title of the sheet and the line below it; `titles` are those of the panels."""
        count = len(titles)
        rows = -(-count // columns)
        side = {1: 20 / 3, 2: 4.4, 3: 3.4, 4: 2.8}[columns]
        self.pixels = round(side * dpi)
        self.width = self.LEFT + columns * (side + self.GAP) - self.GAP + self.RIGHT
        heading = Heading(*heading, self.width - self.LEFT - self.EDGE, (14, 11))
        titles = ["\n".join(line for words in title.split("\n") for line in wrapped(words, 9, side + self.GAP / 2, ","))
                  for title in titles]
        further = max(title.count("\n") for title in titles)  # lines above a panel
        gap = self.GAP + 0.15 * max(0, further - 1)
        self.top = 1 + 0.15 * further + heading.extra
        self.height = self.top + rows * (side + gap) - gap + self.BOTTOM
        self.figure, self.panels = pyplot.subplots(rows, columns, squeeze=False, dpi=dpi,
                                                   sharex=True, sharey=shares_vertical_axis,
                                                   figsize=(self.width, self.height))
        heading.write(self.figure, self.LEFT, (0.4, 0.67))
        for panel, title in zip(self.panels.flat, titles):
            panel.set_title(title, fontsize=9)
        self.figure.subplots_adjust(self.LEFT / self.width, self.BOTTOM / self.height,
                                    1 - self.RIGHT / self.width, 1 - self.top / self.height,
                                    self.GAP / side, gap / side)
        for unused in self.panels.flat[count:]:
            unused.set_visible(False)
        for lowest in self.panels.flat[max(count - columns, 0):count]:
            lowest.tick_params(labelbottom=True)

    def name_axes(self, across, up):
        self.figure.supxlabel(across, fontsize=12, y=0.15 / self.height,
                              x=(self.LEFT + self.width - self.RIGHT) / 2 / self.width)
        self.figure.supylabel(up, fontsize=12, x=0.15 / self.width,
                              y=(self.BOTTOM + self.height - self.top) / 2 / self.height)

    def explain(self, **entries):
        corner = (1 - (self.RIGHT - 0.2) / self.width, 1 - self.top / self.height)
        legend = self.figure.legend(
            loc="upper left", bbox_to_anchor=corner, borderaxespad=0, frameon=False, fontsize=10.5,
            handlelength=1.6, handleheight=1.2, labelspacing=0.7, alignment="left", **entries)
        legend.get_title().set_fontsize(10.5)
