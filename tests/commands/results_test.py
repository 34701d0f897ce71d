"""Output of finished runs: what is stored, and equal bytes from equal jobs."""

import json
import subprocess
import tomllib
import unittest

import h5py
import numpy as np
import xarray

from program import ENVIRONMENT, JOBS, OVERTURN, PATIENCE, SMALL, Scratch, checksum, words


def few_points_of(job):
    """Returns --set arguments that reduce the axes of a job to at most three values each."""
    return [f"--set=plane.{name}.count=3" for name, axis in job.get("plane", {}).items()
            if isinstance(axis, dict) and axis.get("count", 0) > 3]


class AShippedJob(Scratch):
    def test_gives_a_data_frame_of_its_points_with_coordinates_and_fields(self):
        for path in sorted(JOBS.glob("*.toml")):
            job = tomllib.loads(path.read_text())
            fields = job.get("output", {}).get("fields", ["region"])
            for command in ("run", "boundary"):
                if command == "boundary" and path.stem not in ("smoke", "statue"):
                    continue
                with self.subTest(path.stem, command=command):
                    self.assert_exit(self.overturn(command, str(path), "-o", "out.h5", *few_points_of(job)), 0)
                    with xarray.open_dataset(self.folder / "out.h5") as found:
                        if command == "boundary":
                            fields = ["flip_amplitude", "flip_pga", "region_below", "region_above"]
                        self.assertEqual(set(found.data_vars), set(fields))
                        table = found.to_dataframe()
                        self.assertEqual(len(table), found[fields[0]].size)
                        self.assertEqual(set(table.columns), {*fields, *found.coords} - {*found.dims})
                        for name in found.variables:
                            self.assertLessEqual(len(found[name].attrs["long_name"]), 40, name)
                    (self.folder / "out.h5").unlink()


