"""Hazard curves: the annual rate lambda(x) at which an intensity measure exceeds x at a site."""

from __future__ import annotations

import csv
import dataclasses
import os
import pathlib
import re
from typing import TYPE_CHECKING

import numpy as np

from overturn.arguments import number, numbers

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

# Other spellings of units of results, and units that are converted to them: the unit of results, the factor.
UNITS = {"m/s": ("m s-1", 1), "cm/s": ("m s-1", 0.01), "cm s-1": ("m s-1", 0.01), "%g": ("g", 0.01)}
# Measures of OpenQuake (openquake.hazardlib.imt): the name in results, and the unit of OpenQuake.
OPENQUAKE = {"PGA": ("pga", "g"), "PGV": ("pgv", "cm/s"), "IA": ("arias_intensity", "m/s"),
             "RSD": ("significant_duration", "s"), "RSD595": ("significant_duration", "s")}
MOST_SITES = 5  # named in a message
_TIME = re.compile(r"(?<!\w)investigation_time=([^,\s\"']+)")
_MEASURE = re.compile(r"(?<!\w)imt=[\"']+([^\"']+)")
_COLUMN = re.compile(r"[#%]\s*(\w[\w().]*)\s*\[([^\]]+)\]")
# What comments name if the numbers beside the levels are no annual rates; _ and - are blanks.
_PROBABILITY = re.compile(r"\b(probabilit(y|ies)|probs?|a?poe|p ?o ?e|aep)\b", re.IGNORECASE)
_PERIOD = re.compile(r"\b(return (period|interval|time)s?|recurrence (period|interval|time)s?|m?rp|mri|ari)\b",
                     re.IGNORECASE)
_YEARS = re.compile(r"\b(?:in|within|over|during|per|of) (?:any )?(\d+(?:\.\d+)?) ?(?:years?|yrs?|y|a)\b"
                    r"|\b(\d+(?:\.\d+)?) ?(?:years?|yrs?|y) (?:exceedance|hazard)", re.IGNORECASE)


@dataclasses.dataclass(frozen=True, eq=False)
class Hazard:
    """A hazard curve from two or more levels. Between two levels it is a power law, lambda = lambda_i (x / x_i)^-k_i,
    a straight line in logarithms. Raises ValueError unless levels are positive and ascend, and rates are positive and
    do not rise with the level."""

    level: NDArray[np.float64]  #: (levels,), of the intensity measure, in `units`
    rate: NDArray[np.float64]  #: (levels,), at which each level is exceeded [1/year]
    im: str  #: name of the intensity measure, as in Fragility
    units: str  #: of the intensity measure, as in Fragility; m/s, cm/s and %g are converted
    source: str = ""  #: of the numbers, for messages and pictures

    def __post_init__(self):
        units, factor = UNITS.get(self.units, (self.units, 1))
        for name, value in (("level", numbers("level", self.level) * factor), ("units", units),
                            ("rate", numbers("rate", self.rate))):
            object.__setattr__(self, name, value)
        where = f"{self.source}: " * bool(self.source)
        if self.level.ndim != 1 or self.level.shape != self.rate.shape or self.level.size < 2:
            raise ValueError(f"{where}levels have the shape {self.level.shape} and rates {self.rate.shape}. A hazard "
                             "curve has two or more levels and a rate for each.")
        for name, values in (("level", self.level), ("rate", self.rate)):
            for i in np.flatnonzero(~(np.isfinite(values) & (values > 0)))[:1]:
                raise ValueError(f"{where}{name}[{i}] = {values[i]:g} is not a positive number. Leave out levels that "
                                 "are never exceeded.")
        for i in np.flatnonzero(np.diff(self.level) <= 0)[:1]:
            raise ValueError(f"{where}level[{i + 1}] = {self.level[i + 1]:g} is not above level[{i}] = "
                             f"{self.level[i]:g}. Sort the levels in ascending order, each once.")
        for i in np.flatnonzero(np.diff(self.rate) > 0)[:1]:
            raise ValueError(f"{where}rate[{i + 1}] = {self.rate[i + 1]:g} is above rate[{i}] = {self.rate[i]:g}. A "
                             "higher level is not exceeded more often. Give rates of exceedance, not of occurrence.")

    @property
    def slope(self) -> NDArray[np.float64]:
        """k_i of each interval between two levels [1]."""
        return -np.diff(np.log(self.rate)) / np.diff(np.log(self.level))

    def at(self, x: ArrayLike) -> NDArray[np.float64]:
        """Returns the rate [1/year] at which x is exceeded, between the first and the last level; NaN elsewhere."""
        x = numbers("x", x)
        log_x = np.log(x, out=np.full(x.shape, -np.inf), where=x > 0)
        return np.exp(np.interp(log_x, np.log(self.level), np.log(self.rate), np.nan, np.nan))

    def scaled(self, *, rate: float = 1.0, level: float = 1.0) -> Hazard:
        """Returns the curve with its rates, its levels, or both multiplied by a factor."""
        return dataclasses.replace(self, rate=self.rate * number("rate", rate),
                                   level=self.level * number("level", level))


