"""Plots the annual rate at which blocks overturn at a site: the hazard curve, the fragility curve, and the shaking that
contributes to the rate."""

from __future__ import annotations  # types of modules that need SciPy, which other pictures do not

import argparse
import pathlib
import textwrap
from typing import NamedTuple

import numpy as np
import overturn
from matplotlib import pyplot
from overturn.block_groups import each_block
from overturn.captions import escaped, plain, shortened
from overturn.motion_words import variable_of_ground
from overturn.output_file import save
from overturn.plot.logic_trees import branches
from overturn.plot.fragility_curves import BAND, COLOURS, POINT, draw_bins, measure_text
from overturn.plot.headings import place_legend_above, wrapped
from overturn.ranges import confidence, table, text_of
from overturn.result_curves import add_curve_arguments, compute_curve, open_dataset
from overturn.ticks import name_ticks
from overturn.tool import USAGE, ToolError, parse_with_picture, parser_of

EXAMPLE = """\
example:
  tools/synthetic_record --suite 50 -o jobs/suite    # writes 50 synthetic records
  overturn run jobs/suite/fragility.toml             # writes fragility.h5
  printf '# pga [g]\\n0.01 0.1\\n0.1 0.01\\n1 1e-4\\n10 1e-8\\n' > hazard.txt
  tools/plot_risk fragility.h5 hazard.txt            # draws fragility_risk.png

HAZARD is a text of two columns, levels of an intensity measure and annual rates at which they are exceeded, whose
first line names the measure and its unit, or a CSV output of hazard curves of OpenQuake, such as
hazard_curve-mean-PGA_1.csv. The fragility is computed against the measure of the hazard.

A list of branches of a logic tree is a CSV with the columns weight and file, of each hazard curve, or
realizations_1.csv of OpenQuake beside its curves of the realizations. The blocks that have survived then change the
weights: posterior = prior survival / sum of prior survival.

rate = integral of P(x) |d lambda(x)|, of the fragility P and the hazard lambda; survival over T years = exp(-rate T),
and its mean over the distribution of T if the age is uncertain.
Two numbers, as in "2e-4 to 3e-4", are a lower and an upper bound: points without a verdict are all safe or all
overturn, and shaking outside the levels of the hazard contributes the least or the most that it can. The 95 %
confidence is from the bootstrap of the fragility; that of the hazard is not included.

Without --together, the rate is that of a block chosen anew at random at each shaking.

The numbers as arrays, other fragilities and two intensity measures: overturn.risk in Python."""

BARS = 30
UPPER = "#e3b58e"
SAFE = ", points without a verdict safe"
TEXT_WIDTH = 105  # characters that fit below the panels
DEFAULT_YEARS = 10000


def risk(hazard, fragility, years=DEFAULT_YEARS, *, title=None):
    """Draws a hazard curve, a fragility (overturn.risk) and the rate of overturning in equal steps of the logarithm of
    the intensity, and returns the three axes. What the bounds of the rate leave open is written below them."""
    found = overturn.risk.annual_rate(hazard, fragility, edges=np.geomspace(*hazard.level[[0, -1]], BARS + 1))
    figure, panels = pyplot.subplots(3, 1, sharex=True, figsize=(6.4, 8.8), layout="constrained")
    draw_hazard(panels[0], hazard)
    draw_fragility(panels[1], hazard, fragility)
    draw_contributions(panels[2], found)
    for panel in panels:
        panel.grid(color="0.9")
        panel.set_axisbelow(True)
    panels[0].set(xscale="log", xlim=hazard.level[[0, -1]])
    name_ticks(panels[2].xaxis)
    panels[2].set_xlabel(measure_text(hazard.im, hazard.units))
    notes = [line for note in found.notes for line in textwrap.wrap(note, TEXT_WIDTH)]
    figure.supxlabel(escaped("\n".join(notes)), fontsize=8, x=0.02, ha="left")
    numbers = found.summary(years).splitlines()[:2]
    lines = [line for text in ([title] if title else []) + numbers for line in wrapped(text, 10, 6.1)]
    figure.suptitle("\n".join(lines), fontsize=10, x=0.02, ha="left")
    return panels


def draw_hazard(ax, hazard):
    ax.plot(hazard.level, hazard.rate, "o-", color=COLOURS[0], markersize=3.5)
    ax.set(yscale="log", ylabel="rate of exceedance [1/year]")
    ax.set_title(escaped(shortened(f"hazard: {pathlib.Path(hazard.source).name}", 60)), fontsize=9)


