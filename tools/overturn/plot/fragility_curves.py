"""Plots fragility curves of a result under records: the fraction of the blocks that overturn against
intensity measures, with lognormal fits and their confidence."""

import itertools
import pathlib
import textwrap

import numpy as np
import overturn
from matplotlib import pyplot
from matplotlib.lines import Line2D
from overturn.block_groups import counted
from overturn.captions import escaped, plain, shortened
from overturn.output_file import save
from overturn.plot.headings import LINE, POINTS, wrapped
from overturn.result_curves import (add_curve_arguments, add_group_argument, azimuths_of, compute_curve, compute_plane,
                                    curves_of, open_dataset, write_csv)
from overturn.ticks import name_ticks
from overturn.tool import parse_with_picture, parser_of

EXAMPLE = """\
example:
  tools/synthetic_record --suite 50 -o jobs/suite    # writes 50 synthetic records
  overturn run jobs/suite/fragility.toml             # writes fragility.h5
  tools/plot_fragility fragility.h5 --im pga pgv     # draws fragility_fragility.png, a panel each
  tools/plot_fragility fragility.h5 --by size        # four curves, each of a quarter of the sizes

The curve is fitted to the single points by maximum likelihood. The band is the 95 % confidence
interval at each value, by bootstrap over the motions. beta is the scatter: the smaller, the better
the measure predicts the outcome. Points without a verdict (undecided, or not computed yet) are left
out, counted and reported.
All blocks are pooled in one curve, unless --by groups them or --together joins them. Rows of a table
with the same value in its column azimuth_of are one block, which falls if it falls in one of them.

--plane draws the fractions in bins of two measures, such as PGA and PGV/PGA, and a logistic fit:
  tools/plot_fragility fragility.h5 --plane          # draws fragility_fragility.png
Measures may be ratios; both of one definition, such as --im pga_rotd50 pgv_rotd50/pga_rotd50.
--polar draws the median of each azimuth of one rock, which is a column of its table or an axis, and
marks the weakest plane, to both sides.

Other choices of blocks, and the numbers as arrays: overturn.fragility() in Python."""

BAND, POINT = "#b9cfdd", "#b3541e"
# Of the curves: CIE L* from 24 to 60, with markers of their own.
COLOURS, MARKERS = ("#0b3c5d", "#c9741a", "#3f7a43", "#8f2d56", "#7d7d85", "#4b2e83"), "osD^vP"
NAMES = {"pga": "PGA", "pgv": "PGV", "arias_intensity": "Arias intensity",
         "significant_duration": "significant duration", "pfa": "PFA", "pfv": "PFV",
         "floor_arias_intensity": "Arias intensity of the floor",
         "floor_significant_duration": "significant duration of the floor",
         **{f"{peak}_{of}".lower(): f"{peak}, {of}" for peak in ("PGA", "PGV", "PFA", "PFV")
            for of in ("RotD50", "RotD100")}}
UNITS = {"m s-1": "m/s"}
FIELDS = {"peak": r"a peak $|\theta|\,/\,\alpha$", "slide_peak": "a largest slide, over R,"}
TEXT_WIDTH = 58  # characters that fit below a panel
TITLE_WIDTH = 4.6  # above it [inches]
WITHOUT_VERDICT = "with points without a verdict"


def fragility(curve, ax=None):
    """Draws a fragility curve (overturn.fragility) and returns the axes: the fraction of each bin, the fitted
    curve and its confidence band. Bins with points without a verdict have a bar over the fractions that these
    points could give. Notes are written below the axes."""
    if not isinstance(curve, overturn.Fragility):
        raise ValueError(f"{curve!r:.60} is no fragility curve. Give what overturn.fragility() returns.")
    if ax is None:
        ax = pyplot.figure(figsize=(5.5, 4.8), layout="constrained").add_subplot()
        return make_room([draw_panel(ax, [curve])])[0]
    return draw_panel(ax, [curve])


def make_room(panels):
    """Enlarges the figure of panels side by side, which has room for a plot and a line below it in each, by the notes
    below the panels and the legends beside them."""
    figure = panels[0].figure
    width, height = figure.get_size_inches()
    legends = [box.width / figure.dpi + 0.1 for box in map(_legend_beside, panels) if box]
    lowest = max([box.height / figure.dpi + 1 for box in map(_legend_beside, panels) if box], default=0)
    lines = max(panel.get_xlabel().count("\n") for panel in panels)
    figure.set_size_inches(width + sum(legends), max(height, lowest) + lines * LINE * pyplot.rcParams["font.size"] / POINTS)
    return panels


def _legend_beside(panel):
    """Returns the extent of the legend of groups, or None."""
    legend = panel.get_legend()
    return legend.get_window_extent() if legend and legend.get_bbox_to_anchor().width == 0 else None


