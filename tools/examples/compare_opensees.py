#!/usr/bin/env python3
"""Compares overturn with OpenSees: one block at 20 scales of a record and at 20 amplitudes of a one-sine pulse, with
several settings of OpenSees."""

import importlib.metadata
import json
import pathlib
import platform
import sys
import time
import warnings

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from overturn.installation import run_elsewhere

try:
    import numpy as np
    import overturn
    from opensees_block import FALLEN, GRAVITY, HEIGHT, WIDTH, Setting, analyse
    from overturn.output_file import write_picture, write_text
    from overturn.regions import REGIONS, STANDS, TOPPLES
    from overturn.tool import parser_of
except ImportError as error:
    run_elsewhere(error)

EPILOG = """\
Needs openseespy, in a Python for which the module of overturn was built:

    /usr/bin/python3 -m venv --system-site-packages venv
    venv/bin/pip install openseespy

Writes OUT.json, the result of every point, and OUT.png; prints a table. Times are processor times of one core. Takes
about a quarter of an hour.

The restitution r of a setting is measured in OpenSees: the block rocks freely after a pulse, and r is the mean energy
ratio of successive half-cycles. overturn then computes the same points with this r, or with r_max
if r could not be measured."""

SLENDERNESS = np.arctan(WIDTH / HEIGHT)  # alpha [rad]
LARGEST_RESTITUTION = (1 - 1.5 * np.sin(SLENDERNESS) ** 2) ** 2  # r_max [1]
RECORD = pathlib.Path(__file__).resolve().parents[2] / "jobs/synthetic.AT2"
PULSE_PERIOD, PULSE_SAMPLES = 0.8, 400  # [s], [1]
PULSE_END, DECAY_END, RECORD_END = 4.8, 8.0, 22.0  # ends of the analyses [s]; the record ends at 20 s
GROUNDS = {"record": ("scale of the record", np.linspace(0.95, 1.33, 20)),
           "pulse": ("peak acceleration of the pulse [g]", np.linspace(0.30, 0.94, 20))}
WEAK_PULSES = np.arange(0.34, 0.2, -0.01)  # before a free decay [g]; the first with a peak below 0.9 alpha is used
LEAST_PEAK = 0.1  # of a half-cycle of the decay, over alpha: lower ones depend on the flexible contact [1]
VERDICTS = {"safe": REGIONS[STANDS][2], "overturns": REGIONS[TOPPLES][2], "not converged": "#b8b8bf"}  # and colours

SETTINGS = [
    Setting("reference: step 0.00005 s, 10^10 N/m", 5e-5, 1e10),
    Setting("step 0.0001 s", 1e-4),
    Setting("step 0.0005 s", 5e-4),
    Setting("step 0.001 s"),
    Setting("step 0.005 s", 5e-3),
    Setting("step 0.01 s", 1e-2),
    Setting("10^8 N/m", stiffness=1e8),
    Setting("10^7 N/m", stiffness=1e7),
    Setting("damping 5 %", damping=0.05),
    Setting("damping 2 %", damping=0.02),
    Setting("damping of initial stiffness", initial=True),
    Setting("HHT 0.7, no damping", damping=0, integrator=("HHT", 0.7)),
    Setting("tolerance 10^-5", tolerance=1e-5),
    Setting("two springs", contact="springs"),
    Setting("20 fibres", contact="fibres", fibres=20),
    Setting("200 fibres", contact="fibres", fibres=200)]


def one_sine(amplitude):
    return amplitude * np.sin(np.linspace(0, 2 * np.pi, PULSE_SAMPLES + 1)), PULSE_PERIOD / PULSE_SAMPLES


def measured_restitution(ops, setting):
    """Returns the energy ratios r of successive half-cycles of a free decay that are above LEAST_PEAK."""
    for amplitude in WEAK_PULSES:
        tilt, converged = analyse(ops, setting, *one_sine(amplitude), DECAY_END)
        if converged and abs(tilt).max() < 0.9 * SLENDERNESS:
            free = tilt[round(PULSE_PERIOD / setting.time_step):]
            parts = np.split(free, np.flatnonzero(np.diff(np.sign(free))) + 1)[1:-1]
            peaks = np.array([abs(part).max() for part in parts])
            peaks = peaks[peaks > LEAST_PEAK * SLENDERNESS]
            energy = np.cos(SLENDERNESS - peaks) - np.cos(SLENDERNESS)
            return energy[1:] / energy[:-1]
    return np.array([])


