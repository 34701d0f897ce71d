"""Plots the history of one block over time: under a pulse the ground, angle, velocity, acceleration
and q; under a record the ground and the tilt; and the friction coefficient that the contact needs."""

from __future__ import annotations

import json
import re
from types import SimpleNamespace

import numpy as np
from matplotlib import pyplot
from overturn.captions import (file_name, ground_text, ground_word, is_linear, is_recorded, plain, slenderness_text,
                               title_of)
from overturn.motion_words import worded
from overturn.output_file import save
from overturn.plot import curves
from overturn.plot.headings import Heading
from overturn.regions import REGIONS, UNDECIDED, meaning_of
from overturn.result_file import HISTORY, damage_reported, open_result
from overturn.spectrum_planes import EQUIVALENTS, JOB, PHYSICAL
from overturn.tables import RATES, SIZES, STRENGTHS
from overturn.ticks import name_ticks
from overturn.tool import ToolError, parse_with_picture, parser_of
from overturn.units import add_units_argument, expect_size, factor_of, powers_of, size_of

EXAMPLE = """\
example:
  overturn history jobs/figure_07a.toml --at frequency=3,amplitude=1.5 -o history.h5
  tools/plot_history history.h5                  # draws history.png
  tools/plot_history history.h5 --until 8        # the first 8/p
  overturn history jobs/synthetic.toml --at scale=1,size=1 --samples 20000 -o recorded.h5
  tools/plot_history recorded.h5 --from 4 --until 12   # from 4 s to 12 s
  tools/plot_history tilt.h5 --units physical    # in seconds and degrees

Grey: duration of the pulse or record. Yellow: the block slips. Thin lines, or ticks under a record: impacts. Dashed:
|theta| = alpha, where the block balances on an edge, and the limits of velocity and q of an upright
block that does not overturn. The curves connect the samples of the file: with too few samples,
peaks of a record are missed."""

INK = "#1f3b57"
LIMIT = "#c8422b"
COLOURS = (INK, *curves.COLOURS[2:])  # of several tilts in the same axes
TILT = "tilt"
SLIPS = "#f3d9a4"
MARKS = {"uplift": ("^", "uplift"), "rest": ("s", "at rest"), "fall": ("X", "fall")}
MOST_IMPACT_LINES = 60
LIMITS = {"angle": r"$|\theta| = \alpha$: balance on an edge",  # meaning of the dashed lines
          "friction_demand": "coefficient of friction"}
LIMITS_OF_UPRIGHT = "limits for an upright block that does not overturn"

# Variable, axis label, share of the height.
PULSE_PANELS = (
    ("ground", r"ground  $\ddot u_g/g$", 0.6),
    ("angle", r"angle  $\theta$ [rad]", 1.3),
    ("velocity", r"velocity  $\theta'$ [rad]", 1),
    ("acceleration", r"acceleration  $\theta''$ [rad]", 1),
    ("q", r"$q$ [rad$^2$]", 1),
    ("friction_demand", "friction  $|H|/N$", 0.8),
    ("slide", "slide  $[R]$", 1),
)
RECORD_PANELS = (("ground", r"ground  $\ddot u_g/g$", 1), ("angle", r"tilt  $\theta/\alpha$", 1.6),
                 ("friction_demand", "friction  $|H|/N$", 0.8), ("slide", "slide  $[R]$", 1))
PHYSICAL_LABELS = {"ground": "ground [g]", "angle": "tilt [degrees]", "velocity": "velocity [degrees/s]",
                   "acceleration": "acceleration [degrees/s²]", "q": "$q$ [degrees²/s²]",
                   "friction_demand": "friction  $|H|/N$", "slide": "slide [mm]"}
