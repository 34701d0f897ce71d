"""The sliding benchmark: what the key `friction` costs."""

import json
import pathlib
import statistics
import subprocess
import tempfile

from building import add_output_argument, run_or_fail, write_results
from launching import add_program_argument, program

EXPLANATION = """\
Times planes of 128 x 128 points of a box of 0.6 m x 1.8 m with rk45 at 1e-9, and of 16 x 128 points
under a synthetic record, in turns: without the key friction, with the field friction_demand, and with
coefficients at which nothing slips, all that moves slides flat, or most of what rocks slips. Medians of
the time in the kernel, on one rank, over that of the field region alone."""

PLANES = {
    "pulse": ('pulse = "one_sine"', "frequency = {{ first = 1.5, last = 11, count = {count} }}\n"
              "amplitude = {{ first = 1.2, last = 9, count = {count} }}"),
    "record": ('record = "{jobs}/synthetic.AT2"', "size = {{ first = 0.5, last = 2, count = 16 }}\n"
               "scale = {{ first = 1, last = 3, count = {count} }}"),
}
CASES = {  # the coefficient, if any, and the fields
    "region": (None, ["region"]),
    "friction_demand": (None, ["region", "friction_demand"]),
    "nothing slips": (10, ["region"]),
    "slides flat": (0.2, ["region", "slide"]),
    "slides and rocks": (0.36, ["region", "slide"]),
}


def add_arguments(parser):
    parser.add_argument("--points", type=int, default=128, help="points of an axis (default: 128)")
    parser.add_argument("--rounds", type=int, default=7, help="runs of each case (default: 7)")
    add_output_argument(parser, "bench_sliding.json")
    add_program_argument(parser)


def job_of(scene, plane, friction, fields):
    lines = ["[scene]", scene, "[plane]", plane, "restitution_of_maximum = 1", "slenderness = 0.3217505543966422",
             *[f"friction = {friction}"] * (friction is not None), "[output]", f"fields = {json.dumps(fields)}"]
    return "\n".join(lines)


def seconds_of(overturn, job, folder):
    (folder / "job.toml").write_text(job)
    (folder / "r.h5").unlink(missing_ok=True)
    run_or_fail([overturn, "run", folder / "job.toml", "-o", folder / "r.h5"], "overturn run",
                stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    return sum(rank["compute_seconds"] for rank in json.loads((folder / "r.h5.json").read_text())["ranks"])


def run(options):
    overturn = program(options)
    jobs = pathlib.Path(__file__).resolve().parents[2] / "jobs"
    results = {}
    with tempfile.TemporaryDirectory() as folder:
        for motion, (scene, plane) in PLANES.items():
            times = {case: [] for case in CASES}
            for _ in range(options.rounds):
                for case, of in CASES.items():
                    job = job_of(scene.format(jobs=jobs), plane.format(count=options.points), *of)
                    times[case].append(seconds_of(overturn, job, pathlib.Path(folder)))
            medians = {case: statistics.median(values) for case, values in times.items()}
            results[motion] = {case: {"seconds": value, "over_region": value / medians["region"]}
                               for case, value in medians.items()}
            for case, of in results[motion].items():
                print(f"{motion:8}{case:18}{of['seconds'] * 1e3:10.1f} ms{of['over_region']:8.2f} x region")
    write_results(options.output, results)
