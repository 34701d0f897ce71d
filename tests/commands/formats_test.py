"""Result files of other versions of the format: earlier ones are read, later ones refused."""

import pathlib
import shutil
import unittest

import h5py
import numpy as np

from program import Scratch


FORMAT_3 = pathlib.Path(__file__).resolve().parent / "format_3"
VERIFIED = "checksums of tiles (this format has none of coordinates) match"


def set_format(path, version):
    with h5py.File(path, "r+") as file:
        file.attrs.modify("format_version", np.int64(version))


class AnEarlierFormat(Scratch):
    """Format 3, which differs in the names and in the checksums of coordinates."""

    def setUp(self):
        super().setUp()
        self.assert_exit(self.overturn("run", "small.toml", "-o", "old.h5"), 0)
        set_format(self.folder / "old.h5", 3)

    def test_is_read_by_the_program(self):
        self.assert_exit(self.overturn("info", "old.h5"), 0, "200 values from 0.5 to 8", "24 of 24 done")
        verified = f"24 of 24 tiles are done; {VERIFIED}"
        self.assert_exit(self.overturn("verify", "old.h5"), 0, verified)
        with h5py.File(self.folder / "old.h5", "r+") as file:
            file["frequency"][0] += 1e-9
        self.assert_exit(self.overturn("verify", "old.h5"), 0, verified)
        with h5py.File(self.folder / "old.h5", "r+") as file:
            file["velocity"][0, 0, 1, 2] += 1e-9
        self.assert_exit(self.overturn("verify", "old.h5"), 74, "1 of 24 finished tiles")

    def test_is_read_by_the_program_and_the_tools_if_an_earlier_program_has_written_it(self):
        self.assert_exit(self.overturn("run", FORMAT_3 / "job.toml", "-o", "new_spectrum.h5"), 0)
        self.assert_exit(self.overturn("boundary", FORMAT_3 / "job.toml", "-o", "new_boundary.h5",
                                       "--set", "plane.frequency.count=4"), 0)
        for name, fields in (("spectrum", ("region", "margin")),
                             ("boundary", ("flip_amplitude", "region_below", "region_above"))):
            shutil.copy(FORMAT_3 / f"{name}.hdf5", self.folder / f"old_{name}.h5")
            self.assert_exit(self.overturn("info", f"old_{name}.h5"), 0, "restitution 0.7",
                             "1 of 1 done" if name == "spectrum" else "crossing 64 values")
            self.assert_exit(self.overturn("verify", f"old_{name}.h5"), 0, VERIFIED)
            with h5py.File(self.folder / f"old_{name}.h5") as old, \
                    h5py.File(self.folder / f"new_{name}.h5") as new:
                for field in fields:
                    # A flip is known to 1e-12; the scan of the earlier program had fewer amplitudes.
                    width = 1e-12 if field == "flip_amplitude" else 0
                    np.testing.assert_allclose(old[field][:].squeeze(), new[field][:].squeeze(), rtol=width)
            for version in ("old", "new"):
                drawn = self.tool(f"plot_{name}", f"{version}_{name}.h5")
                self.assertEqual(drawn.returncode, 0, drawn.stderr)

    def test_is_not_resumed(self):
        before = (self.folder / "old.h5").read_bytes()
        self.assert_exit(self.overturn("run", "small.toml", "-o", "old.h5"), 74,
                         "has the format of an earlier version (3), which can be read but not resumed")
        self.assertEqual((self.folder / "old.h5").read_bytes(), before)

    def test_before_it_is_refused(self):
        for version in (1, 2):
            set_format(self.folder / "old.h5", version)
            before = (self.folder / "old.h5").read_bytes()
            for command in (["info", "old.h5"], ["verify", "old.h5"], ["run", "small.toml", "-o", "old.h5"]):
                self.assert_exit(self.overturn(*command), 74,
                                 f"has format version {version}, but this program reads the versions 3 and 4")
            drawn = self.tool("plot_spectrum", "old.h5")
            self.assertEqual(drawn.returncode, 74, drawn.stderr)
            self.assertEqual((self.folder / "old.h5").read_bytes(), before)


class ALaterFormat(Scratch):
    def test_is_refused_by_the_program_and_by_the_tools(self):
        self.overturn("run", "small.toml")
        set_format(self.folder / "small.h5", 5)
        for command in ("info", "verify"):
            self.assert_exit(self.overturn(command, "small.h5"), 74, "newer")
        self.assert_exit(self.overturn("run", "small.toml"), 74, "newer")
        drawn = self.tool("plot_spectrum", "small.h5")
        self.assertEqual(drawn.returncode, 74)
        self.assertIn("newer", drawn.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