# Attribute, symbol, unit of the point, in the order of the picture.
AXES = (("frequency", r"$\omega_p/p$", ""), ("amplitude", r"$a_p/(g\,{threshold})$", ""),
        ("pulse_period", "period", " s"), ("pulse_frequency", "frequency", " Hz"),
        ("scale", "scale", ""), ("pga", "PGA", " g"),
        ("size", "$R$", " m"), ("frequency_parameter", "$p$", " 1/s"))


def slendernesses(file):
    """Returns the attributes with alpha of the block, or of its sides plus and minus."""
    sides = ("slenderness_plus", "slenderness_minus")
    return sides if sides[0] in file.attrs else ("slenderness",)


def of_standing(friction, angle, sides):
    """Returns the friction until the block last passes alpha: later it has overturned. Where it would leave the ground,
    there is no number."""
    stands = np.flatnonzero((-sides[-1] <= angle) & (angle <= sides[0]))
    needed = np.where(np.isfinite(friction), friction, np.nan)
    needed[stands[-1] + 1 if len(stands) else 0:] = np.nan
    return needed


def slipping(modes):
    """Whether the block slips, by samples with the codes of `mode`."""
    return (modes == 1) | (modes == 3)


class History:
    """The contents of the file between two times. Times are in 1/p and angles in rad. Under a record, times are
    in seconds and angles are divided by alpha; in physical units, they are in seconds and degrees."""

    def __init__(self, file, start, until, units=JOB):
        self.is_recorded = is_recorded(file)
        panels = RECORD_PANELS if self.is_recorded else PULSE_PANELS
        has_friction = not is_linear(file)
        self.panels = [panel for panel in panels if panel[0] in file
                       and (panel[0] != "friction_demand" or has_friction)]
        self.is_in_seconds = self.is_recorded or units == PHYSICAL
        sides = [float(file.attrs[name]) for name in slendernesses(file)]
        slenderness = sides[0]
        per_time = float(file.attrs["frequency_parameter"]) if self.is_in_seconds else 1
        per_angle = slenderness if self.is_recorded else 1
        if len(sides) > 1 and self.is_recorded:
            self.panels = [(name, label.replace(r"\alpha", r"\alpha_+"), share) for name, label, share in self.panels]
        if units == PHYSICAL:
            self.panels = [(name, PHYSICAL_LABELS[name], share) for name, _, share in self.panels]
            per_angle = np.radians(1)
        self.panels = [(name, worded(file.attrs, label), share) for name, label, share in self.panels]
        time = file["time"][:] / per_time
        shown = (time >= start) & (time <= until)
        self.start, self.time = start, time[shown]
        if not len(self.time):
            unit = " s" if self.is_in_seconds else "/p"
            raise ToolError(f"\"{file.filename}\" has no data from {start:g}{unit} to "
                            f"{until:g}{unit}.")
        rate = per_time / per_angle
        size = 1000 * file.attrs[size_of(file)] if units == PHYSICAL and "slide" in file else 1  # [mm]
        self.values = {name: factor_of(powers_of(file, name), 1 / per_angle, per_time, size) * file[name][:][shown]
                       for name, _, _ in self.panels}
        self.slips = slipping(file["mode"][:])[shown] if "mode" in file else np.zeros(len(self.time), bool)
        if has_friction and not self.slips.any():
            self.values["friction_demand"] = of_standing(self.values["friction_demand"], file["angle"][:][shown], sides)
        events = file.events()
        self.events = [(when, kind, angle) for when, kind, angle in zip(
            events["time"] / per_time, events["kind"], events["angle_after"] / per_angle)
            if start <= when <= self.time[-1]]
        self.alphas = -sides[-1] / per_angle, slenderness / per_angle
        self.has_two_sides = len(sides) > 1
        self.largest_rate = rate * (slenderness if is_linear(file) else 2 * np.sin(slenderness / 2))
        self.end_of_ground_motion = float(file.attrs["end_of_pulse"]) / per_time
        self.friction = float(file.attrs["friction"]) if "friction" in file.attrs else None

    def impacts(self):
        return [when for when, kind, _ in self.events if kind == "impact"]

    def limits(self, name):
        """Returns the values of the dashed lines."""
        if self.has_two_sides and name not in ("angle", "friction_demand"):
            return ()  # they are those of one side
        return {"angle": self.alphas, "friction_demand": [self.friction] * (self.friction is not None),
                "velocity": (-self.largest_rate, self.largest_rate),
                "q": (0, self.largest_rate**2)}.get(name, ())


