"""Jobs in which any quantity is a number, an axis or a column of a table."""

import itertools
import math
import subprocess
import unittest

import h5py
import numpy as np
import xarray

from program import Scratch, checksum

FIELDS = ("region", "angle", "margin")
JOB = """
scene.pulse = "one_sine"
[plane]
pulse_period = { first = 0.3, last = 1.5, count = 9 }
pga = { first = 0.2, last = 2.0, count = 10 }
restitution_of_maximum = 0.9
[output]
fields = ["region", "angle", "margin"]
"""
TABLE_JOB = """
scene.pulse = "one_sine"
blocks.table = "blocks.csv"
[plane]
pulse_period = { first = 0.3, last = 1.5, count = 9 }
width = 0.5
height = 1.8
[output]
fields = ["region", "angle", "margin"]
"""
TABLE = [(0.7, 0.4), (0.65, 0.9), (0.8, 0.7)]  # r, pga [g]
ENGINES = ("netcdf4", "h5netcdf")


class ScratchWithGrids(Scratch):
    def setUp(self):
        super().setUp()
        (self.folder / "job.toml").write_text(JOB)

    def compute(self, name, *settings, job="job.toml"):
        self.assert_exit(self.overturn("run", job, "-o", name, *(f"--set={each}" for each in settings)), 0)
        return self.opened(name)

    def assert_equal(self, some, others):
        """Checks that the fields are equal, bit for bit, and so are the coordinates of both."""
        for field in FIELDS:
            np.testing.assert_array_equal(some[field].values, others[field].values, field)
        self.assertEqual(set(some.coords), set(others.coords))
        for name in some.coords:
            np.testing.assert_array_equal(some[name].values, others[name].values, name)


class AnyAxis(ScratchWithGrids):
    def test_may_be_a_side_of_the_block(self):
        heights, widths = [1.2, 1.8, 2.4], [0.4, 0.7]
        data = self.compute("sides.h5", f"plane.height.values={heights}", f"plane.width.values={widths}")
        self.assertEqual(data.region.dims, ("width", "height", "pga", "pulse_period"))
        self.assertEqual(data.region.shape, (2, 3, 10, 9))
        for name, dims in (("slenderness", ("width", "height")), ("size", ("width", "height")),
                           ("frequency_parameter", ("width", "height")), ("restitution", ("width", "height")),
                           ("amplitude", ("width", "height", "pga")),
                           ("frequency", ("width", "height", "pulse_period")),
                           ("restitution_of_maximum", ())):
            self.assertEqual(data[name].dims, dims, name)
        np.testing.assert_allclose(data.slenderness, np.arctan(data.width / data.height), rtol=1e-15)
        np.testing.assert_allclose(data["size"],
                                   np.hypot(data.width, data.height) / 2, rtol=1e-15)
        for width, height in itertools.product(widths, heights):
            block = self.compute(f"{width}x{height}.h5", f"plane.width={width}", f"plane.height={height}")
            self.assertEqual(block.region.dims, ("pga", "pulse_period"))
            self.assert_equal(block, data.sel(width=width, height=height))

    def test_may_be_the_frequency_parameter_under_a_pulse(self):
        block = ("plane.slenderness=0.3", "plane.restitution=0.7")
        parameters = [2, 3.5, 5]
        data = self.compute("p.h5", *block, f"plane.frequency_parameter.values={parameters}")
        self.assertEqual(data.region.dims, ("frequency_parameter", "pga", "pulse_period"))
        self.assertEqual(data.amplitude.dims, ("pga",))
        self.assertEqual(data.frequency.dims, ("frequency_parameter", "pulse_period"))
        np.testing.assert_allclose(data["size"], 3 * 9.81 / (4 * data.frequency_parameter**2), rtol=1e-15)
        np.testing.assert_allclose(data.frequency, 2 * np.pi / (data.frequency_parameter * data.pulse_period),
                                   rtol=1e-15)
        for p in parameters:
            one = self.compute(f"{p}.h5", *block, f"plane.frequency_parameter={p}")
            self.assert_equal(one, data.sel(frequency_parameter=p))

    def test_may_be_the_aspect_ratio(self):
        data = self.compute("ratios.h5", "plane.size=1.1", "plane.aspect_ratio.values=[3, 5.67, 1000]")
        self.assertEqual(data.region.dims, ("aspect_ratio", "pga", "pulse_period"))
        self.assertEqual(data.slenderness.dims, ("aspect_ratio",))
        for ratio, slenderness in zip(data.aspect_ratio.values, data.slenderness.values, strict=True):
            self.assertEqual(slenderness, math.atan(1 / ratio))
            one = self.compute(f"{ratio}.h5", "plane.size=1.1", f"plane.slenderness={slenderness!r}")
            self.assert_equal(one, data.sel(aspect_ratio=ratio).drop_vars("aspect_ratio"))

    def test_may_be_a_point_of_its_own(self):
        data = self.compute("axes.h5", "plane.height.values=[1.8]", "plane.width.values=[0.6]")
        self.assertEqual(data.region.dims, ("width", "height", "pga", "pulse_period"))
        self.assertEqual(data.region.shape, (1, 1, 10, 9))
        self.assert_equal(data.squeeze(), self.compute("numbers.h5", "plane.height=1.8", "plane.width=0.6"))


