#!/usr/bin/env python3
"""Compares `overturn assess` with `overturn run` and own arithmetic on random tables of objects: every column.

usage: OVERTURN=PROGRAM random_tables.py [TABLES [SEED]]

For each case, a job has the strengths of the search as an axis. A second one has all points at which the search may
refine the end of a range.
"""

import concurrent.futures
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import overturn  # noqa: E402
from overturn.regions import SAFE, UNSAFE  # noqa: E402

OVERTURN = os.path.abspath(os.environ["OVERTURN"])
STEP, WIDTH, NINTHS = 0.005, 1e-4, 9  # of the search
PERIODS = (0.2, 0.35, 0.5, 0.8, 1.3)


def run_in(folder, *command):
    return subprocess.run(list(map(str, command)), cwd=folder, check=True, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL).stdout


def write_table(path, rows):
    with open(path, "w", newline="") as file:
        csv.writer(file).writerows([list(rows[0]), *(list(row.values()) for row in rows)])


def fields_at(folder, row, motion, strengths):
    """The values of the fields of an object at these ascending peak ground accelerations, as `run` computes them:
    +1 topples, -1 stands, 0 undecided; the largest tilt over alpha; the largest slide over R."""
    write_table(folder / "one.csv", [row])
    fields = ["region", "peak"] + ["slide_peak"] * ("friction" in row)
    job = [motion["scene"], "blocks.table = \"one.csv\"", "numerics = { resolve = true, tolerance = 1e-12 }",
           f"output.fields = {json.dumps(fields)}", "[plane]", *motion["plane"],
           f"pga.values = {json.dumps([float(strength) for strength in strengths])}"]
    job += ["restitution_of_maximum = 1"] * ("restitution_of_maximum" not in row)
    (folder / "one.toml").write_text("\n".join(job))
    (folder / "one.h5").unlink(missing_ok=True)
    run_in(folder, OVERTURN, "run", "one.toml", "-o", "one.h5")
    with h5py.File(folder / "one.h5") as file:
        values = {name: file[name][()].reshape(-1) for name in fields}
    region = values.pop("region")
    return {"toppling": np.isin(region, UNSAFE).astype(int) - np.isin(region, SAFE), "slide_peak": np.zeros(len(region)),
            **values}


def random_table(generator):
    optional = [name for name in ("center_offset", "incline", "restitution_of_maximum") if generator.random() < 0.4]
    if "incline" not in optional and generator.random() < 0.4:
        optional.append("friction")
    rows = []
    for i in range(generator.integers(1, 6)):
        height = generator.uniform(0.3, 3)
        width = height * generator.uniform(0.12, 0.5)
        values = {"center_offset": width * generator.choice([0, generator.uniform(-0.3, 0.3)]),
                  "incline": generator.choice([0, generator.uniform(-0.04, 0.04)]),
                  "restitution_of_maximum": generator.uniform(0.7, 1), "friction": generator.uniform(0.15, 0.8)}
        rows.append({"name": f"object {i}", "width": width, "height": height,
                     **{name: float(values[name]) for name in optional}})
    return rows


def thresholds_of(row):
    """The ground accelerations over g that lift an object about its sides plus and minus, and those that move it."""
    sides = [math.tan(math.atan2(row["width"] / 2 - sign * row.get("center_offset", 0), row["height"] / 2) -
                      sign * row.get("incline", 0)) for sign in (1, -1)]
    friction = row.get("friction", math.inf)  # only on level bases
    lifting = [side if side < friction else math.inf for side in sides]
    return lifting, [min(side, friction) for side in sides]


def pga_of(thresholds, motion, direction):
    """The least peak ground acceleration of a motion that exceeds a threshold. Positive accelerations push the block
    towards its side minus."""
    plus, minus = thresholds if direction == 0 else thresholds[::-1]
    peaks = motion["positive"], motion["negative"]
    return max(peaks) * min(minus / peaks[0], plus / peaks[1])


