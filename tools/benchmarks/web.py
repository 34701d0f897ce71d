"""The web benchmark: the page's WebAssembly module in Node beside the kernels of this computer."""

import json
import pathlib
import shutil
import statistics
import subprocess
import tempfile

from building import SOURCE, add_build_argument, add_output_argument, build, fail, write_results
from launching import measured_run

EXPLANATION = """\
Computes a plane of period and peak acceleration of a vase of 18 cm x 45 cm under one-sine pulses, with resolved
verdicts: in the module of the page, which Node runs in one thread, and with the kernel `double` of this computer on one
rank, in turns. Prints medians, and how long the page needs for a first verdict. tools/check web builds the module."""

BLOCK = {"width": 0.18, "height": 0.45}
PGA = {"first": 0.05, "last": 2, "middle": 0.6}
PERIOD = {"first": 0.1, "last": 2, "middle": 0.5}


def add_arguments(parser):
    add_build_argument(parser)
    parser.add_argument("--module", type=pathlib.Path, default=SOURCE / "build-web" / "overturn.wasm",
                        help="the WebAssembly module (default: build-web/overturn.wasm)")
    parser.add_argument("--side", type=int, default=512, help="points of each axis (default: 512)")
    parser.add_argument("--rounds", type=int, default=7, help="default: 7")
    add_output_argument(parser, "bench_web.json")


def module_times(options):
    question = json.dumps({"block": BLOCK, "pga": PGA, "period": PERIOD})
    command = ["node", SOURCE / "tools" / "benchmarks" / "web.mjs", options.module, str(options.side)]
    return json.loads(subprocess.run(command, input=question, text=True, stdout=subprocess.PIPE, check=True).stdout)


def kernel_seconds(overturn, options, folder):
    def axis(values):
        return f"{{ first = {values['first']}, last = {values['last']}, count = 2, spacing = \"log\" }}"

    job = pathlib.Path(folder) / "vase.toml"
    job.write_text(f"scene.pulse = \"one_sine\"\nblock = {{ width = {BLOCK['width']}, height = {BLOCK['height']} }}\n"
                   f"output.fields = [\"region\"]\n[numerics]\nmethod = \"taylor\"\nresolve = true\n"
                   f"[plane]\nrestitution_of_maximum = 1\npga = {axis(PGA)}\npulse_period = {axis(PERIOD)}\n")
    _, sidecar = measured_run(overturn, options.side, [], job=job, axes=("pga", "pulse_period"),
                              options=("--kernel", "double"))
    return sum(rank["compute_seconds"] for rank in sidecar["ranks"])


def run(options):
    if not options.module.exists() or shutil.which("node") is None:
        fail(f"{options.module} or node is missing. tools/check web builds the one and installs the other.")
    overturn = build(options.build, "overturn")
    rounds = []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            rounds.append({**module_times(options), "kernel_double": kernel_seconds(overturn, options, folder)})
            print(".", end="", flush=True)
    medians = {name: statistics.median(each[name] for each in rounds) for name in rounds[0]}
    ratio = statistics.median(each["spectrum"] / each["kernel_double"] for each in rounds)
    points = options.side**2
    print(f"\nmodule: compiled in {1e3 * medians['compile']:.0f} ms, first verdict {1e3 * medians['first_verdict']:.0f} ms, "
          f"with ranges {1e3 * medians['ranges']:.0f} ms, 128 x 128 points in tiles {1e3 * medians['tiles_128']:.0f} ms")
    print(f"{options.side} x {options.side} points: module {1e6 * medians['spectrum'] / points:.2f} us per point, kernel "
          f"`double` {1e6 * medians['kernel_double'] / points:.2f} us, ratio {ratio:.2f}")
    write_results(options.output, {"ratio": ratio, **medians})
