"""Blocks that may slip: what goes together with the key `friction`, and what is refused."""

import json
import math
import unittest

import h5py
import numpy as np

from program import JOBS, Scratch

SLIPPED = 64
JOB = """
[scene]
{scene}
[block]
width = {width}
height = 1.8
friction = {friction}
{block}
[plane]
{motion}
restitution_of_maximum = {restitution}
[numerics]
{numerics}
[output]
fields = {fields}
"""
PULSE = "pulse_period = 0.5\npga = { first = 0.3, last = 2.5, count = 45 }"
SCALES = "scale = { first = 0.5, last = 1.6, count = 12 }"
FIELDS = ["region", "angle", "velocity", "margin", "error", "peak", "fall_time", "friction_demand", "normal", "slide",
          "slide_peak", "impacts", "steps", "status"]


class Friction(Scratch):
    def write(self, scene='pulse = "one_sine"', motion=PULSE, block="", friction="0.4", restitution="1", numerics="",
              width=0.6, fields=FIELDS):
        (self.folder / "job.toml").write_text(JOB.format(scene=scene, motion=motion, block=block, friction=friction,
                                                         restitution=restitution, numerics=numerics, width=width,
                                                         fields=json.dumps(list(fields))))

    def computed(self, **what):
        self.write(**what)
        (self.folder / "r.h5").unlink(missing_ok=True)
        self.assert_exit(self.overturn("run", "job.toml", "-o", "r.h5"), 0)
        with h5py.File(self.folder / "r.h5") as file:
            return {name: file[name][()].ravel() for name in what.get("fields", FIELDS)}

    def refused(self, command, *words, **what):
        self.write(**what)
        self.assert_exit(self.overturn(command, "job.toml", "-o", "r.h5"), 65, *words)
        self.assertFalse((self.folder / "r.h5").exists())

    def expect_slips(self, found):
        slips = (found["status"] & SLIPPED) != 0
        self.assertGreater(slips.sum(), 0)
        self.assertTrue((found["region"] != 254).all())
        self.assertTrue((found["slide_peak"][slips] > 0).all())
        self.assertTrue((found["slide"][~slips] == 0).all())
        self.assertTrue((abs(found["slide"]) <= found["slide_peak"]).all())

    def test_that_is_not_needed_changes_no_bit(self):
        for scene, motion in (('pulse = "one_sine"', PULSE), ('pulse = "symmetric_ricker"', PULSE),
                              (f'record = "{JOBS}/synthetic.AT2"', SCALES)):
            for numerics in ("", 'method = "taylor"', "resolve = true"):
                for block in ("", "center_offset = 0.05\nincline = 0.03"):
                    with self.subTest(scene=scene, numerics=numerics, block=block):
                        what = {"scene": scene, "motion": motion, "numerics": numerics, "block": block}
                        found = self.computed(friction="5", **what)
                        text = (self.folder / "job.toml").read_text()
                        (self.folder / "job.toml").write_text(
                            text.replace("friction = 5\n", "").replace(', "slide", "slide_peak"', ""))
                        (self.folder / "plain.h5").unlink(missing_ok=True)
                        self.assert_exit(self.overturn("run", "job.toml", "-o", "plain.h5"), 0)
                        with h5py.File(self.folder / "plain.h5") as plain:
                            same = (found["status"] & SLIPPED) == 0
                            self.assertGreater(same.sum(), 5)
                            for name in plain:
                                if name in found:
                                    np.testing.assert_array_equal(found[name][same], plain[name][()].ravel()[same])
                            # A block that needs less than the coefficient until it last passes alpha, and stands.
                            stands = (plain["region"][()].ravel() <= 2) & (plain["friction_demand"][()].ravel() < 5)
                            self.assertTrue(same[stands].all())

    def test_is_needed_by_impacts_of_blocks_with_two_sides(self):
        # h b / (k^2 + h^2) is 0.35 at the corner plus; the block lifts at the corner minus, which needs 0.1875.
        block = "center_offset = -0.1\ncenter_height = 0.8\nradius_of_gyration = 0.4"
        for friction, slips in ((0.3499, True), (0.3501, False)):
            found = self.computed(friction=str(friction), motion="pulse_period = 0.5\npga = 0.19",
                                  width=0.5, block=block, fields=["status", "friction_demand", "impacts", "region"])
            self.assertEqual(bool(found["status"][0] & SLIPPED), slips)
            self.assertLess(found["friction_demand"][0], 0.3499)
            self.assertLessEqual(found["region"][0], 2)

    def test_goes_with_every_pulse(self):
        for pulse in ("one_sine", "one_cosine", "symmetric_ricker", "antisymmetric_ricker", "half_sine", "rectangular",
                      "triangular", "sine", "cosine", "mavroeidis_papageorgiou"):
            for friction in ("0.2", "0.4"):
                with self.subTest(pulse=pulse, friction=friction):
                    keys = {"sine": "cycles = 2", "cosine": "cycles = 1.5",
                            "mavroeidis_papageorgiou": "gamma = 2\nnu = 1"}.get(pulse, "")
                    found = self.computed(scene=f'pulse = "{pulse}"\n{keys}', friction=friction)
                    self.assertGreater(((found["status"] & SLIPPED) != 0).sum(), 0)
                    if friction == "0.2":  # below b/h: it never rocks
                        self.expect_slips(found)
                        self.assertTrue((found["region"] == 0).all())
                        self.assertTrue((found["peak"] == 0).all())

    def test_goes_with_records_directions_and_a_vertical_motion(self):
        record = f'record = "{JOBS}/synthetic.AT2"'
        for scene in (record, f'{record}\nvertical = "{JOBS}/synthetic_vertical.AT2"'):
            for block in ("", "direction = 180\ncenter_offset = 0.05"):
                with self.subTest(scene=scene, block=block):
                    motion = SCALES
                    if "direction" in block:
                        motion += "\ndirection = 180"
                    self.expect_slips(self.computed(scene=scene, motion=motion,
                                                    block=block.replace("direction = 180\n", "")))

    def test_is_that_in_the_plane_of_a_direction(self):
        one, other = (f"{JOBS}/synthetic{name}.AT2" for name in ("", "_vertical"))
        fields = ["region", "slide", "slide_peak", "status"]
        both = f'record = "{one}"\nsecond_component = "{other}"'
        scales = "scale = { first = 1.5, last = 3, count = 4 }"
        for direction, record in ((0, one), (90, other)):
            found = self.computed(scene=both, motion=f"{scales}\ndirection = {direction}", friction="0.25",
                                  fields=fields)
            alone = self.computed(scene=f'record = "{record}"', motion=scales, friction="0.25", fields=fields)
            self.assertGreater(np.count_nonzero(alone["slide"]), 0)
            for name in fields:
                np.testing.assert_allclose(found[name], alone[name], rtol=0, atol=1e-9)
        self.write(scene=both, motion=f"{scales}\ndirection = 30", fields=fields)
        for command in (("run", "job.toml", "-o", "both.h5"), ("check", "job.toml")):
            self.assert_exit(self.overturn(*command), 0, "the slip is computed in the plane of the direction only")

    def test_is_an_axis_and_a_column(self):
        found = self.computed(friction="{ values = [0.2, 0.4, 3.0] }")
        slipped = ((found["status"] & SLIPPED) != 0).reshape(3, -1).sum(axis=1)
        self.assertTrue(slipped[0] > slipped[1] > slipped[2])
        (self.folder / "t.csv").write_text("width,height,friction\n0.6,1.8,0.2\n0.6,1.8,0.4\n0.6,1.8,3.0\n")
        (self.folder / "list.toml").write_text(f"""
            scene.pulse = "one_sine"
            blocks.table = "t.csv"
            output.fields = ["slide"]
            [plane]
            {PULSE}
            restitution_of_maximum = 1
            """)
        self.assert_exit(self.overturn("run", "list.toml", "-o", "list.h5"), 0)
        with h5py.File(self.folder / "list.h5") as file:
            np.testing.assert_array_equal(file["slide"][()].ravel(), found["slide"])

    def test_gives_a_margin_that_does_not_depend_on_the_other_fields(self):
        alone = self.computed(friction="0.4", fields=["margin", "region"])
        found = self.computed(friction="0.4", fields=["margin", "region", "slide", "peak", "fall_time"])
        np.testing.assert_array_equal(found["margin"], alone["margin"])
        slips = np.isnan(alone["margin"])
        self.assertTrue(0 < slips.sum() < slips.size / 2)
        np.testing.assert_array_equal(alone["margin"][~slips] > 0, alone["region"][~slips] <= 2)

    def test_has_the_verdicts_of_resolved_jobs(self):
        plain = self.computed(friction="0.45")
        resolved = self.computed(friction="0.45", numerics="resolve = true")
        np.testing.assert_array_equal(plain["region"], resolved["region"])
        np.testing.assert_allclose(plain["slide"], resolved["slide"], rtol=0, atol=1e-9)

    def test_gives_boundaries_and_answers(self):
        self.write(friction="0.5")
        self.assert_exit(self.overturn("boundary", "job.toml", "-o", "b.h5"), 0)
        with h5py.File(self.folder / "b.h5") as file:
            flips = file["flip_pga"][()].ravel()
        np.testing.assert_allclose(flips[np.isfinite(flips)], [0.903473050, 2.247929522], rtol=0, atol=2e-8)
        statue = ("topple", "--width", "0.6", "--height", "1.8", "--period", "0.5", "--pga-max", "3")
        harms = self.overturn(*statue, "--friction", "0.45", "--pga", "1.9")
        self.assert_exit(harms, 0)
        for words in ("topples at 1.9 g", "sliding harms: without slip it does not topple", "lifts before it slides"):
            self.assertIn(words, harms.stdout)
        flat = json.loads(self.overturn(*statue, "--friction", "0.2", "--pga", "0.6", "--json").stdout)
        self.assertTrue(flat["slip"]["stays_flat"])
        self.assertAlmostEqual(flat["slip"]["moving_pga"], 0.2, places=12)
        self.assertAlmostEqual(flat["slip"]["slide_over_size"] * math.hypot(0.3, 0.9), -0.0201010964, places=9)
        self.assertEqual(flat["toppling_pga"], [])

    def test_has_a_history(self):
        one = {"friction": "0.2", "motion": "pulse_period = 0.5\npga = 0.6", "fields": ["region"]}
        self.write(**one)
        shown = self.overturn("history", "job.toml", "-o", "h.h5")
        self.assert_exit(shown, 0)
        self.assertIn("slides 20.1 mm, at most 88.3 mm away", shown.stdout)
        with h5py.File(self.folder / "h.h5") as file:
            self.assertEqual(file["mode"].attrs["flag_meanings"], b"rest slide rock slide_rock")
            self.assertEqual(set(file["mode"][()]), {0, 1})
            slide = file["slide"][()] * math.hypot(0.3, 0.9)
            self.assertAlmostEqual(slide[-1], -0.0201010964, places=9)
            self.assertAlmostEqual(abs(slide).max(), 0.0883227284, places=5)
            slips = file["mode"][()] == 1
            np.testing.assert_allclose(abs(file["force_along"][()][slips]), 0.2, rtol=1e-12)
            np.testing.assert_allclose(file["force_normal"][()], 1, rtol=1e-14)
            kinds = file["events/kind"][()].tolist()
            self.assertEqual(kinds[0], 5)  # slip
            self.assertIn(2, kinds)  # rest
        self.assert_exit(self.overturn("history", "job.toml", "-o", "h.h5"), 0)  # replaces it
        (self.folder / "job.toml").write_text((self.folder / "job.toml").read_text().replace("friction = 0.2\n", ""))
        self.assert_exit(self.overturn("history", "job.toml", "-o", "plain.h5"), 0)
        with h5py.File(self.folder / "plain.h5") as file:
            self.assertNotIn("mode", file)

    def test_is_told_by_check(self):
        for friction, words in (("0.2", "slides from 0.2 g, does not rock"),
                                ("0.4", "lifts from 0.3333 g before it slides"),
                                ("{ values = [0.2, 0.25, 0.4] }", "slides from 0.2 g, does not rock; or lifts from 0.333")):
            self.write(friction=friction, fields=["region"])
            shown = self.overturn("check", "job.toml")
            self.assert_exit(shown, 0)
            self.assertIn(words, shown.stdout)

    def test_equal_to_the_strength_is_enough_although_the_scale_is_rounded(self):
        peak = 0.56
        (self.folder / "r.txt").write_text(f"# units = g\n0.0 0\n0.1 {peak}\n0.2 -0.3\n0.3 0\n")
        rounded_up = [pga / 100 for pga in range(5, 80) if pga / 100 / peak * peak > pga / 100]
        self.assertGreater(len(rounded_up), 3)
        for pga in rounded_up:
            answer = self.overturn("topple", "--width", "0.6", "--height", "0.5", "--friction", str(pga), "--record",
                                   "r.txt", "--pga", str(pga), "--no-search")
            self.assert_exit(answer, 0)
            self.assertIn("does not slip", answer.stdout)

    def test_is_refused_where_it_makes_no_sense(self):
        plain = {"fields": ["region"]}
        self.refused("run", "linear theory has no forces of the contact", scene='pulse = "one_sine"\ntheory = "linear"',
                     **plain)
        self.refused("run", "With friction, the restitution is at most r_max", restitution="1.05", **plain)
        self.refused("run", "would slide down at rest", friction="0.1", block="incline = 0.11", **plain)
        self.refused("run", "fill = true is not possible: where blocks slip", numerics="fill = true", **plain)
        self.refused("run", "is outside (0, 10]", friction="-0.1", **plain)
        self.write(friction="0.4")
        text = (self.folder / "job.toml").read_text()
        (self.folder / "job.toml").write_text(text.replace("friction = 0.4\n", ""))
        self.assert_exit(self.overturn("run", "job.toml"), 65, "without the key friction, no block slips")
        for name in ("mu", "friction_coefficient"):
            (self.folder / "job.toml").write_text(text.replace("friction = 0.4", f"{name} = 0.4"))
            self.assert_exit(self.overturn("run", "job.toml"), 65, f"block.{name}", 'Did you mean "block.friction"?')
        (self.folder / "job.toml").write_text(text.replace('"friction_demand"', '"friction"'))
        self.assert_exit(self.overturn("run", "job.toml"), 65, 'Did you mean "friction_demand"?')


if __name__ == "__main__":
    unittest.main()
