"""Numbers in texts: bounds, intervals, and tables of them."""

import numpy as np


def text_of(pair):
    """Returns one number if both bounds agree in four digits."""
    low, high = (f"{number:.4g}" for number in pair)
    return low if low == high else _range(low, high)


def confidence(interval, what="95 % confidence "):
    """Returns an interval in brackets, or nothing if there is none."""
    return f" ({what}{_range(*(f'{end:.3g}' for end in interval))})" if np.isfinite(interval[0]) else ""


def table(rows):
    """Returns the lines of a table, with columns as wide as their texts."""
    widths = [max(map(len, column)) for column in zip(*rows)]
    return ["  ".join(map(str.ljust, row, widths)).rstrip() for row in rows]


def _range(low, high):
    return f"{low} or more" if high == "inf" else f"{low} to {high}"
