"""What fragilities of one and of two intensity measures have in common: points in bins, and their table."""

from __future__ import annotations

import csv
import re
from typing import TYPE_CHECKING

import numpy as np

from overturn.block_groups import counted
from overturn.exceedance import Exceedance
from overturn.output_file import new_file

if TYPE_CHECKING:
    from numpy.typing import NDArray

COUNTS = ("points", "exceeding", "without_verdict")
COLUMNS = (*COUNTS, "fraction", "fraction_low", "fraction_high", "probability", "probability_low", "probability_high")
_SUMMARY = re.compile(r"# .* against [\w/]+ \[.*points with a verdict")
_HEADER = re.compile(r"([\w/]+)_from,\1_to,(([\w/]+)_from,\3_to,)?" + ",".join(COLUMNS))
_ROW = re.compile(f"[-+.0-9einfa]*(,[-+.0-9einfa]*){{{len(COLUMNS) + 1}}}(,[-+.0-9einfa]*,[-+.0-9einfa]*)?")


class Binned:
    """Of objects that have the fields of Fragility that count points."""

    @property
    def fraction(self) -> NDArray[np.float64]:
        """Exceeding points / points with a verdict per bin; NaN in a bin without any."""
        return np.divide(self.exceeding, self.points, out=np.full(self.points.shape, np.nan), where=self.points > 0)

    @property
    def exceedance(self) -> Exceedance:
        return Exceedance(self.of, self.above)

    def counts_text(self, against):
        blocks = counted(self.blocks, self.kind)
        if self.blocks > 1 or self.kind.endswith("directions"):
            blocks += " together" if self.together else " pooled"
        counts = f"{self.exceeding.sum()} of {self.points.sum()}"
        return (f"{self.exceedance.noun()} against {against}: {counts} points with a verdict, {self.motions} motions, "
                f"{blocks}; {self.undecided} undecided, {self.not_computed} not computed")

    def write_table(self, path, edges, probability, band):
        """Writes one row per bin, below the summary as comments that begin with #.

        edges: from and to of each bin, by the name of the measure. probability, band: of each bin, and the ends of its
        confidence; the bins are those of `points`, in the same order."""
        numbers = [self.fraction, *self.fraction_interval, probability, *band]
        rows = zip(zip(*(ends for pair in edges.values() for ends in pair)),
                   zip(*(getattr(self, name).ravel() for name in COUNTS)), zip(*(each.ravel() for each in numbers)))
        with new_file(path, "a table of a fragility curve", _is_own) as part, open(
                part, "w", newline="", encoding="utf-8") as file:
            file.writelines(f"# {line}\n" for line in self.summary().splitlines())
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow([*(f"{name}_{end}" for name in edges for end in ("from", "to")), *COLUMNS])
            writer.writerows([*(f"{end:.6g}" for end in ends), *counts,
                              *("" if np.isnan(number) else f"{number:.6g}" for number in numbers)]
                             for ends, counts, numbers in rows)


def numbers_text(names, values, intervals):
    """Returns a line for each value, with its interval if there is one."""
    return [f"{name} {value:.4g}" + (f" ({low:.4g} to {high:.4g})" if np.isfinite(low) else "")
            for name, value, (low, high) in zip(names, values, intervals)]


def _is_own(beginning):
    """Whether a file is what Binned.write_table() writes: a summary, the names of the columns, and rows of numbers."""
    lines = beginning.decode(errors="replace").split("\n")
    rows = [line for line in lines[:-1] if not line.startswith("#")]
    return (_SUMMARY.match(lines[0]) is not None and bool(rows) and _HEADER.fullmatch(rows[0]) is not None
            and all(_ROW.fullmatch(row) for row in rows[1:]))
