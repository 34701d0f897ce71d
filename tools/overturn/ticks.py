"""Scales and ticks of axes. On logarithmic axes Matplotlib labels powers of ten only: just one from
1.13 to 11.3."""

import numpy as np
from matplotlib.ticker import FixedLocator, MaxNLocator, NullFormatter

FEWEST, MOST = 4, 9  # ticks of an axis
DIGITS = ((1,), (1, 2, 5), (1, 1.5, 2, 3, 5, 7))  # leading digits of ticks; fewer for wider ranges


def log_ticks(low, high):
    """Returns round numbers between two positive limits, nearly evenly spaced in the logarithm."""
    decades = np.arange(np.floor(np.log10(low)), np.ceil(np.log10(high)) + 1)
    for digits in DIGITS:
        ticks = np.array([digit * 10.0**decade for decade in decades for digit in digits])
        # Limits are rounded: include a tick at a limit.
        ticks = ticks[(ticks >= low * (1 - 1e-9)) & (ticks <= high * (1 + 1e-9))]
        if len(ticks) >= FEWEST:
            return ticks[::-(-len(ticks) // MOST)]
    ticks = MaxNLocator(6).tick_values(low, high)  # so narrow that it is nearly linear
    return ticks[(ticks >= low) & (ticks <= high)]


def name_ticks(axis):
    """Labels the ticks of an axis whose scale and limits are set."""
    axis.set_major_formatter("{x:g}")
    if axis.get_scale() == "log":
        axis.set_major_locator(FixedLocator(log_ticks(*sorted(axis.get_view_interval()))))
        axis.set_minor_formatter(NullFormatter())


def set_axes(panel, across, up):
    """Sets scales, limits and ticks of a panel from two Axis of spectrum_file. An axis of one value
    has one tick: the width of its cell has no meaning."""
    panel.set(xscale=across.scale, yscale=up.scale, xlim=across.limits(), ylim=up.limits())
    for drawn, axis in ((panel.xaxis, across), (panel.yaxis, up)):
        name_ticks(drawn)
        if axis.only_value is not None:
            drawn.set_ticks([axis.only_value], [f"{axis.only_value:.4g}"])