def draw_fragility(ax, hazard, fragility):
    x = np.geomspace(*hazard.level[[0, -1]], 300)
    bounds = overturn.risk.probability_of(fragility).at(x)
    if len(bounds) > 1:
        low, high = np.quantile(bounds[1:, 0], 0.025, axis=0), np.quantile(bounds[1:, 1], 0.975, axis=0)
        ax.fill_between(x, low, high, color=BAND, linewidth=0, label="95 % confidence")
    is_open = bool((bounds[0, 0] < bounds[0, 1]).any())
    if is_open:
        ax.fill_between(x, *bounds[0], color=UPPER, linewidth=0, label="up to: if they overturn")
    ax.plot(x, bounds[0, 0], color=COLOURS[0], linewidth=2, label="fragility" + SAFE * is_open)
    what = "a block overturns"
    if isinstance(fragility, overturn.Fragility):
        draw_bins(ax, fragility, POINT, "o", "full")
        one, several = ("an object", "objects") if fragility.kind.startswith("objects") else ("a block", "blocks")
        what = f"{f'one of the {several}' if fragility.together else one} {fragility.exceedance.verb()}"
    ax.set(ylim=(-0.03, 1.03), ylabel="probability")
    ax.set_title(f"fragility: {what}", fontsize=9)
    place_legend_above(ax, 4)


def draw_contributions(ax, found):
    edges, (low, high) = found.edges[1:-1], found.contribution[:, 1:-1]
    if (low < high).any():
        ax.stairs(high, edges, fill=True, color=UPPER, label="up to: if they overturn")
    ax.stairs(low, edges, fill=True, color=COLOURS[1],
              label="contribution of each range" + SAFE * bool((low < high).any()))
    ax.set_ylabel("rate of overturning [1/year]")
    ax.set_ylim(0, 1.25 * np.max(high, initial=1e-300))  # with room for the legend
    ax.ticklabel_format(axis="y", scilimits=(-2, 3), useMathText=True)
    ax.legend(fontsize=8)


def duration(word):
    years = float(word)
    if not 0 < years < np.inf:
        raise argparse.ArgumentTypeError(f"{word} is not a positive number of years.")
    return years


def probability(word):
    value = float(word)
    if not 0 < value < 1:
        raise argparse.ArgumentTypeError(f"{word} is not between 0 and 1. Give a probability such as 0.05.")
    return value


def read_arguments(argv):
    parser = parser_of("plot_risk", __doc__, EXAMPLE, "overturn run under records")
    parser.add_argument("hazard", metavar="HAZARD",
                        help="hazard curve: text of two columns, or CSV of OpenQuake; or a list of branches")
    parser.add_argument("--im", metavar="MEASURE",
                        help="measure of a text that does not name it, or one of those whose curves OpenQuake wrote: pga, "
                             "pgv, arias_intensity or significant_duration")
    parser.add_argument("--im-units", metavar="UNIT", help="unit of a text that does not name it: g, m/s or cm/s")
    parser.add_argument("--site", type=int, metavar="N", help="row of a hazard of several sites, counted from 0")
    add_age_arguments(parser)
    parser.add_argument("--survival", type=probability, metavar="P",
                        help="also print the largest factors on the hazard with which the blocks survive these years "
                             "with the probability P")
    add_curve_arguments(parser, 20, "; prints also the rate of each alone")
    parser.add_argument("--csv", metavar="OUT.csv", help="of a list of branches: also write the weights")
    arguments = parse_with_picture(parser, argv, "FILE_risk.png")
    if arguments.years is not None and (arguments.years_interval or arguments.years_samples):
        parser.error("--years and a distribution without it: omit --years, or give its --years-sigma")
    if arguments.years_sigma and arguments.years is None:
        parser.error("--years-sigma is the standard deviation of --years. Give both")
    return arguments


def add_age_arguments(parser):
    parser.add_argument("--years", type=duration, metavar="T",
                        help=f"for which the blocks have stood (default: {DEFAULT_YEARS})")
    spread = parser.add_mutually_exclusive_group()
    spread.add_argument("--years-sigma", type=duration, metavar="S",
                        help="standard deviation of --years, which are then the mean of a normal distribution")
    spread.add_argument("--years-interval", type=duration, nargs=2, metavar=("LOW", "HIGH"),
                        help="in place of --years: 95 %% of a lognormal distribution of the years are in this interval")
    spread.add_argument("--years-samples", metavar="FILE",
                        help="in place of --years: text with a sample of the years in each line or, in two columns, "
                             "years and their weights")


def age_of(arguments):
    """Returns the time for which the blocks have stood."""
    ages = overturn.risk.Age
    if arguments.years_samples:
        return overturn.risk.read_age(arguments.years_samples)
    if arguments.years_interval:
        return ages.interval(*arguments.years_interval)
    if arguments.years_sigma:
        return ages.normal(arguments.years, arguments.years_sigma)
    return ages.samples(arguments.years or DEFAULT_YEARS)


