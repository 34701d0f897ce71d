"""The time T for which a block has stood, as a distribution. A block that shaking overturns at an annual rate has
survived with the probability

    S(rate) = mean of exp(-rate T)

which is the Laplace transform of the distribution. It is exact for fixed times, samples, uniform pieces (a to b:
(exp(-rate a) - exp(-rate b)) / (rate (b - a))) and the normal distribution."""

from __future__ import annotations

import dataclasses
import os
import pathlib
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import brentq
from scipy.special import erfcx, log_ndtr, ndtr, ndtri

from overturn.arguments import number, numbers, positive

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

INTERVAL = 0.95  # of Age.interval() and in texts
# The trapezoidal rule of step h for a lognormal T = m exp(s z), E = sum of exp(-rate T - z^2 / 2) h / sqrt(2 pi), has a
# relative error below 2 exp(c - 2 pi a / h) if the integrand is analytic for |Im z| < a and its integral along these
# lines is at most exp(c) of that along the real one. For s a <= 1, it grows by exp(a^2 / 2) and, because
# cos(s a) >= exp(-0.62 (s a)^2) and d ln E / d ln rate >= -FURTHEST / s, by exp(0.62 FURTHEST s a^2).
FURTHEST = 37  # |z| of the earliest age; exp(-z^2 / 2) is a normal number
LATEST = 9  # z, above which are 1e-19 of the distribution
DIGITS = 37  # ln of the relative error is below -37 + ln 2: 2e-16
CHUNK = 1_000_000  # rates times ages computed at once: 8 MB an array


@dataclasses.dataclass(frozen=True, eq=False)
class Age:
    """How long a block has stood, as a distribution. The functions below return common ones; for another one, give
    log_mean, such as lambda rate: -np.log1p(rate * 5000), of exponentially distributed ages with a mean of 5,000."""

    #: of positive rates [1/year], in an array of any shape: the logarithm of the mean of exp(-rate T)
    log_mean: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    median: float  #: [years]
    text: str  #: in sentences, such as "10000 years (normal, standard deviation 1500)"

    @staticmethod
    def samples(years: ArrayLike, weights: ArrayLike | None = None) -> Age:
        """Ages, and how much each of them counts: samples of a distribution, or its density at evenly spaced ages. A
        single one is known exactly."""
        years = np.atleast_1d(positive("years", years)).ravel()
        weights = np.ones(len(years)) if weights is None else np.atleast_1d(numbers("weights", weights)).ravel()
        if weights.shape != years.shape or not ((weights >= 0).all() and 0 < weights.sum() < np.inf):
            raise ValueError(f"{len(years)} ages have {len(weights)} weights. Give as many weights as ages, each 0 or "
                             "more, and one or more of them positive.")
        order = np.argsort(years)[weights[np.argsort(years)] > 0]
        years, mass = years[order], weights[order] / weights.sum()
        median, low, high = (years[min(np.searchsorted(np.cumsum(mass), share), len(years) - 1)]
                             for share in (0.5, (1 - INTERVAL) / 2, (1 + INTERVAL) / 2))
        text = f"{len(years)} samples, {_interval_text(low, high)}"
        return Age(_mean_of_pieces(years, years, mass), median, _text(median, text if len(years) > 1 else ""))

    @staticmethod
    def uniform(low: float, high: float) -> Age:
        """Every age from low to high [years] is equally likely."""
        return Age.quantiles([0, 1], [low, high])

    @staticmethod
    def quantiles(probability: ArrayLike, years: ArrayLike) -> Age:
        """Quantiles of the distribution, such as [0, 0.025, 0.5, 0.975, 1] and an age for each. Between two of them,
        every age is equally likely."""
        probability, years = numbers("probability", probability), numbers("years", years)
        if probability.ndim != 1 or probability.shape != years.shape or len(years) < 2 or not (
                (np.diff(probability) > 0).all() and probability[0] == 0 and probability[-1] == 1):
            raise ValueError(f"probability = {probability} must ascend from 0 to 1, with an age for each.")
        if not (np.isfinite(years).all() and years[0] >= 0 and (np.diff(years) > 0).all()):
            raise ValueError(f"years = {years} must be 0 or more, and ascend.")
        low, median, high = np.interp([(1 - INTERVAL) / 2, 0.5, (1 + INTERVAL) / 2], probability, years)
        return Age(_mean_of_pieces(years[:-1], years[1:], np.diff(probability)), median, _text(
            median, f"uniform from {_year(years[0])} to {_year(years[1])}" if len(years) == 2
            else _interval_text(low, high)))

    @staticmethod
    def normal(mean: float, deviation: float) -> Age:
        """Normal distribution with a mean and a standard deviation [years], without ages below 0."""
        mean, deviation = _one("mean", mean), _one("deviation", deviation)
        ratio = mean / deviation

        def log_mean(rate):
            # exp(-rate mean + (rate deviation)^2 / 2) Phi(-z) / Phi(ratio), z = rate deviation - ratio; large z cancel.
            z = rate * deviation - ratio
            tail = np.log(erfcx(np.maximum(z, 0) / np.sqrt(2)) / 2) - ratio**2 / 2
            usual = log_ndtr(-np.minimum(z, 0)) + deviation * rate * (z - ratio) / 2
            return np.where(z > 0, tail, usual) - log_ndtr(ratio)
        median = mean + deviation * ndtri((1 + ndtr(-ratio)) / 2)
        return Age(log_mean, median, _text(mean, f"normal, standard deviation {_year(deviation)}"))

    @staticmethod
    def lognormal(median: float, sigma: float) -> Age:
        """Lognormal distribution with a median [years] and sigma, the standard deviation of the logarithm [1]. The mean
        is known to 2e-16 of it for all probabilities above 1e-150."""
        median, sigma = _one("median", median), _one("sigma", sigma)
        growth = 0.5 + 0.62 * FURTHEST * sigma
        width = min(1 / sigma, np.sqrt(DIGITS / growth))
        step = 2 * np.pi * width / (DIGITS + growth * width**2)
        z = step * np.arange(np.ceil(-FURTHEST / step), LATEST / step)
        years = median * np.exp(sigma * z)
        mass = np.exp(-z * z / 2) * step / np.sqrt(2 * np.pi)
        return Age(_mean_of_pieces(years, years, mass), median, _text(median, f"lognormal, sigma {sigma:.3g}"))

    @staticmethod
    def interval(low: float, high: float) -> Age:
        """Lognormal distribution with 95 % of the ages from low to high [years] and half of the others on each side."""
        low, high = _one("low", low), _one("high", high)
        if not low < high:
            raise ValueError(f"low = {low:g} is not below high = {high:g}. Give the lower end of the interval first.")
        found = Age.lognormal(np.sqrt(low * high), np.log(high / low) / (2 * ndtri((1 + INTERVAL) / 2)))
        return dataclasses.replace(found, text=_text(found.median, f"lognormal, {_interval_text(low, high)}"))

    def log_survival(self, rate: ArrayLike) -> NDArray[np.float64]:
        """Returns the logarithm of S(rate) of rates [1/year], which may be 0 or infinite."""
        rate = np.asarray(rate, float)
        usual = (0 < rate) & (rate < np.inf)
        return np.where(usual, self.log_mean(np.where(usual, rate, 1 / self.median)), -rate)

    def rate(self, survival: float) -> float:
        """Returns the annual rate at which survival has this probability, between 0 and 1."""
        def excess(log_rate):
            return float(self.log_survival(np.exp(log_rate))) - np.log(survival)
        ends = [-np.log(self.median)] * 2
        for end, sign in enumerate((1, -1)):
            while sign * excess(ends[end]) < 0:
                ends[end] -= sign
        return float(np.exp(brentq(excess, *ends, xtol=1e-14)))