class APartialTable(ScratchWithGrids):
    def setUp(self):
        super().setUp()
        (self.folder / "table.toml").write_text(TABLE_JOB)
        (self.folder / "blocks.csv").write_text(
            "restitution,pga\n" + "".join(f"{r},{pga}\n" for r, pga in TABLE))

    def test_has_the_values_of_a_job_per_row(self):
        data = self.compute("table.h5", job="table.toml")
        self.assertEqual(data.region.dims, ("block", "pulse_period"))
        for name, dims in (("restitution", ("block",)), ("pga", ("block",)), ("amplitude", ("block",)),
                           ("frequency", ("pulse_period",)), ("slenderness", ()), ("width", ())):
            self.assertEqual(data[name].dims, dims, name)
        self.assertEqual(data.slenderness.item(), math.atan(0.25 / 0.9))
        for row, (r, pga) in enumerate(TABLE):
            one = self.compute(f"{row}.h5", "block.width=0.5", "block.height=1.8",
                               f"plane.restitution={r}", f"plane.pga={pga}")
            self.assertEqual(one.region.dims, ("pulse_period",))
            self.assert_equal(one, data.isel(block=row).drop_vars("block"))
        self.assert_exit(self.overturn("verify", "table.h5"), 0)
        self.assert_exit(self.overturn("check", "table.toml"), 0, "3 of blocks.csv", "27 in 1 tile")

    def test_is_kept_when_a_number_of_the_plane_is_set(self):
        data = self.compute("table.h5", "plane.width=0.6", job="table.toml")
        self.assertEqual(data.region.dims, ("block", "pulse_period"))
        self.assertEqual(data.width.item(), 0.6)


class ASinglePoint(ScratchWithGrids):
    POINT = ("--set=plane.pulse_period=0.5", "--set=plane.pga=1.2", "--set=plane.width=0.6",
             "--set=plane.height=1.8")

    def run_point(self, output, ranks=None):
        result = self.overturn("run", "job.toml", "-o", output, *self.POINT, ranks=ranks)
        self.assert_exit(result, 0)
        return result.stdout

    def test_is_run_described_verified_and_resumed(self):
        self.assertIn("computed 1 point in", self.run_point("point.h5"))
        self.assert_exit(self.overturn("info", "point.h5"), 0, "tiles 1 of 1 done, 1 point each",
                         "width 0.6 m", "slenderness 0.3217505543966422 rad", "restitution 0.9, of the maximum")
        self.assert_exit(self.overturn("verify", "point.h5"), 0, "1 of 1 tile is done")
        whole = checksum(self.folder / "point.h5")
        self.assertIn("is already complete", self.run_point("point.h5"))
        self.forget("point.h5", ...)
        self.assert_exit(self.overturn("verify", "point.h5"), 0, "0 of 1 tile")
        self.run_point("point.h5", ranks=2)
        self.assertEqual(checksum(self.folder / "point.h5"), whole)
        self.run_point("ranks.h5", ranks=2)
        self.assertEqual(checksum(self.folder / "ranks.h5"), whole)
        with h5py.File(self.folder / "point.h5", "r+") as file:
            file["margin"][...] += 1e-9
        self.assert_exit(self.overturn("verify", "point.h5"), 74, "tile numbers: 0")
        self.assertIn("1 damaged tile to recompute", self.run_point("point.h5"))
        self.assertEqual(checksum(self.folder / "point.h5"), whole)

    def test_opens_in_xarray_and_ncdump(self):
        self.run_point("point.h5")
        for engine in ENGINES:
            with xarray.open_dataset(self.folder / "point.h5", engine=engine) as data:
                self.assertEqual(dict(data.sizes), {})
                self.assertEqual(set(data.data_vars), set(FIELDS))
                self.assertEqual(data.pulse_period.item(), 0.5)
                self.assertIn("frequency", data.margin.coords)
                self.assertEqual(data.region.item() > 2, data.margin.item() < 0)
        dump = subprocess.run(["ncdump", "point.h5"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((dump.returncode, dump.stderr), (0, ""))
        self.assertIn("double margin ;", dump.stdout)

    def test_is_that_of_a_spectrum_and_of_a_history(self):
        self.run_point("point.h5")
        data = self.compute("spectrum.h5", "plane.width=0.6", "plane.height=1.8", "plane.pga.values=[0.4, 1.2]",
                            "plane.pulse_period.values=[0.5, 0.7]")
        with xarray.open_dataset(self.folder / "point.h5") as point:
            self.assert_equal(point, data.sel(pga=1.2, pulse_period=0.5))
        self.assert_exit(self.overturn("history", "job.toml", "-o", "history.h5", *self.POINT), 0, "region")


if __name__ == "__main__":
    unittest.main(verbosity=2)
