"""Result files read by other libraries: xarray with both engines, h5py, netCDF4, ncdump.

Requires WRITE_SAMPLE (the program write_sample) and MPIEXEC (mpirun) in the environment.
Every warning is an error.
"""

import os
import signal
import subprocess
import tempfile
import unittest
import warnings

import h5py
import netCDF4
import numpy as np
import xarray as xr

ENGINES = ["h5netcdf", "netcdf4"]
SHAPE = {"slenderness": 2, "restitution_of_maximum": 3, "amplitude": 67, "frequency": 131}
FIELDS = ["region", "angle", "velocity", "margin", "impacts", "status"]


def write_sample(*arguments, ranks=2):
    command = [os.environ["MPIEXEC"], "-n", str(ranks), os.environ["WRITE_SAMPLE"]]
    return subprocess.run([*command, *arguments], capture_output=True, text=True, timeout=100)


def position():
    """Returns the number of each point, frequency varying fastest."""
    return np.arange(np.prod(list(SHAPE.values()))).reshape(list(SHAPE.values()))


class Sample(unittest.TestCase):
    """Creates a finished and an unfinished file, once for all tests."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.finished = os.path.join(cls.folder.name, "finished.h5")
        cls.unfinished = os.path.join(cls.folder.name, "unfinished.h5")
        for arguments in ([cls.finished], [cls.unfinished, "1"]):
            run = write_sample(*arguments)
            if run.returncode != 0:
                raise RuntimeError(run.stderr)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def setUp(self):
        caught = warnings.catch_warnings()
        caught.__enter__()
        self.addCleanup(caught.__exit__, None, None, None)
        warnings.simplefilter("error")

    def in_every_engine(self, path, check, group=None):
        for engine in ENGINES:
            with self.subTest(engine), xr.open_dataset(path, engine=engine, group=group) as dataset:
                check(dataset.load())


class TestXarray(Sample):
    def test_has_four_coordinates_with_units(self):
        def check(dataset):
            units = {name: dataset[name].attrs["units"] for name in SHAPE}
            self.assertEqual(units, {"slenderness": "rad", "restitution_of_maximum": "1",
                                     "amplitude": "1", "frequency": "1"})
            np.testing.assert_array_equal(dataset.slenderness, [0.1745716, 0.25])
            np.testing.assert_array_equal(dataset.restitution_of_maximum, [0.7, 0.85, 1])
            np.testing.assert_allclose(dataset.amplitude, np.linspace(0.25, 16, 67), rtol=1e-15)
            np.testing.assert_allclose(dataset.frequency, np.linspace(0.5, 12, 131), rtol=1e-15)
            for name in dataset.variables:
                self.assertIn(len(dataset[name].attrs["long_name"]), range(3, 41), name)
        self.in_every_engine(self.finished, check)

    def test_has_every_field_on_the_four_dimensions(self):
        def check(dataset):
            for name in FIELDS:
                self.assertEqual(dict(dataset[name].sizes), SHAPE)
                self.assertEqual(dataset[name].dims, tuple(SHAPE))
            types = [dataset[name].dtype for name in FIELDS]
            self.assertEqual(types, ["u1", "f8", "f8", "f8", "u2", "u1"])
        self.in_every_engine(self.finished, check)

    def test_finds_each_value_at_its_point(self):
        def check(dataset):
            np.testing.assert_array_equal(dataset.region, position() % 251)
            np.testing.assert_array_equal(dataset.angle, position() + 1 / 8)
            np.testing.assert_array_equal(dataset.velocity, position() + 2 / 8)
            np.testing.assert_array_equal(dataset.margin, position() + 3 / 8)
            np.testing.assert_array_equal(dataset.impacts, position() % 251)
            np.testing.assert_array_equal(dataset.status, position() % 251)
        self.in_every_engine(self.finished, check)

    def test_selects_by_coordinates(self):
        def check(dataset):
            point = dataset.angle.sel(slenderness=0.25, restitution_of_maximum=0.85, amplitude=16,
                                      frequency=0.5)
            self.assertEqual(point.item(), position()[1, 1, 66, 0] + 1 / 8)
        self.in_every_engine(self.finished, check)

    def test_has_derived_coordinates(self):
        largest = (1 - 1.5 * np.sin([[0.1745716], [0.25]]) ** 2) ** 2

        def check(dataset):
            self.assertEqual(dataset.restitution.dims, ("slenderness", "restitution_of_maximum"))
            np.testing.assert_allclose(dataset.restitution, [[0.7, 0.85, 1]] * largest, rtol=1e-14)
            self.assertEqual(dataset.pga.dims, ("slenderness", "amplitude"))
            np.testing.assert_allclose(dataset.pga, np.tan(dataset.slenderness) * dataset.amplitude,
                                       rtol=1e-14)
            self.assertLessEqual({"restitution", "pga"}, set(dataset.coords))
        self.in_every_engine(self.finished, check)

    def test_has_as_many_meanings_as_flags(self):
        def check(dataset):
            region = dict(zip(dataset.region.attrs["flag_meanings"].split(),
                              dataset.region.attrs["flag_values"]))
            self.assertEqual(region, {"S": 0, "S+": 1, "S-": 2, "U0+": 3, "U0-": 4, "U1+": 5, "U1-": 6, "F+": 7,
                                      "F-": 8, "U2+": 9, "U2-": 10, "undecided": 254, "not_computed": 255})
            status = dict(zip(dataset.status.attrs["flag_meanings"].split(),
                              dataset.status.attrs["flag_masks"]))
            self.assertEqual(status, {"came_to_rest": 1, "cap_was_hit": 2, "not_finite": 4,
                                      "unresolved": 8, "free_fall": 16, "lifts_off": 32,
                                      "slipped": 64, "jammed": 128})
            impacts = dict(zip(dataset.impacts.attrs["flag_meanings"].split(),
                               dataset.impacts.attrs["flag_values"]))
            self.assertEqual(impacts["bounce_series"], 65535)
            for name, flags in [("region", "flag_values"), ("status", "flag_masks"),
                                ("impacts", "flag_values")]:
                self.assertEqual(np.asarray(dataset[name].attrs[flags]).dtype, dataset[name].dtype)
        self.in_every_engine(self.finished, check)

    def test_reads_nan_and_codes_in_tiles_not_computed(self):
        def check(dataset):
            missing = np.isnan(dataset.angle.values)
            self.assertEqual((~missing).sum(), 2 * 64 * 64)  # one tile of each rank
            self.assertEqual(dataset.region.dtype, "u1")
            np.testing.assert_array_equal(dataset.region.values == 255, missing)
            np.testing.assert_array_equal(dataset.status.values == 255, missing)
            np.testing.assert_array_equal(dataset.impacts.values == 65534, missing)
        self.in_every_engine(self.unfinished, check)

    def test_has_the_checksums_in_a_group(self):
        def check(run):
            self.assertEqual((run.checksum.values != 0).sum(), 2)
        self.in_every_engine(self.unfinished, check, group="run")

    def test_has_the_provenance(self):
        def check(dataset):
            self.assertEqual(dataset.attrs["Conventions"], "CF-1.8")
            self.assertEqual(dataset.attrs["title"], "Sample: r = r_max, α = 10°")
            self.assertEqual(dataset.attrs["window"], 1.25)
            self.assertIn("Rocking of rigid blocks", dataset.attrs["references"])
        self.in_every_engine(self.finished, check)

    def test_has_the_job_in_a_group(self):
        def check(run):
            given = run.job_given.item()
            self.assertTrue(given.startswith('title = "Sample: r = r_max, α = 10°"\nvalues = [0, 1,'))
            self.assertGreater(len(run.job_resolved.item()), 50000)
            self.assertTrue(run.job_resolved.item().endswith(", 9999]\n"))
            self.assertEqual(run.job_overrides.item().splitlines()[1],
                             'output.fields=["region"]')
        self.in_every_engine(self.finished, check, group="run")

    def test_has_coordinates_and_fields_only(self):
        def check(dataset):
            table = dataset.to_dataframe()
            self.assertEqual(len(table), np.prod(list(SHAPE.values())))
            self.assertEqual(set(table.columns), {*FIELDS, "restitution", "pga"})
        self.in_every_engine(self.finished, check)

    def test_writes_the_dataset_again(self):
        def check(dataset):
            copy = os.path.join(self.folder.name, "copy.nc")
            dataset.to_netcdf(copy, engine="netcdf4")
            with xr.open_dataset(copy, engine="netcdf4") as again:
                xr.testing.assert_identical(dataset, again.load())
        self.in_every_engine(self.finished, check)


class TestOtherReaders(Sample):
    def test_h5py_finds_dimension_scales(self):
        with h5py.File(self.finished) as file:
            for name in FIELDS:
                self.assertEqual([scale.keys()[0] for scale in file[name].dims], list(SHAPE))
                np.testing.assert_array_equal(file[name].dims[3][0], file["frequency"])
            self.assertEqual(file["run/job_resolved"][()].tobytes().decode()[:5], "pulse")
            self.assertEqual(file["angle"].chunks, (1, 1, 64, 64))

    def test_netcdf4_masks_only_points_not_computed(self):
        with netCDF4.Dataset(self.unfinished) as file:
            self.assertEqual(file["angle"].dimensions, tuple(SHAPE))
            for name in ("angle", "region"):
                self.assertEqual(np.ma.count(file[name][:]), 2 * 64 * 64)

    def test_ncdump_reads_every_value(self):
        run = subprocess.run(["ncdump", self.finished], capture_output=True, text=True, timeout=60)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("double angle(slenderness, restitution_of_maximum, amplitude, frequency) ;", run.stdout)
        self.assertIn('frequency:units = "1" ;', run.stdout)
        self.assertIn("tile = 36 ;", run.stdout)


class TestAKilledRun(Sample):
    def test_leaves_a_file_that_opens_and_resumes_to_the_same_bytes(self):
        path = os.path.join(self.folder.name, "killed.h5")
        killed = write_sample(path, "5", "kill")
        self.assertIn(killed.returncode, (128 + signal.SIGKILL, -signal.SIGKILL, signal.SIGKILL),
                      killed.stderr)
        with xr.open_dataset(path, engine="netcdf4", group="run") as run:
            done = int((run.checksum != 0).sum())
        self.assertTrue(1 <= done <= 10, done)
        resumed = write_sample(path, ranks=1)
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        with open(path, "rb") as one, open(self.finished, "rb") as other:
            self.assertTrue(one.read() == other.read())


if __name__ == "__main__":
    unittest.main()
