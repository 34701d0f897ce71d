"""Curves of a field along one axis, one for each of a few values of another axis. Above them, each has a strip with the
verdict of its points: it ends where a block topples, and where nothing is known."""

import numpy as np
from matplotlib.lines import Line2D
from overturn.captions import curve_text, escaped, told_apart
from overturn.colourings import LEVELS
from overturn.plot.bands import set_axes
from overturn.plot.cover import cover, hatch
from overturn.spectrum_planes import BANDS
from overturn.units import axis_of

# As unlike as possible with normal sight, with each kind of colour blindness, and in grey; none is red as what topples.
COLOURS = ("#000000", "#123a8c", "#096662", "#865fcc", "#b48600", "#5ab4e6")
MARKERS = ("o", "s", "^", "D", "v", "X")
MARKED = 16  # points of a curve, evenly spaced; and all that have no neighbours
MOST_LETTERS = 28  # of a label
GAP, STRIP = 0.012, 0.028  # above a panel, and height of a strip, over the height of the panel
LEVEL = {"color": "#707070", "linewidth": 0.9, "linestyle": (0, (4, 3))}


def height_of_strips(count):
    """Over the height of the panel."""
    return GAP + count * STRIP


def style_of(number):
    return {"color": COLOURS[number], "marker": MARKERS[number], "markersize": 4, "linewidth": 1.2}


def places_of_markers(values):
    """Returns the indices of some finite values, among them all that a line would not show."""
    is_known = np.isfinite(values)
    is_alone = is_known & ~np.append(False, is_known[:-1]) & ~np.append(is_known[1:], False)
    return np.flatnonzero(is_alone | is_known & (np.arange(len(values)) % max(1, len(values) // MARKED) == 0)).tolist()


def draw_strips(panel, pictures):
    """Draws the strips, of several pictures each, one above the other, the first one at the top."""
    count = len(pictures)
    strips = panel.inset_axes((0, 1 + GAP, 1, count * STRIP))
    hatch(strips)
    for number, layers in enumerate(pictures):
        for layer in layers:
            cover(strips, layer, (count - 1 - number) / count, (count - number) / count)
        strips.axhline(number, color="black", linewidth=0.5)
        if count > 1:
            strips.plot(-0.012, count - 0.5 - number, transform=strips.get_yaxis_transform(), clip_on=False,
                        **style_of(number))
    strips.set(xticks=[], yticks=[], ylim=(0, count))


def draw_curves(panel, lines, up, pixels, units, layers):
    """Draws the values of a Field on lines, planes of one dimension with the Axis up. `layers` are the field and marks.
    Returns the codes in the strips."""
    field, *marks = layers
    present, strips, nothing = set(), [], axis_of(lines[0], None, None)
    texts = told_apart([curve_text(line, units) for line in lines], MOST_LETTERS) if len(lines) > 1 else ["_"]
    set_axes(panel, up, field.axis)
    for number, line in enumerate(lines):
        values, known = field.line(line, up)
        panel.plot(values, known, **{**style_of(number), "linestyle": "none" if up.scale == BANDS else "-"},
                   markevery=places_of_markers(known), label=escaped(texts[number]), zorder=3)
        codes = line.read_regions(up, nothing, pixels)
        shown, picture = field.verdicts(line, codes, up, nothing)
        present.update(np.unique(shown))
        strips.append([each.swapaxes(0, 1)[:max(1, round(STRIP * pixels))]
                       for each in (picture, *(mark.picture(line, codes, up, nothing) for mark in marks))])
    if field.name in LEVELS:
        panel.axhline(LEVELS[field.name][0], **LEVEL)
    draw_strips(panel, strips)
    return present


def curve_entries(panel, field):
    """Returns the entries of a legend for the curves in a panel, and for what follows: the strips."""
    curves = [line for line in panel.lines if line.get_label()[:1] != "_"]
    level = [Line2D([], [], label=LEVELS[field.name][1], **LEVEL)] if field.name in LEVELS else []
    strips = Line2D([], [], linestyle="none", label=f"verdict, in the strip{'s' * (len(curves) > 1)} above:")
    return [*curves, *level, strips]
