"""overturn history and its picture."""

import unittest.mock

import h5py
import numpy as np
import xarray

from program import ENVIRONMENT, Scratch, checksum

AT = "--at=frequency=3,amplitude=1.3,restitution_of_maximum=1"


class AHistory(Scratch):
    def history(self, *arguments):
        return self.overturn("history", "small.toml", "-o", "history.h5", *arguments)

    def test_prints_the_events_and_writes_them(self):
        self.assert_exit(self.history(AT), 0, "region S", "uplift", "impact", "end_of_pulse",
                         "history.h5: written")
        with h5py.File(self.folder / "history.h5") as file:
            self.assertEqual(file.attrs["frequency"], 3)
            self.assertAlmostEqual(file.attrs["restitution"], 0.911547, places=6)
            self.assertEqual(len(file["time"]), len(file["angle"]))
            meanings = file["events/kind"].attrs["flag_meanings"].decode().split()
            kinds = [meanings[code] for code in file["events/kind"][:]]
            self.assertEqual(kinds[0], "uplift")
            self.assertEqual(kinds[-1], "rest")
            impacts = file["events/kind"][:] == meanings.index("impact")
            before = file["events/velocity_before"][:][impacts]
            after = file["events/velocity_after"][:][impacts]
            self.assertTrue(np.allclose(after**2, file.attrs["restitution"] * before**2))

    def test_opens_in_xarray(self):
        self.history(AT)
        for engine in ("netcdf4", "h5netcdf"):
            with xarray.open_dataset(self.folder / "history.h5", engine=engine) as found:
                self.assertEqual(found.angle.dims, ("time",))
                self.assertTrue((np.diff(found.time) >= 0).all())
                self.assertEqual(set(found.to_dataframe().columns),
                                 {"angle", "velocity", "acceleration", "q", "ground", "friction_demand"})
            with xarray.open_dataset(self.folder / "history.h5", engine=engine, group="events") as events:
                self.assertEqual(events.time.dims, ("event",))

    def test_is_described_by_info(self):
        self.history(AT)
        self.assert_exit(self.overturn("info", "history.h5"), 0, "A small plane",
                         "contains the history of one block", "made by overturn",
                         "amplitude = { values = [1.3] }")
        self.assert_exit(self.overturn("verify", "history.h5"), 74, "its kind is \"rocking history\"")

    def test_of_a_job_with_many_points_requires_at(self):
        result = self.history("--at", "frequency=3")
        self.assert_exit(result, 2, "150 values of plane.amplitude", "--at amplitude=0.5")
        self.assertFalse((self.folder / "history.h5").exists())

    def test_coordinates_may_have_spaces_around_them(self):
        spaced = "--at= frequency = 3, amplitude=1.3 ,restitution_of_maximum = 1 "
        self.assert_exit(self.history(spaced), 0)
        with h5py.File(self.folder / "history.h5") as file:
            self.assertEqual(file.attrs["amplitude"], 1.3)

    def test_refuses_an_unknown_or_invalid_coordinate(self):
        for words in ("frequncy=3", "frequency", "frequency=", "frequency= ", "=3"):
            self.assert_exit(self.history("--at", words), 2, "where AXIS is one of direction, width")
        for value in ("x", "3x", "3 4", "[3]", "'3'", "0x3", "1e"):
            self.assert_exit(self.history("--at", f"frequency={value}"), 2, f"{value} is not a number")
        self.assert_exit(self.history("--at", "frequency=-3"), 65, "--at frequency=-3: ", "outside (0, inf)")
        self.assert_exit(self.history("--at", "frequency=3,amplitude=1,frequency=4"), 2,
                         "--at frequency=4: frequency=3 gives the same quantity. Give one value.")

    @unittest.mock.patch.dict(ENVIRONMENT, OVERTURN_UNTRAPPED="1")  # this motion overflows
    def test_refuses_a_motion_beyond_the_range_of_numbers(self):
        result = self.history("--at", "frequency=3,amplitude=1e300,restitution_of_maximum=1")
        self.assert_exit(result, 65, "plane.amplitude = 1e+300", "beyond the range")
        self.assertNotIn("nan", result.stdout)
        self.assertFalse((self.folder / "history.h5").exists())
        # A spectrum stores the point with its status.
        one = ("--set=plane.frequency.values=[3]", "--set=plane.amplitude.values=[1.5, 1e300]")
        self.assert_exit(self.overturn("run", "small.toml", *one), 0)
        with h5py.File(self.folder / "small.h5") as file:
            self.assertEqual(list(file["region"][0, 1, :, 0] == 254), [False, True])
            self.assertEqual(list(file["status"][0, 1, :, 0]), [0, 4])

    def test_replaces_an_older_history_and_nothing_else(self):
        self.assert_exit(self.history(AT), 0)
        first = checksum(self.folder / "history.h5")
        self.assert_exit(self.history(AT), 0)
        self.assertEqual(checksum(self.folder / "history.h5"), first)
        self.overturn("run", "small.toml", "-o", "spectrum.h5")
        before = checksum(self.folder / "spectrum.h5")
        result = self.overturn("history", "small.toml", "-o", "spectrum.h5", AT)
        self.assert_exit(result, 74, 'its kind is not "rocking history"')
        self.assertEqual(checksum(self.folder / "spectrum.h5"), before)

    def test_does_not_replace_what_was_derived_from_a_history(self):
        self.history(AT)
        (self.folder / "history.h5").rename(self.folder / "own.h5")
        with xarray.open_dataset(self.folder / "own.h5", engine="netcdf4") as data:
            data.isel(time=slice(0, 10)).to_netcdf(self.folder / "derived.h5", engine="netcdf4")
        (self.folder / "more.h5").write_bytes((self.folder / "own.h5").read_bytes())
        with h5py.File(self.folder / "more.h5", "r+") as file:
            file["measured"] = np.arange(3.0)
        for name in ("derived.h5", "more.h5"):
            before = checksum(self.folder / name)
            result = self.overturn("history", "small.toml", "-o", name, AT)
            self.assert_exit(result, 74, f'"{name}" exists and is not as overturn wrote it. Move it away')
            self.assertEqual(checksum(self.folder / name), before)

    def test_refuses_a_folder_as_its_file(self):
        (self.folder / "folder").mkdir()
        result = self.overturn("history", "small.toml", "-o", "folder", AT)
        self.assert_exit(result, 74, 'cannot write "folder": it is not a regular file')
        self.assertNotIn("Remove", result.stderr)

    def test_is_plotted_with_its_point_and_events(self):
        self.history(AT)
        result = self.tool("plot_history", "history.h5", "-o", "history.svg")
        self.assertEqual(result.returncode, 0, result.stderr)
        picture = (self.folder / "history.svg").read_text()
        for words in ("A small plane", "uplift", "at rest"):
            self.assertIn(f">{words}<", picture)
        self.assertIn("safe, no more impacts needed (S)", picture)

    def test_is_plotted_with_the_settings_not_shown_below_the_title(self):
        self.history(AT, "--set", "scene.pulse='half_sine'", "--set", "plane.restitution_of_maximum.values=[0.8]")
        self.assertEqual(self.tool("plot_history", "history.h5", "-o", "history.svg").returncode, 0)
        self.assertIn(">A small plane, with scene.pulse='half_sine'<",
                      (self.folder / "history.svg").read_text().replace("&apos;", "'"))

    def test_plot_refuses_a_spectrum(self):
        self.overturn("run", "small.toml", "-o", "spectrum.h5")
        result = self.tool("plot_history", "spectrum.h5")
        self.assertEqual(result.returncode, 74)
        self.assertIn("is not a history written by overturn history", result.stderr)


if __name__ == "__main__":
    unittest.main()
