#!/usr/bin/env python3
"""includes_follow_the_layers.py SOURCE_DIR: checks that files include only headers of the same
layer or a lower one; that within layer 4, other modules may include only `job`, and only `job` and `answers` may
include `record`; that only certain modules include TOML, HDF5 and MPI; and that headers have an
include guard."""

import pathlib
import re
import sys

LAYER = {"number": 0, "text": 0, "mechanics": 1, "integrate": 2, "problem": 3,
         "sweep": 3, "record": 4, "job": 4,
         "file": 4, "farm": 4, "answers": 4, "commands": 5, "python": 5, "web": 5}
# The modules of layer 4 that another of layer 4 may include.
NEIGHBOURS = {"record": set(), "job": {"record"}, "answers": {"job", "record"}, "file": {"job"}, "farm": {"job"}}
# Only these modules may include these headers. Module file opens files on a communicator.
MODULES_OF = {"toml++/": {"job", "web"}, "hdf5": {"file"}, "H5": {"file"}, "mpi.h": {"farm", "file"},
              "CLI/": {"commands"}, "nlohmann/": {"answers", "commands"}, "ranges": {"answers", "commands"}, "xsimd/": {"number"}, "pybind11/": {"python"}}
STREAMS = {"iostream", "fstream", "sstream", "cstdio", "chrono", "ctime"}


def module_of(path, source):
    parts = path.relative_to(source).parts
    return parts[2] if parts[0] == "include" else (parts[1] if len(parts) > 2 else "commands")


def mistakes_in(path, source):
    module = module_of(path, source)
    if path.suffix == ".hpp" and "#pragma once\n" not in path.read_text():
        yield f"{path.relative_to(source)}: #pragma once is missing"
    for number, line in enumerate(path.read_text().splitlines(), 1):
        found = re.match(r'\s*#\s*include\s*["<]([^">]+)[">]', line)
        if not found:
            continue
        header = found.group(1)
        where = f"{path.relative_to(source)}:{number}: module {module} includes {header}"
        if header.startswith("overturn/"):
            other = header.split("/")[1]
            if LAYER[other] > LAYER[module]:
                yield f"{where}, which belongs to a higher layer"
            elif LAYER[module] == LAYER[other] == 4 and other not in NEIGHBOURS[module] | {module}:
                yield f"{where}, another module of layer 4"
        for prefix, modules in MODULES_OF.items():
            if header.startswith(prefix) and module not in modules:
                yield f"{where}; only {', '.join(sorted(modules))} may"
        if header in STREAMS and LAYER[module] < 4:
            yield f"{where}; streams and clocks are not allowed below layer 4"


def main():
    source = pathlib.Path(sys.argv[1])
    files = [path for folder in ("include", "src") for path in sorted((source / folder).rglob("*"))
             if path.suffix in {".hpp", ".cpp"}]
    mistakes = [mistake for path in files for mistake in mistakes_in(path, source)]
    print("\n".join(mistakes) if mistakes else f"{len(files)} files follow the layers")
    return 1 if mistakes or len(files) < 40 else 0


if __name__ == "__main__":
    sys.exit(main())
