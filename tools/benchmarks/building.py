"""Builds and runs the benchmark programs."""

import json
import os
import pathlib
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def fail(message):
    sys.exit(f"bench: {message}")


def run_or_fail(command, what, **options):
    finished = subprocess.run([str(word) for word in command], text=True, **options)
    if finished.returncode != 0:
        output = ((finished.stdout or "") + (finished.stderr or "")).strip()
        fail(f"{what} failed with exit code {finished.returncode}"
             + (f":\n{output}" if output else "; see its output above"))
    return finished


def add_build_argument(parser):
    parser.add_argument("--build", type=pathlib.Path, default=SOURCE / "build-bench",
                        help="folder to build in (default: build-bench in the checkout)")


def add_output_argument(parser, name, more=""):
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path(name),
                        help=f"JSON file for the results{more} (default: {name})")


def write_results(path, results):
    path.write_text(json.dumps(results, indent=2) + "\n")
    print(f"written: {path}")


def build(folder, target):
    """Installs missing dependencies and builds one of the programs in tools/benchmarks."""
    print("installing missing dependencies and building (a few minutes the first time)", flush=True)
    folder = folder.resolve()
    run_or_fail([SOURCE / "tools" / "install_dependencies", "build", "bench"], "installing")
    run_or_fail(["cmake", "-S", SOURCE, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                 "-DOVERTURN_TESTS=OFF", "-DOVERTURN_KERNELS=all", "-DOVERTURN_BENCHMARKS=ON"], "configuring",
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    run_or_fail(["cmake", "--build", folder, "--target", target, "--parallel", os.cpu_count()],
                "building", stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return folder / target
