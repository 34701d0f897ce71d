"""The annual rate at which a block overturns at a site, and the probability that it survives:

    rate = integral of P(x) |d lambda(x)|,   survival over T years = exp(-rate T), or its mean over an uncertain T

with the fragility P and the hazard curve lambda (C. Cornell, Bulletin of the Seismological Society of America 58 (1968)
1583-1606). A power law lambda = k0 x^-k and a lognormal P have the rate lambda(median) exp(k^2 beta^2 / 2)."""

from __future__ import annotations

import dataclasses
import functools
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np
from scipy.optimize import brentq

from overturn import rate_integral
from overturn.age import Age, age_of, read_age
from overturn.arguments import number, numbers, positive
from overturn.fragility_curve import Fragility
from overturn.hazard import Hazard, read_hazard
from overturn.logic_tree import UpdatedWeights, read_branches, updated_weights
from overturn.probability import (Probability, binned, binned_marginal, lognormal, marginal, probability_of,
                                  shares_of)
from overturn.ranges import confidence, text_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Age", "Factor", "Hazard", "Probability", "Risk", "UpdatedWeights", "annual_rate", "binned",
           "binned_marginal", "largest_factor", "lognormal", "marginal", "probability_of", "read_age", "read_branches",
           "read_hazard", "shares_of", "updated_weights"]

SMALL = 1e-3  # part of the rate from outside the data of the fragility that is not mentioned
LARGEST_FACTOR = 1e6
TOLERABLE = 1.3  # factor between the rates with and without the fit that is not mentioned, if there is no confidence


@dataclasses.dataclass(frozen=True, eq=False)
class Risk:
    """How often a block overturns at a site. Pairs are a lower and an upper bound: they differ by points without a
    verdict and by shaking outside the levels of the hazard curve, and are equal in all shown digits without these."""

    im: str  #: name of the intensity measure
    units: str  #: of the intensity measure
    rate: NDArray[np.float64]  #: (2,), bounds [1/year]; infinite: unbounded
    interval: NDArray[np.float64]  #: (2,), of 95 % confidence, by the bootstrap of the fragility [1/year]; or NaN
    edges: NDArray[np.float64]  #: of the ranges of the measure of `contribution`; the first is 0, the last infinite
    contribution: NDArray[np.float64]  #: (2, ranges), bounds of the rate from each range [1/year]; their sum is `rate`
    error: float  #: estimate of the error of the integral [1/year]
    notes: tuple[str, ...]  #: what the bounds leave open

    @property
    def disaggregation(self) -> NDArray[np.float64]:
        """Share of each range in each of the two bounds of the rate, (2, ranges) [1]; NaN for a rate of 0 or without
        an upper bound."""
        with np.errstate(invalid="ignore"):
            return self.contribution / self.rate[:, None]

    def survival(self, years: ArrayLike | Age) -> NDArray[np.float64]:
        """Bounds of the probability of no overturning in so many years, (2, *shape of years) [1]; of an Age, (2,)."""
        return _survival(self.rate[::-1], years)

    def survival_interval(self, years: ArrayLike | Age) -> NDArray[np.float64]:
        """Interval of 95 % confidence of survival(), (2, *shape of years) [1]. That of the age is not in it, but in the
        probability itself."""
        return _survival(self.interval[::-1], years)

    def summary(self, years: float | Age | None = None) -> str:
        """Returns the numbers as a text of several lines."""
        lines = [f"rate {text_of(self.rate)} a year{confidence(self.interval)}"]
        if years is not None:
            age = age_of(years)
            lines.append(f"survival of {age.text} {text_of(self.survival(age))}"
                         f"{confidence(self.survival_interval(age))}")
        return "\n".join([*lines, *self.notes])


class Factor(NamedTuple):
    bounds: NDArray[np.float64]  #: (2,), lower and upper bound [1]
    interval: NDArray[np.float64]  #: (2,), of 95 % confidence [1]; NaN without a bootstrap

    def text(self) -> str:
        return text_of(self.bounds) + confidence(self.interval)


def annual_rate(hazard: Hazard, fragility: Fragility | Probability, *, edges: ArrayLike | None = None) -> Risk:
    """Returns the annual rate at which a block overturns, its bounds and which shaking contributes to it.

    hazard: of the site, see read_hazard().
    fragility: of fragility(), lognormal(), binned(), marginal() or binned_marginal(), in the measure of the hazard.
    edges: of the ranges of the disaggregation within the levels of the hazard; by default its levels.

    Shaking above the last level contributes P(last level) lambda(last level) at least and lambda(last level) at most.
    Shaking below the first level contributes at most what it would if lambda continued as in the first interval; this
    is an upper bound if lambda, in logarithms, is nowhere steeper to the left of this interval. If it is above
    lambda(first level), the rate is unbounded.

    Raises ValueError if the measures or their units differ, or if the fragility pools samples of an object.
    """
    p = rate_integral.in_the_measure_of(hazard, fragility)
    first, last = hazard.level[[0, -1]]
    inner = hazard.level[1:-1] if edges is None else np.unique(numbers("edges", edges))
    inner = inner[(first < inner) & (inner < last)]
    points, within = rate_integral.within(hazard, p, inner)
    below, above = (part(hazard, p)[..., None] for part in (rate_integral.below, rate_integral.above))
    of_ranges = np.add.reduceat(within, np.searchsorted(points, [first, *inner]), axis=-1)
    contribution = np.concatenate([below, of_ranges, above], axis=-1)
    rate, halved = contribution.sum(axis=-1), rate_integral.within(hazard, p, inner, 2)[1]
    interval = rate_integral.interval(rate)
    notes = _notes(hazard, p, contribution[0], points, within[0], interval)
    if isinstance(fragility, Fragility) and np.isfinite(fragility.median):
        of_shares = annual_rate(hazard, shares_of(fragility)).rate
        notes.append(f"without the fit, from the shares in the {len(fragility.points)} bins of the fragility: "
                     f"{text_of(of_shares)} a year")
        lows, highs = zip(rate[0], of_shares)
        if np.isnan(interval[0]) and max(lows) > TOLERABLE * min(highs):
            notes.append(f"warning: the rates with and without the fit differ by a factor of {max(lows) / min(highs):.2g}, "
                         "and there is no confidence interval. Use more motions")
        if max(of_shares) < interval[0] or min(of_shares) > interval[1]:
            notes.append("warning: the rate without the fit is outside the confidence interval of that with it, so that the "
                         "fit does not describe these points. Compare both in the picture")
    return Risk(p.im, p.units, rate[0], interval, np.array([0, first, *inner, last, np.inf]), contribution[0],
                float(abs((halved - within)[0].sum(axis=-1)).max()), tuple(notes))


