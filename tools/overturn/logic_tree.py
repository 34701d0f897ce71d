"""The branches of a logic tree of the hazard, and what the survival of blocks changes about their weights:

    posterior weight = prior weight S(rate) / sum over branches of prior weight S(rate)

with the rate at which the shaking of a branch overturns the blocks, and their survival S (J. Baker and others, Bulletin
of the Seismological Society of America 103 (2013), for fragile geologic structures)."""

from __future__ import annotations

import csv
import dataclasses
import os
import pathlib
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from overturn import rate_integral
from overturn.age import Age, age_of
from overturn.arguments import numbers
from overturn.fragility_curve import Fragility
from overturn.hazard import OPENQUAKE, Hazard, read_hazard
from overturn.lognormal_fit import LEVEL
from overturn.output_file import new_file
from overturn.probability import Probability, probability_of
from overturn.ranges import confidence, table, text_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

ENDS = (1 - LEVEL) / 2, (1 + LEVEL) / 2
RETURN_PERIODS = (475, 2475, 10_000)  # [years], of the mean hazard in summaries
IMPROBABLE = 0.05  # survival with the most favourable branch, below which it is mentioned
ROUNDING = 1e-3  # of the sum of the weights
COLUMNS = ("branch", "prior", "posterior_low", "posterior_high", "confidence_low", "confidence_high", "rate_low",
           "rate_high", "survival_low", "survival_high")


