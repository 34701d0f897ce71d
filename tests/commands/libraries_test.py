"""One result file with two C libraries whose functions differ in the last digit: glibc on
processors with and without AVX2."""

import math
import os
import subprocess
import sys
import unittest

import h5py
import numpy as np

from program import ENVIRONMENT, Scratch

WITHOUT_AVX2 = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2"}
# Some of these heights give another slenderness with the other arctangent.
HEIGHTS = [5 + i / 999 for i in range(3000)]

JOB = """
[scene]
pulse = "one_sine"
[plane]
frequency = {{ first = 0.5, last = 8.3, count = 200, spacing = "log" }}
amplitude = {{ first = 0.57, last = 12.0, count = 150, spacing = "log" }}
restitution_of_maximum = {{ values = [0.7, 1.0] }}
[block]
half_width = 1.0
half_height = {height!r}
[output]
fields = ["region"]
"""


def slendernesses(settings):
    code = f"import math; print([math.atan(1.0 / height) for height in {HEIGHTS}])"
    run = subprocess.run([sys.executable, "-c", code], env={**os.environ, **settings}, check=True,
                         capture_output=True, text=True)
    return [float(value) for value in run.stdout.strip("[]\n").split(", ")]


class AnotherCLibrary(Scratch):
    @classmethod
    def setUpClass(cls):
        ours = [math.atan(1.0 / height) for height in HEIGHTS]
        others = slendernesses(WITHOUT_AVX2)
        cls.height = next((height for height, one, other in zip(HEIGHTS, ours, others)
                           if one != other), None)
        if cls.height is None:
            raise unittest.SkipTest("the C library has the same digits with and without AVX2")

    def setUp(self):
        super().setUp()
        (self.folder / "job.toml").write_text(JOB.format(height=self.height))

    def compute_with_the_other(self):
        subprocess.run([os.environ["OVERTURN"], "run", "job.toml", "-o", "out.h5"], cwd=self.folder,
                       env={**ENVIRONMENT, **WITHOUT_AVX2}, check=True, capture_output=True,
                       timeout=60)

    def test_verifies_the_file(self):
        self.compute_with_the_other()
        self.assert_exit(self.overturn("verify", "out.h5"), 0)

    def test_resumes_the_file_to_the_same_regions(self):
        self.assert_exit(self.overturn("run", "job.toml", "-o", "alone.h5"), 0)
        self.compute_with_the_other()
        with h5py.File(self.folder / "out.h5", "a") as file, h5py.File(self.folder / "alone.h5") as alone:
            # Otherwise the libraries would not differ.
            self.assertNotEqual(file["slenderness"][()], alone["slenderness"][()])
            file["run/checksum"][4:] = 0  # all but the first row of tiles
            file["region"][0, 64:] = file["region"][1] = 255
        self.assert_exit(self.overturn("run", "job.toml", "-o", "out.h5"), 0)
        self.assert_exit(self.overturn("verify", "out.h5"), 0)
        with h5py.File(self.folder / "out.h5") as file, h5py.File(self.folder / "alone.h5") as alone:
            np.testing.assert_array_equal(file["region"][...], alone["region"][...])


if __name__ == "__main__":
    unittest.main()
