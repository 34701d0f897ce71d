"""Draws fragilities in the plane of two intensity measures."""

import textwrap

import numpy as np
import overturn
from matplotlib import patheffects, pyplot
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.patches import Patch, Rectangle
from overturn.captions import escaped
from overturn.plot.fragility_curves import COLOURS, TEXT_WIDTH, TITLE_WIDTH, counts_text, measure_text, share_text
from overturn.plot.headings import LINE, POINTS, place_legend_above, wrapped
from overturn.ticks import name_ticks

SHARES = {0.16: "--", 0.5: "-", 0.84: "-."}
# From what stands to what overturns; no colour is that of a bin without points, white.
SHADES = LinearSegmentedColormap.from_list("shares", ("#e9e3cf", "#fdbb84", "#d7301f", "#5f0010"))
UNKNOWN, HATCH = "#b8b8b8", "0.45"
HALO = [patheffects.withStroke(linewidth=3, foreground="white")]
VALUES = 50  # along y, of the band


def fragility_plane(plane, ax=None):
    """Draws a fragility in the plane of two measures (overturn.fragility_plane) and returns the axes: the fraction of
    each bin, where the fit is 16, 50 and 84 %, and the confidence of its 50 %. Bins with points without a verdict are
    hatched, those with no other points grey, those without points blank."""
    if not isinstance(plane, overturn.FragilityPlane):
        raise ValueError(f"{plane!r:.60} is no fragility in a plane. Give what overturn.fragility_plane() returns.")
    return draw_panel(ax, plane) if ax else draw([plane]).axes[0]


def draw(planes):
    """Returns a figure with a panel for each plane."""
    figure, panels = pyplot.subplots(1, len(planes), squeeze=False, layout="constrained",
                                     figsize=(6.4 * len(planes), 5.2))
    lines = max(draw_panel(panel, plane).get_xlabel().count("\n") for panel, plane in zip(panels.flat, planes))
    figure.set_figheight(figure.get_figheight() + lines * LINE * pyplot.rcParams["font.size"] / POINTS)
    return figure


def draw_panel(ax, plane):
    draw_bins(ax, plane)
    handles = draw_fit(ax, plane) if np.isfinite(plane.coefficients).all() else []
    if plane.without_verdict.any():
        handles.append(Patch(facecolor="none", edgecolor=HATCH, hatch="////", label="with points without a verdict"))
    ax.set(xscale="log", yscale="log", xlim=plane.x_edges[[0, -1]], ylim=plane.y_edges[[0, -1]])
    name_ticks(ax.xaxis)
    name_ticks(ax.yaxis)
    notes = [line for note in plane.notes for line in textwrap.wrap(escaped(note), TEXT_WIDTH)]
    ax.set_xlabel("\n".join([measure_text(plane.x, plane.x_units), *notes]))
    ax.set_ylabel(measure_text(plane.y, plane.y_units))
    ax.set_title("\n".join(wrapped(counts_text([plane]), 9, TITLE_WIDTH)), fontsize=9)
    if handles:
        place_legend_above(ax, 4, handles)
    return ax


def draw_bins(ax, plane):
    mesh = ax.pcolormesh(plane.x_edges, plane.y_edges, np.ma.masked_invalid(plane.fraction.T), cmap=SHADES, vmin=0,
                         vmax=1, edgecolor="white", linewidth=0.3)
    ax.figure.colorbar(mesh, ax=ax, label=share_text(plane))
    for i, j in zip(*np.nonzero(plane.without_verdict)):
        corner = plane.x_edges[i], plane.y_edges[j]
        size = np.diff(plane.x_edges)[i], np.diff(plane.y_edges)[j]
        ax.add_patch(Rectangle(corner, *size, facecolor=UNKNOWN if not plane.points[i, j] else "none", edgecolor=HATCH,
                               hatch="////", linewidth=0))


def draw_fit(ax, plane):
    """Returns the entries of the legend."""
    y = np.geomspace(*plane.y_edges[[0, -1]], VALUES)
    handles = []
    if len(plane.samples):
        handles.append(ax.fill_betweenx(y, *plane.line_interval(y), color=COLOURS[0], alpha=0.35, linewidth=0,
                                        label="95 % confidence of 50 %"))
    lines = [ax.plot(plane.line(y, share), y, style, color=COLOURS[0], path_effects=HALO,
                     label=f"fit: {100 * share:.0f} %")[0] for share, style in SHARES.items()]
    return lines + handles
