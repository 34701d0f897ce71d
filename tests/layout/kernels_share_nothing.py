#!/usr/bin/env python3
"""kernels_share_nothing.py NM OBJECT...: a kernel compiled for AVX2 or AVX-512 must not define a
function that the linker could choose for the rest of the program, which runs on processors without
these instructions: every weak function must contain the name of an instruction set. Constants
contain no instructions and may be shared (kinds V and u)."""

import subprocess
import sys


def main():
    nm, objects = sys.argv[1], sys.argv[2:]
    weak = 0
    shared = []
    for path in objects:
        symbols = subprocess.run([nm, "-C", "--defined-only", path], check=True,
                                 capture_output=True, text=True).stdout.splitlines()
        for symbol in symbols:
            _, kind, name = symbol.split(maxsplit=2)
            if kind == "W":
                weak += 1
                if "avx" not in name and "__gxx_personality" not in name:
                    shared.append(f"{path}: {name}")
    print("\n".join(shared) if shared else f"{len(objects)} kernels, {weak} weak functions, none shared")
    return 1 if shared or not objects else 0


if __name__ == "__main__":
    sys.exit(main())
