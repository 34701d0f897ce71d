"""Maximum-likelihood fits of the probability that a point exceeds, and their confidence by bootstrap over motions:

    P = F(z),   z = a + b v + c w,   ln L = sum of y ln P + (n - y) ln(1 - P)

with n points at (v, w), of which y exceed; F is the normal or the logistic distribution, w may be missing. (J. Baker,
Earthquake Spectra 31 (2015) 579-599.) Points under one motion are not independent. Motions are therefore drawn with
replacement; intervals are those of the studentized bootstrap (A. Davison, D. Hinkley, Bootstrap methods (1997), section
5.2), with the sandwich estimate of the covariance of a, b and c, whose scores are summed by motion. They are those of

    v at P = 1/2 and w = 0, m = -a/b;   the logarithm of the scatter, -ln b;   the slope of v at P = 1/2, g = -c/b

which are unbounded."""

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.special import ndtr

LEVEL = 0.95  # of the intervals
ENDS = [(1 - LEVEL) / 2, (1 + LEVEL) / 2]  # quantiles
LEAST_MOTIONS = 10  # with fewer, intervals are erratic: some samples consist of nearly equal motions
MOST_WITHOUT_FIT = 1 - LEVEL  # share of the samples; above it, there are no intervals
MOST_ITERATIONS = 60
CONVERGED = 1e-8  # step of a, b and c, whose standard errors are above 1e-4 for fewer than 1e8 motions
LARGEST_STEP = 1.0  # of a, b and c
LARGEST_Z = 30.0  # Phi(-30) = 5e-198 is a normal number
LARGEST_LOG = 700.0  # of a median or beta among the samples; exp(709.8) overflows
CHUNK = 1_000_000  # samples times values computed at once: 8 MB an array


def _normal(z):
    p, density = ndtr(z), np.exp(-z * z / 2) / math.sqrt(2 * math.pi)
    return p, density / (p * ndtr(-z)), density


def _logistic(z):
    odds = np.exp(-z)
    p = 1 / (1 + odds)
    return p, np.ones_like(p), odds * p * p


@dataclasses.dataclass(frozen=True)
class Link:
    at: Callable  # of z: P, P' / (P (1 - P)) and P'
    logit: float  # ln(P / (1 - P)) is near logit z


NORMAL, LOGISTIC = Link(_normal, 1.7), Link(_logistic, 1.0)


@dataclasses.dataclass(frozen=True)
class Fitted:
    """Values of m, -ln b and, of two measures, g. NaN where there is no interval."""

    estimate: np.ndarray  # (2 or 3,)
    interval: np.ndarray  # (2, 2 or 3)
    samples: np.ndarray  # (samples, 2 or 3), whose quantiles are the interval; none without an interval
    samples_without_fit: int


def drawn(motions, samples, seed):
    """Returns how often each motion is in each sample, (samples, motions)."""
    return np.random.default_rng(seed).multinomial(motions, np.full(motions, 1 / motions), samples)


