"""The fill benchmark: time of filled spectra against the number of points on a side, beside that of
spectra of which every point is integrated."""

import math
import pathlib
import statistics

from building import SOURCE, add_output_argument, write_results
from launching import add_program_argument, measured_run, program

EXPLANATION = """\
Runs the nine planes of the paper (jobs/figure_*.toml, region only) with and without numerics.fill,
on one rank, and prints the time in the kernel and that of the whole run with file and audit. Above
--direct points a side, the time without filling is extrapolated from that at --direct, in
proportion to the number of points. Then fits the exponent: time grows as side^exponent. Plots the
times."""

SIDES = (512, 1024, 2048, 4096, 8192, 16384)


def add_arguments(parser):
    add_program_argument(parser)
    parser.add_argument("--sides", type=int, nargs="+", default=SIDES,
                        help="points of the frequency and of the amplitude axis")
    parser.add_argument("--direct", type=int, default=4096,
                        help="largest side at which every point is integrated (default: 4096)")
    parser.add_argument("--audit", type=float, default=1e-3,
                        help="share of the filled points that is integrated as well (default: 1e-3)")
    parser.add_argument("--jobs", nargs="+", type=pathlib.Path,
                        default=sorted((SOURCE / "jobs").glob("figure_*.toml")),
                        help="the planes (default: those of the paper)")
    add_output_argument(parser, "bench_fill.json", "; the picture has the same name and ends in .png")


def measured(overturn, job, side, *settings):
    """Seconds in the kernel, of writing, and of the whole run."""
    wall, sidecar = measured_run(overturn, side, ['output.fields=["region"]', *settings],
                                 job=job.resolve())
    return {"kernel": sum(rank["compute_seconds"] for rank in sidecar["ranks"]),
            "writing": sum(rank["write_seconds"] for rank in sidecar["ranks"]), "run": wall}


def compared(overturn, job, options):
    filling = ("numerics.fill=true", f"numerics.audit={options.audit}")
    direct = {side: measured(overturn, job, side)
              for side in options.sides if side <= options.direct}
    last = max(direct)
    rows = []
    for side in options.sides:
        by_area = {key: value * (side / last)**2 for key, value in direct[last].items()}
        rows.append({"job": job.stem, "side": side, "filled": measured(overturn, job, side, *filling),
                     "direct": direct.get(side, by_area), "direct_is_measured": side in direct})
        filled, every = rows[-1]["filled"], rows[-1]["direct"]
        print(f"{job.stem:12}{side:>7}{filled['kernel']:>10.3f} s{filled['writing']:>8.3f} s"
              f"{filled['run']:>9.3f} s{every['kernel']:>13.3f} s{every['run']:>10.3f} s"
              f"{every['kernel'] / filled['kernel']:>9.1f}{every['run'] / filled['run']:>7.1f}"
              f"{'' if side in direct else '  (direct: by area)'}", flush=True)
    return rows


def exponent(rows, side):
    """The slope of log(time) over log(side) by least squares, from `side` on."""
    points = [(math.log(row["side"]), math.log(row["filled"]["kernel"]))
              for row in rows if row["side"] >= side]
    return statistics.linear_regression(*zip(*points)).slope if len(points) > 1 else math.nan


def plot(rows, path):
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    for kind, colour in (("direct", "#767676"), ("filled", "#1b6ca8")):
        for what, style in (("kernel", "-"), ("run", "--")):
            sides = sorted({row["side"] for row in rows})
            means = [statistics.mean(row[kind][what] for row in rows if row["side"] == side)
                     for side in sides]
            axes.loglog(sides, means, style, color=colour, marker="o", markersize=3,
                        label=f"{'filled' if kind == 'filled' else 'every point integrated'}, "
                              f"{'kernel' if what == 'kernel' else 'whole run'}")
    axes.set_xticks(sides, [str(side) for side in sides])
    axes.minorticks_off()
    axes.set_xlabel("points on a side")
    axes.set_ylabel("mean time of a plane, one rank [s]")
    axes.legend(frameon=False)
    figure.savefig(path, dpi=150)


def run(options):
    import matplotlib  # before the runs: if it is missing, the command starts again elsewhere
    matplotlib.use("Agg")
    overturn = program(options)
    print(f"{'plane':12}{'side':>7}{'kernel':>12}{'writing':>10}{'run':>11}{'direct kernel':>15}"
          f"{'run':>12}{'ratio':>9}{'run':>7}")
    rows = []
    for job in options.jobs:
        rows += (mine := compared(overturn, job, options))
        print(f"{job.stem:12} time in the kernel grows as side^{exponent(mine, 1024):.2f} from 1024 on")
    for side in options.sides:
        ratios = [row["direct"]["kernel"] / row["filled"]["kernel"]
                  for row in rows if row["side"] == side]
        print(f"{side:>6} points a side: {statistics.mean(ratios):.1f} times faster in the kernel "
              f"(mean; {min(ratios):.1f} to {max(ratios):.1f})")
    write_results(options.output, {"benchmark": "fill", "rows": rows})
    plot(rows, options.output.with_suffix(".png"))
    print(f"written: {options.output.with_suffix('.png')}")
