"""Result files of other versions of the format: earlier ones are read, later ones refused."""

import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np

from program import Scratch


TESTS = pathlib.Path(__file__).resolve().parents[1]
TOOLS = TESTS.parent / "tools"
sys.path.insert(0, str(TOOLS))
import overturn  # noqa: E402


def dissolve_groups(path):
    """Moves everything to the root group, as in the first two versions of the format."""
    with h5py.File(path, "r+") as file:
        for group, prefix in (("run", ""), ("events", "event_")):
            for name in list(file.get(group, ())):
                file.move(f"{group}/{name}", name if name == "event" else prefix + name)
            if group in file:
                del file[group]


def make_second_format(path):
    dissolve_groups(path)
    with h5py.File(path, "r+") as file:
        file.attrs["format_version"] = np.int64(2)


def make_first_format(path):
    dissolve_groups(path)
    with h5py.File(path, "r+") as file:
        del file.attrs["format_version"]
        marks = file["checksum"].attrs
        *_, marks["amplitude_extent"], marks["frequency_extent"] = marks["tile_shape"]
        del marks["tile_shape"], marks["dimensions"]


def tool(name, *arguments, folder):
    return subprocess.run([sys.executable, TOOLS / name, *arguments], cwd=folder, text=True,
                          capture_output=True)


class AnEarlierFormat(Scratch):
    def test_is_read_by_the_program_and_by_the_tools(self):
        for name, holds in (("spectrum", "amplitude"), ("boundary", "crossing"),
                            ("unfinished", "unfinished"), ("format_2", "crossing")):
            with self.subTest(name):
                shutil.copy(TESTS / "fuzz" / "corpus" / "result_file" / f"{name}.hdf5",
                            self.folder / "old.h5")
                self.assert_exit(self.overturn("info", "old.h5"), 0, holds)
                self.assert_exit(self.overturn("verify", "old.h5"), 0)

    def test_gives_the_same_values(self):
        self.overturn("run", "small.toml")
        for name, convert in (("first", make_first_format), ("second", make_second_format)):
            shutil.copy(self.folder / "small.h5", self.folder / f"{name}.h5")
            convert(self.folder / f"{name}.h5")
        tables = []
        for name in ("small", "first", "second"):
            self.assert_exit(self.overturn("verify", f"{name}.h5"), 0)
            made = tool("to_csv", f"{name}.h5", "--restitution", "0", folder=self.folder)
            self.assertEqual(made.returncode, 0, made.stderr)
            tables.append((self.folder / f"{name}.csv").read_text())
            drawn = tool("plot_spectrum", f"{name}.h5", folder=self.folder)
            self.assertEqual(drawn.returncode, 0, drawn.stderr)
        self.assertEqual(tables, tables[:1] * 3)

    def test_of_a_boundary_and_a_history_is_drawn_and_opened_alike(self):
        few = ("--set", "plane.frequency.count=5", "--set", "plane.amplitude.count=9", "--set",
               "plane.restitution.values=[0.7]")
        self.overturn("boundary", "small.toml", "-o", "boundary.h5", *few)
        self.overturn("history", "small.toml", "--at", "frequency=3,amplitude=1.5,restitution=0.7",
                      "-o", "history.h5")
        for name in ("boundary", "history"):
            pictures, columns = [], []
            for version in (f"{name}.h5", f"old_{name}.h5"):
                drawn = tool(f"plot_{name}", version, "-o", "picture.svg", folder=self.folder)
                self.assertEqual(drawn.returncode, 0, drawn.stderr)
                pictures.append(re.findall(r" d=.*", (self.folder / "picture.svg").read_text()))
                with overturn.open(self.folder / version) as dataset:
                    columns.append({name for name in dataset.variables if not name.startswith("event")})
                if version == f"{name}.h5":
                    shutil.copy(self.folder / version, self.folder / f"old_{version}")
                    make_second_format(self.folder / f"old_{version}")
            self.assertEqual(*pictures)
            self.assertGreater(len(pictures[0]), 10)
            self.assertEqual(*columns)

    def test_is_not_resumed(self):
        self.overturn("run", "small.toml")
        make_first_format(self.folder / "small.h5")
        before = (self.folder / "small.h5").read_bytes()
        self.assert_exit(self.overturn("run", "small.toml"), 74, "earlier version")
        self.assertEqual((self.folder / "small.h5").read_bytes(), before)


class ALaterFormat(Scratch):
    def test_is_refused_by_the_program_and_by_the_tools(self):
        self.overturn("run", "small.toml")
        with h5py.File(self.folder / "small.h5", "r+") as file:
            file.attrs["format_version"] = np.int64(file.attrs["format_version"] + 1)
        for command in ("info", "verify"):
            self.assert_exit(self.overturn(command, "small.h5"), 74, "newer")
        self.assert_exit(self.overturn("run", "small.toml"), 74, "newer")
        drawn = tool("plot_spectrum", "small.h5", folder=self.folder)
        self.assertEqual(drawn.returncode, 74)
        self.assertIn("newer", drawn.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