def read_hazard(path: str | os.PathLike[str], *, im: str | None = None, units: str | None = None,
                site: int | None = None) -> Hazard:
    """Reads a hazard curve from one of two kinds of files.

    Text of two columns: levels of the intensity measure and annual rates of exceedance, separated by blanks or a
    comma. Lines that begin with # or % are comments; the first with a bracket, such as "# pga [g]", names the measure
    and its unit. Without it, im and units are required. A comment that names probabilities, return periods or a number
    of years is refused, with the conversion to annual rates.

    The CSV output of OpenQuake's hazard curves (hazard_curve-mean-PGA_1.csv). Probabilities p of exceedance in the
    investigation time t become rates, -ln(1 - p) / t. Levels at the end that are never exceeded are left out.

    im, units: of a file that does not state them; units "g", "m/s" or "cm/s", or another text. For a measure of
        OpenQuake that results do not have, such as SA(0.3), im may be another name for it. PGA and PGV may be those
        of all directions, such as "pga_rotd50".
    site: row of the file, counted from 0, if it contains several sites.

    Raises ValueError with the place if the file is not understood or contradicts an argument, OSError if it cannot be
    read.
    """
    lines = pathlib.Path(path).read_text("utf-8-sig", errors="replace").splitlines()
    if any("poe-" in line or _TIME.search(line) for line in lines[:2]):
        return _from_openquake(os.fspath(path), lines, im, units, site)
    if site is not None:
        raise ValueError(f"site = {site}, but \"{path}\" has two columns, for one site. Omit the site.")
    return _from_text(os.fspath(path), lines, im, units)


def _from_text(path, lines, im, units):
    rows = []
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        if line.lstrip()[0] in "#%":
            _expect_rates(f"{path}:{number}", line.strip())
            continue
        try:
            level, rate = map(float, line.replace(",", " ").split())
        except ValueError:
            raise ValueError(f"{path}:{number}: \"{line.strip()[:40]}\" is not two numbers. A line contains a level "
                             "and an annual rate of exceedance.") from None
        rows.append((level, rate))
    stated = next(filter(None, map(_COLUMN.match, map(str.strip, lines))), None)
    im, units = _agreed(path, "measure", im, stated and stated[1]), _agreed(path, "unit", units, stated and stated[2])
    return Hazard(*np.array(rows).reshape(-1, 2).T, im, units, path)


def _expect_rates(where, comment):
    """Raises ValueError if a comment names other numbers than annual rates, such as "probability in 50 years"."""
    words = re.sub(r"[\s_-]+", " ", comment)
    years = _YEARS.search(words)
    span = years and (years[1] or years[2])
    if _PERIOD.search(words):
        what, conversion = "return periods", "rate = 1 / return period"
    elif _PROBABILITY.search(words) or span and float(span) != 1:
        what = "probabilities" + f" in {span} years" * bool(span)
        conversion = f"rate = -ln(1 - probability) / {span or 'years'}"
    else:
        return
    raise ValueError(f"{where}: the comment \"{comment[:60]}\" names {what}, but the second column must contain annual "
                     f"rates of exceedance [1/year]. Convert it, {conversion}; if it contains annual rates, remove the "
                     "comment.")


def _agreed(path, what, given, stated):
    if given is None and stated is None:
        raise ValueError(f"{path} does not state the {what} of its levels. Give im and units, or begin the file with a "
                         "line such as \"# pga [g]\".")
    if given is not None and stated is not None and UNITS.get(given, (given, 1)) != UNITS.get(stated, (stated, 1)):
        raise ValueError(f"{path} states the {what} {stated}, not {given}. Omit the argument, or correct it.")
    return stated if given is None else given


def _from_openquake(path, lines, im, units, site):
    time, measure = (pattern.search(lines[0]) for pattern in (_TIME, _MEASURE))
    header, *rows = csv.reader(line for line in lines[1:] if line.strip())
    first = next((i for i, name in enumerate(header) if name.startswith("poe-")), None)
    if not time or not measure or first is None or not rows:
        raise ValueError(f"{path} is not an output of hazard curves of OpenQuake, whose first line has "
                         "investigation_time and imt and whose second has columns such as poe-0.1. Export "
                         "\"Hazard Curves\" as csv.")
    if site is None and len(rows) == 1:
        site = 0
    if site is None or not 0 <= site < len(rows):
        sites = [f"{i} ({', '.join(row[:first])})" for i, row in enumerate(rows[:MOST_SITES])]
        raise ValueError(f"{path} has {len(rows)} sites ({', '.join(header[:first])}): {', '.join(sites)}"
                         f"{', ...' * (len(rows) > MOST_SITES)}. Choose one with site = 0 to {len(rows) - 1}.")
    try:
        levels = np.array([float(name.removeprefix("poe-")) for name in header[first:]])
        years, probability = float(time[1]), np.array(rows[site][first:], float)
    except ValueError as error:
        raise ValueError(f"{path}:{site + 3}: {error}. Export the file again.") from None
    for level, p in zip(levels, probability):
        if not 0 <= p < 1:
            raise ValueError(f"{path}:{site + 3}: the probability of exceeding {level:g} in {years:g} years is {p:g}. "
                             "A rate follows from 0 or more and less than 1 only. Compute the curve for fewer years.")
    if not years > 0:
        raise ValueError(f"{path}:1: investigation_time = {time[1]} is not positive. Export the file again.")
    exceeded = slice(0, np.count_nonzero(np.maximum.accumulate(probability[::-1])))
    name, unit = OPENQUAKE.get(measure[1], (measure[1], "g" if measure[1].startswith("SA(") else None))
    if im is not None and (measure[1] not in OPENQUAKE or im.startswith(f"{name}_rotd")):
        name = im
    return Hazard(levels[exceeded], -np.log1p(-probability[exceeded]) / years, _agreed(path, "measure", im, name),
                  _agreed(path, "unit", units, unit), path)
