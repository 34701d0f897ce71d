"""Parts of a job, `run --part`, and the file that `overturn merge` makes of them. Also requires the library
FAULTY_DISK of tests/faults in the environment."""

import json
import math
import re
import signal
import time
import unittest

import h5py
import numpy as np

from disk_test import OnFaultyDisk, OnSmallDisk
from program import JOBS, PATIENCE, Scratch, checksum, words


class ScratchWithParts(Scratch):
    JOB = ["run", "small.toml"]

    def setUp(self):
        super().setUp()
        self.have("whole.h5", lambda: self.overturn(*self.JOB, "-o", "whole.h5"))
        self.whole = checksum(self.folder / "whole.h5")

    @staticmethod
    def part(number, count):
        return f"small.part-{number:0{len(str(count))}}-of-{count}.h5"

    def parts(self, count):
        return [self.part(number, count) for number in range(1, count + 1)]

    def have_part(self, number, count):
        self.have(self.part(number, count), lambda: self.overturn(*self.JOB, "--part", f"{number}/{count}"))

    def have_parts(self, count):
        for number in range(1, count + 1):
            self.have_part(number, count)

    def merge(self, parts, output="merged.h5"):
        return self.overturn("merge", *parts, "-o", output)

    def assert_merged(self, parts, output="merged.h5"):
        self.assert_exit(self.merge(parts, output), 0, f"from {len(parts)} part")
        self.assertEqual(checksum(self.folder / output), self.whole)


class MergedParts(ScratchWithParts):
    """Have the bytes of one run."""

    def test_of_16_which_may_be_given_in_any_order(self):
        self.have_parts(16)
        self.assert_merged(self.parts(16)[::-1])
        self.assert_exit(self.overturn(*self.JOB, "-o", "merged.h5"), 0, "merged.h5 is already complete.")
        self.assert_exit(self.merge(self.parts(16)), 0, "merged.h5 is already complete.")
        self.assertFalse([name for name in self.files() if name.endswith((".lock", ".part"))])

    def test_of_one(self):
        self.assert_exit(self.overturn(*self.JOB, "--part", "1/1"), 0, "part 1 of 1: 60.0 k points in 24 tiles")
        self.assert_merged([self.part(1, 1)])

    def test_of_different_numbers_of_ranks_kernels_and_files(self):
        for number, (ranks, kernel) in enumerate([(None, "double"), (2, "avx2"), (3, "auto")], 1):
            self.assert_exit(self.overturn(*self.JOB, "--part", f"{number}/3", "-o", f"{number}.h5", "--kernel", kernel,
                                           ranks=ranks), 0, f"part {number} of 3: 20.0 k points in 8 tiles")
        self.assert_merged(["1.h5", "2.h5", "3.h5"])

    def test_of_other_products(self):
        def settings(*all_settings):
            return [f"--set={each}" for each in all_settings]

        fill = settings("numerics.fill=true", 'output.fields=["region"]', "numerics.audit=0.01")
        along = settings("boundary.along=slenderness", "plane.slenderness={first=0.15,last=0.3,count=9}",
                         "plane.frequency.count=3", "plane.amplitude.count=2")
        strips = settings("plane.scale={first=1.0,last=1.2,count=3}", "plane.size={first=0.4,last=0.9,count=5}")
        statues = settings("plane.pulse_period.count=66", "plane.pga.count=9")
        for product in (["run", "small.toml", *fill], ["boundary", "small.toml", *along],
                        ["boundary", JOBS / "synthetic.toml", *strips], ["run", JOBS / "statues.toml", *statues]):
            with self.subTest(product):
                one = self.overturn(*product, "-o", "one.h5")
                self.assert_exit(one, 0)
                for number in (1, 2):
                    self.assert_exit(self.overturn(*product, "--part", f"{number}/2", "-o", f"{number}.h5"), 0)
                merged = self.merge(["1.h5", "2.h5"], "merged.h5")
                self.assert_exit(merged, 0)
                self.assertEqual(checksum(self.folder / "merged.h5"), checksum(self.folder / "one.h5"))
                # What must be known of the result is printed as by one run.
                computed = re.search(r"one.h5: computed .*\n((?s:.*))", one.stdout)[1]
                self.assertEqual(merged.stdout.partition("\n")[2], computed.replace("one.h5", "merged.h5"))
                for name in ("one.h5", "1.h5", "2.h5", "merged.h5"):
                    (self.folder / name).unlink()


