"""The integral of the rate at which a block overturns, and its bounds:

    rate = integral of P(x) |d lambda(x)|

Arrays of rates are (rows, 2): rows of Probability.at(), the estimate first; lower and upper bound [1/year]."""

import numpy as np

from overturn.hazard import Hazard
from overturn.lognormal_fit import LEVEL
from overturn.motion_words import FLOOR_MEASURES
from overturn.probability import NODES, WEIGHTS, probability_of

# The error of the integral over a panel of width h in ln x is below 6e-31 h^21 times the 20th derivative of the
# integrand k lambda P (Gauss-Legendre, 10 nodes). With h <= beta / 2, that of Phi((ln x - m) / beta) exp(-k ln x) is
# below (2.7 / beta + k)^20; with k h <= 4, the error is below 6e-31 (1.4 + 4)^20 = 3e-16 of what lambda falls by, times
# k h / (1 - exp(-k h)) <= 4.1. In total it is below 2e-15 of the rate at the first level. Binned shares are constant in
# a panel.
WIDEST = 0.25  # h, also without breaks of P [1]
STEEPEST = 4.0  # k h [1]
FURTHEST = 60  # powers of e by which the range below the first level is searched for its contribution
NEGLIGIBLE = 1e-17  # part of the contribution below the first level
UNBOUNDED = 1e300  # [1/year]


def in_the_measure_of(hazard, fragility):
    if not isinstance(hazard, Hazard):
        raise TypeError(f"hazard is {type(hazard).__name__}. Give a Hazard, such as read_hazard() returns.")
    p = probability_of(fragility)
    if (hazard.im, hazard.units) != (p.im, p.units):
        if p.im in FLOOR_MEASURES:
            raise ValueError(f"the hazard is of {hazard.im} [{hazard.units}], the fragility of {p.im} [{p.units}], a "
                             "measure of a floor. A hazard curve is usually one of the ground: compute the fragility "
                             f"against ground_{hazard.im}, the measure of the ground that caused each motion of the "
                             "floor (docs/floors.md), or give a hazard curve of the floor.")
        raise ValueError(f"the hazard is of {hazard.im} [{hazard.units}], the fragility of {p.im} [{p.units}]. Compute "
                         "the fragility against the measure of the hazard, or convert the levels of the hazard.")
    return p


def within(hazard, p, inner=(), divisions=1):
    """Returns the values of x between which P and the slope of the hazard are smooth, and the contributions of these
    ranges to the integral between the first and the last level, (rows, 2, ranges)."""
    first, last = hazard.level[[0, -1]]
    points = np.union1d(hazard.level, [*inner, *p.breaks[(first < p.breaks) & (p.breaks < last)]])
    slope, width = hazard.slope[np.searchsorted(hazard.level, points[1:]) - 1], np.diff(np.log(points))
    counts = divisions * np.ceil(np.maximum(width / WIDEST, slope * width / STEEPEST)).astype(int).clip(1)
    starts = np.concatenate([[0], np.cumsum(counts)])  # of the panels of each range
    ends = np.interp(np.arange(starts[-1] + 1), starts, np.log(points))
    x = np.exp(ends[:-1, None] + np.diff(ends)[:, None] * (1 + NODES) / 2)
    weights = np.repeat(slope, counts)[:, None] * hazard.at(x) * np.diff(ends)[:, None] * WEIGHTS / 2
    bounds = p.at(x.ravel())
    panels = (bounds.reshape(*bounds.shape[:2], *x.shape) * weights).sum(axis=-1)
    return points, np.add.reduceat(panels, starts[:-1], axis=-1)


def below(hazard, p):
    """Returns bounds of the contribution of shaking below the first level, (rows, 2). There is no upper bound if it
    exceeded the rate of this level: a continued hazard that overturns more often by weaker shaking bounds nothing."""
    slope, first, total = hazard.slope[0], np.log(hazard.level[0]), 0.0
    parts = int(np.ceil(max(1 / WIDEST, slope / STEEPEST)))
    depth = (np.arange(parts)[:, None] + (1 + NODES) / 2).ravel() / parts
    for power in range(FURTHEST):
        with np.errstate(over="ignore", invalid="ignore"):
            weights = slope * hazard.rate[0] * np.exp(slope * (power + depth)) * np.tile(WEIGHTS, parts) / (2 * parts)
            p_high = p.at(np.exp(first - power - depth))[:, 1]
            added = np.where(p_high > 0, p_high * weights, 0).sum(axis=-1)
        total = total + added
        if (added <= NEGLIGIBLE * total).all():
            break
    is_bounded = (added <= NEGLIGIBLE * total) & (total <= hazard.rate[0])
    return np.stack([np.zeros_like(total), np.where(is_bounded, total, np.inf)], axis=-1)


def above(hazard, p):
    """Returns bounds of the contribution of shaking above the last level, (rows, 2)."""
    low = p.at(hazard.level[-1:])[:, 0, 0] * hazard.rate[-1]
    return np.stack([low, np.full_like(low, hazard.rate[-1])], axis=-1)


def rates(hazard, p):
    """Returns the rates of all shaking, (rows, 2)."""
    return within(hazard, p)[1].sum(axis=-1) + below(hazard, p) + above(hazard, p)


def interval(rates):
    """Returns the interval of 95 % confidence of the samples, from the lower bounds to the upper ones."""
    if len(rates) == 1:
        return np.full(2, np.nan)
    low, high = rates[1:, 0], np.minimum(rates[1:, 1], np.finfo(float).max)  # quantiles of infinite rates are NaN
    ends = np.array([np.quantile(low, (1 - LEVEL) / 2), np.quantile(high, (1 + LEVEL) / 2)])
    return np.where(ends < UNBOUNDED, ends, np.inf)