class Search:
    """The search of one case."""

    def __init__(self, folder, row, motion, lifting, end, asked):
        self.at = lambda strengths: fields_at(folder, row, motion, strengths)
        self.lowest = self.undecided = self.below = self.above = self.of_asked = None
        if asked:
            self.of_asked = {name: values[0] for name, values in self.at([asked]).items()}
        if not lifting < end:
            return
        steps = math.ceil(math.log(end / lifting) / STEP)
        scan = [lifting * (end / lifting) ** (i / steps) for i in range(steps + 1)]
        if motion["is_pulse"]:
            low = min(1.3 * lifting, end)
            scan += list(np.linspace(lifting, low, 1 + math.ceil(max((low - lifting) / (0.0005 * lifting), 10))))
            scan += list(np.linspace(low, end, 1 + math.ceil(min(max((end - low) / (0.1 * lifting), 10), 2000))))
        else:
            scan += [asked * (1 + i / 1000) for i in range(-20, 21)]
        scan = [value for value in scan if lifting < value < end] + [lifting, end]
        scan = np.unique(scan + [asked] * bool(lifting < asked < end))
        toppling = self.at(scan)["toppling"]
        self.lowest, self.undecided = self.first(scan, toppling, lifting)
        if not asked or self.of_asked["toppling"] > 0 or self.lowest is None or self.lowest > asked:
            self.above = self.lowest
            return
        place = np.searchsorted(scan, asked)
        self.below, _ = self.first(scan[:place][::-1], toppling[:place][::-1], asked)
        self.above, _ = self.first(scan[place:], toppling[place:], asked)

    def first(self, scan, toppling, safe):
        """The first strength of a scan, which ascends or descends, that topples, and the first one before it that is
        undecided."""
        places = np.flatnonzero(toppling > 0)
        count = places[0] if len(places) else len(scan)
        unknown = next(iter(scan[:count][toppling[:count] == 0]), None)
        if not len(places):
            return None, unknown
        safe = next(iter(scan[:count][toppling[:count] < 0][::-1]), safe)
        found = scan[count]
        # All points that may be visited.
        parts = NINTHS ** max(1, math.ceil(math.log(abs(found - safe) / (WIDTH * min(found, safe)), NINTHS)))
        points = safe + (found - safe) * np.arange(1, parts) / parts
        inside = self.at(np.sort(points))["toppling"]
        inside = np.concatenate([[-1], inside if found > safe else inside[::-1], [1]])
        low, high = 0, parts
        while (high - low) * abs(found - safe) / parts > WIDTH * (safe + (found - safe) * low / parts):
            between = low + (high - low) // NINTHS * np.arange(1, NINTHS)
            topple = between[inside[between] > 0]
            before = between[(inside[between] < 0) & (between < min(topple, default=parts))]
            if not len(topple) and not len(before):
                unknown = unknown if unknown is not None else safe + (found - safe) * between[0] / parts
                break
            low, high = max(before, default=low), min(topple, default=high)
        return safe + (found - safe) * high / parts, unknown


def least(values):
    return min((value for value in values if value is not None), default=None)


def expected_row(row_of_table, searches, thresholds, asked, end):
    """The columns of the answer for an object, by own arithmetic. thresholds: of its cases."""
    lifting, moving = (min(values) for values in zip(*thresholds))
    not_safe = sorted(min(each.lowest or math.inf, each.undecided or math.inf) for each in searches)
    lowest, unknown = (least(getattr(each, name) for each in searches) for name in ("lowest", "undecided"))
    row = {"lifts_from": lifting if math.isfinite(lifting) else None, "topples_from": lowest,
           "undecided_from": unknown if unknown and not (lowest and lowest <= unknown) else None, "end_of_search": end,
           "cases": len(searches)}
    for name, share in (("median", 0.5), ("percentile_16", 0.16)):
        value = not_safe[max(1, math.ceil(share * len(searches) - 1e-9)) - 1]
        row[name] = value if math.isfinite(value) else None
    row["slides_from"] = moving if moving < lifting else None
    if not asked:
        return {**row, **dict.fromkeys(("verdict", "pga", "share_toppling", "share_undecided", "peak_of_alpha", "slide",
                                        "factor_below", "factor_above"))}
    values = [each.of_asked for each in searches]
    toppling = np.array([each["toppling"] for each in values])
    slide_peak = max(each["slide_peak"] for each in values)
    slides = slide_peak > 0
    size = math.hypot(row_of_table["width"] / 2 - row_of_table.get("center_offset", 0), row_of_table["height"] / 2)
    peak = np.nan if (toppling == 0).any() else max(each["peak"] for each in values)
    row["verdict"] = ("topples" if (toppling > 0).any() else "undecided" if (toppling == 0).any() else
                      " and ".join(["rocks"] * bool(peak > 0) + ["slides"] * bool(slides)) or "stands")
    row.update(pga=asked, share_toppling=np.mean(toppling > 0), share_undecided=np.mean(toppling == 0),
               peak_of_alpha=float(peak) if np.isfinite(peak) else None,
               slide=float(slide_peak * size))
    standing = [] if row["verdict"] == "topples" else searches
    row["factor_below"] = max((each.below / asked for each in standing if each.below), default=None)
    row["factor_above"] = least(each.above / asked for each in standing if each.above)
    return row


def differences(found, expected, tolerances):
    for name, value in expected.items():
        if name not in found:
            assert name in ("slides_from", "slide"), name
            continue
        same = (found[name] == value if not isinstance(value, float) or found[name] is None else
                math.isclose(found[name], value, rel_tol=tolerances.get(name, 1e-10), abs_tol=1e-15))
        if not same:
            yield f"{name}: {found[name]} instead of {value}"