class Site(NamedTuple):
    """What the arguments tell: hazard curves, with weights if they are branches; the fragility of the blocks, and that
    of each alone if they stand together."""

    title: str
    age: overturn.risk.Age
    hazards: list
    weights: object
    curve: overturn.Fragility
    alone: dict


def compute(arguments):
    """Returns the Site."""
    from overturn.logic_tree import is_list_of_branches  # needs SciPy
    how = {"im": arguments.im, "units": arguments.im_units, "site": arguments.site}
    try:
        age = age_of(arguments)
        if is_list_of_branches(arguments.hazard):
            hazards, weights = overturn.risk.read_branches(arguments.hazard, **how)
        else:
            hazards, weights = [overturn.risk.read_hazard(arguments.hazard, **how)], None
    except OSError as error:
        raise ToolError(f"cannot read \"{error.filename}\": {error.strerror}.") from error
    except ValueError as error:
        raise ToolError(str(error), USAGE) from error
    for option, is_for_branches in (("survival", False), ("csv", True)):
        if getattr(arguments, option) is not None and is_for_branches != (weights is not None):
            raise ToolError(f"--{option}: \"{arguments.hazard}\" is {'no' if is_for_branches else 'a'} list of "
                            "branches. Omit it.", USAGE)
    with open_dataset(arguments.file) as dataset:
        im = variable_of_ground(dataset.attrs, hazards[0].im)
        curve = compute_curve(dataset, im, arguments)
        overturn.risk.probability_of(curve)  # refuses what has no rate, before each block alone
        alone = {name: compute_curve(block, im, arguments)
                 for name, block in (each_block(dataset, arguments.together).items() if curve.together else ())}
        title = dataset.attrs.get("title") or f"Risk: {pathlib.Path(arguments.file).name}"
        return Site(plain(title), age, hazards, weights, curve, alone if len(alone) > 1 else {})


def report(arguments, site):
    """Returns the numbers as lines."""
    hazard, age = site.hazards[0], site.age
    measures = ("rate", "level") if arguments.survival is not None else ()
    lines, rows = [site.curve.summary()], [[site.curve.together, "rate [1/year]", "survival",
                                            *(f"factor on {on}s" for on in measures)]]
    for name, curve in {"all together": site.curve, **site.alone}.items():
        found = overturn.risk.annual_rate(hazard, curve)
        factors = [overturn.risk.largest_factor(hazard, curve, age, arguments.survival, on) for on in measures]
        pairs = [(found.rate, found.interval), (found.survival(age), found.survival_interval(age)), *factors]
        rows.append([name, *(text_of(bounds) + confidence(interval, "") for bounds, interval in pairs)])
        if curve is site.curve:
            lines += [found.summary(age), *(
                f"largest factor on the {on}s of the hazard, survival of {age.text} with the probability "
                f"{arguments.survival:g}: {factor.text()}" for on, factor in zip(measures, factors))]
    return [*lines, *(table(rows) if site.alone else ()), *notes_of_each(site)]


def notes_of_each(site):
    return [f"{name}: {note}" for name, curve in site.alone.items() for note in curve.notes
            if note not in site.curve.notes]


def report_of_branches(site, updated):
    """Returns the numbers as lines."""
    lines = [site.curve.summary(), updated.summary()]
    if site.alone:
        each = {"all together": updated, **{name: updated_by(site, curve) for name, curve in site.alone.items()}}
        rows = [["branch", *updated.names], *([name, *one.weight_texts()] for name, one in each.items())]
        lines += ["posterior weights by each block alone:",
                  *table(rows if len(site.alone) > len(site.hazards) else [*zip(*rows)])]
    return lines + notes_of_each(site)


def updated_by(site, curve):
    return overturn.risk.updated_weights(site.hazards, site.weights, curve, site.age)


def main(argv=None):
    arguments = read_arguments(argv)
    site = compute(arguments)
    try:
        if site.weights is None:
            lines = report(arguments, site)
            panels = risk(site.hazards[0], site.curve, site.age, title=site.title)
        else:
            updated = updated_by(site, site.curve)
            lines = report_of_branches(site, updated)
            panels = branches(updated, title=site.title)
    except ValueError as error:
        raise ToolError(str(error), USAGE) from error
    print("\n".join(lines))
    if arguments.csv:
        updated.to_csv(arguments.csv)
        print(arguments.csv)
    save(panels[0].figure, arguments.output, dpi=150)