class InSinglePrecision(ScratchWithParts):
    """The fields that are numbers; of runs, parts, ranks and kernels, the bytes are the same."""

    JOB = [*ScratchWithParts.JOB, "--set", 'output.precision="single"']

    def test_values_are_those_in_double_precision_rounded(self):
        self.assert_exit(self.overturn(*ScratchWithParts.JOB, "-o", "double.h5"), 0)
        self.assert_exit(self.overturn("verify", "whole.h5"), 0, "24 of 24 tiles are done")
        with h5py.File(self.folder / "whole.h5") as single, h5py.File(self.folder / "double.h5") as double:
            for name in ("region", "angle", "velocity", "margin", "impacts", "status"):
                is_number = name in ("angle", "velocity", "margin")
                self.assertEqual(single[name].dtype, np.float32 if is_number else double[name].dtype)
                rounded = double[name][:].astype(single[name].dtype)
                np.testing.assert_array_equal(single[name][:], rounded)
            self.assertEqual(single["margin"].attrs["_FillValue"].dtype, np.float32)
            for name in ("frequency", "amplitude"):
                self.assertEqual(single[name].dtype, np.float64)

    def test_parts_of_any_ranks_and_kernels_are_merged_to_the_bytes_of_one_run(self):
        for number, (ranks, kernel) in enumerate([(None, "double"), (2, "avx2"), (3, "auto")], 1):
            self.assert_exit(self.overturn(*self.JOB, "--part", f"{number}/3", "-o", f"{number}.h5", "--kernel", kernel,
                                           ranks=ranks), 0)
        self.assert_merged(["1.h5", "2.h5", "3.h5"])

    def test_continues_no_file_of_another_precision(self):
        self.assert_exit(self.overturn(*ScratchWithParts.JOB, "-o", "whole.h5"), 74, "belongs to another job",
                         'precision = "single"')

    def test_of_a_boundary_is_double(self):
        few = ["--set=plane.frequency.count=2", "--set=plane.amplitude.count=3"]
        self.assert_exit(self.overturn("boundary", *self.JOB[1:], *few, "-o", "boundary.h5"), 0)
        with h5py.File(self.folder / "boundary.h5") as file:
            self.assertEqual(file["flip_amplitude"].dtype, np.float64)

    def test_of_another_name_is_refused(self):
        self.assert_exit(self.overturn("check", "small.toml", "--set", 'output.precision="half"'), 65,
                         'output.precision = "half" is unknown. Allowed: single, double.')


