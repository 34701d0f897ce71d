"""Values of a quantity at which a block topples: overturn topple --vary, and boundary.along."""

import json
import re
import unittest

import h5py
import numpy as np

from program import JOBS, Scratch

HEIGHT = ("--height", "1.8", "--period", "0.5", "--pga", "0.95")
STATUE = (*HEIGHT, "--width", "0.6")
RECORD = ("--height", "1.8", "--record", str(JOBS / "synthetic.AT2"))


class AVariedQuantity(Scratch):
    def answer(self, *arguments):
        result = self.overturn("topple", *arguments, "--json")
        self.assert_exit(result, 0)
        return json.loads(result.stdout)

    def assert_topples(self, expected, *arguments):
        self.assertEqual(self.answer(*arguments, "--no-search")["topples"], expected, arguments)

    def test_of_the_statue_says_from_which_width_on_it_stands(self):
        text = self.overturn("topple", *HEIGHT, "--vary", "width", "0.3", "1.2").stdout
        for words in ("restitution  r = r_max\n", "verdict      nothing topples at 0.95 g from width = 0.6141 m on\n",
                      "topples      below 0.6141 m, searched from 0.3 up to 1.2 m\n", "in steps of 0.00225 m, halved"):
            self.assertIn(words, text)

    def test_states_the_restitution(self):
        for given, words in ((("--restitution", "0.64"), "r = 0.64"), (("--velocity-restitution", "0.8"), "r = 0.64"),
                             (("--restitution-of-maximum", "0.9"), "r = 0.9 r_max")):
            text = self.overturn("topple", *HEIGHT, *given, "--vary", "width", "0.3", "1.2").stdout
            self.assertIn(f"restitution  {words}\n", text)
        self.assertNotIn("restitution  ", self.overturn("topple", *STATUE, "--vary", "velocity_restitution", "0.5", "1").stdout)

    def test_changes_the_verdict_where_topple_does(self):
        for name, first, last, others in (
                ("width", 0.3, 1.2, HEIGHT), ("height", 1, 3, (*HEIGHT[2:], "--width", "0.6")),
                ("incline", -0.05, 0.05, (*STATUE, "--restitution-of-maximum", "0.9", "--direction", "180")),
                ("restitution", 0.4, 1, STATUE), ("friction", 0.1, 1, STATUE), ("center_height", 0.5, 1.3, STATUE),
                ("width", 0.3, 1.2, ("--height", "1.8", "--record", str(JOBS / "synthetic.AT2"), "--scale", "1.8"))):
            answer = self.answer(*others, "--vary", name, repr(first), repr(last))
            self.assertGreater(len(answer["changes"]), 0, name)
            option = "--" + name.replace("_", "-")
            for change in answer["changes"][:4]:
                self.assert_topples(False, *others, f"{option}={change!r}")  # the safe side of the change
            inner = [end for safe in answer["safe"] for end in safe if first < end < last]
            self.assertEqual(answer["changes"], inner)
            for begin, end in answer["topples"][:3]:
                self.assert_topples(True, *others, f"{option}={(begin + end) / 2!r}")

    def test_has_the_worse_of_both_directions_at_each_value(self):
        answer = self.answer(*STATUE, "--vary", "center_offset", "-0.04", "0.02")
        by_direction = answer["by_direction"]
        self.assertEqual([each["direction"] for each in by_direction], [0, 180])

        def is_in(ranges, value):
            return any(first < value < last for first, last in ranges)

        for value in np.random.default_rng(1).uniform(-0.04, 0.02, 200):
            self.assertEqual(is_in(answer["topples"], value), any(is_in(each["topples"], value) for each in by_direction))
            self.assertEqual(is_in(answer["safe"], value), all(is_in(each["safe"], value) for each in by_direction))
        text = self.overturn("topple", *STATUE, "--vary", "center_offset", "-0.04", "0.02").stdout
        self.assertTrue("in direction 0: " in text and "in direction 180: " in text)
        one = self.answer(*STATUE, "--vary", "center_offset", "-0.04", "0.02", "--direction", "180")
        self.assertEqual({name: one[name] for name in by_direction[1] if name != "direction"},
                         {name: value for name, value in by_direction[1].items() if name != "direction"})

    def test_rounds_so_that_the_stated_values_are_safe(self):
        generator = np.random.default_rng(2)
        for _ in range(5):
            motion = ("--height", "1.8", f"--period={generator.uniform(0.4, 0.8)!r}", f"--pga={generator.uniform(0.8, 1.2)!r}")
            text = self.overturn("topple", *motion, "--vary", "width", "0.3", "1.2").stdout
            width = re.search("from width = ([0-9.]+) m on", text)[1]
            self.assert_topples(False, *motion, "--width", width)
            answer = self.answer(*motion, "--vary", "width", "0.3", "1.2")
            self.assertTrue(0 <= float(width) - answer["safe_from"] < 1.01e-4)
            self.assertEqual(answer["safe_from"], answer["safe"][-1][0])

    def test_is_refused_before_anything_is_computed(self):
        for arguments, words in (
                (("--vary", "widht", "0.3", "1"), 'Did you mean "width"?'),
                (("--vary", "pga", "0.3", "1"), 'there is no quantity "pga". Allowed: width, '),
                (("--vary", "width", "1", "0.3"), "the first width, 1, is not below the last one, 0.3"),
                (("--vary", "width", "0.3", "0.3"), "is not below the last one"),
                (("--vary", "width", "0.3", "x"), "x is not a number"),
                (("--vary", "width", "0.3", "nan"), "width = nan is outside"),
                (("--vary", "width", "-0.3", "1"), "width = -0.3 is outside (0, inf)"),
                (("--vary", "width", "0.3"), "3 required"),
                (("--vary", "width", "0.3", "1", "--width", "0.5"), "--vary width cannot be combined with a value of width"),
                (("--vary", "restitution", "0.3", "1", "--restitution", "0.5"), "cannot be combined with a value of restitution"),
                (("--vary", "width", "0.3", "1", "--history", "a.h5"), "--history excludes --vary"),
                (("--vary", "width", "0.3", "1", "--no-search"), "--no-search excludes --vary"),
                (("--vary", "width", "0.3", "1", "--pga-max", "3"), "--pga-max excludes --vary")):
            self.assert_exit(self.overturn("topple", *HEIGHT, *arguments), 2, words)
        self.assert_exit(self.overturn("topple", *RECORD, "--vary", "width", "0.3", "1"), 2, "Give --pga or --scale")
        for arguments, words in (
                ((*STATUE, "--vary", "half_width", "0.3", "1"), "gives the same quantity"),
                ((*STATUE, "--vary", "size", "0.3", "1"), "describes the block in another way"),
                ((*HEIGHT, "--vary", "width", "0.3", "9"), "Possible are values from 0.3 to 2.54"),
                ((*STATUE, "--vary", "incline", "-0.5", "0.5"), "Possible are values from -0.3217 to 0.3217."),
                ((*STATUE, "--vary", "friction", "0.01", "1", "--incline", "0.1"), "Possible are values from 0.1004 to 1."),
                ((*STATUE, "--vary", "friction", "0.1", "1", "--set", "scene.theory=linear"), "no forces of the contact")):
            self.assert_exit(self.overturn("topple", *arguments), 65, words)


