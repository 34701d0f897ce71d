"""Pictures of fragility curves."""

import textwrap

import numpy as np
from matplotlib import pyplot
from overturn.ticks import name_ticks

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
        ax.legend(loc="upper left", fontsize=9)
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
