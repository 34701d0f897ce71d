"""Result files of other versions of the format: earlier ones are read, later ones refused."""

import pathlib
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np

from program import Scratch

TESTS = pathlib.Path(__file__).resolve().parents[1]
TOOLS = TESTS.parent / "tools"


def make_first_format(path):
    """Converts a file to the first version of the format."""
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
                            ("unfinished", "unfinished")):
            with self.subTest(name):
                shutil.copy(TESTS / "fuzz" / "corpus" / "result_file" / f"{name}.hdf5",
                            self.folder / "old.h5")
                self.assert_exit(self.overturn("info", "old.h5"), 0, holds)
                self.assert_exit(self.overturn("verify", "old.h5"), 0)

    def test_gives_the_same_values(self):
        self.overturn("run", "small.toml")
        shutil.copy(self.folder / "small.h5", self.folder / "old.h5")
        make_first_format(self.folder / "old.h5")
        tables = []
        for name in ("small", "old"):
            self.assert_exit(self.overturn("verify", f"{name}.h5"), 0)
            made = tool("to_csv", f"{name}.h5", "--restitution", "0", folder=self.folder)
            self.assertEqual(made.returncode, 0, made.stderr)
            tables.append((self.folder / f"{name}.csv").read_text())
            drawn = tool("plot_spectrum", f"{name}.h5", folder=self.folder)
            self.assertEqual(drawn.returncode, 0, drawn.stderr)
        self.assertEqual(*tables)

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