@dataclasses.dataclass(frozen=True, eq=False)
class UpdatedWeights:
    """Weights of the branches of a logic tree before and after the survival of blocks. Pairs are bounds, as in Risk:
    those of a posterior weight have the branch at one end of its rate and all others at the other end."""

    hazards: tuple[Hazard, ...]  #: of the branches; `source` is the name of a branch
    age: Age
    prior: NDArray[np.float64]  #: (branches,) [1]; their sum is 1
    posterior: NDArray[np.float64]  #: (2, branches), bounds [1]
    interval: NDArray[np.float64]  #: (2, branches), of 95 % confidence, by the bootstrap of the fragility [1]; or NaN
    rate: NDArray[np.float64]  #: (2, branches), bounds of the rate of overturning [1/year]; infinite: unbounded
    before: Hazard  #: mean of the branches, over the levels that all of them contain
    after: tuple[Hazard, Hazard]  #: bounds of the mean with the posterior weights
    after_interval: tuple[Hazard, Hazard] | None  #: of 95 % confidence at each level; None without a bootstrap
    notes: tuple[str, ...]  #: what the bounds leave open, and what the weights cannot tell

    @property
    def names(self) -> list[str]:
        """Names of the branches, from the sources of their hazards."""
        return [hazard.source or f"branch {i}" for i, hazard in enumerate(self.hazards, 1)]

    @property
    def survival(self) -> NDArray[np.float64]:
        """Bounds of the survival of the blocks under each branch, (2, branches) [1]."""
        return np.exp(self.age.log_survival(self.rate[::-1]))

    def summary(self) -> str:
        """Returns the numbers as a text of several lines: a table of the branches, and what changes about the mean."""
        has_confidence = bool(np.isfinite(self.interval).any())
        rows = [["branch", "prior", "posterior" + " (95 % confidence)" * has_confidence, "rate [1/year]", "survival"],
                *([name, f"{prior:.4g}", weight, text_of(rate), text_of(survival)]
                  for name, prior, weight, rate, survival
                  in zip(self.names, self.prior, self.weight_texts(), self.rate.T, self.survival.T))]
        lines = [f"survival of {self.age.text} with the prior weights {text_of(self.survival @ self.prior)}"]
        for years in RETURN_PERIODS:
            means = self.before, *self.after, *(self.after_interval or ())
            levels = [_level_at(hazard, 1 / years) for hazard in means]
            if np.isfinite(levels).all():
                lines.append(f"{self.before.im} that is exceeded once in {years} years (mean hazard): {levels[0]:.4g} "
                             f"{self.before.units} before, {text_of(levels[1:3])} {self.before.units} after"
                             f"{confidence(levels[3:]) if self.after_interval else ''}")
        return "\n".join([*table(rows), *lines, *self.notes])

    def weight_texts(self) -> list[str]:
        """Returns the posterior weights as texts, with their confidence in brackets."""
        return [text_of(pair) + confidence(interval, "") for pair, interval in zip(self.posterior.T, self.interval.T)]

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Writes a row for each branch. Unknown numbers are empty."""
        columns = [self.prior, *self.posterior, *self.interval, *self.rate, *self.survival]
        with new_file(path, "a table of weights of branches", _is_own) as part, open(
                part, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(COLUMNS)
            writer.writerows([name, *("" if np.isnan(value) else f"{value:.6g}" for value in row)]
                             for name, row in zip(self.names, np.transpose(columns)))


def _is_own(beginning):
    return beginning.decode(errors="replace").split("\n")[0] == ",".join(COLUMNS)


def updated_weights(hazards: Sequence[Hazard], weights: ArrayLike, fragility: Fragility | Probability,
                    years: float | Age) -> UpdatedWeights:
    """Returns the weights of the branches of a logic tree after the survival of blocks for so many years.

    hazards: a curve for each branch, of one measure, see read_branches().
    weights (branches,): before, 0 or more; they are divided by their sum.
    fragility: of the block, or of several blocks together, see annual_rate().
    years: a number, or a distribution, over which survival is averaged.

    Raises ValueError if the measures or their units differ, if the curves have no two levels in common, or if the
    fragility pools samples of an object.
    """
    hazards, weights, age = tuple(hazards), np.atleast_1d(numbers("weights", weights)), age_of(years)
    if not hazards or weights.shape != (len(hazards),):
        raise ValueError(f"{len(hazards)} hazards and weights of the shape {weights.shape}. Give one or more branches, "
                         "and a weight for each.")
    if not ((weights >= 0).all() and 0 < weights.sum() < np.inf):
        raise ValueError(f"weights = {weights} must be 0 or more, with a positive sum.")
    p, prior = probability_of(fragility), weights / weights.sum()
    for hazard in hazards:
        rate_integral.in_the_measure_of(hazard, p)
    levels = _common_levels(hazards)
    rates = np.stack([rate_integral.rates(hazard, p) for hazard in hazards], axis=-1)  # (rows, 2, branches)
    low, high = _likelihoods(prior, age.log_survival(rates[:, ::-1]))
    posterior = _bounds_of_shares(low, high)
    at_levels = np.exp([np.interp(np.log(levels), np.log(each.level), np.log(each.rate)) for each in hazards])
    means = np.stack([_bounds_of_mean(low, high, values) for values in at_levels.T], axis=-1)  # (rows, 2, levels)

    def mean_hazard(rate):  # that of a plateau may rise by rounding
        return Hazard(levels, np.minimum.accumulate(rate), p.im, p.units, "mean")
    has_samples = len(rates) > 1
    return UpdatedWeights(
        hazards, age, prior, posterior[0], _interval(posterior) if has_samples else np.full(posterior[0].shape, np.nan),
        rates[0], mean_hazard(prior @ at_levels), tuple(map(mean_hazard, means[0])),
        tuple(map(mean_hazard, _interval(means))) if has_samples else None,
        tuple(_notes(hazards, weights, rates[0], np.exp(age.log_survival(rates[0, 0])), posterior[0])))


def _common_levels(hazards):
    """Returns the levels of all curves in the range that each of them has."""
    first, last = max(each.level[0] for each in hazards), min(each.level[-1] for each in hazards)
    if not first < last:
        raise ValueError(f"the hazard curves have no range of levels in common: one begins at {first:g} "
                         f"{hazards[0].units}, another one ends at {last:g} {hazards[0].units}. Compute them for the "
                         "same levels.")
    levels = np.unique(np.concatenate([each.level for each in hazards]))
    return levels[(first <= levels) & (levels <= last)]


def _likelihoods(prior, log_survival):
    """Returns the lower and the upper bounds of prior S, (rows, branches) each, in units of the largest one of a row,
    so that improbable survival does not underflow."""
    with np.errstate(divide="ignore"):
        logs = np.log(prior) + log_survival
    return np.exp(logs - logs.max(axis=(1, 2), keepdims=True)).transpose(1, 0, 2)


def _bounds_of_shares(low, high):
    """Returns bounds of w_i / sum of w, (rows, 2, branches), for all low <= w <= high: w_i is at one end, the others
    are at the other one. What is unknown is from 0 to 1."""
    others_low, others_high = (np.maximum(each.sum(axis=1, keepdims=True) - each, 0) for each in (low, high))
    return np.stack([np.divide(own, own + others, out=np.full(own.shape, unknown), where=own + others > 0)
                     for own, others, unknown in ((low, others_high, 0.0), (high, others_low, 1.0))], axis=1)


def _bounds_of_mean(low, high, values):
    """Returns bounds of sum of w v / sum of w, (rows, 2), for all low <= w <= high. At the upper one, the largest
    values have the high weights and the others the low ones; how many are the largest is found by trying all numbers.
    """
    def extreme(order, best):
        few, many, v = low[:, order], high[:, order], values[order]
        with np.errstate(invalid="ignore"):
            means = ((np.cumsum(many * v, axis=1) + _sums_after(few * v))
                     / (np.cumsum(many, axis=1) + _sums_after(few)))
        return best(means, axis=1)
    ascending = np.argsort(values)
    return np.stack([extreme(ascending, np.nanmin), extreme(ascending[::-1], np.nanmax)], axis=1)


def _sums_after(terms):
    """Returns the sum of all later terms of each row."""
    sums = np.cumsum(terms[:, ::-1], axis=1)[:, ::-1]
    return np.concatenate([sums[:, 1:], np.zeros((len(terms), 1))], axis=1)


def _interval(bounds):
    """Returns the interval of 95 % confidence of bounds (rows, 2, ...), from the lower ones to the upper ones."""
    return np.stack([np.quantile(bounds[1:, which], end, axis=0) for which, end in enumerate(ENDS)])


def _level_at(hazard, rate):
    """Returns the level that is exceeded at a rate; NaN outside the curve."""
    return np.exp(np.interp(-np.log(rate), -np.log(hazard.rate), np.log(hazard.level), np.nan, np.nan))


def _notes(hazards, weights, rate, best_survival, posterior):
    total = weights.sum()
    if abs(total - 1) > ROUNDING:
        yield f"the sum of the weights is {total:.4g}; they are divided by it"
    for i in np.flatnonzero(np.isinf(rate[1]))[:1]:
        yield (f"{np.isinf(rate[1]).sum()} of {len(hazards)} rates have no upper end, such as that of "
               f"\"{hazards[i].source}\": if the hazard continued below its first level as above it, weaker shaking "
               "would overturn more often than this level is exceeded. Check the first levels, or begin the hazard at "
               "a level that overturns nothing")
    if any(text_of(pair) != f"{pair[0]:.4g}" for pair in posterior.T):
        yield ("two numbers are bounds: points without a verdict, bins without points, and shaking outside the levels "
               "of a hazard curve are safe for one branch and overturn for the others")
    if best_survival.max() < IMPROBABLE:
        yield (f"no branch gives the survival a probability above {best_survival.max():.2g}: the weights compare "
               "branches that are all improbable. Check the ages, the fragility and what the branches have in common")


def is_list_of_branches(path: str | os.PathLike[str]) -> bool:
    """Whether a file is one for read_branches(): whether the first line that is no comment has a word `weight`.
    Raises OSError if it cannot be read."""
    _, header, _ = _rows_of(path)
    return "weight" in header


def read_branches(path: str | os.PathLike[str], *, im: str | None = None, units: str | None = None,
                  site: int | None = None) -> tuple[list[Hazard], NDArray[np.float64]]:
    """Reads the hazard curves of the branches of a logic tree, and their weights, from a CSV with a row for each
    branch. Lines that begin with # are comments. Columns:

    weight: of the branch.
    file: of its hazard curve, for read_hazard(), from the folder of the CSV; or rlz_id, the number of a realization of
        OpenQuake, whose file in this folder is called hazard_curve-rlz-000-PGA_1.csv if the CSV is realizations_1.csv,
        as OpenQuake exports both.
    name: of the branch, if it is not that of the file; of OpenQuake, branch_path.

    im, units, site: as for read_hazard(). If OpenQuake wrote curves of several measures, im chooses one.

    Raises ValueError with the place if a file is not understood, OSError if it cannot be read.
    """
    path = pathlib.Path(path)
    delimiter, header, rows = _rows_of(path)
    if "weight" not in header or not {"file", "rlz_id"} & {*header} or not rows:
        raise ValueError(f"{path} is no list of branches: a CSV with the columns weight and file, or weight and "
                         "rlz_id, and a row for each branch.")
    hazards, weights = [], []
    for place, row in rows:
        if len(row) != len(header):
            raise ValueError(f"{path}:{place}: {len(row)} values, but {len(header)} columns.")
        row = dict(zip(header, row))
        try:
            weights.append(float(row["weight"].replace(",", ".") if delimiter == ";" else row["weight"]))
        except ValueError:
            raise ValueError(f"{path}:{place}: weight = \"{row['weight']}\" is not a number.") from None
        file = path.parent / row["file"] if "file" in row else _file_of_realization(path, place, row["rlz_id"], im)
        try:
            hazard = read_hazard(file, im=im, units=units, site=site)
        except OSError as error:
            raise type(error)(error.errno, f"{error.strerror} (named in {path}:{place})", str(file)) from error
        hazards.append(dataclasses.replace(hazard, source=row.get("name") or row.get("branch_path") or file.stem))
    return hazards, np.array(weights)


def _rows_of(path):
    """Returns the delimiter of a CSV, the names of its columns, and its rows, each with the number of its line."""
    lines = [(place, line) for place, line in enumerate(
        pathlib.Path(path).read_text("utf-8-sig", errors="replace").splitlines(), 1) if line.strip() and line[0] != "#"]
    if not lines:
        return ",", [], []
    delimiter = max(",;\t", key=lines[0][1].count)
    rows = [(place, [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter))]) for place, line in lines]
    return delimiter, [name.lower() for name in rows[0][1]], rows[1:]


def _file_of_realization(path, place, number, im):
    """Returns the file of a realization of OpenQuake beside its list, realizations_1.csv."""
    calculation = path.stem.rpartition("_")[2]
    wanted = {im, *(name for name, (ours, _) in OPENQUAKE.items() if ours == im)}
    start, end = f"hazard_curve-rlz-{number.zfill(3)}-", f"_{calculation}.csv"
    found = {each.name.removeprefix(start).removesuffix(end): each for each in path.parent.glob(f"{start}*{end}")}
    chosen = {measure: file for measure, file in found.items() if im is None or measure in wanted}
    if len(chosen) == 1:
        return next(iter(chosen.values()))
    if not found:
        raise ValueError(f"{path}:{place}: there is no file \"{start}*{end}\" beside this list. Export the hazard "
                         "curves of the realizations (individual_rlzs = true in the job of OpenQuake).")
    raise ValueError(f"{path}:{place}: realization {number} has curves of {', '.join(sorted(found))}. Choose one of "
                     "them with im.")
