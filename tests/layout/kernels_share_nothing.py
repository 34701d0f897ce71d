#!/usr/bin/env python3
"""kernels_share_nothing.py NM OBJECT...: a kernel compiled for AVX2 or AVX-512 must not define a
function that the linker could choose for the rest of the program, which runs on processors without
these instructions: every weak function must contain the name of an instruction set, and no two targets, which are
compiled with different instructions, may define the same one. Constants contain no instructions and may be shared
(kinds V and u)."""

import re
import subprocess
import sys


def main():
    nm, objects = sys.argv[1], sys.argv[2:]
    weak = 0
    shared = []
    targets = {}  # of each weak function, the first target that defines it
    for path in objects:
        target = re.search(r"kernel_(\w+?)_(?:taylor|runge|recorded)", path)[1]
        symbols = subprocess.run([nm, "-C", "--defined-only", path], check=True,
                                 capture_output=True, text=True).stdout.splitlines()
        for symbol in symbols:
            _, kind, name = symbol.split(maxsplit=2)
            if kind == "W":
                weak += 1
                if "__gxx_personality" not in name and (
                        "avx" not in name or targets.setdefault(name, target) != target):
                    shared.append(f"{path}: {name}")
    print("\n".join(shared) if shared else f"{len(objects)} kernels, {weak} weak functions, none shared")
    return 1 if shared or not objects else 0


if __name__ == "__main__":
    sys.exit(main())