class APart(ScratchWithParts):
    def test_is_an_unfinished_result_that_says_which_part_it_is(self):
        self.have_part(3, 16)
        name = self.part(3, 16)
        self.assert_exit(self.overturn("info", name), 0, "part 3 of 16, with 2 of the 24 tiles of the job",
                         "tiles 2 of 2 done", "unfinished Join all parts with overturn merge")
        self.assert_exit(self.overturn("verify", name), 0, f"{name}: part 3 of 16: 2 of 2 tiles are done")
        with h5py.File(self.folder / name) as file, h5py.File(self.folder / "whole.h5") as whole:
            done = file["run/checksum"][:] != 0
            self.assertEqual(np.count_nonzero(done), 2)
            np.testing.assert_array_equal(file["run/checksum"][:][done], whole["run/checksum"][:][done])
            # Readers that ignore the checksums read the values of points that are not computed.
            points = np.kron(done.reshape(1, 2, 3, 4), np.ones((64, 64), bool))[..., :150, :200]
            for field in ("region", "margin", "impacts"):
                values = file[field][:]
                np.testing.assert_array_equal(values[points], whole[field][:][points])
                np.testing.assert_array_equal(values[~points], file[field].fillvalue)
        self.assertLess((self.folder / name).stat().st_size, (self.folder / "whole.h5").stat().st_size / 6)

    def test_resumes_after_a_stop_and_a_kill_on_other_ranks(self):
        # 18 whole tiles: each row of those at the edge takes a write.
        job, name = [*self.JOB, "--set", "plane.frequency.count=192"], self.part(2, 2)
        second = [*job, "--part", "2/2"]
        self.assert_exit(self.overturn(*second), 0)
        self.forget(name, ...)  # the slow runs need not create the file
        for end in (signal.SIGUSR1, signal.SIGKILL):
            with self.start(*second, variables=self.with_slow(name, milliseconds=16)) as process:
                self.assertIn("part 2 of 2: ", process.stdout.readline())
                process.send_signal(signal.SIGSTOP)  # while its tiles are counted
                before = self.tiles_done(name)
                while self.tiles_done(name) < before + 2:
                    process.send_signal(signal.SIGCONT)
                    time.sleep(0.05)
                    self.assertIsNone(process.poll(), "the run ended too early")
                    process.send_signal(signal.SIGSTOP)
                process.send_signal(end)
                process.send_signal(signal.SIGCONT)
                output, _ = process.communicate(timeout=PATIENCE)
            self.go_on()
            self.assertEqual(process.returncode, 85 if end == signal.SIGUSR1 else -end, output)
        done = self.tiles_done(name)
        self.assert_exit(self.overturn("info", name), 0, f"overturn run JOB.toml --part 2/2 -o {name}")
        found = json.loads(self.overturn("info", name, "--json").stdout)
        points = math.prod(axis["size"] for axis in found["axes"])
        self.assertEqual([found[key] for key in ("part", "parts", "tiles", "tiles_done", "items_all", "items_done")],
                         [2, 2, 9, done, points // 2, points * done // 18])
        self.assert_exit(self.merge([name]), 74, "of 2 parts, 1 is missing: 1, and 1 is unfinished: 2.")
        self.assert_exit(self.overturn(*second, ranks=2), 0, f"part 2 of 2: resuming: {done} of 9 tiles done")
        self.assert_exit(self.overturn(*job, "--part", "1/2", ranks=2), 0)
        self.assert_exit(self.merge([self.part(1, 2), name]), 0)
        self.assert_exit(self.overturn(*job, "-o", "one.h5"), 0)
        self.assertEqual(checksum(self.folder / "merged.h5"), checksum(self.folder / "one.h5"))

    def tiles_done(self, name):
        told = words(self.overturn("info", name).stdout)
        return int(told.split(" tiles ")[1].split(" of ")[0]) if " tiles " in told else 0

    def test_is_refused_if_it_is_no_part_or_the_job_has_fewer_tiles(self):
        for given in ("0/3", "4/3", "3", "1/x", "1/", "-1/3", "1/1000000", "1/2/3"):
            self.assert_refused(2, [f"--part: {given} is no part. Give I/N"], *self.JOB, f"--part={given}")
        self.assert_refused(2, ["--part 1/25: the job has 24 tiles"], *self.JOB, "--part", "1/25")

    def test_is_not_continued_as_another_one(self):
        self.have_part(3, 16)
        for more in (["--part", "4/16"], ["--part", "3/8"], []):
            self.assert_refused(74, ["is part 3 of 16 of this job, but"], *self.JOB, *more, "-o", self.part(3, 16))
        self.assert_refused(74, ["is the whole of this job, but part 1 of 16"], *self.JOB, "--part", "1/16", "-o",
                            "whole.h5")


class AMerge(ScratchWithParts):
    """Refuses parts before anything is written."""

    def setUp(self):
        super().setUp()
        self.have_parts(3)

    def assert_not_merged(self, phrases, *parts):
        self.assert_refused(74, phrases, "merge", *parts, "-o", "merged.h5")

    def test_is_refused_with_the_reason(self):
        first, second, third = self.parts(3)
        self.assert_not_merged(["of 3 parts, 1 is missing: 2."], first, third)
        self.assert_not_merged(["of 3 parts, 1 is missing: 2."], first, "nowhere.h5", third)
        self.assert_not_merged([f'"{first}" and "{first}" are both part 1 of 3'], first, first, second, third)
        self.assert_not_merged(["whole.h5", "not of a part of it"], first, second, third, "whole.h5")
        self.assert_not_merged(["small.toml", "is not an HDF5 file"], "small.toml")
        self.assert_not_merged(["nowhere.h5"], "nowhere.h5")
        self.assert_exit(self.overturn(*self.JOB, "--part", "1/2", "-o", "half.h5"), 0)
        self.assert_not_merged(['"half.h5" is part 1 of 2', "is part 1 of 3"], *self.parts(3), "half.h5")
        self.assert_exit(self.overturn(*self.JOB, "--part", "1/3", "-o", "other.h5", "--set",
                                       "numerics.tolerance=1e-7"), 0)
        self.assert_not_merged(['"other.h5" belongs to another job', "tolerance = 1e-07"], second, "other.h5", third)
        self.assert_refused(74, [f'"{first}" is part 1 of 3, not the file of all parts'], "merge", *self.parts(3),
                            "-o", first)
        self.assert_refused(2, ["-o"], "merge", *self.parts(3))

    def test_is_refused_if_a_part_is_unfinished_or_damaged_until_it_is_computed_again(self):
        for name, how in (("second", self.lose_a_checksum), ("third", self.change_a_value)):
            with self.subTest(name):
                how()
                self.assert_exit(self.overturn(*self.JOB, "--part", "2/3"), 0)
                self.assert_merged(self.parts(3))
                (self.folder / "merged.h5").unlink()

    def lose_a_checksum(self):
        with h5py.File(self.folder / self.part(2, 3), "r+") as file:
            tile = np.flatnonzero(file["run/checksum"][:])[-1]
            file["run/checksum"][tile] = 0
        self.assert_not_merged(["of 3 parts, 1 is unfinished: 2."], *self.parts(3))

    def change_a_value(self):
        with h5py.File(self.folder / self.part(2, 3), "r+") as file:
            place = np.argwhere(np.isfinite(file["margin"][:]))[-1]
            file["margin"][tuple(place)] += 1e-9
        self.assert_not_merged([self.part(2, 3), "the checksums of 1 of 8 finished tiles do not match",
                                "overturn run JOB.toml --part 2/3"], *self.parts(3))

    def test_is_refused_if_another_file_has_its_name(self):
        self.assert_exit(self.overturn(*self.JOB, "-o", "merged.h5"), 0)
        self.forget("merged.h5", 5)
        self.assert_not_merged(['"merged.h5" exists, but lacks 1 of 24 tiles'], *self.parts(3))
        (self.folder / "merged.h5").write_text("somebody else's")
        self.assert_not_merged(["merged.h5"], *self.parts(3))
        self.assertEqual((self.folder / "merged.h5").read_text(), "somebody else's")


class AMergeOnABadDisk(OnSmallDisk, OnFaultyDisk, ScratchWithParts):
    def test_that_is_too_small_is_refused_before_anything_is_written(self):
        self.have_parts(3)
        result = self.on_small_disk(f"$OVERTURN merge {' '.join(self.parts(3))} -o $DISK/out.h5; code=$?;"
                                    "[[ -z $(ls $DISK) ]] || exit 1; exit $code")
        self.assert_exit(result, 74, "it takes 2", "bytes, but", "are available. Free some space, or choose")

    def test_can_be_repeated_after_an_error_a_kill_or_a_stop(self):
        self.have_parts(3)
        before = self.files()
        merge = ["merge", *self.parts(3), "-o", "out.h5"]
        result = self.overturn_on_faulty_disk(*merge, COUNT_WRITES_IN=self.folder / "count")
        self.assert_exit(result, 0)
        writes = int((self.folder / "count").read_text().split()[0])
        for name in ("out.h5", "count"):
            (self.folder / name).unlink()
        for write in (1, writes // 2, writes):
            result = self.overturn_on_faulty_disk(*merge, FAIL_AT_WRITE=write, ERROR=28)
            self.assert_exit(result, 74, "cannot create", "no space left on device")
            self.assertEqual(self.files(), before)
            stopped = self.overturn_on_faulty_disk(*merge, KILL_AT_WRITE=write, KILL_BY=int(signal.SIGUSR1))
            self.assertIn(stopped.returncode, (0, 85), stopped.stderr)  # after the last chunk it is too late
            if stopped.returncode == 85:
                self.assertIn("stopped by a signal before the parts were merged", stopped.stderr)
                self.assertEqual(self.files(), before)
            (self.folder / "out.h5").unlink(missing_ok=True)
            killed = self.overturn_on_faulty_disk(*merge, KILL_AT_WRITE=write, KILL_TORN=1)
            self.assertEqual(killed.returncode, -signal.SIGKILL)
            self.assertNotIn("out.h5", self.files())
            self.assert_merged(self.parts(3), "out.h5")
            self.assertEqual(self.files(), sorted([*before, "out.h5"]))
            (self.folder / "out.h5").unlink()


if __name__ == "__main__":
    unittest.main(verbosity=2)
