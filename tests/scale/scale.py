#!/usr/bin/env python3
"""Tests with many ranks, many points, and more points than 32 bits can count.

    scale.py [FOLDER] [--part PART] [--points-per-side N] [--more-points-per-side N] [--ranks N] [--seed N]

    ranks    64 ranks on this machine's cores: the same bytes as one rank, also stopped and resumed
    bytes    the same bytes on 1, 2, 3, 8 and 64 ranks, in 1, 3 and 16 parts, and by all kernels, in
             single and in double precision
    nodes    the same bytes on 64 and 128 ranks in nodes of 2 to 32, also after the leader of a node was
             killed or suspended
    points   10^9 points, stopped once and a rank killed once: bounded memory and correct values
    beyond   the last tiles of a plane of more than 2^32 points, and one of 1000 parts of it in single
             precision
    merged   two parts of as many points, filled: the same bytes as one run

Files are created in a subfolder of FOLDER (or $TMPDIR, or the current folder), which is removed at
the end; they take 4.4 GB, and 18 GB in the part `merged`. Requires OVERTURN and MPIEXEC in the environment."""

import argparse
import ctypes
import os
import pathlib
import random
import re
import shutil
import signal
import sys
import tempfile

import h5py
import numpy as np

from plane import (CHEAP, CORES, COSTLY, MIB, SINGLE, STOPPED, Command, Failure, Plane, demand,
                   demand_little_memory, digest, human, resume, say, verify)


# Part 1

