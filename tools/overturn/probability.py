"""The probability P(x) that a block overturns under shaking of the intensity x, in one form whatever it comes from."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import ndtr

from overturn.arguments import OLD_FRICTION, OLD_LIMIT, count, number, numbers, refuses_old
from overturn.exceedance import OVERTURNING, Exceedance
from overturn.fragility_curve import Fragility
from overturn.plane_of_measures import FragilityPlane, points_of_plane, two_counts
from overturn.motion_bootstrap import LEAST_MOTIONS, drawn

if TYPE_CHECKING:
    import xarray
    from numpy.typing import ArrayLike, NDArray

NODES, WEIGHTS = np.polynomial.legendre.leggauss(10)  # of a panel of an integral, in [-1, 1]
PANELS = 4  # of an interval of y
ROUNDING = 1e-8  # of the integral of a density over y


@dataclasses.dataclass(frozen=True, eq=False)
class Probability:
    """Bounds of P(x). They differ where points have no verdict, and where nothing is known."""

    #: of values (n,): lower and upper bound, (1 + samples, 2, n). The first row is the estimate, the others are samples
    #: of the bootstrap
    at: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    im: str  #: name of the intensity measure
    units: str  #: of the intensity measure
    breaks: NDArray[np.float64]  #: ascending values between which P is smooth
    data: tuple[float, float] = (0, np.inf)  #: range of the values with data


def probability_of(fragility: Fragility | Probability) -> Probability:
    """Returns P(x) of a fragility curve: its fit; without one, shares_of() it. A share u of the points of a bin has no
    verdict: P is between P (1 - u) and P (1 - u) + u there."""
    if isinstance(fragility, Probability):
        return fragility
    if not isinstance(fragility, Fragility):
        raise TypeError(f"{type(fragility).__name__} is not a fragility. Give the result of fragility(), lognormal(), "
                        "binned(), marginal() or binned_marginal().")
    expect_no_samples(fragility.pools_samples)
    if np.isnan(fragility.median):
        return shares_of(fragility)
    curve, total = fragility, fragility.points + fragility.without_verdict
    is_outside = curve.undecided + curve.not_computed > curve.without_verdict.sum()
    unknown = np.divide(curve.without_verdict, total, out=np.zeros(len(total)), where=total > 0)
    return lognormal(curve.median, curve.beta, im=curve.im, units=curve.units, samples=curve.samples,
                     edges=curve.edges, unknown=[is_outside, *unknown])


def expect_no_samples(pools_samples):
    """Raises ValueError if a fragility pools samples: survival is a mean over them, not that of their mean."""
    if pools_samples:
        raise ValueError("this fragility pools the samples of an object (column sample). Its contacts do not change from "
                         "one shaking to the next, so the survival of the pooled samples would be too low, often by far. Use a "
                         "table without --jitter, or the mean of the survival of each sample: docs/risk.md, "
                         "\"Uncertain contacts\".")


def shares_of(curve: Fragility) -> Probability:
    """Returns P(x) of the bins of a fragility curve, without its fit; see binned()."""
    expect_no_samples(curve.pools_samples)
    if not len(curve.edges):
        raise ValueError("no point of this fragility curve has a verdict. Compute the missing points.")
    total = curve.points + curve.without_verdict
    low, high = (np.divide(exceeding, total, out=np.full(len(total), np.nan), where=total > 0)
                 for exceeding in (curve.exceeding, curve.exceeding + curve.without_verdict))
    return binned(curve.edges, low, high, im=curve.im, units=curve.units)


def lognormal(median: float, beta: float, *, im: str, units: str, samples: ArrayLike = (), edges: ArrayLike = (),
              unknown: ArrayLike = (0,)) -> Probability:
    """Returns P(x) = Phi(ln(x / median) / beta).

    median: in `units`. beta: standard deviation of the logarithm [1]. samples (n, 2): of both.
    edges: of bins. unknown: share of the points without a verdict, outside the bins and in each of them [1].
    """
    median, beta = number("median", median), number("beta", beta)
    medians, betas = np.array([(median, beta), *samples], float).T[:, :, None]
    if not (np.isfinite([median, beta]).all() and median > 0 and beta > 0):
        raise ValueError(f"median = {median} and beta = {beta} must be positive numbers.")
    edges, unknown = np.asarray(edges, float), np.asarray(unknown, float)

    def at(x):
        share = unknown[np.searchsorted(edges, x) % max(len(edges), 1)]  # below and above the bins, 0
        with np.errstate(over="ignore", divide="ignore"):  # 0 or infinity is right
            low = ndtr(np.log(x / medians) / betas) * (1 - share)
        return np.stack([low, low + share], axis=1)
    # Beyond 8 beta, P is 0 or 1 within 1e-15.
    with np.errstate(over="ignore"):  # beyond all levels
        breaks = np.union1d(edges, median * np.exp(beta * np.arange(-8, 8.5, 0.5)))
    return Probability(at, im, units, breaks,
                       (edges[0], edges[-1]) if len(edges) else (0, np.inf))


def binned(edges: ArrayLike, low: ArrayLike, high: ArrayLike | None = None, *, im: str, units: str) -> Probability:
    """Returns P(x) of shares in bins. Where there are none, P is assumed not to fall with x: below the bins it is from
    0 to the share of the first one, above from that of the last one to 1, between from the largest share below to the
    smallest one above.

    edges: ascending, in `units`, one more than bins.
    low, high: of each bin, the share that overturns if points without a verdict are safe, and if they overturn [1];
        NaN if nothing is known. Without high, every point has a verdict.
    """
    edges, low = numbers("edges", edges), numbers("low", low)
    high = low if high is None else numbers("high", high)
    if edges.ndim != 1 or low.ndim != 1 or low.shape != high.shape:
        raise ValueError(f"edges, low and high have the shapes {edges.shape}, {low.shape} and {high.shape}, but must "
                         "have one dimension, with a share for each bin.")
    shares = np.stack([low, high])
    if shares.shape != (2, len(edges) - 1) or not (edges[0] > 0 and (np.diff(edges) > 0).all()):
        raise ValueError(f"{len(edges)} edges and shares of the shape {shares.shape[1:]}: edges must be positive, "
                         "ascend, and be one more than shares.")
    if not (np.isnan(shares) | (0 <= shares[0]) & (shares[0] <= shares[1]) & (shares[1] <= 1)).all():
        raise ValueError("shares must satisfy 0 <= low <= high <= 1.")
    return _in_bins(edges, shares[None], im, units)


def _in_bins(edges, shares, im, units, mass=None):
    """Returns P(x) of shares (rows, 2, bins), or (rows, 2, bins, bins of y) with the function mass(x) that returns the
    probability of each bin of y given x, (values, bins of y), and that of y elsewhere, where P is from 0 to 1."""
    below = np.maximum.accumulate(np.nan_to_num(shares[:, 0]), axis=1)
    above = np.minimum.accumulate(np.nan_to_num(shares[:, 1, ::-1], nan=1), axis=1)[:, ::-1]
    between = np.sort(np.stack([below, above], axis=1), axis=1)  # known shares may fall
    shares = np.where(np.isnan(shares), between, shares)

    def at(x):
        place = np.searchsorted(edges, x) - 1
        found = shares[:, :, np.clip(place, 0, len(edges) - 2)]
        if mass:
            of_y, elsewhere = mass(x)
            found = np.einsum("rbxy,xy->rbx", found, of_y)
            found[:, 1] += elsewhere
        found[:, 0, place < 0], found[:, 1, place > len(edges) - 2] = 0, 1
        return found
    return Probability(at, im, units, edges, (edges[0], edges[-1]))


def marginal(probability: Callable | FragilityPlane, density: Callable, y: ArrayLike | None = None, *,
             im: str | None = None, units: str | None = None) -> Probability:
    """Returns P(x) = integral of P(x, y) f(y | x) dy of a function of two intensity measures, or of the fit of
    fragility_plane(), with its confidence. In a bin of a plane in which a share u of the points has no verdict, P is
    between P (1 - u) and P (1 - u) + u.

    probability(x, y), density(y, x): P [1] and f [1 / unit of y], of arrays that broadcast. P must be smooth in x.
    y: ascending values from the lowest to the highest y, no farther apart than P and f are smooth. Of what f has
        outside, if it is above 1e-8, nothing or all overturns. Of a plane, by default the edges of its bins.
    im, units: of x; those of a plane are known.

    Computing a rate raises ValueError if f is negative or exceeds 1 in total.
    """
    breaks = np.empty(0)
    if isinstance(probability, FragilityPlane):
        expect_no_samples(probability.pools_samples)
        if np.isnan(probability.coefficients).any():
            raise ValueError("this plane has no fit; its notes say why. binned_marginal() needs none.")
        im, units, breaks, edges = probability.x, probability.x_units, probability.x_edges, probability.y_edges
        y = edges if y is None else np.union1d(y, edges[(np.min(y) < edges) & (edges < np.max(y))])
    nodes, weights = _nodes(np.asarray(y, float))

    def at(x):
        mass, elsewhere = _mass(density, nodes, weights, x)
        if len(breaks):
            unknown = mass * probability.without_verdict_at(x[:, None], nodes)
            known = mass - unknown
            low = np.array([np.einsum("xy,xy->x", known, p) for p in probability.of_samples(x, nodes)])
            elsewhere = elsewhere + unknown.sum(axis=1)
        else:
            low = (mass * probability(x[:, None], nodes)).sum(axis=1)[None]
        return np.stack([low, low + elsewhere], axis=1)
    return Probability(at, im, units, breaks, tuple(breaks[[0, -1]]) if len(breaks) else (0, np.inf))


def _nodes(y):
    """Returns the nodes and the weights of the integral over y, panel by panel."""
    ends = np.interp(np.arange((len(y) - 1) * PANELS + 1) / PANELS, np.arange(len(y)), y)
    half = np.diff(ends)[:, None] / 2
    return (ends[:-1, None] + half * (1 + NODES)).ravel(), (half * WEIGHTS).ravel()


def _mass(density, nodes, weights, x):
    """Returns the probability of y at each node, (values, nodes), and of y elsewhere; rounding of the integral counts
    as nothing elsewhere."""
    mass = np.broadcast_to(density(nodes, x[:, None]) * weights, (len(x), len(nodes)))
    total = mass.sum(axis=1)
    for i in np.flatnonzero(~((mass >= 0).all(axis=1) & (total <= 1 + ROUNDING)))[:1]:
        raise ValueError(f"density(y, x) at x = {x[i]:g} is negative, or its integral over y, {total[i]:g}, is above "
                         "1. Give the probability density of y for this x, or values of y closer to each other.")
    whole = abs(total - 1) <= ROUNDING
    return mass / np.where(whole, total, 1)[:, None], np.where(whole, 0, 1 - total)


@refuses_old(OLD_FRICTION | OLD_LIMIT)
def binned_marginal(dataset: xarray.Dataset, x: str, y: str, density: Callable, *, of: str = OVERTURNING,
                    above: float | None = None, friction_demand: float | None = None, together: str | None = None,
                    bins: tuple[int, int] = (10, 10), samples: int = 1000, seed: int = 1) -> Probability:
    """Returns P(x) = integral of P(x, y) f(y | x) dy of a result under records, where P(x, y) is the share of the
    points that overturns in bins of two intensity measures, evenly spaced in their logarithms. Points without a verdict
    are safe in the lower bound and overturn in the upper one. In bins without points, P is bounded as by binned().
    What the density has outside the bins of y overturns in the upper bound, whatever x: give one that is 0 there.

    x, y: measures as for fragility(), or ratios of two, such as "pgv/pga".
    density(y, x): f, as for marginal().
    of, above, friction_demand, together, samples, seed: as for fragility(). There are no samples with fewer than ten
        motions.

    Raises ValueError if the dataset lacks what is needed.
    """
    bins, samples, seed = two_counts(bins), count("samples", samples, least=0), count("seed", seed, least=0)
    found = points_of_plane(dataset, x, y, Exceedance(of, above), friction_demand, together, bins)
    expect_no_samples(found.blocks["pools_samples"])
    motions, edges = found.motions, found.edges
    points, exceeding, unknown = found.totals()
    weights = np.vstack([np.ones(len(motions)), drawn(len(motions), samples * (len(motions) >= LEAST_MOTIONS), seed)])
    low, high, total = (np.tensordot(weights, sums, 1)
                        for sums in (exceeding, exceeding + unknown, points + unknown))
    shares = np.stack([low, high], axis=1)
    shares = np.divide(shares, total[:, None], out=np.full(shares.shape, np.nan), where=total[:, None] > 0)
    nodes, weights = _nodes(edges[1])

    def mass(x):
        each, elsewhere = _mass(density, nodes, weights, x)
        return each.reshape(len(x), len(edges[1]) - 1, -1).sum(axis=2), elsewhere
    return _in_bins(edges[0], shares, found.names[0], found.units[0], mass)
