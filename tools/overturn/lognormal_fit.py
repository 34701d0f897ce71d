"""Maximum-likelihood fit of a lognormal fragility curve, and its confidence by bootstrap over motions:

    P(x) = Phi(ln(x / median) / beta) = Phi(a + b s),   s = (ln x - center) / width

see motion_bootstrap. The band consists of quantiles of the curves of all samples; each of them rises with x, and so
does the band. Intervals of a + b s would not: with few motions, they include curves that fall."""

import dataclasses
import math
from typing import Any

import numpy as np
from scipy.special import ndtr

from overturn import motion_bootstrap
from overturn.motion_bootstrap import ENDS, LARGEST_LOG, LEAST_MOTIONS, LEVEL, NORMAL

__all__ = ["Counts", "Fit", "LEAST_MOTIONS", "LEVEL", "fit", "has_maximum"]


@dataclasses.dataclass(frozen=True)
class Counts:
    """Points at each value x of the intensity measure. Matrices are (motions, values), sparse or not."""

    log_measure: np.ndarray  # ln x, ascending
    points: Any
    exceeding: Any


@dataclasses.dataclass(frozen=True)
class Fit:
    """NaN where there is no fit or no interval."""

    median: float  # in the units of x
    beta: float  # standard deviation of ln x [1]
    median_interval: np.ndarray  # (2,)
    beta_interval: np.ndarray  # (2,)
    band: np.ndarray  # (2, values): of P at the requested values
    samples: np.ndarray  # (samples, 2): median and beta, whose quantiles are the intervals; none without intervals
    samples_without_fit: int = 0


def fit(counts, log_at, samples, seed):
    """Returns the fit, with intervals from this many samples and the band at log_at; or None if the
    likelihood has no maximum with a rising curve."""
    total = np.asarray(counts.points.sum(axis=0)).ravel()
    center, width = standardized(counts.log_measure, total)
    s = (counts.log_measure - center) / width
    found = motion_bootstrap.fit(counts.points, counts.exceeding, np.stack([np.ones_like(s), s], axis=1), NORMAL,
                                 samples, seed, has_maximum)
    if not found:
        return None

    def logs(values):  # ln(median) and ln(beta)
        return values * [width, 1] + [center, math.log(width)]
    estimate, interval, kept = map(logs, (found.estimate, found.interval, found.samples))
    if not (abs(estimate) <= LARGEST_LOG).all():
        return None
    kept = np.exp(np.clip(kept, -LARGEST_LOG, LARGEST_LOG))
    band = np.full((2, len(log_at)), np.nan)
    if len(kept):
        band = np.quantile(ndtr((log_at - np.log(kept[:, :1])) / kept[:, 1:]), ENDS, axis=0)
    with np.errstate(over="ignore"):  # few different motions may give an interval without an upper end
        ends = np.exp(interval)
    return Fit(*map(float, np.exp(estimate)), ends[:, 0], ends[:, 1], band, kept, found.samples_without_fit)


def standardized(log_measure, weights):
    """Returns the mean and the standard deviation; 1 if all values are equal."""
    center = np.average(log_measure, weights=weights)
    return center, math.sqrt(np.average((log_measure - center) ** 2, weights=weights)) or 1.0


def has_maximum(points, exceeding):
    """Whether exceeding points and the others overlap in x; (samples, values)."""
    def ends(some):
        return np.argmax(some, axis=1), some.shape[1] - 1 - np.argmax(some[:, ::-1], axis=1)
    above, below = exceeding > 0, exceeding < points
    (first_above, last_above), (first_below, last_below) = ends(above), ends(below)
    return (above.any(axis=1) & below.any(axis=1)
            & (first_above < last_below) & (first_below < last_above))
