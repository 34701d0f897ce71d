"""Ticks of axes. On logarithmic axes Matplotlib labels powers of ten only: just one from
1.13 to 11.3."""

import numpy as np
from matplotlib.ticker import FixedLocator, MaxNLocator, NullFormatter

FEWEST, MOST = 4, 9  # ticks of an axis
ROOM = {"x": 0.42, "y": 0.22}  # of a number beside others [inches]
DIGITS = ((1,), (1, 2, 5), (1, 1.5, 2, 3, 5, 7))  # leading digits of ticks; fewer for wider ranges


def log_ticks(low, high, most=MOST):
    """Returns round numbers between two positive limits, nearly evenly spaced in the logarithm."""
    decades = np.arange(np.floor(np.log10(low)), np.ceil(np.log10(high)) + 1)
    for digits in DIGITS:
        ticks = np.array([digit * 10.0**decade for decade in decades for digit in digits])
        # Limits are rounded: include a tick at a limit.
        ticks = ticks[(ticks >= low * (1 - 1e-9)) & (ticks <= high * (1 + 1e-9))]
        if len(ticks) >= min(FEWEST, most):
            return ticks[::-(-len(ticks) // most)]
    ticks = MaxNLocator(6).tick_values(low, high)  # so narrow that it is nearly linear
    return ticks[(ticks >= low) & (ticks <= high)]


def length_of(axis):
    """Returns the length of an axis [inches]."""
    box = axis.axes.get_window_extent()
    return (box.width if axis.axis_name == "x" else box.height) / axis.axes.figure.dpi


def tick_text(value, _place=None):
    """Returns a number in few letters: beside an axis is room for five."""
    return f"{value:g}" if value == 0 or abs(value) >= 1e-3 else f"{value:.0e}".replace("e-0", "e-")


def name_ticks(axis):
    """Labels the ticks of an axis whose scale and limits are set."""
    axis.set_major_formatter(tick_text)
    if axis.get_scale() == "log":
        most = int(np.clip(length_of(axis) / ROOM[axis.axis_name], 2, MOST))
        axis.set_major_locator(FixedLocator(log_ticks(*sorted(axis.get_view_interval()), most)))
        axis.set_minor_formatter(NullFormatter())