def least_widths(folder, row, motions, asked, end):
    """The widths from which on no case topples an object, ascending, None last, by `topple` for each."""
    options = [word for name, value in row.items() if name not in ("name", "width")
               for word in (f"--{name.replace('_', '-')}", repr(value))]
    found = []
    for motion in motions:
        for direction in (0,) if is_symmetric(row) else (0, 180):
            def safe_between(first, last):
                answer = run_in(folder, OVERTURN, "topple", "--json", *options, *motion["options"], "--pga", repr(asked),
                                "--direction", direction, "--vary", "width", repr(first), repr(last))
                value = json.loads(answer)["safe_from"]
                return last if value is None else value

            least, finer = row["width"], safe_between(row["width"], end)
            while least < finer < end:  # again in finer steps
                least, finer = finer, safe_between(finer, min(finer * 1.1, end))
            found.append(finer if finer < end else None)
    return sorted(found, key=lambda value: math.inf if value is None else value)


def is_symmetric(row):
    return not row.get("center_offset", 0) and not row.get("incline", 0)


def same_numbers(found, expected):
    return len(found) == len(expected) and all(
        one == other if one is None or other is None else math.isclose(one, other, rel_tol=1e-10)
        for one, other in zip(found, expected))


def check_table(seed, records):
    """Compares one random table. Returns the number of cases and the differences."""
    generator = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        rows = random_table(generator)
        write_table(folder / "objects.csv", rows)
        end = float(generator.uniform(0.5, 2))
        asked = float(generator.uniform(0.1, 1) * end * generator.choice([0, 1, 1, 1, 1]))
        if generator.random() < 0.6:
            periods = sorted(generator.choice(PERIODS, generator.integers(1, 4), replace=False).tolist())
            options = ["--period", ",".join(map(str, periods))]
            motions = [{"scene": 'scene.pulse = "one_sine"', "plane": [f"pulse_period = {period}"], "is_pulse": True,
                        "options": ["--period", period]}
                       for period in periods]
            motions = [{**motion, "positive": 1, "negative": 1} for motion in motions]
        else:
            chosen = sorted(generator.choice(list(records), generator.integers(1, 4), replace=False).tolist())
            options = [word for record in chosen for word in ("--record", record)]
            motions = [{"scene": f"scene.record = {json.dumps(record)}", "plane": [], "is_pulse": False,
                        "options": ["--record", record],
                        "positive": max(records[record]), "negative": -min(records[record])} for record in chosen]
        options += ["--pga", repr(asked)] * bool(asked) + ["--pga-max", repr(end)]
        answer = json.loads(run_in(folder, OVERTURN, "assess", "objects.csv", "--json", *options))
        found = {each["name"]: each for each in answer["objects"]}
        cases, wrong = 0, []
        for row in rows:
            searches, thresholds = [], []
            for motion in motions:
                for direction in (0,) if is_symmetric(row) else (0, 180):
                    directed = {**motion, "plane": [*motion["plane"], f"direction = {direction}"]}
                    thresholds.append([pga_of(each, motion, direction) for each in thresholds_of(row)])
                    searches.append(Search(folder, row, directed, thresholds[-1][0], end, asked))
            cases += len(searches)
            expected = expected_row(row, searches, thresholds, asked, end)
            # A rounding of the lifting strength changes the steps, and with them the refined values by up to WIDTH.
            tolerances = dict.fromkeys(("topples_from", "median", "percentile_16", "factor_below", "factor_above"), 2 * WIDTH)
            wrong += [f"table {seed}, {row['name']}: {text}"
                      for text in differences(found[row["name"]], expected, {**tolerances, "peak_of_alpha": 1e-8})]
        if widths := answer["least_widths"]:
            row = next(each for each in rows if each["name"] == widths["object"])
            least = least_widths(folder, row, motions, asked, widths["end_of_search"])
            wrong += [f"table {seed}, widths of {row['name']}: {widths} instead of {least}"] * (
                widths["width"] != row["width"] or not same_numbers(widths["safe_from"], least))
        wrong += [f"table {seed}: no widths"] * (bool(asked) and answer["objects"][0]["verdict"] == "topples" and
                                                 not widths)
        ranks = [("topples", "undecided").index(each["verdict"]) if each["verdict"] in ("topples", "undecided") else 2
                 for each in answer["objects"]]
        wrong += [f"table {seed}: not the most vulnerable first"] * (ranks != sorted(ranks))
        return cases, wrong


def main(tables="200", seed="1"):
    with tempfile.TemporaryDirectory() as folder:
        records = {}
        for i in range(5):  # of different peaks
            path = os.path.join(folder, f"{i}.AT2")
            run_in(folder, ROOT / "tools" / "synthetic_record", "--seed", i, "--pga", 0.3 + 0.1 * i, "--duration", 10,
                   "-o", path)
            records[path] = overturn.read_record(path).acceleration
        compared, different = 0, []
        with concurrent.futures.ProcessPoolExecutor() as pool:
            seeds = range(int(seed), int(seed) + int(tables))
            for cases, wrong in pool.map(check_table, seeds, [records] * len(seeds)):
                compared += cases
                different += wrong
                print("\n".join(wrong), end="\n" * bool(wrong), flush=True)
    print(f"{tables} tables, {compared} cases: {len(different)} differences")
    return bool(different)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
