"""tools/floor_motion: the files that it writes, and what it refuses. Requires OVERTURN (the binary) in the environment."""

import json
import os
import subprocess
import unittest

import numpy as np
from tool import JOBS, PATIENCE, InAFolder

import overturn

RECORD = JOBS / "synthetic.AT2"
TWO_MODES = ("--period", "0.6", "0.24", "--shape", "1.0", "0.16")


class TestAMotionOfAFloor(InAFolder):
    TOOL = "floor_motion"

    def samples(self, name):
        return np.loadtxt(self.folder / name)[:, 1]

    def test_is_that_of_the_package(self):
        shown = self.output_of(RECORD, *TWO_MODES, "--damping", "0.03")
        expected = overturn.floor_motion(overturn.read_record(RECORD), periods=[0.6, 0.24], damping=0.03, shape=[1.0, 0.16])
        np.testing.assert_array_equal(self.samples("floor/synthetic.txt"), expected.acceleration)
        self.assertEqual(overturn.read_record(self.folder / "floor/synthetic.txt").ground_pga, expected.ground_pga)
        self.assertRegex(shown, rf"floor/synthetic.txt +0\.4000 +{abs(expected.acceleration).max():.4f}\n")
        self.assertIn("--record 'floor/*.txt' --scale 1", shown)

    def test_of_a_straight_mode_has_its_shape(self):
        self.output_of(RECORD, "--period", "0.35", "--storeys", "3", "--floor", "2", "-o", "straight")
        self.output_of(RECORD, "--period", "0.35", "--shape", str(6 / 7), "-o", "given")
        np.testing.assert_array_equal(self.samples("straight/synthetic.txt"), self.samples("given/synthetic.txt"))

    def test_is_written_for_each_factor_on_the_periods(self):
        self.output_of(RECORD, *TWO_MODES, "--period-factors", "0.8", "1", "1.25")
        self.assertEqual(sorted(path.name for path in (self.folder / "floor").iterdir()),
                         ["synthetic_0.8.txt", "synthetic_1.25.txt", "synthetic_1.txt"])
        self.output_of(RECORD, "--period", "0.75", "0.3", "--shape", "1.0", "0.16", "-o", "longer")
        np.testing.assert_array_equal(self.samples("floor/synthetic_1.25.txt"), self.samples("longer/synthetic.txt"))

    def test_is_a_motion_of_assess(self):
        self.output_of(RECORD, *TWO_MODES)
        (self.folder / "objects.csv").write_text("name,width,height\nstatue,0.5,2.0\n")
        done = subprocess.run([os.environ["OVERTURN"], "assess", "objects.csv", "--record", "floor/*.txt", "--scale", "1",
                               "--json"], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE, check=True)
        self.assertEqual(json.loads(done.stdout)["objects"][0]["verdict"], "topples")  # as on the page, docs/floors.md


class TestAMotionOfAFloorRefused(InAFolder):
    TOOL = "floor_motion"

    def refuses_and_writes_nothing(self, code, sentence, *arguments):
        self.refuses(code, sentence, *arguments)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_without_a_shape_or_with_two(self):
        for options in ((), ("--shape", "1", "--storeys", "3", "--floor", "2")):
            self.refuses_and_writes_nothing(2, "give either --shape, or --storeys and --floor", RECORD, "--period", "0.5", *options)
        self.refuses_and_writes_nothing(2, "belong together", RECORD, "--period", "0.5", "--floor", "2")
        self.refuses_and_writes_nothing(2, "give one --period", RECORD, *TWO_MODES[:3], "--storeys", "3", "--floor", "2")
        self.refuses_and_writes_nothing(2, "--floor 4 is outside 1 to 3", RECORD, "--period", "1", "--storeys", "3", "--floor", "4")

    def test_of_values_that_are_not_allowed(self):
        self.refuses_and_writes_nothing(2, "damping[0] = 5 is outside (0, 1)", RECORD, *TWO_MODES, "--damping", "5")
        self.refuses_and_writes_nothing(2, "shape has the shape (1,)", RECORD, *TWO_MODES[:3], "--shape", "1")
        self.refuses_and_writes_nothing(2, "--period-factors has 1 twice", RECORD, *TWO_MODES, "--period-factors", "1", "1.0")

    def test_of_two_records_of_one_name(self):
        self.refuses_and_writes_nothing(2, "two records are called synthetic", RECORD, "a/synthetic.AT2", *TWO_MODES)

    def test_of_no_record(self):
        self.refuses_and_writes_nothing(74, "absent.AT2", "absent.AT2", *TWO_MODES)

    def test_among_other_texts(self):
        (self.folder / "floor").mkdir()
        (self.folder / "floor/notes.txt").write_text("a note\n")
        self.refuses(74, "it holds other texts, such as notes.txt", RECORD, *TWO_MODES)
        self.assertEqual(len(list((self.folder / "floor").iterdir())), 1)

    def test_warns_of_periods_in_milliseconds(self):
        run = self.run_tool(RECORD, "--period", "600", "--shape", "1.0", "--damping", "0.9")
        self.assertIn("periods[0] = 600 is outside 0.01 to 20", run.stderr)


if __name__ == "__main__":
    unittest.main()