def draw_panel(ax, curves, blocks=""):
    """Draws the curves of one intensity measure, one for each group of blocks. blocks: all of these, in words."""
    first, is_alone = curves[0], len(curves) == 1
    styles = itertools.product(("-", "--"), zip(COLOURS, MARKERS))
    entries = []
    for curve, (line, (colour, marker)) in zip(curves, styles):
        fillstyle = "full" if line == "-" else "none"
        if len(curve.edges):
            draw_bins(ax, curve, POINT if is_alone else colour, marker, fillstyle, is_alone)
        if np.isfinite(curve.median):
            draw_fit(ax, curve, colour, line, len(curves))
        entries.append(Line2D([], [], color=colour, linestyle=line if np.isfinite(curve.median) else "none",
                              marker=marker, fillstyle=fillstyle, label=group_text(curve)))
    ends = [end for curve in curves if len(curve.edges) for end in (curve.edges[0] / 1.05, curve.edges[-1] * 1.05)]
    if ends:
        ax.set_xscale("log")
        ax.set_xlim(min(ends), max(ends))
        name_ticks(ax.xaxis)
    ax.set_ylim(-0.03, 1.03)
    ax.set_ylabel(share_text(first))
    notes = [escaped(f"{curve.group}: {note}" if curve.group else note) for curve in curves for note in curve.notes]
    ax.set_xlabel("\n".join([measure_text(first.im, first.units),
                             *(line for note in notes for line in textwrap.wrap(note, TEXT_WIDTH))]))
    ax.set_title("\n".join(wrapped(counts_text(curves, blocks), 9, TITLE_WIDTH)), fontsize=9)
    ax.grid(color="0.9")
    ax.set_axisbelow(True)
    if not is_alone:
        bars = [handle for handle, label in zip(*ax.get_legend_handles_labels()) if label == WITHOUT_VERDICT][:1]
        ax.legend(handles=entries + bars, fontsize=9, handlelength=3, loc="upper left", bbox_to_anchor=(1.01, 1.0))
    elif ax.get_legend_handles_labels()[0]:
        ax.legend(fontsize=9, loc="best")
    return ax


def measure_text(im, units):
    """Returns a measure and its unit, or a ratio such as PGV/PGA [m/s/g]."""
    names, units = ("/".join(words.get(each, each) for each in text.split("/"))
                    for words, text in ((NAMES, im), (UNITS, units)))
    for of in (", RotD50", ", RotD100"):  # of both measures of a ratio, once
        names = names.replace(of, "", names.count(of) - 1) if names.endswith(of) else names
    return escaped(f"{names} [{units}]")


def share_text(curve):
    if curve.above is None:
        return "fraction that overturns"
    return f"fraction with {FIELDS.get(curve.of, escaped(curve.of))} above {curve.above:g}"


def group_text(curve):
    """Returns the blocks of a group, and the numbers of their curve."""
    is_an_object = curve.blocks == 1 and curve.kind.startswith("objects")
    count = "" if is_an_object else f" ({counted(curve.blocks, curve.kind)})"
    blocks = escaped(shortened(curve.group, 40) + count)
    return f"{blocks}\n{fit_text(curve)}" if np.isfinite(curve.median) else blocks


def fit_text(curve):
    is_within = curve.edges[0] <= curve.median <= curve.edges[-1]
    return rf"median {curve.median:.3g}{'' if is_within else ' (extrapolated)'}, $\beta$ = {curve.beta:.2f}"


def counts_text(curves, blocks=""):
    first, motions = curves[0], counted(max(curve.motions for curve in curves), "motions")
    if len(curves) > 1:
        return f"{motions},  {blocks},  {len(curves)} groups"
    how = (" together" if first.together else " pooled") * (first.blocks > 1)
    return f"{motions},  {counted(first.blocks, first.kind)}{how}" + f",  {escaped(first.group)}" * bool(first.group)


def draw_bins(ax, curve, colour, marker, fillstyle, has_spread=True):
    decided, known = curve.points > 0, np.isfinite(curve.fraction_interval).all(axis=0)
    has_spread = has_spread and bool(known.any())
    ax.plot(curve.mean[decided], curve.fraction[decided], marker, color=colour, fillstyle=fillstyle, zorder=3,
            label="fraction of the points in a bin" + ",\nwith 95 % confidence" * has_spread)
    if has_spread:
        ax.vlines(curve.mean[known], *curve.fraction_interval[:, known], color=colour, linewidth=1, zorder=3)
    unknown = curve.without_verdict > 0
    if unknown.any():
        total = (curve.points + curve.without_verdict)[unknown]
        low, high = curve.exceeding[unknown] / total, (curve.exceeding + curve.without_verdict)[unknown] / total
        ax.vlines(curve.mean[unknown], low, high, color=colour, linewidth=4, alpha=0.45,
                  label=WITHOUT_VERDICT)


