"""Jobs in metres, seconds, Hz and g, and the equivalent dimensionless jobs."""

import math
import unittest

import h5py
import numpy as np

from program import Scratch

JOB = """
title = "A statue"
[scene]
pulse = "one_sine"
[plane]
pulse_period = { first = 0.2, last = 2.0, count = 30 }
pga = { first = 0.1, last = 5.0, count = 40 }
restitution_of_maximum = 0.9
[block]
width = 0.6
height = 1.8
[numerics]
method = "taylor"
[output]
fields = ["region", "angle", "velocity", "margin"]
"""
TWO_BLOCKS = ("--set", "plane.slenderness.values=[0.2, 0.3217505543966422]", "--set",
              "plane.size=0.9486832980505138")
P = math.sqrt(3 * 9.81 / (4 * math.hypot(0.3, 0.9)))


class Dimensions(Scratch):
    def setUp(self):
        super().setUp()
        (self.folder / "job.toml").write_text(JOB)

    def compute(self, command, name, *arguments):
        self.assert_exit(self.overturn(command, "job.toml", "-o", name, *arguments), 0)
        return self.opened(name)

    def equivalent(self, command, name, data, *arguments):
        """Computes the points of one block with the values of the derived coordinates as axes."""
        return self.compute(command, name, "--set",
                            f"plane.frequency.values={np.sort(data.frequency).tolist()}", "--set",
                            f"plane.amplitude.values={data.amplitude.values.tolist()}", "--set",
                            f"plane.slenderness={float(data.slenderness)!r}", *arguments)

    def assert_equal(self, data, equivalent, order):
        for name in ("region", "angle", "velocity", "margin"):
            self.assertTrue(np.array_equal(data[name].values[..., order], equivalent[name].values,
                                           equal_nan=True), name)

    def test_a_period_and_a_peak_acceleration_are_bit_identical_to_dimensionless_axes(self):
        for theory in ("nonlinear", "linear"):
            theory = ("--set", f"scene.theory={theory}")
            data = self.compute("run", f"{theory[1][-9:]}.h5", *theory)
            self.assertEqual(data.region.dims, ("pga", "pulse_period"))
            self.assertTrue(np.allclose(data.frequency, 2 * np.pi / (P * data.pulse_period),
                                        rtol=1e-15))
            self.assertTrue((np.diff(data.frequency) < 0).all())
            self.assert_equal(data, self.equivalent("run", f"equivalent_{theory[1][-9:]}.h5", data, *theory),
                              slice(None, None, -1))

    def test_a_frequency_in_hertz_and_several_slendernesses_are_too(self):
        data = self.compute("run", "hertz.h5", *TWO_BLOCKS, "--set",
                            "plane.pulse_frequency={ first = 0.5, last = 5.0, count = 30 }")
        self.assertEqual(data.amplitude.dims, ("slenderness", "pga"))
        self.assertEqual(data.region.dims[-1], "pulse_frequency")
        for i in (0, 1):
            self.assertTrue(np.allclose(data.amplitude[i],
                                        data.pga / np.tan(data.slenderness[i]), rtol=1e-15))
            block = data.isel(slenderness=i)
            self.assert_equal(block, self.equivalent("run", f"equivalent_{i}.h5", block), slice(None))

    def test_dimensionless_axes_have_their_equivalents(self):
        for blocks, shape in (((), (40,)), (TWO_BLOCKS, (2, 40))):
            data = self.compute("run", f"plain{len(blocks)}.h5", *blocks, "--set",
                                "plane.frequency={ first = 1, last = 8, count = 30 }", "--set",
                                "plane.amplitude={ first = 0.5, last = 9, count = 40 }")
            self.assertEqual(data.pga.shape, shape)
            self.assertTrue(np.allclose(data.pga, np.tan(data.slenderness) * data.amplitude, rtol=1e-15))
            self.assertTrue(np.allclose(data.pulse_period, 2 * np.pi / (P * data.frequency),
                                        rtol=1e-15))
            self.assert_exit(self.overturn("verify", f"plain{len(blocks)}.h5"), 0)

    def test_a_boundary_has_its_flips_in_both_units(self):
        few = ("--set", "plane.pulse_period.count=5")
        data = self.compute("boundary", "b.h5", *few)
        with h5py.File(self.folder / "b.h5") as file:
            self.assertTrue(np.allclose(file["run/scan_pga"], np.linspace(0.1, 5, 40), rtol=1e-15))
        self.assertTrue(np.allclose(data.flip_pga, data.flip_amplitude / 3, rtol=1e-15,
                                    equal_nan=True))
        equivalent = self.compute("boundary", "t.h5", *few, "--set",
                                  "plane.amplitude={ first = 0.3, last = 15, count = 40 }")
        self.assertGreater(np.isfinite(data.flip_pga).sum(), 8)
        # Each flip is between verdicts that are 1e-12 apart.
        self.assertTrue(np.allclose(data.flip_pga, equivalent.flip_pga, rtol=2e-12, equal_nan=True))
        self.assertTrue(np.array_equal(data.region_above, equivalent.region_above))

    def test_a_history_is_that_of_the_equivalent_dimensionless_job(self):
        at = "--at=pulse_period=0.5,pga=0.4,restitution_of_maximum=1"
        result = self.overturn("history", "job.toml", at, "-o", "h.h5")
        self.assert_exit(result, 0, "peak 0.8868 degrees, 4.81 % of alpha", "time [s]",
                         "angle [deg]", "rests after 1.88783 s")
        with h5py.File(self.folder / "h.h5") as file:
            frequency, amplitude = (file.attrs[name] for name in ("frequency", "amplitude"))
            self.assertAlmostEqual(file.attrs["frequency_parameter"], P, places=14)
            angle = file["angle"][:]
        at = f"--at=frequency={frequency!r},amplitude={amplitude!r},restitution_of_maximum=1"
        self.assert_exit(self.overturn("history", "job.toml", at, "-o", "t.h5"), 0)
        with h5py.File(self.folder / "t.h5") as file:
            self.assertTrue(np.array_equal(file["angle"][:], angle))

    def test_are_printed_by_check_which_warns_of_mistakes(self):
        self.assert_exit(self.overturn("check", "job.toml"), 0, "alpha = 18.43 degrees",
                         "r_max = 0.7225", "R = 0.9487 m", "p = 2.785 1/s (g = 9.81 m/s2)",
                         "period 0.2 to 2 s, peak 0.1 to 5 g")
        self.assertEqual(self.overturn("check", "job.toml").stderr, "")
        r = "--set=plane.restitution=0.99"
        for change, words in ((["--set=plane.pulse_frequency=100"],
                               "the period of the pulse = 0.01 s"),
                              (["--set=plane.frequency=0.05"], "the period of the pulse = 45"),
                              (["--set=block.width=4", r], "alpha = 65.77 degrees"),
                              (["--set=plane.pga=981"], "the peak ground acceleration = 981 g"),
                              ([r], "r = 0.99 is above r_max = 0.7225")):
            result = self.overturn("check", "job.toml", *change)
            self.assert_exit(result, 0)
            self.assertEqual(result.stderr.count("overturn: warning: "), 1)
            self.assertIn(words, result.stderr)

    def test_in_centimetres_are_refused_before_anything_is_computed(self):
        wrong = ("--set", "block.width=60", "--set", "block.height=180", "--set", "plane.pga=1", "--set",
                 "plane.pulse_period=0.5")
        for command in (("check",), ("run", "-o", "x.h5"), ("history", "-o", "x.h5")):
            self.assert_exit(self.overturn(*command, "job.toml", *wrong), 65, "0.6 m x 1.8 m?")
        self.assertFalse((self.folder / "x.h5").exists())

    def test_that_look_mistaken_are_computed_with_one_warning(self):
        wrong = ("--set", "block.width=20", "--set", "block.height=60", "--set",
                 "plane.pga={ first = 1, last = 4, count = 3 }", "--set", "plane.pulse_period=0.5")
        for command in (("run",), ("boundary",), ("history", "--at", "pga=1")):
            result = self.overturn(*command[:1], "job.toml", "-o", f"{command[0]}.h5", *wrong,
                                   *command[1:])
            self.assert_exit(result, 0)
            self.assertEqual(result.stderr.count("overturn: warning: "), 1)
            self.assertIn("R = 31.62 m is outside 0.02 to 10 m (lengths are in metres)",
                          result.stderr)

    def test_are_found_by_value_in_xarray(self):
        data = self.compute("run", "x.h5")
        column = data.region.sel(pulse_period=0.5, method="nearest")
        self.assertAlmostEqual(float(column.pulse_period), 0.5, delta=0.04)
        self.assertEqual(column.dims, ("pga",))


if __name__ == "__main__":
    unittest.main(verbosity=2)
