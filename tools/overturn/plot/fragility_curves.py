"""Plots fragility curves of a result under records: the fraction of the blocks that overturn against
intensity measures, with lognormal fits and their confidence."""

import argparse
import pathlib
import textwrap

import numpy as np
import overturn
from matplotlib import pyplot
from overturn.interpreter import run_elsewhere
from overturn.result_file import USAGE, PlotError, add_picture_argument, name_picture, save
from overturn.ticks import name_ticks

EXAMPLE = """\
example:
  tools/synthetic_record --suite 50 -o jobs/suite    # writes 50 synthetic records
  overturn run jobs/suite/fragility.toml             # writes fragility.h5
  tools/plot_fragility fragility.h5 --im pga pgv     # draws fragility_fragility.png, a panel each

The curve is fitted to the single points by maximum likelihood. The band is the 95 % confidence interval at each
value, by bootstrap over the motions. beta is the scatter: the smaller, the better the measure predicts
the outcome. Points without a verdict (undecided, or not computed yet) are left out, counted and reported.

Other choices of blocks, and the numbers as arrays: overturn.fragility() in Python."""

CURVE, BAND, POINT = "#0b3c5d", "#b9cfdd", "#b3541e"  # CIE L* 24, 82 and 44: distinct in greyscale
NAMES = {"pga": "PGA", "pgv": "PGV", "arias_intensity": "Arias intensity",
         "significant_duration": "significant duration"}
UNITS = {"m s-1": "m/s"}
TEXT_WIDTH = 58  # characters that fit below a panel


def fragility(curve, ax=None):
    """Draws a fragility curve (overturn.fragility) and returns the axes: the fraction of each bin, the fitted
    curve and its confidence band. Bins with points without a verdict have a bar over the fractions that these
    points could give. Notes are written below the axes."""
    if ax is None:
        ax = pyplot.figure(figsize=(5.5, 4.8), layout="constrained").add_subplot()
    if len(curve.edges):
        draw_bins(ax, curve)
        ax.set_xscale("log")
        ax.set_xlim(curve.edges[0] / 1.05, curve.edges[-1] * 1.05)
        name_ticks(ax.xaxis)
    if np.isfinite(curve.median):
        draw_fit(ax, curve)
    ax.set_ylim(-0.03, 1.03)
    ax.set_ylabel("fraction that overturns" if curve.limit is None
                  else rf"fraction with a peak $|\theta|\,/\,\alpha$ above {curve.limit:g}")
    ax.set_xlabel("\n".join([f"{NAMES.get(curve.im, curve.im)} [{UNITS.get(curve.units, curve.units)}]",
                             *(line for note in curve.notes for line in textwrap.wrap(note, TEXT_WIDTH))]))
    ax.grid(color="0.9")
    ax.set_axisbelow(True)
    if ax.get_legend_handles_labels()[0]:
        ax.legend(loc="best", fontsize=9)
    return ax


def draw_bins(ax, curve):
    middle = np.sqrt(curve.edges[:-1] * curve.edges[1:])
    decided = curve.points > 0
    ax.plot(middle[decided], curve.fraction[decided], "o", color=POINT, zorder=3,
            label="fraction of the points in a bin")
    unknown = curve.without_verdict > 0
    if unknown.any():
        total = (curve.points + curve.without_verdict)[unknown]
        low, high = curve.exceeding[unknown] / total, (curve.exceeding + curve.without_verdict)[unknown] / total
        ax.vlines(middle[unknown], low, high, color=POINT, linewidth=4, alpha=0.45,
                  label="with points without a verdict")


def draw_fit(ax, curve):
    if np.isfinite(curve.band).all():
        ax.fill_between(curve.value, *curve.band, color=BAND, linewidth=0, label="95 % confidence of the curve")
    ax.plot(curve.value, curve.probability, color=CURVE, linewidth=2,
            label=rf"lognormal: median {curve.median:.3g}, $\beta$ = {curve.beta:.2f}")


def read_arguments(argv):
    parser = argparse.ArgumentParser(prog="plot_fragility", description=__doc__, epilog=EXAMPLE,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", metavar="FILE.h5", help="written by overturn run under records")
    parser.add_argument("--im", metavar="MEASURE", nargs="+", default=["pgv"],
                        help="intensity measures: pga, pgv, arias_intensity or significant_duration "
                             "(default: pgv)")
    parser.add_argument("--limit", type=float, metavar="PEAK",
                        help="count the points whose field peak, the largest |theta| / alpha, is above PEAK; "
                             "otherwise those that overturn")
    parser.add_argument("--bins", type=int, metavar="N", default=10, help="number of bins (default: %(default)s)")
    parser.add_argument("--samples", type=int, metavar="N", default=1000,
                        help="samples of the bootstrap (default: %(default)s)")
    parser.add_argument("--seed", type=int, metavar="N", default=1, help="of the bootstrap (default: %(default)s)")
    parser.add_argument("--csv", metavar="OUT.csv",
                        help="also write the numbers of each bin; OUT_MEASURE.csv if there are several measures")
    add_picture_argument(parser, "FILE_fragility.png")
    arguments = parser.parse_args(argv)
    name_picture(parser, arguments, pathlib.Path(arguments.file).stem + "_fragility.png")
    return arguments


def compute(arguments):
    """Returns the curve of each measure."""
    try:
        import h5netcdf  # noqa: F401 (for overturn.open)
        import scipy  # noqa: F401 (for overturn.fragility)
        import xarray  # noqa: F401 (for overturn.open)
    except ImportError as error:
        run_elsewhere(error)
    try:
        dataset = overturn.open(arguments.file)
    except (OSError, ValueError) as error:
        raise PlotError(f"cannot read \"{arguments.file}\": {error}") from error
    with dataset:
        try:
            return [overturn.fragility(dataset, im, arguments.limit, bins=arguments.bins,
                                       samples=arguments.samples, seed=arguments.seed) for im in arguments.im]
        except ValueError as error:
            raise PlotError(f"\"{arguments.file}\": {error}", USAGE) from error


def write_csv(curve, arguments):
    path = pathlib.Path(arguments.csv)
    if len(arguments.im) > 1:
        path = path.with_name(f"{path.stem}_{curve.im}{path.suffix}")
    curve.to_csv(path)
    print(path)


def main(argv=None):
    arguments = read_arguments(argv)
    curves = compute(arguments)
    for curve in curves:
        print(curve.summary())
        if arguments.csv:
            write_csv(curve, arguments)
    figure, panels = pyplot.subplots(1, len(curves), squeeze=False, sharey=True, layout="constrained",
                                     figsize=(5.5 * len(curves), 4.8))
    for panel, curve in zip(panels.flat, curves):
        fragility(curve, panel)
    for panel in panels.flat[1:]:
        panel.set_ylabel("")
    save(figure, arguments.output, dpi=150)