def age_of(years: ArrayLike | Age) -> Age:
    """Returns an age, of a number one that is known exactly."""
    return years if isinstance(years, Age) else Age.samples(number("years", years))


def read_age(path: str | os.PathLike[str]) -> Age:
    """Reads Age.samples() from a text of one or two columns, ages [years] and weights, separated by blanks or a comma.
    Lines that begin with # or % are comments.

    Raises ValueError with the place if the file is not understood, OSError if it cannot be read."""
    rows = []
    for place, line in enumerate(pathlib.Path(path).read_text("utf-8-sig", errors="replace").splitlines(), 1):
        words = line.replace(",", " ").split()
        if not words or words[0][0] in "#%":
            continue
        try:
            row = [*map(float, words)]
        except ValueError:
            row = []
        if len(row) not in (1, 2) or rows and len(row) != len(rows[0]):
            raise ValueError(f"{path}:{place}: \"{line.strip()[:40]}\" is not an age in years, or an age and a weight "
                             "as in every line.")
        rows.append(row)
    if not rows:
        raise ValueError(f"{path} has no ages. Write one in each line.")
    try:
        return Age.samples(*np.array(rows).T)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _mean_of_pieces(low, high, mass):
    """Returns the function log_mean of ages that are equally likely from low to high in each piece; pieces without a
    width are ages. They ascend and have positive masses: with the first one as a factor, the sum does not underflow."""
    later, widths = low - low[0], high - low

    def of_chunk(rate):
        means = np.exp(-np.multiply.outer(rate, later))
        if widths.any():
            share = np.multiply.outer(rate, widths)
            means *= np.divide(-np.expm1(-share), share, out=np.ones_like(share), where=share > 0)
        return np.log(means @ mass) - rate * low[0]

    def log_mean(rate):
        chunks = np.array_split(rate.ravel(), 1 + rate.size * len(low) // CHUNK)
        return np.concatenate([*map(of_chunk, chunks)]).reshape(rate.shape)
    return log_mean


def _one(name, value):
    return float(positive(name, number(name, value)))


def _year(value):
    return f"{float(f'{value:.4g}'):g}"


def _text(years, distribution):
    return f"{years:g} years" if not distribution else f"{_year(years)} years ({distribution})"


def _interval_text(low, high):
    return f"{100 * INTERVAL:g} % from {_year(low)} to {_year(high)}"