def many_ranks(folder, options, chance):
    """64 ranks, uninterrupted or stopped and resumed, must give the same bytes as one rank."""
    # The work grows with the cores: a signal has to arrive during the run.
    plane = Plane(folder, "ranks", 1250 * max(1, CORES // 4), 1270, COSTLY)
    alone = folder / "alone.h5"
    say(f"{plane} in {plane.tiles} tiles on one rank")
    plane.run(None, alone).must_end_with(0)

    say(f"on {options.ranks} ranks and {CORES} cores")
    whole = plane.run(options.ranks).must_end_with(0).must_say(f"; {options.ranks} ranks, ")
    verify(plane)
    demand(digest(plane.file) == digest(alone), "bytes differ")
    plane.file.unlink()

    say("again, with a stop")
    stopped = plane.run(options.ranks)
    stopped.wait_for_tiles(plane, 0.1)
    stopped.stop()
    there = plane.done()
    say(f"resumed on 3 ranks with {there} of {plane.tiles} tiles")
    resume(plane, 3).must_end_with(0)
    verify(plane)
    demand(digest(plane.file) == digest(alone), "bytes differ after it was stopped and resumed")
    memory = demand_little_memory(plane, whole, stopped)
    return (f"{options.ranks} ranks on {CORES} cores, {plane.tiles} tiles; whole, and stopped at {there} tiles and "
            f"resumed on 3 ranks | 0 bytes differ from one rank's, at most {memory} per rank")


# Part 2

def equal_bytes(folder, options, chance):
    """Ranks, parts and kernels must not change a byte, in either precision."""
    doctor = Command(folder, ["doctor"]).must_end_with(0).words()
    kernels = re.findall(r"(\w+): yes", re.search(r"^kernels .*$", doctor, re.MULTILINE)[0])
    compared = 0
    for precision in ("double", "single"):
        plane = Plane(folder, precision, 300, 520, {**COSTLY, "precision": precision})
        plane.run(None).must_end_with(0)
        expected = digest(plane.file)
        say(f"{plane} in {plane.tiles} tiles, {precision} precision: ranks, kernels and parts")
        for kernel, ranks in [("auto", 2), ("auto", 3), ("auto", 8), ("auto", options.ranks),
                              *((kernel, None) for kernel in kernels)]:
            other = folder / f"{precision}_{kernel}_{ranks}.h5"
            Command(folder, ["run", plane.job, "--kernel", kernel, "-o", other], ranks).must_end_with(0)
            demand(digest(other) == expected, f"bytes differ: {other.name}")
            compared += 1
        for count in (1, 3, 16):
            parts = [folder / f"{precision}_{number}_of_{count}.h5" for number in range(1, count + 1)]
            for number, part in enumerate(parts, 1):
                arguments = ["run", plane.job, "--part", f"{number}/{count}", "-o", part]
                arguments += ["--kernel", kernels[number % len(kernels)]]
                Command(folder, arguments, (None, 2, 3)[number % 3]).must_end_with(0)
            merged = folder / f"{precision}_{count}.h5"
            Command(folder, ["merge", *parts, "-o", merged]).must_end_with(0)
            demand(digest(merged) == expected, f"bytes differ: {count} parts, {precision} precision")
            compared += 1
    return (f"{plane.tiles} tiles on 1, 2, 3, 8 and {options.ranks} ranks, in 1, 3 and 16 parts, by the kernels "
            f"{', '.join(kernels)}, in single and double precision | 0 bytes of {compared} files differ")


# Part 3

def nodes(folder, options, chance):
    """The division of ranks into nodes must not change a byte; a leader that dies loses nothing."""
    plane = Plane(folder, "nodes", 640, 1270, COSTLY)
    plane.run(None).must_end_with(0)
    expected = digest(plane.file)

    def start(ranks, ranks_per_node):
        plane.file.unlink(missing_ok=True)
        return Command(folder, ["run", plane.job, "-o", plane.file, "--patience", "20"], ranks,
                       {"OVERTURN_RANKS_PER_NODE": str(ranks_per_node)})

    for ranks in (64, 128):
        for ranks_per_node in (2, 4, 8, 16, 32):
            say(f"{plane} in {plane.tiles} tiles on {ranks} ranks in nodes of {ranks_per_node}")
            start(ranks, ranks_per_node).must_end_with(0)
            demand(digest(plane.file) == expected, "bytes differ")
    disturbed = 0
    for ranks, ranks_per_node in ((64, 8), (128, 32), (64, 2)):
        for signal_to_leader in (signal.SIGKILL, signal.SIGSTOP):
            leader = ranks_per_node * chance.randrange(1, ranks // ranks_per_node)
            say(f"rank {leader}, the leader of one of {ranks // ranks_per_node} nodes: {signal_to_leader.name}")
            run = start(ranks, ranks_per_node)
            run.wait_for_tiles(plane, 0.1)
            if signal_to_leader == signal.SIGKILL:
                run.kill_rank(leader)
            else:
                os.kill(run.pids[leader], signal.SIGSTOP)
                run.must_end_with(STOPPED).must_say(f"rank {leader} on ", "has not responded for 20 s")
            if plane.done() < plane.tiles:  # the suspended rank may have had none
                resume(plane, 3).must_end_with(0)
            demand(digest(plane.file) == expected, "bytes differ after it was resumed")
            disturbed += 1
    return (f"{plane.tiles} tiles on 64 and 128 ranks, in nodes of 2, 4, 8, 16 and 32; {disturbed} runs whose leader "
            f"of a node was killed or suspended, resumed on 3 ranks | 0 bytes differ")


# Part 4

def many_points(folder, options, chance):
    """A plane that is stopped once and killed once: bounded memory and correct values."""
    side = options.points_per_side
    plane = Plane(folder, "points", side, side, CHEAP)
    say(f"{plane} in {plane.tiles} tiles on {CORES} ranks")
    stopped = plane.run(CORES)
    stopped.wait_for_tiles(plane, 0.3)
    stopped.stop()

    say(f"stopped at {plane.done()} tiles")
    killed = resume(plane, CORES)
    killed.wait_for_tiles(plane, 0.6)
    killed.kill_a_rank(chance)
    there = plane.done()
    say(f"a rank killed at {there} tiles")
    last = resume(plane, CORES)
    last.must_end_with(0)
    ending = re.search(r"computed .*", last.words())[0]
    say(f"complete: {ending}")

    checked = verify(plane)
    say("verified; computing parts of it separately")
    compared = plane.demand_right_lines(chance, 20)
    runs = (stopped, killed, last)
    memory, of_verify = demand_little_memory(plane, *runs), demand_little_memory(plane, checked)
    speed = plane.points / sum(run.seconds for run in runs)
    return (f"{plane} in {plane.tiles} tiles, stopped once, a rank killed once | {human(speed)} points/s on "
            f"{CORES} cores with both, at most {memory} per rank, {of_verify} to verify; {human(compared)} "
            f"points equal when computed separately")


# Part 5

def beyond_32_bits(folder, options, chance):
    """Stops a run at its beginning, marks most missing tiles as done, and computes the last
    ones."""
    side = options.more_points_per_side
    plane = Plane(folder, "beyond", side, side, CHEAP)
    say(f"{plane} in {plane.tiles} tiles, its beginning on {CORES} ranks")
    Command(folder, ["check", plane.job]).must_end_with(0).must_say(
        f"{human(plane.points)} in {plane.tiles} tiles", f"frequency    {side} values",
        f"amplitude    {side} values")
    first = plane.run(CORES)
    first.wait_for_tiles(plane, 1 / plane.tiles)
    first.stop()
    beginning = np.flatnonzero(plane.marks())
    say(f"stopped at {len(beginning)} tiles; marking the others as done, except some at the end")
    Command(folder, ["info", plane.file]).must_end_with(0).must_say(
        f"{len(beginning)} of {plane.tiles} done", f"frequency    {side} values",
        f"amplitude    {side} values")

    pending = tiles_at_the_end(plane)
    demand(not set(beginning) & set(pending), "the plane is too small: its end was reached")
    mark_as_done(plane, pending)
    places = places_in_file(plane, pending)
    before = digest(plane.file, left_out=places)
    say(f"computing tiles {', '.join(map(str, pending))}")
    last = resume(plane, CORES).must_end_with(0)
    checked = verify(plane)
    say("verified; computing parts of it separately")
    demand(digest(plane.file, left_out=places) == before, "more than the last tiles has changed")
    plane.demand_right_tiles([*pending, *chance.sample(beginning.tolist(), min(10, len(beginning)))])
    of_part = one_part(folder, side, chance)
    memory, of_verify = demand_little_memory(plane, first, last, of_part), demand_little_memory(plane, checked)
    return (f"{plane} ({human(plane.points)}) in {plane.tiles} tiles, the first {len(beginning)}, the last, and "
            f"a part of 1000 in single precision | equal when computed separately, nothing else changed; {memory} "
            f"per rank, {of_verify} to verify")


def one_part(folder, side, chance):
    """Computes one of 1000 parts of a plane; its file is smaller than its fields."""
    part = Plane(folder, "part", side, side, SINGLE)
    run = Command(folder, ["run", part.job, "--part", "500/1000", "-o", part.file], CORES).must_end_with(0)
    tiles = np.flatnonzero(part.marks()).tolist()
    demand(len(tiles) in (part.tiles // 1000, part.tiles // 1000 + 1), f"a part has {len(tiles)} tiles")
    Command(folder, ["verify", part.file]).must_end_with(0).must_say(f"{len(tiles)} of {len(tiles)} tiles are done")
    part.demand_right_tiles([*chance.sample(tiles, min(10, len(tiles))), tiles[-1]])
    return run


def tiles_at_the_end(plane):
    """Returns the tile of point 2^32 (2^31 in a smaller plane, ...) and the last three."""
    point = 2 ** ((plane.points - 1).bit_length() - 1)
    return sorted({plane.tile_of(point), *range(plane.tiles - 3, plane.tiles)})


def mark_as_done(plane, but):
    """Marks all tiles but some as done, with the checksum of tiles not computed, i.e. of fill
    values.

    If they contain other values, the run that resumes recomputes them and reports it."""
    with h5py.File(plane.file, "r+") as file:
        marks, region = file["run/checksum"][:], file["region"]
        some = int(np.flatnonzero(marks)[0])
        library = ctypes.CDLL("libxxhash.so.0")  # also used by the program
        library.XXH64.restype = ctypes.c_uint64
        library.XXH64.argtypes = (ctypes.c_char_p, ctypes.c_size_t, ctypes.c_uint64)
        job = file["run/job_resolved"][:].tobytes()
        seed = library.XXH64(job, len(job), 0)

        def checksum_of(data, tile):
            """Returns the checksum of a tile with one field, by attribute `algorithm`."""
            return library.XXH64(data, len(data), (seed + tile) % 2**64) or 1
        demand(checksum_of(region[(0, *plane.slices(some))].tobytes(), some) == marks[some],
               "the checksum does not match its attribute `algorithm`")
        fill = {}  # by shape
        for tile in set(np.flatnonzero(marks == 0).tolist()) - set(but):
            shape = tuple(part.stop - part.start for part in plane.slices(tile))
            if shape not in fill:
                fill[shape] = np.full(shape, region.fillvalue, region.dtype).tobytes()
            marks[tile] = checksum_of(fill[shape], tile)
        file["run/checksum"][:] = marks


def places_in_file(plane, tiles):
    """Returns (offset, size) of the values and the checksums of some tiles."""
    with h5py.File(plane.file) as file:
        checksums = file["run/checksum"].id.get_offset()
        corners = [(0, *(part.start for part in plane.slices(tile))) for tile in tiles]
        chunks = [file["region"].id.get_chunk_info_by_coord(corner) for corner in corners]
    return ([(checksums + 8 * tile, 8) for tile in tiles] +
            [(chunk.byte_offset, chunk.size) for chunk in chunks])


# Part 6

def merged_parts(folder, options, chance):
    """Merges two parts of more than 2^32 points, on any number of ranks, to the file of one run."""
    side = options.more_points_per_side
    plane = Plane(folder, "merged", side, side, CHEAP)
    filled = ["run", plane.job, "--set", "numerics.fill=true"]
    say(f"{plane}, filled, on {CORES} ranks")
    Command(folder, [*filled, "-o", plane.file], CORES).must_end_with(0)
    expected = digest(plane.file)
    plane.file.unlink()
    parts = [folder / f"part{number}.h5" for number in (1, 2)]
    for number, part in enumerate(parts, 1):
        say(f"part {number} of 2")
        Command(folder, [*filled, "--part", f"{number}/2", "-o", part], (None, CORES)[number % 2]).must_end_with(0)
    say("merging both")
    merge = Command(folder, ["merge", *parts, "-o", plane.file]).must_end_with(0)
    demand(digest(plane.file) == expected, "the merged file differs from that of one run")
    return (f"{plane} ({human(plane.points)}), filled, in two parts, merged | 0 bytes differ from one run's; "
            f"{demand_little_memory(plane, merge)} to merge")


PARTS = {"ranks": many_ranks, "bytes": equal_bytes, "nodes": nodes, "points": many_points, "beyond": beyond_32_bits,
         "merged": merged_parts}


def demand_room(folder, options):
    """Checks the disk space for the largest files: slightly more than a byte per point, or four."""
    points = {"points": options.points_per_side**2, "beyond": options.more_points_per_side**2,
              "merged": 4 * options.more_points_per_side**2}
    needed = 1.1 * max(points.get(part, 0) for part in options.part) + 200 * MIB
    free = shutil.disk_usage(folder).free
    if free < needed:
        sys.exit(f"scale.py: {folder} has {free / 1e9:.1f} GB free, and {needed / 1e9:.1f} GB are needed: "
                 f"{(needed - free) / 1e9:.1f} GB are missing. Name a folder on another disk, or fewer "
                 "points.")


def read_options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", default=os.environ.get("TMPDIR", "."), type=pathlib.Path,
                        help="folder with space for the files (default: $TMPDIR, or this folder)")
    parser.add_argument("--part", action="append", choices=PARTS, help="repeatable; default: all")
    parser.add_argument("--ranks", type=int, default=64, help="ranks in part ranks")
    parser.add_argument("--points-per-side", type=int, default=31623, help="part points: 10^9 in all")
    parser.add_argument("--more-points-per-side", type=int, default=65610,
                        help="part beyond: more than 2^32 in all, smaller tiles at the edges")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    options.part = options.part or list(PARTS)
    return options


def main():
    options = read_options()
    if not options.folder.is_dir():
        sys.exit(f"scale.py: there is no folder {options.folder}")
    demand_room(options.folder, options)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("scale.py: terminated"))  # clean up
    chance = random.Random(options.seed)
    results = []
    with tempfile.TemporaryDirectory(prefix="overturn-scale-", dir=options.folder) as scratch:
        folder = pathlib.Path(scratch).resolve()
        try:
            for part in options.part:
                results.append(PARTS[part](folder, options, chance))
                for file in folder.iterdir():
                    file.unlink()
        except Failure as failure:
            sys.exit(f"FAILED (seed {options.seed}): {failure}")
        finally:
            Command.end_all()
    say("everything passed:")
    for result in results:
        print(f"| {result} |")


if __name__ == "__main__":
    main()
