#!/usr/bin/env python3
"""Draws which ground motions topple a statue on a floor of a building, for buildings of different periods."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from overturn.installation import run_elsewhere

try:
    import numpy as np
    import overturn
    from matplotlib import pyplot
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch
    from overturn.output_file import save
    from overturn.regions import REGIONS, VERDICTS
    from overturn.tool import USAGE, ToolError, parse_with_picture, parser_of, run_tool
    from scipy.linalg import eigh
except ImportError as error:
    run_elsewhere(error)

EXAMPLE = """\
example:
  tools/examples/floors.py jobs/synthetic.AT2 -o floors.png

The building has three storeys and the mode shapes of docs/floors.md; the stiffness of all storeys is
varied. The upper panel shows the ground and the floor for the first period of that page. The lower one
shows what becomes of the statue on the floor, and the least acceleration that topples it on the ground."""

MASS = np.array([60.0, 60.0, 40.0])  # of the floors; only ratios matter
STOREY = np.array([30.0, 25.0, 20.0])  # stiffness of the storeys; only ratios matter
DAMPING = 0.05
FIRST_PERIOD = 0.602  # of the building of docs/floors.md [s]
STATUE = {"width": 0.5, "height": 2.0, "restitution_of_maximum": 0.9}  # [m]
PERIODS = np.geomspace(0.1, 2, 161)  # first periods [s]
PGA = np.linspace(0.005, 1.2, 240)  # [g]
COLOURS = {name: REGIONS[code][2] for code, name in VERDICTS.items()}
GROUND, FLOOR = "0.55", "#0b3c5d"


def modes_of_the_building():
    """Returns the periods over the first one [1], and (floors, modes): participation factor times mode shape [1]."""
    stiffness = np.diag(STOREY + [*STOREY[1:], 0]) - np.diag(STOREY[1:], 1) - np.diag(STOREY[1:], -1)
    squares, modes = eigh(stiffness, np.diag(MASS))
    return np.sqrt(squares[0] / squares), modes * (modes.T @ MASS)


def floor_of(record, first_period, shape):
    return overturn.floor_motion(record.acceleration, record.time_step, damping=DAMPING, shape=shape,
                                 periods=first_period * modes_of_the_building()[0])


def verdicts(motion, scale):
    return overturn.evaluate(**STATUE, record=motion.acceleration, time_step=motion.time_step, scale=scale)["verdict"]


def draw(record, floor, output):
    shape = modes_of_the_building()[1][floor - 1]
    figure, (above, below) = pyplot.subplots(2, 1, figsize=(7.2, 7.6), layout="constrained", height_ratios=(2, 3))
    motions = {f"floor {floor}, T = {FIRST_PERIOD:g} s": (floor_of(record, FIRST_PERIOD, shape), FLOOR),
               "ground": (record, GROUND)}
    for name, (motion, colour) in motions.items():
        t = np.arange(motion.acceleration.size) * motion.time_step
        above.plot(t, motion.acceleration, color=colour, linewidth=0.8, label=name)
    lift = STATUE["width"] / STATUE["height"]
    above.axhline(lift, color="black", linestyle=":", linewidth=1, label=f"lifts the statue, {lift:g} g")
    above.axhline(-lift, color="black", linestyle=":", linewidth=1)
    above.set(xlim=(0, record.time_step * record.acceleration.size), xlabel="time [s]", ylabel="acceleration [g]")
    above.legend(fontsize=8, loc="upper right")

    scale = PGA / abs(record.acceleration).max()
    codes = np.stack([verdicts(floor_of(record, period, shape), scale) for period in PERIODS], axis=1)
    below.pcolormesh(PERIODS, PGA, codes, cmap=ListedColormap(list(COLOURS.values())), vmin=-0.5, vmax=2.5,
                     shading="nearest", rasterized=True)
    entries = [Patch(facecolor=colour, label=f"{name} on floor {floor}")
               for code, (name, colour) in enumerate(COLOURS.items()) if (codes == code).any()]
    toppling = PGA[verdicts(record, scale) == overturn.Verdict.OVERTURNS]
    if toppling.size:
        entries.append(below.axhline(toppling[0], color="black", linestyle="--",
                                     label=f"least that topples it on the ground, {toppling[0]:.2f} g"))
    below.set(xscale="log", xlabel="first period T of the building [s]", ylabel="PGA of the ground [g]")
    below.set_xticks([0.1, 0.2, 0.5, 1, 2], ["0.1", "0.2", "0.5", "1", "2"])
    below.legend(handles=entries, fontsize=8, loc="upper left")
    figure.suptitle(f"Statue of {STATUE['width']:g} m x {STATUE['height']:g} m on floor {floor} of 3", fontsize=11)
    save(figure, output, dpi=130)


def main():
    parser = parser_of("floors.py", __doc__, EXAMPLE)
    parser.add_argument("file", metavar="RECORD", help="ground motion, such as jobs/synthetic.AT2; not a text")
    parser.add_argument("--floor", type=int, choices=(1, 2, 3), default=2, help="counted from below (default: 2)")
    arguments = parse_with_picture(parser, None, "FILE_floors.png")
    try:
        record = overturn.read_record(arguments.file)
    except ValueError as error:
        raise ToolError(str(error), USAGE) from error
    draw(record, arguments.floor, arguments.output)


if __name__ == "__main__":
    run_tool("floors.py", main)
