"""The Python benchmark: overturn.evaluate() compared with the kernel."""

import concurrent.futures
import os
import subprocess
import tempfile
import time

from building import add_build_argument, build, fail, run_or_fail

EXPLANATION = """\
Computes random blocks under one-sine pulses of their own (method taylor, tolerance 1e-9) with
overturn.evaluate() on one thread and on two, and compares the times with that of the kernel for the
same blocks. Shortest times of five rounds. Do not run other programs at the same time."""

ROUNDS = 5
COLUMNS = {"width": (0.2, 1), "height": (1, 4), "restitution_of_maximum": (0.8, 1), "pga": (0.1, 1),
           "pulse_period": (0.2, 2)}


def add_arguments(parser):
    add_build_argument(parser)
    parser.add_argument("--blocks", type=int, default=1_000_000, help="number of blocks (default: 1000000)")


def shortest(call):
    times = []
    for _ in range(ROUNDS):
        began = time.perf_counter()
        call()
        times.append(time.perf_counter() - began)
    return min(times)


def run(options):
    program = build(options.build, "bench_blocks")
    os.environ["OVERTURN"] = str(build(options.build, "overturn_python").parent / "overturn")
    import numpy as np

    import overturn
    evaluate = overturn.evaluate
    random = np.random.default_rng(1)
    blocks = {name: random.uniform(*limits, options.blocks) for name, limits in COLUMNS.items()}
    with tempfile.TemporaryFile() as columns:
        for values in blocks.values():
            columns.write(values.tobytes())
        columns.seek(0)
        done = run_or_fail([program, options.blocks], "bench_blocks", stdout=subprocess.PIPE, stdin=columns)
    kernel, sweep = map(float, done.stdout.split())
    halves = [{name: values[part::2].copy() for name, values in blocks.items()} for part in range(2)]
    with concurrent.futures.ThreadPoolExecutor(2) as threads:
        one = shortest(lambda: evaluate(**blocks))
        two = shortest(lambda: list(threads.map(lambda half: evaluate(**half), halves)))
    if not kernel > 0:
        fail("the time of the kernel is too short to measure; give more blocks")
    print(f"{options.blocks} blocks: {'seconds':>20}{'over kernel':>13}")
    for name, seconds in (("kernel", kernel), ("compute_tile()", sweep), ("evaluate()", one),
                          ("evaluate(), two threads", two)):
        print(f"  {name:26}{seconds:>13.3f}{seconds / kernel:>13.2f}")
    print(f"Two threads take {two / one:.2f} of the time of one.")