def draw_fit(ax, curve, colour, line, count):
    is_alone = count == 1
    if np.isfinite(curve.band).all() and count <= len(COLOURS):  # more bands would hide each other
        how = {"color": BAND, "label": "95 % confidence of the curve"} if is_alone else {"color": colour, "alpha": 0.12}
        ax.fill_between(curve.value, *curve.band, linewidth=0, **how)
    ax.plot(curve.value, curve.probability, line, color=colour, linewidth=2, label=f"lognormal: {fit_text(curve)}")


def read_arguments(argv):
    parser = parser_of("plot_fragility", __doc__, EXAMPLE, "overturn run under records")
    parser.add_argument("--im", metavar="MEASURE", nargs="+",
                        help="intensity measures: pga, pgv, arias_intensity or significant_duration; under two "
                             "horizontal components also pga_rotd50, pga_rotd100, pgv_rotd50 and pgv_rotd100; under motions "
                             "of a floor, those of the floor, and ground_pga if it is known (default: pgv)")
    parser.add_argument("--plane", action="store_true",
                        help="draw the plane of two measures, --im X Y (default: pga pgv/pga)")
    parser.add_argument("--polar", metavar="COLUMN", nargs="?", const="direction",
                        help="draw the medians of the azimuths in a column of the table of blocks, or along an axis "
                             "(default: direction, on a compass)")
    add_group_argument(parser)
    add_curve_arguments(parser, bins=10)
    parser.add_argument("--csv", metavar="OUT.csv",
                        help="also write the numbers of each bin; OUT_MEASURE.csv if there are several measures, "
                             "with --by OUT_1.csv, OUT_2.csv, ... of the groups")
    arguments = parse_with_picture(parser, argv, "FILE_fragility.png")
    arguments.im = arguments.im or (["pga", "pgv/pga"] if arguments.plane else ["pgv"])
    if arguments.polar and (arguments.plane or arguments.by):
        parser.error("--polar has a curve for each azimuth of one object; draw it without --plane and --by")
    if arguments.plane and len(arguments.im) != 2:
        parser.error("--plane needs two measures, such as --im pga pgv/pga")
    if arguments.polar and len(arguments.im) != 1:
        parser.error("--polar needs one measure, such as --im pga")
    return arguments


def compute(arguments):
    """Returns the title, the blocks in words, the azimuths with --polar, and the curves of each measure, one for each group of blocks or
    each azimuth; with --plane, the planes."""
    from overturn.fragility_curve import expect_records  # need SciPy: if it is missing, fail before anything is read
    from overturn.fragility_points import blocks_of
    with open_dataset(arguments.file) as dataset:
        expect_records(dataset)
        title, objects = title_of(dataset, arguments), blocks_of(dataset)
        blocks = counted(objects["blocks"], objects["kind"])
        if arguments.plane:
            return title, blocks, None, [curves_of(dataset, arguments, lambda blocks: compute_plane(blocks, arguments))]
        if arguments.polar and objects["kind"].startswith("objects") and objects["blocks"] > 1:
            raise ValueError(f"--polar draws the azimuths of one object, but this result has {blocks}. Run a table of "
                             "each of them.")
        degrees, parts = azimuths_of(dataset, arguments.polar) if arguments.polar else (None, None)
        return title, blocks, degrees, [
            curves_of(dataset, arguments, lambda blocks: compute_curve(blocks, im, arguments), parts)
            for im in arguments.im]


def title_of(dataset, arguments):
    name = dataset.attrs.get("title") or f"Fragility: {pathlib.Path(arguments.file).name}"
    by = "object" if arguments.by == "azimuth_of" else arguments.by
    return name + f", by {by}".replace("_", " ") * bool(by)


def draw(by_measure, blocks):
    """Returns a figure with a panel for each measure. blocks: of all curves, in words."""
    figure, panels = pyplot.subplots(1, len(by_measure), squeeze=False, sharey=True, layout="constrained",
                                     figsize=(5.5 * len(by_measure), 5.2))
    make_room([draw_panel(panel, curves, blocks) for panel, curves in zip(panels.flat, by_measure)])
    for panel in panels.flat[1:]:
        panel.set_ylabel("")
    return figure


def main(argv=None):
    from overturn.plot import azimuths, fragility_planes  # they import this module
    arguments = read_arguments(argv)
    title, blocks, degrees, by_measure = compute(arguments)
    for curves in by_measure:
        for number, curve in enumerate(curves, 1):
            print(curve.summary())
            if arguments.csv:
                write_csv(curve, number, arguments.csv, len(by_measure) > 1)
    if arguments.plane:
        figure = fragility_planes.draw(by_measure[0])
    elif arguments.polar:
        figure = azimuths.fragility_azimuths(degrees, by_measure[0], arguments.polar).figure
    else:
        figure = draw(by_measure, blocks)
    lines = wrapped(plain(title), 12, 0.96 * figure.get_figwidth())
    figure.suptitle("\n".join(lines), fontsize=12, x=0.02, ha="left")
    save(figure, arguments.output, dpi=150)
