"""Maximum-likelihood fit of a lognormal fragility curve, and its confidence by bootstrap over motions:

    P(x) = Phi(ln(x / median) / beta) = Phi(a + b s),   s = (ln x - center) / width
    ln L = sum of y ln P + (n - y) ln(1 - P)            n points at x, of which y exceed

(J. Baker, Earthquake Spectra 31 (2015) 579-599). Points under one motion are not independent. Motions
are therefore drawn with replacement; intervals are those of the studentized bootstrap (A. Davison,
D. Hinkley, Bootstrap methods (1997), section 5.2), with the sandwich estimate of the covariance of a and
b, whose scores are summed by motion. They are computed for ln(median) and ln(beta), which are unbounded.
The band consists of quantiles of the curves of all samples; each of them rises with x, and so does the
band. Intervals of a + b s would not: with few motions, they include curves that fall."""

import dataclasses
import math
from typing import Any

import numpy as np
from scipy.special import ndtr

LEVEL = 0.95  # of the intervals
LEAST_MOTIONS = 10  # with fewer, intervals are erratic: some samples consist of nearly equal motions
MOST_WITHOUT_FIT = 1 - LEVEL  # share of the samples; above it, there are no intervals
MOST_ITERATIONS = 60
CONVERGED = 1e-8  # step of a and b, whose standard errors are above 1e-4 for fewer than 1e8 motions
LARGEST_STEP = 1.0  # of a and b
LARGEST_Z = 30.0  # Phi(-30) = 5e-198 is a normal number
LARGEST_LOG = 700.0  # of a median or beta among the samples; exp(709.8) overflows
CHUNK = 1_000_000  # samples times values computed at once: 8 MB an array


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
    motions, values = counts.points.shape
    total = np.asarray(counts.points.sum(axis=0)).ravel()
    center = np.average(counts.log_measure, weights=total)
    width = math.sqrt(np.average((counts.log_measure - center) ** 2, weights=total)) or 1.0
    estimate, error = (rows[0] for rows in estimates(counts, np.ones((1, motions)), center, width))
    if not (abs(estimate) <= LARGEST_LOG).all():  # NaN, or a curve that hardly rises
        return None
    without_fit, interval, kept = 0, np.full((2, 2), np.nan), np.empty((0, 2))
    band = np.full((2, len(log_at)), np.nan)
    if motions >= LEAST_MOTIONS:
        weights = np.random.default_rng(seed).multinomial(motions, np.full(motions, 1 / motions), samples)
        chunks = np.array_split(weights, -(-samples * values // CHUNK))
        drawn, errors = map(np.concatenate, zip(*(estimates(counts, chunk, center, width) for chunk in chunks)))
        deviation = (drawn - estimate) / errors
        without_fit = int(np.isnan(deviation).any(axis=1).sum())
        if without_fit <= MOST_WITHOUT_FIT * samples:
            ends = np.nanquantile(deviation, [(1 + LEVEL) / 2, (1 - LEVEL) / 2], axis=0)
            interval = estimate - ends * error
            kept = estimate - deviation * error
            kept = np.exp(np.clip(kept[~np.isnan(kept).any(axis=1)], -LARGEST_LOG, LARGEST_LOG))
            band = np.quantile(ndtr((log_at - np.log(kept[:, :1])) / kept[:, 1:]),
                               [(1 - LEVEL) / 2, (1 + LEVEL) / 2], axis=0)
    with np.errstate(over="ignore"):  # few different motions may give an interval without an upper end
        ends = np.exp(interval)
    return Fit(*map(float, np.exp(estimate)), ends[:, 0], ends[:, 1], band, kept, without_fit)


def estimates(counts, weights, center, width):
    """Returns ln(median) and ln(beta) of each sample, and their standard errors; weights (samples, motions)
    are how often a motion was drawn. NaN in samples without a fit."""
    points, exceeding = weights @ counts.points, weights @ counts.exceeding
    s = (counts.log_measure - center) / width
    ab = np.full((len(weights), 2), np.nan)
    fitted = has_maximum(points, exceeding)
    ab[fitted] = maximum(s, points[fitted], exceeding[fitted])
    a, b = ab[:, 0], np.where(ab[:, 1] > 0, ab[:, 1], np.nan)
    values = np.column_stack([center - width * a / b, np.log(width / b)])
    by_a = np.column_stack([-width / b, np.zeros_like(b)])
    by_b = np.column_stack([width * a / b**2, -1 / b])
    aa, ab_, bb = covariance(counts, s, ab, weights, points)[:, :, None]
    variance = by_a**2 * aa + 2 * by_a * by_b * ab_ + by_b**2 * bb
    return values, np.sqrt(np.where(variance > 0, variance, np.nan))


def has_maximum(points, exceeding):
    """Whether exceeding points and the others overlap in x; (samples, values)."""
    def ends(some):
        return np.argmax(some, axis=1), some.shape[1] - 1 - np.argmax(some[:, ::-1], axis=1)
    above, below = exceeding > 0, exceeding < points
    (first_above, last_above), (first_below, last_below) = ends(above), ends(below)
    return (above.any(axis=1) & below.any(axis=1)
            & (first_above < last_below) & (first_below < last_above))


def maximum(s, points, exceeding):
    """Returns a and b at the maximum of ln L in each sample, by Fisher scoring; NaN if the iteration
    does not converge."""
    share = (exceeding.sum(axis=1) + 0.5) / (points.sum(axis=1) + 1)
    ab = np.column_stack([np.log(share / (1 - share)) / 1.7, np.ones_like(share)])  # Phi(z) is near 1/(1 + exp(-1.7 z))
    active = np.arange(len(ab))
    for _ in range(MOST_ITERATIONS):
        if not active.size:
            break
        p, factor, weight = terms(s, ab[active], points[active])
        slope = (exceeding[active] - points[active] * p) * factor  # of ln L along z
        along_a, along_b = slope.sum(axis=1), slope @ s
        aa, ab_, bb = inverse_information(s, weight)
        step = np.column_stack([aa * along_a + ab_ * along_b, ab_ * along_a + bb * along_b])
        ab[active] += np.clip(step, -LARGEST_STEP, LARGEST_STEP)
        active = active[~(np.abs(step).max(axis=1) < CONVERGED)]
    ab[active] = np.nan
    return ab


def terms(s, ab, points):
    """Returns P, P' / (P (1 - P)) and the terms n P'^2 / (P (1 - P)) of the information; P' = dP/dz."""
    z = np.clip(ab[:, :1] + ab[:, 1:] * s, -LARGEST_Z, LARGEST_Z)
    p, density = ndtr(z), np.exp(-z * z / 2) / math.sqrt(2 * math.pi)
    factor = density / (p * ndtr(-z))
    return p, factor, points * density * factor


def inverse_information(s, weight):
    """Returns the elements aa, ab and bb of the inverse of the expected information."""
    aa, ab, bb = weight.sum(axis=1), weight @ s, weight @ (s * s)
    determinant = aa * bb - ab * ab
    determinant = np.where(determinant > 0, determinant, np.nan)
    return bb / determinant, -ab / determinant, aa / determinant


def covariance(counts, s, ab, weights, points):
    """Returns the elements aa, ab and bb of the sandwich estimate; (3, samples)."""
    p, factor, weight = terms(s, ab, points)
    aa, ab_, bb = inverse_information(s, weight)
    along_a, along_b = ((counts.exceeding @ (factor * part).T - counts.points @ (p * factor * part).T).T
                        for part in (1.0, s))  # scores of each motion
    influence_a, influence_b = (row[:, None] * along_a + other[:, None] * along_b
                                for row, other in ((aa, ab_), (ab_, bb)))
    return np.stack([(weights * left * right).sum(axis=1) for left, right in (
        (influence_a, influence_a), (influence_a, influence_b), (influence_b, influence_b))])
