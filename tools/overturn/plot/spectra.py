"""Plots the overturning spectra of a result file as maps of regions, of verdicts or of a field."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from types import SimpleNamespace

import numpy as np
from matplotlib.lines import Line2D
from overturn.arguments import OLD_FRICTION, refuses_old
from overturn.captions import ground_word, heading, panel_titles, plain, subtitle
from overturn.choice import add_choice_arguments, add_title_argument, sheet_of
from overturn.colourings import VALUE, Field, Regions, Verdicts
from overturn.friction import expect_coefficient
from overturn.marked_points import Misjudged, Slipping
from overturn.output_file import save
from overturn.overlay import draw_boundary, open_boundary
from overturn.plot.bands import set_axes
from overturn.plot.cover import cover, expect_empty, hatch
from overturn.plot.curves import curve_entries, draw_curves, height_of_strips
from overturn.plot.sheet import MOST_PANELS, Sheet
from overturn.region_labels import Label, add_label_argument, thinned, write_label
from overturn.result_file import SPECTRUM, open_result
from overturn.tool import USAGE, Renamed, ToolError, parse_with_picture, parser_of
from overturn.units import add_units_argument, axes_of_plane, expect_size, name_axes

EXAMPLE = """\
example:
  overturn run jobs/figure_07a.toml              # writes figure_07a.h5
  tools/plot_spectrum figure_07a.h5              # draws figure_07a.png

A file of several spectra (such as records, blocks of a table, slendernesses) is plotted as a grid of maps; of more
than 100, so many in even steps:
  tools/plot_spectrum four_axes.h5 -o nine.pdf
  tools/plot_spectrum four_axes.h5 --slenderness 0 --restitution 2   # the first and the third
  tools/plot_spectrum suite.h5 --motion 0        # the first record of a suite

The axes are the last two dimensions of several values; an index of one of these takes it out:
  tools/plot_spectrum heights.h5 --index pulse_period=0   # height and PGA, of height, PGA and period

Three colours show what stands, what topples and what is unknown. The largest tilt, the field peak, is a rocking
spectrum: a map or, of at most 6 values of an axis, such as slendernesses, a curve for each:
  tools/plot_spectrum figure_07a.h5 --verdict
  tools/plot_spectrum figure_07a.h5 --field peak

A label is placed where its region is widest:
  tools/plot_spectrum figure_07a.h5 --label III=S+@10,12 --label V=S+@7,12

Published practice calls a block overturned when |theta| >= alpha. To mark and count the safe blocks
that it misjudges, store the field peak:
  tools/plot_spectrum suite.h5 --practice

A verdict holds if the friction coefficient is large enough. To hatch the points that need more than
0.5, store the field friction_demand:
  tools/plot_spectrum friction.h5 --friction-demand 0.5

Axes are drawn in the units of the job. If it gives the size of the block, all can be drawn in s and g:
  tools/plot_spectrum statue.h5 --units physical

