"""Titles of pictures, in as many lines as the width of the picture needs."""

import re

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

POINTS = 72  # per inch
LEGEND = 8  # size of the font of a legend [points]
LINE = 1.3  # height of a line over the size of the font


def width_of(text, size):
    """Returns the width [inches] of a line in a font of this size [points]: that of the control points of its outlines,
    because Matplotlib computes the extrema of their curves slowly."""
    if not text.strip():
        return 0.0  # some versions of Matplotlib refuse a path without glyphs
    return TextPath((0, 0), text, size=size, prop=FontProperties()).vertices[:, 0].max(initial=0) / POINTS


def wrapped(text, size, width, separator=""):
    """Returns the lines of a text, not wider than `width` [inches]: broken at blanks after the separator, and between
    words where a part without separators is too wide. A single word may be wider."""
    lines = [""]
    for part in re.split(rf"(?<=\S)(?<={separator})(?= )", text):
        for piece in [part] if width_of(part, size) <= width else re.split(r"(?<=\S)(?= )", part):
            if lines[-1] and width_of(lines[-1] + piece, size) > width:
                lines.append("")
            lines[-1] += piece if lines[-1] else piece.lstrip()
    return lines


def place_legend_above(ax, columns, handles=None):
    """Places the legend of axes between them and their title, where it hides nothing."""
    handles = ax.get_legend_handles_labels()[0] if handles is None else handles
    rows = -(-len(handles) // columns) * max(handle.get_label().count("\n") + 1 for handle in handles)
    ax.legend(handles=handles, fontsize=LEGEND, ncols=columns, loc="lower center", bbox_to_anchor=(0.5, 1), frameon=False)
    ax.set_title(ax.get_title(), fontsize=ax.title.get_fontsize(), pad=6 + rows * 1.6 * LEGEND)


class Heading:
    """A title and a second line of quantities separated by commas, each wrapped to a width [inches]. Sizes are in
    points."""

    def __init__(self, title, second, width, sizes):
        self.texts = [wrapped(title, sizes[0], width), wrapped(second, sizes[1], width, ",")]
        self.sizes = sizes
        #: height [inches] of all lines but the first of both
        self.extra = sum((len(lines) - 1) * LINE * size / POINTS for lines, size in zip(self.texts, sizes))

    def write(self, figure, left, tops):
        """Writes the lines from the left edge [inches] on; tops [inches] are the distances of the baselines of both
        from the top of the figure if each has one line."""
        width, height = figure.get_size_inches()
        lower = 0.0
        for lines, size, top in zip(self.texts, self.sizes, tops):
            for line in lines:
                figure.text(left / width, 1 - (top + lower) / height, line, fontsize=size)
                lower += LINE * size / POINTS
            lower -= LINE * size / POINTS