def curves_in(axes):
    """Returns the tilts in axes of a caller."""
    return [line for line in axes.lines if str(line.get_gid()).startswith(TILT)]


def draw_panel(axes, history, name, label, /, **curve):
    """Draws a quantity; `curve` are properties of its line."""
    values = history.values[name]
    axes.axvspan(0, min(history.end_of_ground_motion, history.time[-1]), color="#eeeeee", zorder=0)
    impacts = history.impacts()
    if len(impacts) <= MOST_IMPACT_LINES and not history.is_recorded:
        for when in impacts:
            axes.axvline(when, color="0.75", linewidth=0.6, zorder=1)
    linewidth = 0.7 if name in ("ground", "friction_demand") and history.is_recorded else 1.3
    if name in ("friction_demand", "slide") and history.slips.any():
        axes.fill_between(history.time, 0, 1, where=history.slips, transform=axes.get_xaxis_transform(),
                          color=SLIPS, linewidth=0, zorder=0.5, label="the block slips" if name == "slide" else None)
    axes.plot(history.time, values, **{"color": INK, "linewidth": linewidth, "zorder": 3, **curve})
    known = values[np.isfinite(values)] if np.isfinite(values).any() else np.zeros(1)
    spread = np.ptp(known) or 1
    low, high = known.min() - 0.08 * spread, known.max() + 0.08 * spread
    dashed = {"color": LIMIT, "linewidth": 0.9, "linestyle": (0, (4, 3))}
    shown = [limit for limit in history.limits(name)
             if low - spread <= limit <= high + spread]  # a distant limit would flatten the curve
    for limit in shown:
        axes.axhline(limit, zorder=2, label=LIMITS.get(name, LIMITS_OF_UPRIGHT), **dashed)
        low, high = min(low, limit - 0.08 * spread), max(high, limit + 0.08 * spread)
    axes.axhline(0, color="0.6", linewidth=0.6, zorder=1)
    axes.set_ylim(low, high)
    axes.set_ylabel(label, fontsize=9)
    axes.tick_params(labelsize=8)
    name_ticks(axes.yaxis)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def explain(axes, **place):
    """Adds a legend of all that has a label; of curves, if there are several."""
    entries = {label: handle for handle, label in zip(*axes.get_legend_handles_labels())
               if handle not in curves_in(axes) or len(curves_in(axes)) > 1}
    if entries:
        axes.legend(entries.values(), entries, fontsize=8, handletextpad=0.4, **place)


def mark_events(axes, history):
    """Marks uplift, rest and overturning on the curve of the angle. Under a record, impacts are ticks below it, because
    they are often too many for lines."""
    for kind, (marker, name) in MARKS.items():
        points = [(when, angle) for when, what, angle in history.events if what == kind]
        if points:
            axes.plot(*zip(*points), linestyle="none", marker=marker, markersize=6,
                      markerfacecolor="white", markeredgecolor=LIMIT, zorder=4, clip_on=False, label=name)
    impacts = history.impacts()
    count = len(impacts)
    if count:
        many = count > MOST_IMPACT_LINES and not history.is_recorded
        label = f"{count} impact{'s' * (count > 1)}{', too many to mark' * many}"
        if history.is_recorded:
            low, high = axes.get_ylim()
            axes.set_ylim(low - 0.08 * (high - low), high)
            axes.plot(impacts, np.full(count, 0.04), transform=axes.get_xaxis_transform(), color="0.35",
                      linestyle="none", marker="|", markersize=7, markeredgewidth=0.6, label=label)
        else:
            axes.plot([], [], color="0.75", linewidth=0.8, label=label)