def by_opensees(ops, setting, motions, end):
    """Returns verdict (0 safe, 1 overturns, 2 not converged) and peak / alpha of each point, and the time per point
    [s]."""
    began, points = time.process_time(), [analyse(ops, setting, *motion, end) for motion in motions]
    return {"verdict": [int(abs(tilt[-1]) > FALLEN) if converged else 2 for tilt, converged in points],
            "peak": [float(abs(tilt).max() / SLENDERNESS) for tilt, _ in points],
            "seconds": (time.process_time() - began) / len(points)}


def by_overturn(record, name, restitution, strengths):
    """The same by overturn (2: undecided)."""
    ground = ({"record": record.acceleration, "time_step": record.time_step, "scale": strengths} if name == "record"
              else {"pulse": "one_sine", "pulse_period": PULSE_PERIOD, "pga": strengths})
    began = time.process_time()
    outcome = overturn.evaluate(width=WIDTH, height=HEIGHT, restitution=restitution, resolve=True, gravity=GRAVITY,
                                **ground)
    return {**{key: outcome[key].tolist() for key in ("verdict", "peak")},
            "seconds": (time.process_time() - began) / len(strengths)}


def compare(ops, record):
    """Returns a row for each setting: its restitution and, of each ground, the points of both programs."""
    scaled = [(scale * record.acceleration, record.time_step) for scale in GROUNDS["record"][1]]
    motions = {"record": (scaled, RECORD_END), "pulse": ([one_sine(pga) for pga in GROUNDS["pulse"][1]], PULSE_END)}
    for setting in SETTINGS:
        ratios = measured_restitution(ops, setting).tolist()
        restitution = min(float(np.mean(ratios)), 1.0) if ratios else LARGEST_RESTITUTION
        yield {"setting": setting.name, "ratios": ratios, "restitution": restitution, **{
            name: {"opensees": by_opensees(ops, setting, *motions[name]),
                   "overturn": by_overturn(record, name, restitution, strengths)}
            for name, (_, strengths) in GROUNDS.items()}}


def differing(verdicts, others):
    """Returns the number of verdicts that differ, of analyses that converged."""
    return sum(one != other for one, other in zip(verdicts, others) if one != 2)


def table_row(row, reference):
    """Returns the cells of a row; of the last four, those of the record come first."""
    ratios, pairs = row["ratios"], [(row[name], reference[name]["opensees"]) for name in GROUNDS]
    cells = [row["setting"], f"{row['restitution']:.3f} ({min(ratios):.3f} to {max(ratios):.3f})" if ratios else "none"]
    for cell in (lambda mine, other: differing(mine["opensees"]["verdict"], mine["overturn"]["verdict"]),
                 lambda mine, other: differing(mine["opensees"]["verdict"], other["verdict"]),
                 lambda mine, other: mine["opensees"]["verdict"].count(2),
                 lambda mine, other: f"{mine['opensees']['seconds']:.2g}"):
        cells.append(", ".join(str(cell(*pair)) for pair in pairs))
    return "| " + " | ".join(cells) + " |"


def summary(row, record):
    """Prints how well the peaks of a setting agree, and how sensitive the verdicts of overturn are to r."""
    for name, (_, strengths) in GROUNDS.items():
        theirs, ours = row[name]["opensees"], row[name]["overturn"]
        safe = np.array(theirs["verdict"]) + ours["verdict"] == 0
        difference = abs(np.array(theirs["peak"]) - ours["peak"])[safe]
        limits = [by_overturn(record, name, r, strengths)["verdict"] for r in (min(row["ratios"]), max(row["ratios"]))]
        print(f"{name}: {safe.sum()} safe in both, peak / alpha differs by {np.median(difference):.4f} (median), "
              f"{difference.max():.4f} (largest), "
              f"{(np.array(theirs['peak'])[safe] > 1).sum()} with a peak above alpha; {differing(*limits)} verdicts of "
              f"overturn differ between the least and the largest r; {1e6 * ours['seconds']:.0f} us per point")


