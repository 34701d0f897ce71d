"""Plots a boundary: the minimum overturning amplitude and all higher amplitudes where the verdict
flips."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from types import SimpleNamespace

import matplotlib
import numpy as np
from matplotlib import pyplot
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from overturn import regions
from overturn.captions import ground_word, heading, is_recorded, panel_titles, plain, subtitle
from overturn.choice import add_choice_arguments, add_title_argument, sheet_of
from overturn.motion_words import worded
from overturn.output_file import save
from overturn.plot.bands import set_axes
from overturn.plot.cover import cover, expect_empty, hatch
from overturn.plot.headings import Heading
from overturn.plot.sheet import MOST_PANELS, Sheet
from overturn.result_file import BOUNDARY, open_result
from overturn.spectrum_planes import BANDS, Axis
from overturn.tables import STRENGTHS
from overturn.tool import parse_with_picture, parser_of
from overturn.units import add_units_argument, axis_of, expect_size, name_axes, name_of_flips, scan_of

EXAMPLE = """\
example:
  overturn boundary jobs/figure_07a.toml         # writes figure_07a_boundary.h5
  tools/plot_boundary figure_07a_boundary.h5     # draws figure_07a_boundary.png

Each flip of the verdict is a point; consecutive ones along the frequency look like a line. The
lowest flip of each frequency, the minimum overturning amplitude, is bold; a frequency at which the
first amplitude of the scan overturns the block has a triangle instead. Overturning amplitudes are
shaded. If the vertical axis ends above the highest flip, before the end of the scan, the line below the
title states this end. Boundaries of several slendernesses, restitutions or records are plotted as a grid
of up to 100 planes. Under a record, there are always strips that are narrower than the steps of the scan: what
is shaded as safe may contain them."""

SAFE, UNSAFE, UNDECIDED, NOT_COMPUTED, NOT_SCANNED = range(5)
VERDICTS = np.full(256, UNDECIDED)  # by the code of a region
VERDICTS[regions.SAFE], VERDICTS[regions.UNSAFE], VERDICTS[regions.NOT_COMPUTED] = SAFE, UNSAFE, NOT_COMPUTED
SHADES = {SAFE: regions.REGIONS[regions.STANDS][2], UNSAFE: regions.REGIONS[regions.TOPPLES][2],
          UNDECIDED: regions.REGIONS[regions.UNDECIDED][2], NOT_COMPUTED: "none", NOT_SCANNED: "white"}
FIRST, OTHERS, DOUBTFUL = "black", "#1f3b57", regions.REGIONS[regions.UNDECIDED][2]
LONG, ABOVE = 0.75, 0.06  # shares of a vertical axis: up to which it is shortened, and above the highest flip
ROWS = 1400  # of the shading: half a pixel at the default size
COLUMN = 4  # height over width of the panel of a single block and frequency
HEIGHT = 6.6  # of the figure of one plane [inches], with one line each for its title and for what is below it
SIZES, TOPS = (13, 10), (0.297, 0.541)  # of these lines [points], and of their baselines from the top [inches]
WORDS = {"pga": "PGA"}  # for what is scanned, where it is not its name


class Lines:
    """The flips of one block, a column per frequency, and the range of amplitudes scanned."""

    def __init__(self, plane, units):
        across, up = plane.quantities(units)
        self.frequency = np.zeros(1) if across is None else plane.values(across, plane.across)
        self.across = axis_of(plane, across, plane.across)
        self.is_column, self.is_along_nothing = len(self.frequency) == 1, across is None
        scan = scan_of(plane, up)
        self.up, self.scan = Axis(scan, is_to_scale=True), (np.min(scan), np.max(scan))
        self.ground, self.word = ground_word(plane.file), worded(plane.file.attrs, WORDS.get(up, up.replace("_", " ")))
        self.is_strength = up in STRENGTHS
        self.flips = plane.read(name_of_flips(up))
        codes = np.stack([plane.read(name) for name in ("region_below", "region_above")])
        self.below, self.above = VERDICTS[codes]
        self.has_undecided = (codes == regions.UNDECIDED).any(axis=(0, 1))
        self.overturns_at_once = self.below[0] == UNSAFE

    def end_at(self, share):
        """Ends the vertical axis at a share of it."""
        first, last = self.up.edges[[0, -1]]
        top = self.up.value_at(first + share * (last - first))
        self.up = Axis(np.append(self.up.values[self.up.values < top], top), self.up.scale, is_to_scale=True)

    def minimum(self):
        """Returns the minimum overturning amplitude; NaN where there is none."""
        found = (self.below[0] == SAFE) & (self.above[0] == UNSAFE)
        return np.where(found, self.flips[0], np.nan)

    def others(self):
        """Returns all other flips; a change next to an undecided amplitude is not a flip."""
        others = np.where((self.below <= UNSAFE) & (self.above <= UNSAFE), self.flips, np.nan)
        others[0, self.below[0] == SAFE] = np.nan
        return others

    def verdicts(self, amplitudes):
        """Returns the verdict of each amplitude, one per row: that above the nearest flip below. Nothing is known beyond
        the first and the last amplitude of the scan."""
        count = (self.flips[:, None, :] < amplitudes[None, :, None]).sum(axis=0)
        verdicts = np.take_along_axis(np.concatenate([self.below[:1], self.above]), count, axis=0)
        is_scanned = (self.scan[0] <= amplitudes) & (amplitudes <= self.scan[1])
        return np.where(is_scanned[:, None], verdicts, NOT_SCANNED)


def end_above_flips(all_lines):
    """Ends the vertical axes a little above the highest flip if they become much shorter and every verdict is known
    from there to the end of the scan. Returns words on that, or none."""
    highest = max(np.nanmax(lines.up.share(lines.flips), initial=0) for lines in all_lines)
    last = [lines.verdicts(np.array([lines.scan[1]])) for lines in all_lines]
    if not 0 < highest < LONG - ABOVE or np.isin(last, UNDECIDED).any():
        return []
    for lines in all_lines:
        lines.end_at(highest + ABOVE)
    return [f"no flips found above the axis, up to {min(lines.scan[1] for lines in all_lines):.4g}"]


def shade(panel, lines):
    """Shades the plane by verdict, column by column."""
    across, up = lines.across, lines.up
    edges = np.linspace(*up.edges[[0, -1]], ROWS + 1)
    middles = (edges[1:] + edges[:-1]) / 2
    amplitudes = np.exp(middles) if up.scale == "log" else middles
    shades = matplotlib.colors.to_rgba_array([SHADES[verdict] for verdict in sorted(SHADES)])
    table = np.round(255 * shades).astype(np.uint8)
    # Columns are as wide as the cells of their frequencies, which may be unequal.
    verdicts = lines.verdicts(amplitudes)[:, across.cells(ROWS)]
    verdicts[:, across.is_between(ROWS)] = NOT_SCANNED if across.scale == BANDS else NOT_COMPUTED
    set_axes(panel, across, up)
    hatch(panel)
    cover(panel, table[verdicts])


def draw_flips(panel, lines):
    size = np.clip(900 / len(lines.frequency), 0.6, 3)
    frequency = np.broadcast_to(lines.frequency, lines.flips.shape)
    panel.plot(frequency.ravel(), lines.others().ravel(), linestyle="none", marker=".",
               markersize=size, color=OTHERS, zorder=2)
    panel.plot(lines.frequency, lines.minimum(), linestyle="none", marker=".",
               markersize=2.2 * size, color=FIRST, zorder=3)
    bottom, top = panel.get_ylim()
    for which, edge, marker, colour in ((lines.overturns_at_once, bottom, "^", FIRST),
                                        (lines.has_undecided, top, "v", DOUBTFUL)):
        if which.any():  # an empty line not clipped would count in the layout
            panel.plot(lines.frequency[which], np.full(which.sum(), edge), linestyle="none",
                       marker=marker, markersize=5, color=colour, clip_on=False, zorder=4)


def legend_entries(all_lines):
    """Returns the handles and labels of what is in any of the planes; overturns and safe are always
    listed."""
    def marks(marker, colour, size):
        return Line2D([], [], linestyle="none", marker=marker, markersize=size, color=colour)

    def shade_of(verdict):
        return Patch(facecolor=SHADES[verdict], edgecolor="black", linewidth=0.5)
    hatched = Patch(**regions.HATCH, linewidth=0.5)
    word = all_lines[0].word
    is_minimum = all_lines[0].ground == "pulse" and all_lines[0].is_strength
    lowest = f"minimum overturning {word}" if is_minimum else "lowest flip found"
    entries = [
        (lambda lines: np.isfinite(lines.minimum()), marks(".", FIRST, 9), lowest),
        (lambda lines: lines.overturns_at_once, marks("^", FIRST, 5),
         f"overturns at the first {word} of the job"),
        (lambda lines: np.isfinite(lines.others()), marks(".", OTHERS, 6), "other flips"),
        (lambda lines: True, shade_of(UNSAFE), "overturns"),
        (lambda lines: True, shade_of(SAFE), "safe"),
        (lambda lines: lines.has_undecided, (shade_of(UNDECIDED), marks("v", DOUBTFUL, 5)),
         "undecided, or more flips"),
        (lambda lines: lines.below[0] == NOT_COMPUTED, hatched, "not computed yet"),
        (lambda lines: lines.across.scale != BANDS and lines.across.is_between(ROWS), hatched, "between computed values")]
    shown = [(handle, label) for is_in, handle, label in entries
             if any(np.any(is_in(lines)) for lines in all_lines)]
    return tuple(zip(*shown))


def draw_panel(panel, lines):
    shade(panel, lines)
    if lines.is_column:  # its width has no meaning
        panel.set_box_aspect(COLUMN)
    if lines.is_along_nothing:
        panel.set_xticks([])
    draw_flips(panel, lines)


def note_on_strips(plane, lines):
    step = float(plane.file["flip_amplitude" if lines.is_strength else "flip_value"].attrs["finest_step"])
    of = f"the {lines.word}" if lines.is_strength else "the range"
    return (f"Scanned in steps of {100 * step:g} % of {of} or less.", "There are narrower strips, "
            "which are not drawn.")


def draw_sheet(planes, all_lines, words, columns, units):
    """Draws several boundaries and returns their axes."""
    sheet = Sheet(words, panel_titles(planes, units), columns, 120, [(lines.across, lines.up) for lines in all_lines])
    for panel, lines in zip(sheet.panels.flat, all_lines):
        draw_panel(panel, lines)
    sheet.name_axes(*name_axes(planes[0], units))
    handles, labels = legend_entries(all_lines)
    labels = ["\n".join(textwrap.wrap(label, 30)) for label in labels]
    sheet.explain(handles=handles, labels=labels, handler_map={tuple: HandlerTuple(None)},
                  title="\n".join(textwrap.wrap(" ".join(note_on_strips(planes[0], all_lines[0])), 32))
                  if is_recorded(planes[0].file) else None)
    return list(sheet.panels.flat[:len(planes)])


def draw_column(plane, lines, words, units):
    """Draws a boundary of a single size or frequency."""
    words = Heading(*words, 5.1, SIZES)
    height = HEIGHT + words.extra
    figure, share = pyplot.figure(figsize=(6, height)), HEIGHT / height
    panel = figure.add_axes((0.13, 0.085 * share, 0.24, 0.755 * share))
    draw_panel(panel, lines)
    panel.set_anchor("NW")
    across, up = name_axes(plane, units)
    panel.set(xlabel=across, ylabel=up)
    handles, labels = legend_entries([lines])
    note = "\n".join(textwrap.wrap(" ".join(note_on_strips(plane, lines)), 40)) if is_recorded(plane.file) else None
    figure.legend(handles, labels, handler_map={tuple: HandlerTuple(None)}, loc="upper left", title=note,
                  bbox_to_anchor=(0.38, 0.855 * share), frameon=False, fontsize=9.5, handletextpad=0.5,
                  alignment="left").get_title().set_fontsize(9.5)
    words.write(figure, 0.78, TOPS)
    return panel


def draw_figure(plane, lines, words, units):
    if lines.is_column:
        return draw_column(plane, lines, words, units)
    words = Heading(*words, 8.3, SIZES)
    height = HEIGHT + words.extra
    (figure, panel), share = pyplot.subplots(figsize=(9.2, height)), HEIGHT / height
    draw_panel(panel, lines)
    across, up = name_axes(plane, units)
    panel.set(xlabel=across, ylabel=up)
    handles, labels = legend_entries([lines])
    one_row = len(labels) <= (4 if lines.overturns_at_once.any() else 5)
    figure.subplots_adjust(left=0.085, right=0.975, top=share * (0.84 if one_row else 0.81), bottom=0.085 * share)
    figure.legend(handles, labels, handler_map={tuple: HandlerTuple(None)}, loc="upper left",
                  bbox_to_anchor=(0.075, 0.9 * share), ncols=5 if one_row else 4, frameon=False,
                  fontsize=9.5, handletextpad=0.5, columnspacing=1.4)
    words.write(figure, 0.78, TOPS)
    if is_recorded(plane.file):
        figure.text(0.5, 0.013 * share, " ".join(note_on_strips(plane, lines)), ha="center", fontsize=10)
        figure.subplots_adjust(bottom=0.115 * share)
    return panel


def draw(path, arguments, ax=None):
    """Draws into the given axes, or without them a figure. Returns the axes; a list of them for several boundaries."""
    expect_empty(ax)
    with open_result(path, BOUNDARY) as file:
        expect_size(file, arguments.units)
        planes, columns, left_out = sheet_of(file, arguments, 1 if ax is not None else MOST_PANELS)
        all_lines = [Lines(plane, arguments.units) for plane in planes]
        if ax is not None:
            draw_panel(ax, all_lines[0])
            across, up = name_axes(planes[0], arguments.units)
            ax.set(xlabel=across, ylabel=up, title=arguments.title or "")
            return ax
        title = heading(planes) if arguments.title is None else arguments.title
        notes = [left_out] * bool(left_out) + end_above_flips(all_lines)
        words = plain(title), ",  ".join([subtitle(planes, arguments.units), *notes])
        if len(planes) > 1:
            return draw_sheet(planes, all_lines, words, columns, arguments.units)
        return draw_figure(planes[0], all_lines[0], words, arguments.units)


def boundary(result, *, motion: int | None = None, slenderness: int | None = None,
             restitution: int | None = None, index: Mapping[str, int] = {}, units: str = "job",
             title: str | None = None, ax=None):
    """Draws a boundary, as tools/plot_boundary does.

    result: the path of a file, or the whole data set that overturn.open() returned for it. motion, slenderness,
    restitution: indices, counted from 0, of one boundary of several. index: the same for any dimensions, such as
    {"height": 0}. units: "job", or "physical" for s and g. title: in place of that of the job. ax: axes of Matplotlib
    without a picture to draw into, without a legend.

    Returns the axes; a list of them for several boundaries. Raises overturn.ToolError."""
    arguments = SimpleNamespace(motion=motion, slenderness=slenderness, restitution=restitution,
                                index=index.items(), units=units, title=title)
    return draw(result, arguments, ax)


def read_arguments(argv):
    parser = parser_of("plot_boundary", __doc__, EXAMPLE, "overturn boundary")
    add_choice_arguments(parser)
    add_units_argument(parser)
    add_title_argument(parser)
    return parse_with_picture(parser, argv)


def main(argv=None):
    arguments = read_arguments(argv)
    drawn = draw(arguments.file, arguments)
    save((drawn[0] if isinstance(drawn, list) else drawn).figure, arguments.output, dpi=120)
