"""Plots an accuracy study: error and share of wrong verdicts against time per point."""

import numpy as np
from matplotlib import pyplot
from overturn.captions import ground_text, plain, title_of
from overturn.output_file import save
from overturn.plot.headings import wrapped
from overturn.result_file import STUDY, open_result
from overturn.ticks import name_ticks
from overturn.tool import ToolError, parse_with_picture, parser_of

EXAMPLE = """\
example:
  overturn accuracy jobs/figure_07a.toml -o accuracy.h5
  tools/plot_accuracy accuracy.h5                # draws accuracy.png

Left, work-precision curves: the error of the margin against time per point, one marker per
tolerance; of blocks with friction, also that of the final slide over R. Right, the share of wrong
verdicts; the lowest level means none."""

METHODS = ("rk45", "taylor")  # as numbered in the file
# Markers and dashes distinguish the methods in greyscale and for colour-blind readers.
COLOURS = {"rk45": "#1b6ca8", "taylor": "#c8422b"}
MARKERS = {"rk45": "o", "taylor": "s"}
QUANTILE = 0.99
ERRORS = {"margin_error": "error of the margin", "slide_error": "error of the slide over R"}


class Curve:
    """One method, resolved or not, from its loosest tolerance to its tightest."""

    def __init__(self, file, method, resolve):
        self.method, self.resolve = METHODS[method], resolve
        chosen = (file["method"][:] == method) & (file["resolve"][:] == resolve)
        order = np.argsort(-file["tolerance"][:][chosen])
        quantile = int(np.argmin(np.abs(file["quantile"][:] - QUANTILE)))

        def column(values):
            return values[chosen][order]

        self.tolerance = column(file["tolerance"][:])
        self.time = column(file["seconds_per_point"][:]) * 1e6
        self.errors = {name: column(file[name][:, quantile]) for name in ERRORS if name in file}
        self.wrong = column(file["wrong_verdicts"][:]) / file.attrs["points_settled"]

    @property
    def label(self):
        return f"{self.method}, resolved" if self.resolve else self.method

    def style(self):
        return {"color": COLOURS[self.method], "marker": MARKERS[self.method], "markersize": 5.5,
                "linestyle": (0, (4, 2)) if self.resolve else "-",
                "markerfacecolor": "white" if self.resolve else COLOURS[self.method],
                "linewidth": 1.6, "label": self.label}


def read_curves(file):
    curves = [Curve(file, method, resolve)
              for resolve in (False, True) for method in range(len(METHODS))]
    return [curve for curve in curves if len(curve.time)]


def name_tolerances(axes, curve, values, upwards):
    """Labels every third tolerance next to its marker, of equal values the last one."""
    named = list(zip(curve.tolerance, curve.time, values))[::3]
    for (tolerance, time, value), following in zip(named, [*named[1:], (0, 0, 0)]):
        if np.isfinite(value) and value > 0 and value != following[2]:
            axes.annotate(f"1e{round(np.log10(tolerance))}", (time, value),
                          (5, 5) if upwards else (-5, -6), textcoords="offset points",
                          ha="left" if upwards else "right", va="bottom" if upwards else "top",
                          fontsize=7.5, color=COLOURS[curve.method])


def draw_order(axes, curve, errors):
    """Draws the slope of a method of order 5: five decades of error per decade of time."""
    time, error = curve.time[-4], errors[-4]
    span = np.array([time / 4, time])
    axes.plot(span * 1.25, error * (span / time)**-5.0, color="0.45", linewidth=1, linestyle=":",
              label="slope of order 5")


def draw_errors(axes, curves, name):
    for curve in curves:
        errors = curve.errors[name]
        shown = np.isfinite(errors) & (errors > 0)
        axes.plot(curve.time[shown], errors[shown], **curve.style())
        if not curve.resolve:
            name_tolerances(axes, curve, errors, curve.method == "rk45")
    for curve in curves:
        # Blocks that slip are not integrated by rk45.
        if curve.method == "rk45" and not curve.resolve and len(curve.time) > 4 and len(curve.errors) == 1:
            draw_order(axes, curve, curve.errors[name])
    axes.set(xscale="log", yscale="log", xlabel="time per point on one core [µs]",
             ylabel=f"{ERRORS[name]}, {100 * QUANTILE:g}th percentile")
    axes.legend(frameon=False, fontsize=8.5)


def draw_wrong_verdicts(axes, curves, points):
    """Plots the share of wrong verdicts; zero is drawn below the least share of the sample."""
    least = 1 / points
    none = least / 4
    for curve in curves:
        values = np.where(curve.wrong > 0, curve.wrong, none)
        axes.plot(curve.time, values, **curve.style())
        if not curve.resolve:
            name_tolerances(axes, curve, np.where(curve.wrong > 0, curve.wrong, np.nan),
                            curve.method == "rk45")
    axes.axhline(least / 2, color="0.7", linewidth=0.8)
    axes.set(xscale="log", yscale="log", xlabel="time per point on one core [µs]",
             ylabel="share of wrong verdicts")
    axes.set_ylim(bottom=none / 2.5)
    decades = [10.0**i for i in range(0, -12, -1) if 10.0**i >= least]
    axes.set_yticks([none] + decades, ["none"] + [f"1e{round(np.log10(d))}" for d in decades])
    axes.minorticks_off()
    axes.set_title(f"Wrong verdicts among {points:,} points", fontsize=11)


def draw(file):
    if not file.attrs["points_settled"] or not file.attrs["points_in_50_digits"]:
        raise ToolError(f"\"{file.filename}\" has no point whose verdict and end state are known: "
                        "there is no reference to compare with.")
    curves = read_curves(file)
    errors = curves[0].errors
    figure, panels = pyplot.subplots(1, len(errors) + 1, figsize=(1.5 + 5 * (len(errors) + 1), 4.9))
    for axes, name in zip(panels, errors):
        draw_errors(axes, curves, name)
    panels[0].set_title("What accuracy costs", fontsize=11)
    draw_wrong_verdicts(panels[-1], curves, int(file.attrs["points_settled"]))
    for axes in panels:
        axes.grid(color="#dddddd", linewidth=0.6)
        axes.set_axisbelow(True)
        axes.margins(x=0.1)  # for the names of tolerances
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
        name_ticks(axes.xaxis)
    title = wrapped(plain(title_of(file) or ground_text(file)), 12, 11)
    figure.suptitle("\n".join(title), fontsize=12, x=0.02, ha="left")
    figure.tight_layout()
    return figure


def read_arguments(argv):
    parser = parser_of("plot_accuracy", __doc__, EXAMPLE, "overturn accuracy")
    return parse_with_picture(parser, argv)


def main(argv=None):
    arguments = read_arguments(argv)
    with open_result(arguments.file, STUDY) as file:
        figure = draw(file)
    save(figure, arguments.output, dpi=120)