def fit(points, exceeding, design, link, samples, seed, has_maximum=None):
    """Returns the fit to the numbers of points, or None if the likelihood has no maximum with P that rises with v.

    points, exceeding: (motions, values), sparse or not. design: 1, v and w (values, 2 or 3), where v and w are of the
    order of 1. has_maximum: of the sums over motions (samples, values), where it is known in advance."""
    counts = _Counts(points, exceeding, np.asarray(design, float), link, has_maximum)
    motions, values = points.shape
    estimate, error, abc = (rows[0] for rows in counts.estimates(np.ones((1, motions))))
    if not (abs(estimate) <= LARGEST_LOG).all():  # NaN, or P that hardly rises
        return None
    without_fit, interval, kept = 0, np.full((2, len(estimate)), np.nan), np.empty((0, len(estimate)))
    if motions >= LEAST_MOTIONS:
        weights = np.array_split(drawn(motions, samples, seed), -(-samples * values // CHUNK))
        estimates, errors, _ = map(np.concatenate, zip(*(counts.estimates(each, abc) for each in weights)))
        deviation = (estimates - estimate) / errors
        without_fit = int(np.isnan(deviation).any(axis=1).sum())
        if without_fit <= MOST_WITHOUT_FIT * samples:
            interval = estimate - np.nanquantile(deviation, ENDS[::-1], axis=0) * error
            kept = estimate - deviation * error
            kept = kept[~np.isnan(kept).any(axis=1)]
    return Fitted(estimate, interval, kept, without_fit)


@dataclasses.dataclass(frozen=True)
class _Counts:
    points: Any
    exceeding: Any
    design: np.ndarray
    link: Link
    has_maximum: Callable | None

    def estimates(self, weights, start=None):
        """Returns the values of Fitted of each sample, their standard errors, and a, b and c; NaN in samples without a
        fit. weights (samples, motions): how often a motion was drawn. start: a, b and c to begin with."""
        points, exceeding = weights @ self.points, weights @ self.exceeding
        fitted = self.has_maximum(points, exceeding) if self.has_maximum else np.ones(len(weights), bool)
        size = self.design.shape[1]
        abc = np.full((len(weights), size), np.nan)
        abc[fitted] = self.maximum(points[fitted], exceeding[fitted], start)
        b = np.where(abc[:, 1] > 0, abc[:, 1], np.nan)[:, None]
        values = -abc / b
        slopes = np.eye(size) * -1 / b[:, :, None]  # of each value along a, b and c
        slopes[:, :, 1] = abc / b**2
        values[:, 1], slopes[:, 1, 1] = -np.log(b[:, 0]), -1 / b[:, 0]
        variance = self.variances(abc, slopes, weights, points)
        return values, np.sqrt(np.where(variance > 0, variance, np.nan)), abc

    def maximum(self, points, exceeding, start=None):
        """Returns a, b and c at the maximum of ln L in each sample, by Fisher scoring; NaN if the iteration does not
        converge."""
        abc = np.zeros((len(points), self.design.shape[1]))
        if start is None:
            share = (exceeding.sum(axis=1) + 0.5) / (points.sum(axis=1) + 1)
            start = np.zeros_like(abc)
            start[:, 0], start[:, 1] = np.log(share / (1 - share)) / self.link.logit, 1
        abc[:] = start
        active = np.arange(len(abc))
        for _ in range(MOST_ITERATIONS):
            if not active.size:
                break
            p, factor, information = self.terms(abc[active], points[active])
            slope = ((exceeding[active] - points[active] * p) * factor) @ self.design
            step = (inverse(information) @ slope[:, :, None])[:, :, 0]
            abc[active] += np.clip(step, -LARGEST_STEP, LARGEST_STEP)
            active = active[~(np.abs(step).max(axis=1) < CONVERGED)]
        abc[active] = np.nan
        return abc

    def terms(self, abc, points):
        """Returns P and P' / (P (1 - P)) at each value, and the expected information; P' = dP/dz."""
        p, factor, density = self.link.at(np.clip(abc @ self.design.T, -LARGEST_Z, LARGEST_Z))
        size = self.design.shape[1]
        squares = (self.design[:, :, None] * self.design[:, None, :]).reshape(-1, size * size)
        return p, factor, (points * density * factor @ squares).reshape(-1, size, size)

    def variances(self, abc, slopes, weights, points):
        """Returns the variances of functions with these slopes, by the sandwich estimate; (samples, functions)."""
        p, factor, information = self.terms(abc, points)
        scores = np.stack([(self.exceeding @ (factor * part).T - self.points @ (p * factor * part).T).T
                           for part in self.design.T], axis=-1)  # (samples, motions, a b c)
        influence = scores @ (slopes @ inverse(information)).transpose(0, 2, 1)
        return np.einsum("sm,smf->sf", weights, influence**2)


def inverse(matrices):
    """Returns the inverse matrices; NaN if the determinant is not positive."""
    found = np.full(matrices.shape, np.nan)
    with np.errstate(invalid="ignore"):  # NaN in samples without a fit
        regular = np.linalg.det(matrices) > 0
    found[regular] = np.linalg.inv(matrices[regular])
    return found
