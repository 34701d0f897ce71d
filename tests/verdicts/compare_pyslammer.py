#!/usr/bin/env python3
"""compare_pyslammer.py PYTHON: the slide of a block that never rocks, under four published records, beside the rigid
block of pySLAMMER, which PYTHON must have (PyPI: pyslammer). It integrates in steps of the record, so that the
difference must fall when the record is resampled to a quarter and to a sixteenth of its step, to less than 0.1 %.
Requires OVERTURN_RECORDS and the package on PYTHONPATH."""

import json
import math
import os
import pathlib
import subprocess
import sys
import warnings

import numpy as np

import overturn

RECORDS = ("WTMC.V2A", "APEEL2_43.smc", "cosmos/*.V2c", "knet/*.EW")
FRICTION, INCLINE, SIDE = 0.3, 0.15, 2.0
PGA = 0.46  # [g]: it slides downhill only, as the block of pySLAMMER does
DIVISIONS = (1, 4, 16)  # of a time step

PEER = """
import json, sys
import numpy, pyslammer
for name, motion in json.load(sys.stdin).items():
    found = pyslammer.RigidAnalysis(motion["yield"], pyslammer.GroundMotion(
        numpy.array(motion["acceleration"]), motion["step"]))
    print(name, float(found.max_sliding_disp))
"""


def peer_slides(python, record, scale):
    """The displacements that pySLAMMER finds. Along the base, the acceleration is larger by cos + mu sin."""
    times = np.arange(len(record.acceleration))
    motions = {}
    for parts in DIVISIONS:
        fine = np.arange((len(times) - 1) * parts + 1) / parts
        motions[str(parts)] = {"yield": math.tan(math.atan(FRICTION) - INCLINE), "step": record.time_step / parts,
                               "acceleration": (-scale * np.interp(fine, times, record.acceleration)).tolist()}
    done = subprocess.run([python, "-c", PEER], input=json.dumps(motions), text=True, check=True, capture_output=True)
    along = math.cos(INCLINE) + FRICTION * math.sin(INCLINE)
    return [along * float(line.split()[1]) for line in done.stdout.splitlines()]


def main():
    folder = pathlib.Path(os.environ.get("OVERTURN_RECORDS") or sys.exit("OVERTURN_RECORDS is not set"))
    warnings.simplefilter("ignore", UserWarning)  # the mirror image is not computed
    passed = True
    for pattern in RECORDS:
        path = sorted(folder.glob(pattern))[0]
        record = overturn.read_record(path)
        scale = PGA / abs(record.acceleration).max()
        slide = float(overturn.evaluate(width=SIDE, height=SIDE, incline=INCLINE, friction=FRICTION, scale=scale,
                                        record=record.acceleration, time_step=record.time_step, gravity=9.80665,
                                        restitution_of_maximum=1.0, fields=["slide"])["slide"]) * SIDE / math.sqrt(2)
        differences = [abs(peer / slide - 1) for peer in peer_slides(sys.argv[1], record, scale)]
        good = differences[-1] < 1e-3 and differences[-1] <= max(differences[0], 1e-4)
        passed = passed and good
        print(f"{path.name}: slides {slide:.6f} m; pySLAMMER differs by "
              + ", ".join(f"{each:.1e}" for each in differences) + ("" if good else ": FAILED"))
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