+ and - denote the side to which a block falls, or swings if it is safe. For an unfinished file the
computed part is plotted."""


def axes_in_picture(plane, arguments, colouring):
    """Returns the horizontal and the vertical Axis; that of a line is horizontal."""
    if lines := colouring.lines(plane):
        return axes_of_plane(lines[0], arguments.units)[1], colouring.axis
    return axes_of_plane(plane, arguments.units, arguments.boundary is not None)


def write_labels(panel, codes, labels, across, up):
    few = codes[np.ix_(thinned(np.arange(codes.shape[0])), thinned(np.arange(codes.shape[1])))]
    for label in labels:
        piece = label.piece(few, across, up)
        if piece.any():
            write_label(panel, piece, label.text, size=13)


def draw_map(panel, plane, across, up, pixels, layers):
    """Draws a map of pixels x pixels, and returns its region codes and the codes in the picture."""
    colouring, *marks = layers
    codes = plane.read_regions(up, across, pixels)
    shown, picture = colouring.picture(plane, codes, up, across)
    set_axes(panel, across, up)
    hatch(panel)
    for each in (picture, *(mark.picture(plane, codes, up, across) for mark in marks)):
        cover(panel, each)
    return codes, np.unique(shown)


def draw_panels(panels, pixels, planes, axes, arguments, layers):
    """Draws the panels and returns the codes in the picture. `layers` are what the colours show, and marks."""
    present = set()
    lines = [layers[0].lines(plane) for plane in planes]
    if arguments.label and any(lines):
        raise ToolError("a label is written in a map, but this field is drawn as curves. Omit --label.", USAGE)
    with open_boundary(arguments.boundary, *lines[0][:1] or planes[:1], arguments.units) as boundary:
        for panel, plane, curves, (across, up) in zip(panels, planes, lines, axes):
            if curves:
                present.update(draw_curves(panel, curves, across, pixels, arguments.units, layers))
                continue
            codes, shown = draw_map(panel, plane, across, up, pixels, layers)
            present.update(shown)
            if boundary is not None:
                draw_boundary(panel, boundary, plane, arguments.units)
            write_labels(panel, codes, arguments.label, across, up)
    return present


def labels_of_axes(plane, units, colouring):
    lines = colouring.lines(plane)
    return (name_axes(lines[0], units)[1], colouring.label) if lines else name_axes(plane, units)


def draw_sheet(planes, columns, left_out, layers, arguments, dpi):
    units, (colouring, *marks) = arguments.units, layers
    axes = [axes_in_picture(plane, arguments, colouring) for plane in planes]
    lines = colouring.lines(planes[0])
    title = heading(planes) if arguments.title is None else arguments.title
    second = ",  ".join([subtitle(planes, units)] + [left_out] * bool(left_out))
    sheet = Sheet((plain(title), second), panel_titles(planes, units), columns, dpi, axes,
                  above=height_of_strips(len(lines)) if lines else 0)
    present = draw_panels(sheet.panels.flat, sheet.pixels, planes, axes, arguments, layers)
    sheet.name_axes(*labels_of_axes(planes[0], units, colouring))
    if isinstance(colouring, Field) and VALUE in present and not lines:
        sheet.add_colour_bar(colouring)
    entries, explanation = colouring.legend(present, ground_word(planes[0].file))
    entries = (curve_entries(sheet.panels.flat[0], colouring) if lines else []) + entries
    entries += [mark.legend_entry() for mark in marks]
    if arguments.boundary:
        entries.append(Line2D([], [], linestyle="none", marker="o", markersize=3, color="black",
                              label="flip of the verdict"))
    sheet.explain(handles=entries, title=explanation)
    return sheet


def draw_into(ax, plane, layers, arguments):
    """Draws one spectrum without a legend; a point of the picture per pixel of the axes."""
    size = ax.get_window_extent()
    pixels = max(1, round(max(size.width, size.height)))
    axes = axes_in_picture(plane, arguments, layers[0])
    draw_panels([ax], pixels, [plane], [axes], arguments, layers)
    across, up = labels_of_axes(plane, arguments.units, layers[0])
    ax.set(xlabel=across, ylabel=up, title=arguments.title or "")


def colouring_of(arguments):
    if arguments.verdict and arguments.field is not None:
        raise ToolError("give a field or the verdict, not both.", USAGE)
    return Verdicts() if arguments.verdict else Regions() if arguments.field is None else Field(arguments.field)


def draw(path, arguments, dpi, ax=None):
    """Draws into the given axes, or without them a sheet, which is returned with the number of its spectra and the
    lines of a report: what is left out, and the counts of points that an option marks."""
    expect_empty(ax)
    marks = [Misjudged()] * bool(arguments.practice)
    marks += [] if arguments.friction_demand is None else [Slipping(arguments.friction_demand)]
    layers = [colouring_of(arguments), *marks]
    fields = dict.fromkeys(["region", *layers[0].FIELDS, *(mark.FIELD for mark in marks)])
    with open_result(path, SPECTRUM, tuple(fields)) as file:
        expect_size(file, arguments.units)
        planes, columns, left_out = sheet_of(file, arguments, 1 if ax is not None else MOST_PANELS)
        for layer in layers:
            layer.add(planes)
        if ax is not None:
            return draw_into(ax, planes[0], layers, arguments)
        report = [left_out] * bool(left_out) + [mark.report() for mark in marks]
        return draw_sheet(planes, columns, left_out, layers, arguments, dpi), len(planes), report


@refuses_old(OLD_FRICTION)
def spectrum(result, *, motion: int | None = None, slenderness: int | None = None,
             restitution: int | None = None, index: Mapping[str, int] = {}, units: str = "job", boundary=None,
             practice: bool = False, friction_demand: float | None = None, labels: tuple[str, ...] = (), title: str | None = None,
             verdict: bool = False, field: str | None = None, ax=None):
    """Draws overturning spectra as maps of regions, as tools/plot_spectrum does.

    result: the path of a file, or a data set of overturn.open(), of which parts may be selected and values changed.
    What where() left out is hatched. motion, slenderness,
    restitution: indices, counted from 0, of one spectrum of several. index: the same for any dimensions, such as
    {"height": 0}. units: "job", or "physical" for s and g. boundary: the path of a boundary to draw on it.
    practice: mark what published practice misjudges; needs the field peak. friction_demand: hatch what needs a larger friction
    coefficient; needs the field friction_demand. labels: such as "III=S+@10,12". verdict: draw what stands, what
    topples and what is unknown. field: the name of a field to draw, such as "peak". ax: axes of Matplotlib for one spectrum
    without a legend.

    Returns the axes; a list of them for several spectra. Raises overturn.ToolError."""
    arguments = SimpleNamespace(motion=motion, slenderness=slenderness, restitution=restitution,
                                index=index.items(), units=units, boundary=boundary, practice=practice, friction_demand=friction_demand,
                                label=[Label(words) for words in labels], title=title, verdict=verdict, field=field)
    drawn = draw(result, arguments, 150, ax)
    if ax is not None:
        return ax
    sheet, count, _ = drawn
    return sheet.panels.flat[0] if count == 1 else list(sheet.panels.flat[:count])


def coefficient(word):
    try:
        value = float(word)
        expect_coefficient(value)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from error
    return value


def read_arguments(argv):
    parser = parser_of("plot_spectrum", __doc__, EXAMPLE, "overturn run")
    add_choice_arguments(parser)
    add_label_argument(parser)
    add_units_argument(parser)
    shown = parser.add_mutually_exclusive_group()
    shown.add_argument("--verdict", action="store_true",
                       help="draw what stands, what topples and what is unknown: undecided, or not computed")
    shown.add_argument("--field", metavar="NAME",
                       help="draw the values of a field of the file, such as peak; as curves if only one axis varies, "
                            "or if one of two has at most 6 values and the other more than 8")
    parser.add_argument("--boundary", metavar="BOUNDARY.h5",
                        help="overlay the flips of the verdict; written by overturn boundary")
    parser.add_argument("--practice", action="store_true",
                        help="mark and count safe points whose |theta| reaches alpha, which "
                             "published practice calls overturned; needs the field peak")
    parser.add_argument("--friction", action=Renamed, const="--friction-demand", help=argparse.SUPPRESS)
    parser.add_argument("--friction-demand", type=coefficient, metavar="COEFFICIENT",
                        help="hatch and count the points whose verdict needs a larger friction coefficient; needs the "
                             "field friction_demand")
    add_title_argument(parser)
    return parse_with_picture(parser, argv)


def main(argv=None):
    arguments = read_arguments(argv)
    dpi = 150 if arguments.output.endswith(".png") else 300
    sheet, _, report = draw(arguments.file, arguments, dpi)
    save(sheet.figure, arguments.output)
    for lines in report:
        print(lines)
