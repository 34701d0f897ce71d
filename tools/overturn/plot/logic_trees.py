"""Draws the weights of the branches of a logic tree before and after the survival of blocks."""

import textwrap

import numpy as np
import overturn
from matplotlib import pyplot
from matplotlib.colors import LinearSegmentedColormap
from overturn.captions import escaped, shortened
from overturn.plot.fragility_curves import BAND, COLOURS, NAMES, POINT, UNITS
from overturn.plot.headings import wrapped
from overturn.ticks import name_ticks

MOST_BARS = 30  # branches whose weights are drawn
VISIBLE = 1e-3  # of the longest bar
TEXT_WIDTH = 105  # characters that fit below the panels
SHADES = LinearSegmentedColormap.from_list("weights", ("#e3e6ea", COLOURS[0]))
WIDTH, CURVES, BAR = 6.4, 3.4, 0.26  # of the picture, of the lower panel and of a branch [inches]
ROOM = 1.9  # for titles, axes and notes [inches]


def branches(updated, *, title=None):
    """Draws the weights of overturn.risk.updated_weights() before and after, and the hazard curves of the branches,
    with their mean before and after, and returns the two axes. Of more than 30 branches, the 30 largest weights are
    drawn."""
    if not isinstance(updated, overturn.risk.UpdatedWeights):
        raise ValueError(f"{updated!r:.60} are no weights. Give what overturn.risk.updated_weights() returns.")
    count = min(len(updated.prior), MOST_BARS)
    bars = BAR * (count + 1)
    notes = [line for note in updated.notes for line in textwrap.wrap(note, TEXT_WIDTH)]
    figure, panels = pyplot.subplots(2, 1, figsize=(WIDTH, bars + CURVES + ROOM + 0.15 * len(notes)),
                                     layout="constrained", gridspec_kw={"height_ratios": (bars + 0.3, CURVES)})
    draw_weights(panels[0], updated, count)
    draw_curves(panels[1], updated)
    for panel in panels:
        panel.grid(color="0.9")
        panel.set_axisbelow(True)
    if notes:
        figure.supxlabel(escaped("\n".join(notes)), fontsize=8, x=0.02, ha="left")
    texts = [title] * bool(title) + [f"weights after the survival of {updated.age.text}"]
    figure.suptitle("\n".join(line for text in texts for line in wrapped(escaped(text), 10, WIDTH - 0.3)), fontsize=10,
                    x=0.02, ha="left")
    return panels


def draw_weights(ax, updated, count):
    largest = np.sort(np.argsort(-np.maximum(updated.prior, updated.posterior[1]), kind="stable")[:count])
    place = np.arange(count)
    low, high = updated.posterior[:, largest]
    ax.barh(place, updated.prior[largest], 0.8, color="none", edgecolor="0.35", linewidth=1.2, label="before", zorder=3)
    ax.barh(place, low, 0.5, color=COLOURS[0], label="after")
    interval = updated.interval[:, largest]
    most = np.nanmax([high, updated.prior[largest], *interval])
    if (high - low).max() > VISIBLE * most:
        ax.barh(place, high - low, 0.5, left=low, color="#e3b58e", label="after, up to: bounds")
    if np.isfinite(interval).any():
        ax.hlines(place, *interval, color=POINT, linewidth=1.6, label="95 % confidence", zorder=4)
    names = [escaped(shortened(updated.names[i], 24)) for i in largest]
    ax.set_yticks(place, names, fontsize=8)
    ax.set_ylim(count - 0.4, -0.6)
    ax.set_xlim(0, 1.4 * most)  # with room for the legend
    total = len(updated.prior)
    ax.set_title("weights of the branches" + f", {count} of {total}" * (count < total), fontsize=9)
    ax.legend(fontsize=8, loc="right")


def draw_curves(ax, updated):
    middle = updated.posterior.mean(axis=0)
    largest = middle.max()
    for i in np.argsort(middle):
        hazard = updated.hazards[i]
        ax.plot(hazard.level, hazard.rate, color=SHADES(middle[i] / largest), linewidth=1)
    before, (low, high) = updated.before, updated.after
    ax.plot(before.level, before.rate, "--", color="black", linewidth=1.8, label="mean before")
    ax.fill_between(before.level, low.rate, high.rate, color=POINT, linewidth=2, label="mean after", zorder=2.5)
    if updated.after_interval:
        ends = [hazard.rate for hazard in updated.after_interval]
        ax.fill_between(before.level, *ends, color=BAND, linewidth=0, label="95 % confidence of the mean after")
    ax.set(xscale="log", yscale="log", ylabel="rate of exceedance [1/year]", xlim=before.level[[0, -1]])
    ax.set_ylim(0.7 * low.rate[-1], 1.4 * max(hazard.at(np.maximum(before.level[0], hazard.level[0]))
                                              for hazard in updated.hazards))
    name_ticks(ax.xaxis)
    ax.set_xlabel(escaped(f"{NAMES.get(before.im, before.im)} [{UNITS.get(before.units, before.units)}]"))
    ax.set_title("hazard curves of the branches", fontsize=9)
    shades = pyplot.cm.ScalarMappable(pyplot.Normalize(0, largest), SHADES)
    ax.figure.colorbar(shades, ax=ax, label="weight after", pad=0.01)
    ax.legend(fontsize=8)
