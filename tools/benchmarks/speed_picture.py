"""The speed picture: the cost of accuracy with each solver, and the cost per point for planes of
different sizes."""

import json
import pathlib

from building import fail

EXPLANATION = """\
Plots bench_peers.json and bench_run.json, written by `tools/bench peers` and `tools/bench run`:
time per point versus error for every solver, and time per point of a whole run versus the number
of points."""

LABELS = {
    "overturn_rk45": "overturn, rk45", "overturn_taylor": "overturn, taylor",
    "odeint_dopri5": "Boost.odeint dopri5", "gsl_rk8pd": "GSL rk8pd",
    "arkode_dopri5": "SUNDIALS ARKODE dopri5", "cvode_adams": "SUNDIALS CVODE Adams",
    "scipy_rk45": "SciPy RK45", "heyoka_taylor": "heyoka.py, batches",
}
OURS = {"overturn_rk45": "#1b6ca8", "overturn_taylor": "#c8422b"}
PEERS = "#767676"
RAISED = {"arkode_dopri5": 5, "cvode_adams": -5, "gsl_rk8pd": 3, "heyoka_taylor": -3}  # labels that would overlap [points]
COMPARED_AT = 1e-9  # [rad]
MARKERS = {"odeint_dopri5": "o", "gsl_rk8pd": "s", "arkode_dopri5": "^", "cvode_adams": "v",
           "scipy_rk45": "D", "heyoka_taylor": "P"}


def add_arguments(parser):
    parser.add_argument("--peers", type=pathlib.Path, default=pathlib.Path("bench_peers.json"),
                        help="output of `tools/bench peers` (default: bench_peers.json)")
    parser.add_argument("--run", type=pathlib.Path, default=pathlib.Path("bench_run.json"),
                        dest="whole_run",
                        help="output of `tools/bench run` (default: bench_run.json)")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("speed.png"),
                        help="the picture (default: speed.png)")


def read(path):
    try:
        return json.loads(path.read_text())
    except OSError as error:
        fail(f"{error}. Run `tools/bench peers` and `tools/bench run` first to write these files.")


def draw_peers(axes, found):
    for solver, label in LABELS.items():
        rows = [row for row in found["records"]
                if row["solver"] == solver and row["us_per_point"]]
        if not rows:
            continue
        errors = [row["achieved_p99"] for row in rows]
        times = [row["us_per_point"] for row in rows]
        ours = solver in OURS
        axes.plot(errors, times, color=OURS.get(solver, PEERS), linewidth=2.4 if ours else 1.2,
                  marker="o" if ours else MARKERS[solver], markersize=6 if ours else 4.5)
        tightest = min(range(len(errors)), key=errors.__getitem__)
        ratio = next((row["ratio_to_overturn_taylor"] for row in rows
                      if row["target_error"] == COMPARED_AT), None)
        if ratio and not ours:
            label += f": {ratio:,.0f} x"
        axes.annotate(label, (errors[tightest], times[tightest]), (7, RAISED.get(solver, 0)),
                      textcoords="offset points", va="center", fontsize=8.5,
                      color=OURS.get(solver, "#333333"), weight="bold" if ours else "normal")
    axes.set(xscale="log", yscale="log", xlim=(4e-6, 1e-18), ylim=(0.05, 1e5),
             xlabel="error of angle and velocity, 99th percentile [rad]",
             ylabel="time per point on one core [µs]")
    axes.set_xticks([1e-6, 1e-9, 1e-12])
    axes.minorticks_off()
    axes.set_title("Time to compute the same motions at the same error", fontsize=11)
    axes.text(0.985, 0.985, "grey: general solvers of differential equations\n"
              "x: times as long as taylor, at an error of 1e-9", transform=axes.transAxes,
              fontsize=8, ha="right", va="top", color="#333333")


def draw_sizes(axes, found):
    for method in ("rk45", "taylor"):
        rows = [row for row in found["one_rank"] if row["method"] == method]
        points = [row["side"]**2 for row in rows]
        times = [row["us_per_point"] for row in rows]
        axes.plot(points, times, color=OURS[f"overturn_{method}"], linewidth=2.4, marker="o")
        axes.annotate(method, (points[-1], times[-1]), (8, 0), textcoords="offset points",
                      va="center", fontsize=8.5, weight="bold", color=OURS[f"overturn_{method}"])
    axes.set(xscale="log", yscale="log", xlim=(100, 2e8),
             xlabel="points of the plane", ylabel="wall time of the whole run per point [µs]")
    axes.minorticks_off()
    axes.set_title("Cost of a whole run, from start to exit", fontsize=11)


def run(options):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    peers, whole_run = read(options.peers), read(options.whole_run)
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11.5, 4.6),
                                            gridspec_kw={"width_ratios": [1.35, 1]})
    draw_peers(left, peers)
    draw_sizes(right, whole_run)
    for axes in (left, right):
        axes.grid(color="#dddddd", linewidth=0.6)
        axes.set_axisbelow(True)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
    machine = peers["machine"]
    figure.text(0.995, 0.005, f"{machine['cpu']}, kernel {machine['kernel']}, "
                f"{machine['compiler']}", ha="right", fontsize=7, color="#666666")
    figure.tight_layout()
    figure.savefig(options.output, dpi=120)
    print(f"written: {options.output}")
