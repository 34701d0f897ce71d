"""Draws the medians of fragility curves around a block, by azimuth."""

import numpy as np
from matplotlib import pyplot
from overturn.block_groups import counted
from overturn.plot.fragility_curves import COLOURS, TITLE_WIDTH, measure_text
from overturn.plot.headings import wrapped

COMPASS = "direction"
WEAKEST, UNKNOWN = "#b2331d", "0.5"
LARGEST = 1.6  # times the largest median, of ends of intervals that are drawn


def fragility_azimuths(degrees, curves, column=COMPASS):
    """Draws the medians of fragility curves at these azimuths [degree], with 95 % confidence, marks the weakest
    plane to both sides, because a block falls to both, and returns the polar axes. Azimuths whose curve has no fit are
    marked at the rim: their median is unknown.

    column: of the azimuths; "direction" is on a compass, others are counted from x, counter-clockwise."""
    figure = pyplot.figure(figsize=(5.6, 6.4), layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0.08, 1, 0.89))  # below it, the legend
    ax = figure.add_subplot(projection="polar")
    azimuths, first = np.radians(degrees), curves[0]
    medians = np.array([curve.median for curve in curves])
    low, high = np.array([curve.median_interval for curve in curves]).T
    known = np.isfinite(medians)
    if column == COMPASS:
        ax.set_theta_zero_location("N")
        ax.set_theta_direction(-1)
    largest = np.max(medians, initial=0, where=known) or 1.0
    rim = 1.1 * max(largest, np.max(np.minimum(high, LARGEST * largest), initial=0, where=np.isfinite(high)))
    words = [f"median {measure_text(first.im, first.units)}"]
    if known.any():
        certain = np.isfinite(low)
        if certain.any():
            ax.vlines(azimuths[certain], low[certain], np.minimum(high, rim)[certain], color=COLOURS[0], linewidth=1,
                      label="95 % confidence")
        ax.plot(azimuths[known], medians[known], "o", color=COLOURS[0], markersize=4, label="median")
        weakest, of_known = np.nanargmin(medians), "" if known.all() else " of the known ones"
        plane = round(degrees[weakest] % 180, 1)
        ax.plot(azimuths[weakest] + np.array([0, 0, np.pi]), medians[weakest] * np.array([1, 0, 1]), color=WEAKEST, linewidth=2,
                label=f"weakest plane{of_known}")
        words.append(f"least{of_known} {medians[weakest]:.3g} in the plane {plane:g}°-{plane + 180:g}°"
                     + " from x" * (column != COMPASS))
    if not known.all():
        ax.plot(azimuths[~known], np.full((~known).sum(), rim), "x", color=UNKNOWN, clip_on=False,
                label="no fit: the median is unknown")
    ax.set_ylim(0, rim)
    what = f"{first.exceedance.noun()}:  {counted(max(curve.motions for curve in curves), 'motions')}"
    ax.set_title("\n".join([what, *wrapped(",  ".join(words), 9, TITLE_WIDTH)]), fontsize=9)
    figure.legend(*ax.get_legend_handles_labels(), fontsize=8, loc="lower center", ncols=2)
    return ax