def draw(rows, record, path):
    """Draws peak / alpha by overturn and by the first setting; below, the verdicts of each setting."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import colors, pyplot
    from matplotlib.patches import Patch
    shades = colors.ListedColormap(list(VERDICTS.values()))
    figure, axes = pyplot.subplots(2, 2, figsize=(11, 8), layout="constrained", sharex="col", sharey="row")
    for (above, below), (name, (label, strengths)) in zip(axes.T, GROUNDS.items()):
        half = (strengths[1] - strengths[0]) / 2
        fine = np.linspace(strengths[0] - half, strengths[-1] + half, 2001)
        curve, theirs = by_overturn(record, name, rows[0]["restitution"], fine), rows[0][name]["opensees"]
        falls = np.array(curve["verdict"]) == 1
        above.fill_between(fine, 0, 1, where=falls, step="mid", color=VERDICTS["overturns"], alpha=0.35, linewidth=0,
                           transform=above.get_xaxis_transform(), label="overturns, overturn")
        above.plot(fine, np.where(falls, np.nan, curve["peak"]), color="0.3", linewidth=1, label="safe, overturn")
        for verdict, marker, word in ((0, "o", "safe"), (1, "^", "overturns")):
            chosen = np.array(theirs["verdict"]) == verdict
            above.plot(strengths[chosen], np.minimum(theirs["peak"], 1.7)[chosen], marker, color="#0b3c5d",
                       markersize=5, label=f"{word}, OpenSees (reference)")
        above.set_ylim(0, 1.8)
        below.imshow([row[name]["opensees"]["verdict"] for row in rows], cmap=shades, vmin=0, vmax=2,
                     aspect="auto", extent=(fine[0], fine[-1], len(rows) - 0.5, -0.5))
        below.plot(*np.transpose([(x, i) for i, row in enumerate(rows) for x, one, other in zip(
            strengths, *(row[name][program]["verdict"] for program in ("opensees", "overturn")))
            if one not in (2, other)]), "kx", markersize=5,
            label="below: differs from overturn")
        below.set(xlim=(fine[0], fine[-1]), xlabel=label, yticks=range(len(rows)),
                  yticklabels=[row["setting"] for row in rows])
    axes[0, 0].set_ylabel("largest |θ| / α")
    axes[0, 1].legend(handles=[*above.get_legend_handles_labels()[0], *(
        Patch(facecolor=colour, edgecolor="0.5", label=f"below: {verdict}, OpenSees")
        for verdict, colour in VERDICTS.items()), below.lines[0]], loc="lower right", framealpha=0.95)
    write_picture(figure, path, dpi=130)


def main():
    parser = parser_of("compare_opensees.py", __doc__, EPILOG)
    parser.add_argument("-o", "--output", metavar="OUT", default="opensees", help="default: %(default)s")
    arguments = parser.parse_args()
    try:
        import openseespy.opensees as ops
    except ImportError as error:
        sys.exit(f"compare_opensees.py: {error}; --help tells how to install it")
    ops.logFile("/dev/null", "-noEcho")  # a step that does not converge is divided, not reported
    warnings.simplefilter("ignore", UserWarning)  # r above r_max
    record, rows = overturn.read_record(RECORD), []
    for row in compare(ops, record):
        rows.append(row)
        print(table_row(row, rows[0]), flush=True)
    write_text(arguments.output + ".json", json.dumps(rows), "a comparison",
               lambda beginning: beginning.startswith(b'[{"setting":'))
    summary(rows[0], record)
    print("Python", platform.python_version(), "OpenSeesPy", importlib.metadata.version("openseespy"))
    draw(rows, record, arguments.output + ".png")


if __name__ == "__main__":
    main()