class AFinishedFile(Scratch):
    def test_the_output_is_named_after_the_job_in_the_working_directory(self):
        (self.folder / "jobs").mkdir()
        (self.folder / "small.toml").rename(self.folder / "jobs" / "small.toml")
        self.assert_exit(self.overturn("run", "jobs/small.toml"), 0, "small.h5")
        self.assertIn("small.h5", self.files())

    def test_a_block_in_metres_has_periods_in_seconds_and_accelerations_in_g(self):
        job = SMALL.replace("slenderness = { values = [0.1745716] }", "")
        (self.folder / "block.toml").write_text(
            job + "[block]\nhalf_width = 1.0\nhalf_height = 5.67\n")
        self.assert_exit(self.overturn("run", "block.toml"), 0)
        for engine in ("netcdf4", "h5netcdf"):
            with xarray.open_dataset(self.folder / "block.h5", engine=engine) as found:
                period = found.region.coords["pulse_period"]
                self.assertEqual(period.attrs["units"], "s")
                # p = 1.130441 rad/s, that of the paper's block.
                product = (period * found.frequency * 1.130441).values
                self.assertTrue(np.allclose(product, 2 * np.pi, rtol=1e-6))
                acceleration = found.region.coords["pga"]
                self.assertTrue(np.allclose((acceleration / found.amplitude).values, 1 / 5.67))
        self.overturn("run", "small.toml")
        with h5py.File(self.folder / "small.h5") as found:
            self.assertNotIn("pulse_period", found)

    def test_a_spectrum_is_written_as_csv_to_the_last_digit(self):
        self.overturn("run", "small.toml")
        self.assertEqual(self.tool("to_csv", "small.h5").returncode, 0)
        whole = np.genfromtxt(self.folder / "small.csv", delimiter=",", names=True)
        self.assertEqual(self.tool("to_csv", "small.h5", "--restitution", "1").returncode, 0)
        table = np.genfromtxt(self.folder / "small.csv", delimiter=",", names=True)
        with h5py.File(self.folder / "small.h5") as found:
            self.assertTrue(np.array_equal(whole["region"], found["region"][:].ravel()))
            shape = found["region"].shape[-2:]
            for name in ("region", "angle", "velocity", "margin", "impacts", "status"):
                self.assertTrue(np.array_equal(table[name].reshape(shape), found[name][:][..., 1, :, :].squeeze()), name)
            self.assertTrue((table["frequency"].reshape(shape) == found["frequency"][:]).all())
            self.assertTrue(
                (table["amplitude"].reshape(shape) == found["amplitude"][:][:, None]).all())

    def test_running_again_reports_a_complete_file_and_changes_nothing(self):
        self.assert_exit(self.overturn("run", "small.toml"), 0, "24 tiles", "60.0 k points")
        before = checksum(self.folder / "small.h5")
        for ranks in (None, 3):
            result = self.overturn("run", "small.toml", ranks=ranks)
            self.assert_exit(result, 0, "small.h5 is already complete")
            self.assertEqual(checksum(self.folder / "small.h5"), before)

    def test_of_one_point_is_described_in_the_singular(self):
        one = ("--set=plane.frequency=3", "--set=plane.amplitude=2", "--set=plane.restitution=0.9")
        self.assert_exit(self.overturn("check", "small.toml", *one), 0, "points 1 in 1 tile")
        self.assert_exit(self.overturn("run", "small.toml", "-o", "one.h5", *one), 0,
                         "one.h5: 1 point in 1 tile; 1 rank,", "computed 1 point in")

    def test_info_describes_its_contents(self):
        self.overturn("run", "small.toml")
        result = self.overturn("info", "small.h5")
        self.assert_exit(
            result, 0, "A small plane", "24 of 24 done", "200 values from 0.5 to 8", "region, uint8"
        )
        self.assertNotIn("unfinished", result.stdout)

    def test_is_read_if_its_values_are_compressed(self):
        # All blocks stay at rest: a thousandth of the size, and more values than the file has bytes.
        self.overturn("run", "small.toml", "-o", "plain.h5", "--set=output.fields=[\"region\"]",
                      "--set=plane.amplitude={ first = 0.1, last = 0.9, count = 5000 }")
        subprocess.run(["h5repack", "-f", "GZIP=9", "plain.h5", "small.h5"], cwd=self.folder, check=True)
        self.assertLess((self.folder / "small.h5").stat().st_size, 2 * 200 * 5000)
        self.assert_exit(self.overturn("info", "small.h5"), 0, "5000 values from 0.1 to 0.9")
        self.assert_exit(self.overturn("verify", "small.h5"), 0, "checksums match")
        with h5py.File(self.folder / "small.h5", "r+") as file:
            file["region"][0, 1, 2, 3] += 1
        self.assert_exit(self.overturn("verify", "small.h5"), 74, "1 of 632 finished tiles")

    def test_the_sidecar_contains_each_ranks_share(self):
        self.assert_exit(self.overturn("run", "small.toml", ranks=3), 0, "3 ranks")
        sidecar = json.loads((self.folder / "small.h5.json").read_text())
        self.assertEqual(len(sidecar["ranks"]), 3)
        self.assertEqual(sum(rank["tiles"] for rank in sidecar["ranks"]), 24)
        self.assertRegex(sidecar["start"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z$")
        self.assertRegex(sidecar["hdf5"], r"^\d+\.\d+\.\d+$")
        for key in ("compiler", "mpi", "program_commit", "wall_seconds"):
            self.assertTrue(sidecar[key])


class Check(Scratch):
    def test_prints_the_plane_its_size_and_time_and_writes_nothing(self):
        before = self.files()
        result = self.overturn("check", "small.toml")
        self.assert_exit(
            result, 0, "A small plane", "one_sine", "60.0 k in 24 tiles", "on one rank",
            "region, 60.0 kB", "angle, 480 kB",
        )  # fmt: skip
        self.assertNotIn("window", result.stdout)
        self.assertEqual(self.files(), before)

    def test_prints_how_much_the_window_cuts_off_a_ricker_wavelet(self):
        # |f| at 2 pi, over the peak: 19 exp(-pi^2) and z (z^2 - 3) exp(-z^2/2) / 1.38, z = 2 pi/sqrt 3.
        for pulse, cut in (("symmetric_ricker", "0.097 %"), ("antisymmetric_ricker", "3.7 %")):
            result = self.overturn("check", "small.toml", "--set", f"scene.pulse={pulse}")
            self.assert_exit(result, 0, pulse, cut)

    def test_estimates_a_time_that_grows_with_the_plane(self):
        def estimate(points):
            counts = [f"plane.{axis}.count={points}" for axis in ("frequency", "amplitude")]
            result = self.overturn("check", "long.toml", "--set", counts[0], "--set", counts[1])
            text = words(result.stdout).split("about ")[1].split(" on one rank")[0]
            seconds = {"ms": 0.001, "s": 1, "min": 60, "h": 3600}
            parts = text.split(" ")
            return sum(float(n) * seconds[unit] for n, unit in zip(parts[::2], parts[1::2]))

        # A hundred times as many points; a busy machine may be off by 2, a lost factor by more.
        ratio = estimate(4000) / estimate(400)
        self.assertGreater(ratio, 20)
        self.assertLess(ratio, 500)


class EqualJobs(Scratch):
    def test_give_equal_bytes_on_any_number_of_ranks(self):
        for ranks in (1, 2, 3, 5):
            output = f"{ranks}.h5"
            self.assert_exit(self.overturn("run", "small.toml", "-o", output, ranks=ranks), 0)
            self.assertEqual(checksum(self.folder / output), checksum(self.folder / "1.h5"))

    def test_give_equal_bytes_with_any_kernel(self):
        for method in ("rk45", "taylor"):
            run = ["run", "small.toml", "--set", f"numerics.method={method!r}", "-o"]
            best = f"{method}.h5"
            self.assert_exit(self.overturn(*run, best), 0)
            for kernel in ("double", "avx2", "avx512"):
                output = f"{method}_{kernel}.h5"
                result = self.overturn(*run, output, "--kernel", kernel)
                if "this build has no kernel" in result.stderr:  # of a build with the native one alone
                    continue
                if result.returncode == 2:
                    self.assert_exit(result, 2, "this processor does not support it")
                    self.assertEqual(kernel, "avx512")
                    continue
                self.assert_exit(result, 0, f"kernel {kernel}")
                self.assertEqual(checksum(self.folder / output), checksum(self.folder / best))

    def test_differ_between_methods_in_their_last_digits_only(self):
        fields = []
        for method in ("rk45", "taylor"):
            output = f"{method}.h5"
            self.assert_exit(self.overturn("run", "small.toml", "-o", output, "--set",
                                           f"numerics.method={method!r}", "--set",
                                           "numerics.tolerance=1e-10"), 0)
            with h5py.File(self.folder / output) as spectrum:
                fields.append({name: spectrum[name][...] for name in ("region", "angle", "impacts")})
        first, second = fields
        self.assertTrue((first["region"] == second["region"]).all())
        self.assertTrue((first["impacts"] == second["impacts"]).all())
        # 60,000 points, each within about a hundred steps of 1e-10 alpha; F ends at pi/2 exactly.
        self.assertLess(abs(first["angle"] - second["angle"]).max(), 1e-7)
        self.assertGreater(abs(first["angle"] - second["angle"]).max(), 0)


class SideBySide(Scratch):
    def test_single_rank_runs_do_not_interfere(self):
        runs = [
            subprocess.Popen(
                [OVERTURN, "run", "small.toml", "-o", f"{i}.h5"], cwd=self.folder,
                env=ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
            )  # fmt: skip
            for i in range(12)
        ]
        for i, run in enumerate(runs):
            _, complaints = run.communicate(timeout=PATIENCE)
            self.assertEqual(run.returncode, 0, complaints)
            self.assertNotIn("Error", complaints)
            self.assertEqual(checksum(self.folder / f"{i}.h5"), checksum(self.folder / "0.h5"))

    def test_single_rank_runs_share_no_folder_of_mpi(self):
        # A folder created and removed by each run would be a race; here none can be created.
        self.assert_exit(
            self.overturn("run", "small.toml", shell_setup="export TMPDIR=/dev/null"), 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
