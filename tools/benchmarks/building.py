"""How the benchmarks build and call their programs."""

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
        said = ((finished.stdout or "") + (finished.stderr or "")).strip()
        fail(f"{what} failed, exit code {finished.returncode}"
             + (f":\n{said}" if said else "; its words are above"))
    return finished


def add_build_argument(parser):
    parser.add_argument("--build", type=pathlib.Path, default=SOURCE / "build-bench",
                        help="folder to build in (default: build-bench in the checkout)")


def build(folder, target):
    """Installs what is missing and builds one of the programs in tools/benchmarks."""
    print("installing what is missing, and building (some minutes the first time)", flush=True)
    folder = folder.resolve()
    run_or_fail([SOURCE / "tools" / "install_dependencies", "build", "bench"], "installing")
    run_or_fail(["cmake", "-S", SOURCE, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                 "-DOVERTURN_TESTS=OFF",
                 "-DOVERTURN_KERNELS=all", "-DOVERTURN_BENCHMARKS=ON"], "configuring",
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    run_or_fail(["cmake", "--build", folder, "--target", target, "--parallel", os.cpu_count()],
                "building", stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return folder / target
