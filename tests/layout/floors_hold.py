#!/usr/bin/env python3
"""floors_hold.py SOURCE_DIR: checks that headers include only the same layer or a lower one, that
of the modules of layer 4 only job is included by the others and only record by job, that only certain
modules include TOML, HDF5 and MPI, and that headers have an include guard."""

import pathlib
import re
import sys

FLOOR = {"number": 0, "mechanics": 1, "integrate": 2, "sweep": 3, "record": 4, "job": 4, "file": 4,
         "farm": 4, "commands": 5, "python": 5}
# The modules of layer 4 that another of layer 4 may include.
NEIGHBOURS = {"record": set(), "job": {"record"}, "file": {"job"}, "farm": {"job"}}
# Only these modules may include these headers. Module file opens files on a communicator.
ROOMS_OF = {"toml++/": {"job"}, "hdf5": {"file"}, "H5": {"file"}, "mpi.h": {"farm", "file"},
            "CLI/": {"commands"}, "xsimd/": {"number"}, "pybind11/": {"python"}}
STREAMS = {"iostream", "fstream", "sstream", "cstdio", "chrono", "ctime"}


def room_of(path, source):
    parts = path.relative_to(source).parts
    return parts[2] if parts[0] == "include" else (parts[1] if len(parts) > 2 else "commands")


def mistakes_in(path, source):
    room = room_of(path, source)
    if path.suffix == ".hpp" and "#pragma once\n" not in path.read_text():
        yield f"{path.relative_to(source)}: #pragma once is missing"
    for number, line in enumerate(path.read_text().splitlines(), 1):
        found = re.match(r'\s*#\s*include\s*["<]([^">]+)[">]', line)
        if not found:
            continue
        header = found.group(1)
        where = f"{path.relative_to(source)}:{number}: module {room} includes {header}"
        if header.startswith("overturn/"):
            other = header.split("/")[1]
            if FLOOR[other] > FLOOR[room]:
                yield f"{where}, which belongs to a higher layer"
            elif FLOOR[room] == FLOOR[other] == 4 and other not in NEIGHBOURS[room] | {room}:
                yield f"{where}, another module of layer 4"
        for prefix, rooms in ROOMS_OF.items():
            if header.startswith(prefix) and room not in rooms:
                yield f"{where}; only {', '.join(sorted(rooms))} may"
        if header in STREAMS and FLOOR[room] < 4:
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
