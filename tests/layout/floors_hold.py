#!/usr/bin/env python3
"""floors_hold.py SOURCE_DIR: includes point to the same floor or a lower one, rooms of floor 4 leave
each other alone but for the job's data, only one room knows each of TOML, HDF5 and MPI, and headers may be
included twice."""

import pathlib
import re
import sys

FLOOR = {"number": 0, "mechanics": 1, "integrate": 2, "sweep": 3, "job": 4, "file": 4, "farm": 4,
         "commands": 5}
# Outside of its rooms nobody includes it. The file room opens files on a communicator.
ROOMS_OF = {"toml++/": {"job"}, "hdf5": {"file"}, "H5": {"file"}, "mpi.h": {"farm", "file"},
            "CLI/": {"commands"}, "xsimd/": {"number"}}
STREAMS = {"iostream", "fstream", "sstream", "cstdio", "chrono", "ctime"}


def room_of(path, source):
    parts = path.relative_to(source).parts
    return parts[2] if parts[0] == "include" else (parts[1] if len(parts) > 2 else "commands")


def mistakes_in(path, source):
    room = room_of(path, source)
    if path.suffix == ".hpp" and "#pragma once\n" not in path.read_text():
        yield f"{path.relative_to(source)}: a header lacks #pragma once"
    for number, line in enumerate(path.read_text().splitlines(), 1):
        found = re.match(r'\s*#\s*include\s*["<]([^">]+)[">]', line)
        if not found:
            continue
        header = found.group(1)
        where = f"{path.relative_to(source)}:{number}: room {room} includes {header}"
        if header.startswith("overturn/"):
            other = header.split("/")[1]
            if FLOOR[other] > FLOOR[room]:
                yield f"{where}, which lies on a higher floor"
            elif FLOOR[room] == FLOOR[other] == 4 and room != other and other != "job":
                yield f"{where}, its neighbour on floor 4"
        for prefix, rooms in ROOMS_OF.items():
            if header.startswith(prefix) and room not in rooms:
                yield f"{where}; only {', '.join(sorted(rooms))} may"
        if header in STREAMS and FLOOR[room] < 4:
            yield f"{where}; below floor 4 there are no streams and no clocks"


def main():
    source = pathlib.Path(sys.argv[1])
    files = [path for folder in ("include", "src") for path in sorted((source / folder).rglob("*"))
             if path.suffix in {".hpp", ".cpp"}]
    mistakes = [mistake for path in files for mistake in mistakes_in(path, source)]
    print("\n".join(mistakes) if mistakes else f"{len(files)} files keep to their floors")
    return 1 if mistakes or len(files) < 40 else 0


if __name__ == "__main__":
    sys.exit(main())