def word_of_record(file, key):
    """Returns a text in `scene.record` of the resolved job; empty if there is none."""
    found = re.search(rf'^record = .*\b{key} = ("(?:[^"\\]|\\.)*")', file.job_text("job_resolved"), re.MULTILINE)
    return json.loads(found[1]) if found else ""


def motion_words(file):
    """Returns what determines the ground motion besides its scale and its time: the record, its components, and the
    direction if it is not that of the record or pulse."""
    words, second, direction = [], "", float(file.attrs.get("direction", 0))
    if is_recorded(file):
        first, second, vertical = (file_name(word_of_record(file, key))
                                   for key in ("component", "second_component", "vertical"))
        words = [ground_text(file)]
        if second:
            words += [f"components {first or 1} and {second}"]
        elif first:
            words += [f"component {first}"]
        words += [f"vertical motion {vertical}"] * bool(vertical)
    if second or direction:
        words += [f"direction {direction:g}°" + " (mirrored)" * (direction == 180 and not second)]
    return words


def point_of(file, units):
    """Returns the names of the quantities of the point: of each kind the first, which is the one that the job gives."""
    kinds = (STRENGTHS, SIZES) if is_recorded(file) else (RATES, STRENGTHS)
    given = [next(name for name in file.attrs if name in kind) for kind in kinds]
    if is_recorded(file):
        return given
    return [*(EQUIVALENTS.get(name, name) if units == PHYSICAL else name for name in given),
            *["frequency_parameter"] * ("frequency_parameter" in file.attrs)]


def number_text(name, value):
    """Returns a value in up to seven digits if the job gives no more; otherwise in four, but a strength in seven,
    because the verdict may flip within four."""
    full = f"{value:.7g}"
    return full if float(full) == value or name in STRENGTHS else f"{value:.4g}"


def is_certain(file):
    """Whether the true motion is that of the curve, which is in double precision."""
    return bool(file.attrs["curve_is_certain"])


def point_words(file, units=JOB):
    """Returns the quantities of the point, with their values."""
    attributes, shown = file.attrs, point_of(file, units)
    threshold = r"\alpha" if is_linear(file) else r"\tan\alpha"
    return {name: f"{worded(attributes, symbol).replace('{threshold}', threshold)} = "
                  f"{number_text(name, attributes[name])}{unit}" for name, symbol, unit in AXES if name in shown}


def describe(file, units=JOB):
    """Returns the point and its outcome in one line."""
    attributes = file.attrs
    region = int(attributes["region"])
    is_decided = region in REGIONS and region != UNDECIDED
    outcome = f"{meaning_of(region, ground_word(file))} ({REGIONS[region][0]})" if is_decided else "undecided"
    if not is_certain(file):
        outcome += "; the curve is uncertain"
    point = point_words(file, units)
    if "frequency_parameter_minus" in attributes and "frequency_parameter" in point:
        minus = attributes["frequency_parameter_minus"]
        point["frequency_parameter"] += f" (+), $p$ = {minus:.4g} 1/s (−)"
    alpha = ", ".join((slenderness_text(attributes[name], units) if units == PHYSICAL
                       else rf"$\alpha$ = {attributes[name]:.4g} rad") + side
                      for name, side in zip(slendernesses(file), (" (+)", " (−)") if len(slendernesses(file)) > 1
                                            else ("",)))
    return ("".join(word + ", " for word in [*(plain(word, 60) for word in motion_words(file)), *point.values()]) +
            rf"{alpha}, $r$ = {attributes['restitution']:.4g}"
            + (rf", $\mu$ = {attributes['friction']:.4g}" if "friction" in attributes else "") + ": "
            f"{outcome}")