JOB = """
scene.pulse = "one_sine"
boundary.along = "width"
[plane]
pulse_period = {{ values = [0.4, 0.5, 0.8] }}
pga = {pga}
restitution_of_maximum = 1.0
width = {{ first = 0.3, last = 1.2, count = {count} }}
height = 1.8
"""


class ABoundaryAlongAQuantity(Scratch):
    def computed(self, name, pga="0.95", count=2, **options):
        (self.folder / "job.toml").write_text(JOB.format(pga=pga, count=count))
        self.assert_exit(self.overturn("boundary", "job.toml", "-o", name, **options), 0)
        return self.folder / name

    def test_has_the_changes_that_topple_finds(self):
        with h5py.File(self.computed("b.h5")) as file:
            self.assertEqual(file["flip_value"].attrs["units"], b"m")
            self.assertNotIn("flip_amplitude", file)
            np.testing.assert_array_equal(file["run/scan_width"][:], [0.3, 1.2])
            for column, period in enumerate(file["pulse_period"][:]):
                answer = json.loads(self.overturn("topple", "--height", "1.8", f"--period={period!r}", "--pga", "0.95",
                                                  "--vary", "width", "0.3", "1.2", "--json").stdout)
                flips = file["flip_value"][:, column]
                np.testing.assert_allclose(flips[np.isfinite(flips)], answer["changes"], rtol=0, atol=1e-11)
                self.assertGreater(len(answer["changes"]), 0)
                below = file["region_below"][0, column]
                self.assertEqual(below <= 2, answer["safe_up_to"] is not None)
        text = self.overturn("info", "b.h5").stdout
        self.assertIn("overturning at the first value of the job: 3 of 3 lines", text)
        self.assertIn('[boundary]\nalong = "width"\n', text)

    def test_on_several_ranks_and_resumed_is_the_same_file(self):
        several = "{ values = [0.3, 0.6, 0.9, 1.2] }"
        one = self.computed("one.h5", several, 4)
        self.assertEqual(one.read_bytes(), self.computed("two.h5", several, 4, ranks=3).read_bytes())
        with h5py.File(one) as file:
            self.assertEqual(file["flip_value"].shape, (64, 4, 3))
            self.assertFalse(np.isfinite(file["flip_value"][:, 0, 0]).any())  # a weak and short pulse
        with h5py.File(one, "r+") as file:
            file["run/checksum"][3:7] = 0
        self.computed("one.h5", several, 4)
        self.assertEqual(one.read_bytes(), (self.folder / "two.h5").read_bytes())

    def test_does_not_change_the_spectrum_nor_the_boundary_along_the_strength(self):
        for command in ("run", "boundary"):
            for name, words in (("with.h5", ("--set", "boundary.along=amplitude")), ("without.h5", ())):
                self.assert_exit(self.overturn(command, "small.toml", "-o", name, *words,
                                               "--set", "plane.frequency.count=9", "--set", "plane.amplitude.count=9"), 0)
            with h5py.File(self.folder / "with.h5") as one, h5py.File(self.folder / "without.h5") as other:
                self.assertEqual(one["run/job_resolved"][:].tobytes(), other["run/job_resolved"][:].tobytes())
                self.assertEqual(one["run/checksum"][:].tobytes(), other["run/checksum"][:].tobytes())
            for name in ("with.h5", "without.h5"):
                (self.folder / name).unlink()

    def test_needs_several_values_of_a_known_quantity(self):
        self.computed("b.h5")
        for along, words in (("height", "plane.height has one value, 1.8"), ("widht", 'Did you mean "width"?'),
                             ("incline", "incline is not among the coordinates of the job"),
                             ("pga", "plane.pga has one value, 0.95"), ("pulse_period", '"pulse_period" is unknown')):
            self.assert_exit(self.overturn("boundary", "job.toml", "-o", "x.h5", "--set", f"boundary.along={along}"), 65, words)
            self.assertFalse((self.folder / "x.h5").exists())

    def test_is_refused_if_values_between_the_ends_describe_no_block(self):
        # J / m = k^2 + h^2 - b_plus b_minus is smallest in the middle.
        self.computed("b.h5")
        wide = [f"--set=plane.{setting}" for setting in ("width=3", "height=1", "restitution=0.1", "pulse_period=0.5")]
        for ends, code, words in (("first=1.2, last=1.4", 0, ""), ("first=-1.4, last=1.4", 65, "moment_kept = -")):
            self.assert_exit(self.overturn("boundary", "job.toml", "-o", "x.h5", *wide, "--set", "boundary.along=center_offset",
                                           "--set", f"plane.center_offset={{{ends}, count=2}}"), code, words)


if __name__ == "__main__":
    unittest.main(verbosity=2)