def _notes(hazard, p, contribution, points, within, interval):
    """Returns what the bounds leave open."""
    first, last = (f"{p.im} = {level:.4g} {p.units}" for level in hazard.level[[0, -1]])
    low, high = within.sum(axis=-1)
    is_bounded = bool(np.isfinite(contribution[1, 0]))
    most = f"at most {contribution[1, 0]:.3g} a year" if is_bounded else "unbounded"
    notes = [f"contribution of shaking below the first level of the hazard, {first}: {most}",
             f"contribution of shaking above the last level, {last}: {text_of(contribution[:, -1])} a year"]
    if not is_bounded or np.isinf(interval[1]):
        what = "the confidence" if is_bounded else "the rate"
        notes.append(f"{what} has no upper end: if the hazard continued below its first level as above it, weaker "
                     f"shaking would overturn more often than this level is exceeded, {hazard.rate[0]:.3g} a year"
                     f"{', in some samples of the bootstrap' * is_bounded}. Check the first levels, or begin the "
                     "hazard at a level that overturns nothing")
    if low < high:
        notes.append(f"points without a verdict, or bins without points: between these levels, the rate is {low:.4g} a "
                     f"year if all of them are safe, {high:.4g} if all overturn")
    outside = within[1, (points[:-1] < p.data[0]) | (points[1:] > p.data[1])].sum()
    if outside > SMALL * high:
        notes.append(f"{100 * outside / high:.3g} % of the rate is from shaking outside the data of the fragility, "
                     f"{p.im} = {p.data[0]:.4g} to {p.data[1]:.4g} {p.units}")
    return notes


def largest_factor(hazard: Hazard, fragility: Fragility | Probability, years: float | Age, survival: float,
                   on: Literal["rate", "level"] = "rate") -> Factor:
    """Returns the largest factor on a hazard curve with which a block survives so many years with the given
    probability: with a larger one, survival is less probable.

    years: a number, or a distribution, over which survival is averaged.
    on: "rate" multiplies the rates of the hazard: factor = -ln(survival) / (rate years). "level" multiplies its levels,
        the strength of every shaking: a root. It is 0 below 1e-6, infinite above 1e6.
    """
    if not 0 < (survival := number("survival", survival)) < 1:
        raise ValueError(f"survival = {survival} is not between 0 and 1. Give a probability such as 0.05.")
    target = age_of(years).rate(survival)
    p = rate_integral.in_the_measure_of(hazard, fragility)
    if on == "rate":
        risk = annual_rate(hazard, p)
        with np.errstate(divide="ignore", over="ignore"):
            return Factor(target / risk.rate[::-1], target / risk.interval[::-1])
    if on != "level":
        raise ValueError(f"on = {on!r} is neither \"rate\" nor \"level\".")

    @functools.cache  # the four roots begin alike
    def rates(log_factor):
        scaled = hazard.scaled(level=np.exp(log_factor))
        each = rate_integral.rates(scaled, p)
        return *each[0], *rate_integral.interval(each)
    roots = np.array([_root(lambda log_factor: rates(log_factor)[which], target) for which in (1, 0, 3, 2)])
    return Factor(roots[:2], roots[2:])


def _root(rate, target):
    """Returns the factor whose logarithm has the given rate; rate rises with it. Most factors are near 1."""
    def excess(log_factor):
        return np.log(np.clip(rate(log_factor), 1e-300, 1e300)) - np.log(target)
    if np.isnan(excess(0.0)):
        return np.nan
    sign, limit = -np.sign(excess(0.0)) or 1.0, np.log(LARGEST_FACTOR)
    start, end = 0.0, sign
    while sign * excess(end) < 0:
        if abs(end) == limit:
            return np.inf if sign > 0 else 0.0
        start, end = end, sign * min(2 * abs(end), limit)
    return np.exp(brentq(excess, start, end, xtol=1e-12))


def _survival(rate, years):
    if isinstance(years, Age):
        return np.exp(years.log_survival(rate))
    return np.exp(-np.multiply.outer(rate, positive("years", years)))
