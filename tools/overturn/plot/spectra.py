"""Plots the overturning spectra of a result file as maps of regions."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from types import SimpleNamespace

import numpy as np
from matplotlib.lines import Line2D
from overturn.captions import ground_word, heading, panel_titles, plain, subtitle
from overturn.choice import add_choice_arguments, sheet_of
from overturn.friction import expect_coefficient, takes_friction_demand
from overturn.marked_points import Misjudged, Slipping
from overturn.output_file import save
from overturn.overlay import draw_boundary, open_boundary
from overturn.plot.bands import set_axes
from overturn.plot.cover import cover, hatch
from overturn.plot.sheet import MOST_PANELS, Sheet
from overturn.region_labels import Label, add_label_argument, thinned, write_label
from overturn.regions import coloured, legend_entries
from overturn.result_file import SPECTRUM, open_result
from overturn.tool import Renamed, parse_with_picture, parser_of
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


def draw_panel(panel, codes, across, up):
    set_axes(panel, across, up)
    hatch(panel)
    cover(panel, coloured(codes))


def write_labels(panel, codes, labels, across, up):
    few = codes[np.ix_(thinned(np.arange(codes.shape[0])), thinned(np.arange(codes.shape[1])))]
    for label in labels:
        piece = label.piece(few, across, up)
        if piece.any():
            write_label(panel, piece, label.text, size=13)


def draw_panels(panels, pixels, planes, axes, arguments, marks):
    """Draws the maps, each of pixels x pixels, and returns the codes in the picture."""
    present = set()
    with open_boundary(arguments.boundary, planes[0], arguments.units) as boundary:
        for panel, plane, (across, up) in zip(panels, planes, axes):
            codes = plane.read_regions(up, across, pixels)
            present.update(np.unique(codes))
            draw_panel(panel, codes, across, up)
            for mark in marks:
                cover(panel, mark.picture(plane, codes, up, across))
            if boundary is not None:
                draw_boundary(panel, boundary, plane, arguments.units)
            write_labels(panel, codes, arguments.label, across, up)
    return present


def draw_sheet(planes, columns, left_out, marks, arguments, dpi):
    units, ground = arguments.units, ground_word(planes[0].file)
    axes = [axes_of_plane(plane, units, arguments.boundary is not None) for plane in planes]
    title = heading(planes) if arguments.title is None else arguments.title
    second = ",  ".join([subtitle(planes, units)] + [left_out] * bool(left_out))
    sheet = Sheet((plain(title), second), panel_titles(planes, units), columns, dpi, axes)
    present = draw_panels(sheet.panels.flat, sheet.pixels, planes, axes, arguments, marks)
    sheet.name_axes(*name_axes(planes[0], units))
    entries = legend_entries(present, ground)
    entries += [mark.legend_entry() for mark in marks]
    if arguments.boundary:
        entries.append(Line2D([], [], linestyle="none", marker="o", markersize=3, color="black",
                              label="flip of the verdict"))
    sheet.explain(handles=entries, title=f"At the end of the {ground}\n(+ and − are the side it moves to)")
    return sheet


def draw_into(ax, plane, marks, arguments):
    """Draws one spectrum without a legend; a point of the picture per pixel of the axes."""
    size = ax.get_window_extent()
    pixels = max(1, round(max(size.width, size.height)))
    axes = axes_of_plane(plane, arguments.units, arguments.boundary is not None)
    draw_panels([ax], pixels, [plane], [axes], arguments, marks)
    across, up = name_axes(plane, arguments.units)
    ax.set(xlabel=across, ylabel=up, title=arguments.title or "")


def draw(path, arguments, dpi, ax=None):
    """Draws into the given axes, or without them a sheet, which is returned with the number of its spectra and the
    lines of a report: what is left out, and the counts of points that an option marks."""
    marks = [Misjudged()] * bool(arguments.practice)
    marks += [] if arguments.friction_demand is None else [Slipping(arguments.friction_demand)]
    with open_result(path, SPECTRUM, ("region", *(mark.FIELD for mark in marks))) as file:
        expect_size(file, arguments.units)
        planes, columns, left_out = sheet_of(file, arguments, 1 if ax is not None else MOST_PANELS)
        for mark in marks:
            mark.add(planes)
        if ax is not None:
            return draw_into(ax, planes[0], marks, arguments)
        report = [left_out] * bool(left_out) + [mark.report() for mark in marks]
        return draw_sheet(planes, columns, left_out, marks, arguments, dpi), len(planes), report


@takes_friction_demand
def spectrum(result, *, motion: int | None = None, slenderness: int | None = None,
             restitution: int | None = None, index: Mapping[str, int] = {}, units: str = "job", boundary=None,
             practice: bool = False, friction_demand: float | None = None, labels: tuple[str, ...] = (), title: str | None = None, ax=None):
    """Draws overturning spectra as maps of regions, as tools/plot_spectrum does.

    result: the path of a file, or a data set of overturn.open(), of which parts may be selected and values changed.
    What where() left out is hatched. motion, slenderness,
    restitution: indices, counted from 0, of one spectrum of several. index: the same for any dimensions, such as
    {"height": 0}. units: "job", or "physical" for s and g. boundary: the path of a boundary to draw on it.
    practice: mark what published practice misjudges; needs the field peak. friction_demand: hatch what needs a larger friction
    coefficient; needs the field friction_demand. labels: such as "III=S+@10,12". ax: axes
    of Matplotlib for one spectrum without a legend.

    Returns the axes; a list of them for several spectra. Raises overturn.ToolError."""
    arguments = SimpleNamespace(motion=motion, slenderness=slenderness, restitution=restitution,
                                index=index.items(), units=units, boundary=boundary, practice=practice, friction_demand=friction_demand,
                                label=[Label(words) for words in labels], title=title)
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
    parser.add_argument("--boundary", metavar="BOUNDARY.h5",
                        help="overlay the flips of the verdict; written by overturn boundary")
    parser.add_argument("--practice", action="store_true",
                        help="mark and count safe points whose |theta| reaches alpha, which "
                             "published practice calls overturned; needs the field peak")
    parser.add_argument("--friction", action=Renamed, const="--friction-demand", help=argparse.SUPPRESS)
    parser.add_argument("--friction-demand", type=coefficient, metavar="COEFFICIENT",
                        help="hatch and count the points whose verdict needs a larger friction coefficient; needs the "
                             "field friction_demand")
    parser.add_argument("--title", help="title of the picture (default: the job's title, or the "
                                        "names of its records)")
    return parse_with_picture(parser, argv)


def main(argv=None):
    arguments = read_arguments(argv)
    dpi = 150 if arguments.output.endswith(".png") else 300
    sheet, _, report = draw(arguments.file, arguments, dpi)
    save(sheet.figure, arguments.output)
    for lines in report:
        print(lines)