def name_time(panel, file, history):
    unit = "[s]" if history.is_in_seconds else r"$\tau = p\,t$"
    panel.set_xlabel(f"time since the start of the {ground_word(file)}  {unit}", fontsize=9)
    panel.set_xlim(history.start, history.time[-1] if history.time[-1] > history.start else history.start + 1)


def draw_figure(file, history, units):
    title = title_of(file, ("plane", "block")) or ground_text(file)
    words = Heading(plain(title), describe(file, units), 8.72, (11, 9))
    height = (5.4 if history.is_recorded else 9.2) + words.extra + 1.3 * sum(
        name in history.values for name in ("friction_demand", "slide"))
    figure, panels = pyplot.subplots(len(history.panels), 1, sharex=True, figsize=(9, height),
                                     height_ratios=[share for _, _, share in history.panels])
    for axes, (name, label, _) in zip(panels, history.panels):
        draw_panel(axes, history, name, label)
        axes.yaxis.set_label_coords(-0.075, 0.5)
        if name == "angle":
            mark_events(axes, history)
        explain(axes, loc="lower right", bbox_to_anchor=(1, 0.98), borderpad=0, frameon=False,
                ncols=len(MARKS) + 2)
    name_time(panels[-1], file, history)
    words.write(figure, 0.18, (0.21, 0.3956))
    figure.subplots_adjust(left=0.1, right=0.975, top=1 - (0.598 + words.extra) / height, bottom=0.506 / height,
                           hspace=0.14)
    return figure


def draw(path, arguments, ax=None):
    """Draws the tilt into the given axes, or without them a figure. Returns the axes."""
    with open_result(path, HISTORY) as file, damage_reported(file.filename, ValueError):
        expect_size(file, arguments.units)
        shown = History(file, arguments.start, arguments.until, arguments.units)
        if ax is None:
            return draw_figure(file, shown, arguments.units).axes
        label = next(label for name, label, _ in shown.panels if name == "angle")
        number = len(curves_in(ax))
        before = [ax.get_xlim(), ax.get_ylim()] if number else []
        draw_panel(ax, shown, "angle", label, color=COLOURS[number % len(COLOURS)], gid=f"{TILT} {number}",
                   label=", ".join(point_words(file, arguments.units).values()))
        mark_events(ax, shown)
        if not is_certain(file):
            ax.plot([], [], linestyle="none", label="the curve is uncertain")
        name_time(ax, file, shown)
        for set_limits, limits, new in zip((ax.set_xlim, ax.set_ylim), before, (ax.get_xlim(), ax.get_ylim())):
            set_limits(min(*limits, *new), max(*limits, *new))
        explain(ax)
        return ax


def history(result, *, start: float = 0, until: float = np.inf, units: str = "job", ax=None):
    """Draws the motion of a block, as tools/plot_history does.

    result: the path of a file, or the whole data set that overturn.open() returned for it. start, until: times
    [1/p]; under a record or in physical units [s]. units: "job", or "physical" for s and degrees. ax:
    axes of Matplotlib to draw the tilt into, with a legend, beside the tilts that they have.

    Returns a list of axes, from the ground motion down, or ax. Raises overturn.ToolError."""
    return draw(result, SimpleNamespace(start=start, until=until, units=units), ax)


def read_arguments(argv):
    parser = parser_of("plot_history", __doc__, EXAMPLE, "overturn history")
    parser.add_argument("--until", type=float, metavar="TIME", default=np.inf,
                        help="last time to draw [1/p]; under a record or in physical units [s]")
    parser.add_argument("--from", dest="start", type=float, metavar="TIME", default=0,
                        help="first time to draw, in the same unit (default: 0)")
    add_units_argument(parser, "time in s, angles in degrees, PGA in g")
    return parse_with_picture(parser, argv)


def main(argv=None):
    arguments = read_arguments(argv)
    save(draw(arguments.file, arguments)[0].figure, arguments.output, dpi=120)
