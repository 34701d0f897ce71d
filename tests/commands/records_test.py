"""Jobs with recorded ground motions: results, resuming, and refusals."""

import json
import math
import shutil
import subprocess
import unittest

import h5py
import numpy as np

from program import JOBS, TOOLS, Scratch, checksum

JOB = """
title = "Blocks under a record"
[scene]
record = "one.AT2"
[plane]
scale = { first = 0.5, last = 4.0, count = 40 }
size = { first = 0.3, last = 3.0, count = 40 }
slenderness = { values = [0.2, 0.3] }
restitution_of_maximum = 1.0
[output]
fields = ["region", "angle", "velocity", "margin", "error", "peak", "impacts", "status"]
"""


class ScratchWithRecords(Scratch):
    def setUp(self):
        super().setUp()
        shutil.copy(JOBS / "synthetic.AT2", self.folder / "one.AT2")
        shutil.copy(JOBS / "synthetic_vertical.AT2", self.folder / "up.AT2")
        (self.folder / "job.toml").write_text(JOB)

    def run_job(self, *arguments, out="out.h5", ranks=None):
        result = self.overturn("run", "job.toml", "-o", out, *arguments, ranks=ranks)
        self.assert_exit(result, 0)
        return result

    def scale_record(self, name, factor, time_step="0.01"):
        """Writes one.AT2 with its accelerations multiplied and another time step."""
        head, *numbers = (self.folder / "one.AT2").read_text().split(" SEC\n")
        values = [float(word) * factor for word in numbers[0].split()]
        (self.folder / name).write_text(head.replace("DT= 0.01", f"DT= {time_step}") + " SEC\n"
                                        + "\n".join(map(repr, values)) + "\n")


class ASpectrumUnderARecord(ScratchWithRecords):
    def test_has_the_dimensions_and_the_origin_of_its_record(self):
        self.run_job()
        data = self.opened("out.h5")
        self.assertEqual(data.region.dims,
                         ("slenderness", "scale", "size"))
        self.assertEqual(data.region.shape, (2, 40, 40))
        self.assertEqual(data.motion_name.item(), "one.AT2")
        self.assertEqual(data.attrs["record"], "one.AT2")
        self.assertAlmostEqual(float(data.record_pga), 0.4, places=6)
        p = np.sqrt(3 * 9.81 / (4 * data["size"].values))
        self.assertTrue(np.allclose(data.frequency_parameter, p, rtol=1e-15))
        self.assertTrue(np.allclose(data.pga, 0.4 * data.scale, rtol=1e-6))
        with h5py.File(self.folder / "out.h5") as file:
            records = file["run/records"][:].tobytes().decode()
        self.assertIn("one.AT2", records)
        self.assertIn("SYNTHETIC RECORD", records)
        safe = data.region.values <= 2
        self.assertTrue(0.2 < safe.mean() < 0.9)
        self.assertTrue(np.isfinite(data.peak.values[safe]).all())
        self.assertTrue(np.isinf(data.peak.values[(data.region.values >= 3)]).all())

    def test_is_the_same_on_every_number_of_ranks_and_after_a_stop(self):
        self.run_job()
        for ranks in (2, 3):
            self.run_job(out=f"ranks{ranks}.h5", ranks=ranks)
            self.assertEqual(checksum(self.folder / f"ranks{ranks}.h5"),
                             checksum(self.folder / "out.h5"))
        whole = (self.folder / "out.h5").read_bytes()
        with h5py.File(self.folder / "out.h5", "r+") as file:
            place = file["run/checksum"].id.get_offset()
        damaged = bytearray(whole)
        damaged[place:place + 8 * 4] = bytes(8 * 4)  # four tiles that are not computed
        (self.folder / "out.h5").write_bytes(bytes(damaged))
        self.assert_exit(self.overturn("verify", "out.h5"), 0, "14 of 18 tiles are done")
        self.run_job(ranks=2)
        self.assertEqual((self.folder / "out.h5").read_bytes(), whole)

    def test_can_be_verified_without_the_file_of_its_record(self):
        self.run_job()
        (self.folder / "one.AT2").unlink()
        self.assert_exit(self.overturn("verify", "out.h5"), 0, "18 of 18 tiles are done")
        self.assert_exit(self.overturn("info", "out.h5"), 0, "one.AT2", "size")

    def test_is_not_resumed_if_the_record_has_changed(self):
        self.run_job()
        before = checksum(self.folder / "out.h5")
        self.scale_record("one.AT2", 1 + 1e-15)
        self.assert_exit(self.overturn("run", "job.toml", "-o", "out.h5"), 74,
                         'the record "one.AT2" has changed since then')
        self.assertEqual(checksum(self.folder / "out.h5"), before)

    def test_does_not_change_with_the_scale_of_time_and_size(self):
        self.scale_record("slow.AT2", 1, "0.02")
        fields = 'output.fields=["region", "angle", "velocity", "margin"]'
        self.run_job("--set", fields)
        self.run_job("--set", fields, "--set", "scene.record=slow.AT2", "--set",
                     "plane.size={ first = 1.2, last = 12.0, count = 40 }", out="slow.h5")
        one, slow = self.opened("out.h5"), self.opened("slow.h5")
        for name in ("region", "angle", "velocity", "margin"):
            self.assertTrue(np.array_equal(one[name].values, slow[name].values, equal_nan=True))

    def test_is_mirrored_by_the_mirrored_record(self):
        self.scale_record("mirrored.AT2", -1)
        self.run_job()
        self.run_job("--set", "scene.record=mirrored.AT2", out="mirrored.h5")
        one, other = self.opened("out.h5"), self.opened("mirrored.h5")
        self.assertTrue(np.array_equal(one.angle.values, -other.angle.values, equal_nan=True))
        mirror = np.array([0, 2, 1, 4, 3, 6, 5, 8, 7])
        self.assertTrue(np.array_equal(one.region.values, mirror[other.region.values]))
        self.assertTrue(np.array_equal(one.peak.values, other.peak.values))

    def test_resolves_all_verdicts_and_changes_none_that_was_certain(self):
        self.run_job()
        self.run_job("--set", "numerics.resolve=true", out="resolved.h5")
        one, resolved = self.opened("out.h5"), self.opened("resolved.h5")
        certain = one.error.values < np.abs(one.margin.values)
        self.assertGreater(certain.mean(), 0.9)
        safe, later = one.region.values <= 2, resolved.region.values <= 2
        self.assertTrue(np.array_equal(safe[certain], later[certain]))
        self.assertLess((resolved.region.values == 254).mean(), 0.01)

    def test_ends_with_a_verdict_or_a_flag_if_impacts_lose_no_energy(self):
        self.run_job("--set", "plane.restitution=1.0", "--set",
                     "plane.scale.count=9", "--set", "plane.size.count=9", "--set",
                     "numerics.resolve=true")
        data = self.opened("out.h5")
        undecided = data.region.values == 254
        self.assertTrue((data.region.values[~undecided] <= 8).all())
        self.assertTrue(np.array_equal(undecided, data.status.values & (2 | 8) != 0))
        self.assertLess(undecided.mean(), 0.1)


class OtherAxes(ScratchWithRecords):
    def test_pga_and_frequency_parameter_are_the_same_points(self):
        self.run_job("--set", "plane.scale.values=[1, 2]", "--set", "plane.size.values=[0.5, 1]")
        p = [math.sqrt(3 * 9.81 / (4 * size)) for size in (1, 0.5)]
        text = JOB.replace("scale = { first = 0.5, last = 4.0, count = 40 }",
                           "pga = { values = [0.4, 0.8] }")
        text = text.replace("size = { first = 0.3, last = 3.0, count = 40 }",
                            f"frequency_parameter = {{ values = {p} }}")
        (self.folder / "job.toml").write_text(text)
        self.run_job(out="other.h5")
        one, other = self.opened("out.h5"), self.opened("other.h5")
        self.assertEqual(other.region.dims[-2:], ("pga", "frequency_parameter"))
        self.assertTrue(np.allclose(other["size"], [1, 0.5]))
        self.assertTrue(np.allclose(other.scale, [1, 2], rtol=1e-6))
        self.assertTrue(np.array_equal(one.region.values[..., ::-1], other.region.values))

    def test_a_block_in_metres_gives_slenderness_and_size(self):
        text = JOB.replace("size = { first = 0.3, last = 3.0, count = 40 }\n", "")
        text = text.replace("slenderness = { values = [0.2, 0.3] }\n", "")
        (self.folder / "job.toml").write_text(
            text + "[block]\nhalf_width = 0.3\nhalf_height = 1.0\n")
        self.run_job()
        data = self.opened("out.h5")
        self.assertEqual(data.region.dims, ("scale",))
        self.assertAlmostEqual(float(data["size"]), math.hypot(0.3, 1.0), places=15)

    def test_a_pattern_is_a_suite_in_byte_order(self):
        for name, factor in (("b2.AT2", 2), ("b10.AT2", 1), ("B.AT2", 0.5)):
            self.scale_record(name, factor)
        self.run_job("--set", 'scene.record="[Bb]*.AT2"', "--set", "plane.scale.values=[1, 2]")
        data = self.opened("out.h5")
        self.assertEqual(list(data.motion_name.values), ["B.AT2", "b10.AT2", "b2.AT2"])
        self.assertTrue(np.allclose(data.record_pga, [0.2, 0.4, 0.8], rtol=1e-6))
        twice = data.region.sel(scale=2).values[1], data.region.sel(scale=1).values[2]
        self.assertTrue(np.array_equal(*twice))

    def test_accelerations_of_a_column_are_divided_by_gravity(self):
        values = [float(word) for word in
                  (self.folder / "one.AT2").read_text().split(" SEC\n")[1].split()]
        (self.folder / "column.txt").write_text("\n".join(repr(9.81 * value) for value in values))
        self.run_job("--set", "plane.scale=1")
        self.run_job("--set", "plane.scale=1", "--set", "scene.record=column.txt", "--set",
                     "scene.units=m/s2", "--set", "scene.time_step=0.01", out="column.h5")
        one, other = self.opened("out.h5"), self.opened("column.h5")
        self.assertTrue(np.array_equal(one.region.values, other.region.values))
        self.assertTrue(np.allclose(one.pga, other.pga, rtol=1e-15))


class Directions(ScratchWithRecords):
    TWO = ("--set", "scene.second_component=up.AT2", "--set", "output.fields=['region', 'margin', 'peak']")
    ROCK = """
[scene]
record = "one.AT2"
second_component = "up.AT2"
[block]
slenderness_plus = {plus}
slenderness_minus = {minus}
size_plus = 1
size_minus = 0.9
radius_of_gyration = 0.6
[plane]
scale = {{ first = 0.5, last = 4.0, count = 12 }}
direction = {{ values = {directions} }}
restitution_of_maximum = 0.9
[output]
fields = ["region", "margin", "peak", "angle"]
"""

    def test_are_the_components_and_their_mirror_images(self):
        self.run_job(*self.TWO, "--set", "plane.direction={ values = [0, 37, 90, 180, 217] }", out="two.h5")
        two = self.opened("two.h5")
        other = ("--set", "scene.component=1", *self.TWO[2:])
        for record, direction in (("one.AT2", 0), ("one.AT2", 180), ("up.AT2", 90)):
            self.run_job(*other, "--set", f"scene.record={record}", "--set",
                         f"plane.direction={direction % 360 if direction != 90 else 0}", out="one.h5")
            one = self.opened("one.h5")
            for field in ("region", "margin", "peak"):
                np.testing.assert_array_equal(two[field].sel(direction=direction).values, one[field].values)
            (self.folder / "one.h5").unlink()
        # Symmetric blocks do not know the sign of the motion.
        np.testing.assert_array_equal(two.margin.sel(direction=37).values, two.margin.sel(direction=217).values)
        self.assertFalse(np.array_equal(two.margin.sel(direction=37).values, two.margin.sel(direction=0).values))
        self.assertEqual(two.pga.dims, ("direction", "scale"))
        first, second = (max(abs(float(word)) for word in (self.folder / name).read_text().split(" SEC\n")[1].split())
                         for name in ("one.AT2", "up.AT2"))
        np.testing.assert_allclose(two.pga.sel(direction=[0, 90, 180]) / two.scale,
                                   np.repeat([[first], [second], [first]], two.scale.size, 1), rtol=1e-14)
        self.assertEqual(two.record_pga.attrs["comment"], "in the direction of the point")

    def test_have_the_measures_of_their_motions_and_those_of_all_directions(self):
        subprocess.run([TOOLS / "synthetic_record", "--suite", "3", "--components", "3", "-o", "suite"], check=True,
                       cwd=self.folder, stdout=subprocess.DEVNULL)
        one = ("--set", "plane.scale.count=2", "--set", "plane.size.count=2", "--set", "output.fields=['region']")
        self.run_job(*one, "--set", 'scene.record="suite/*_H1.AT2"', "--set", 'scene.second_component="suite/*_H2.AT2"',
                     "--set", 'scene.vertical="suite/*_V.AT2"', "--set",
                     "plane.direction={ values = [0, 30, 90, 270] }", out="two.h5")
        two = self.opened("two.h5")
        self.assertEqual(list(two.motion_name.values), [f"suite/0{number}_H1.AT2" for number in (1, 2, 3)])
        for place, end in ((0, "H1"), (2, "H2"), (3, "H2")):
            self.run_job(*one, "--set", f'scene.record="suite/*_{end}.AT2"', out=f"{place}.h5")
            alone = self.opened(f"{place}.h5")
            for measure in ("record_pga", "pgv", "arias_intensity", "significant_duration"):
                self.assertEqual(two[measure].dims, ("motion", "direction"))
                self.assertEqual(alone[measure].dims, ("motion",))
                # The cosine of 90 degrees is 0, so that values are those of the component.
                np.testing.assert_array_equal(two[measure].values[:, place], alone[measure].values)
                self.assertFalse(np.array_equal(two[measure].values[:, 1], alone[measure].values))
            self.assertNotIn("pga_rotd50", alone)
        np.testing.assert_array_equal(two.record_pga * two.scale, two.pga)

        def components(name):
            return [np.array((self.folder / name.replace("H1", end)).read_text().split(" SEC\n")[1].split(), float)
                    for end in ("H1", "H2")]
        angles = np.radians(np.arange(180))[:, None]
        for number, name in enumerate(two.motion_name.values):
            first, second = components(name)
            peaks = np.abs(np.cos(angles) * first + np.sin(angles) * second).max(axis=1)
            velocities = [np.append(0, np.cumsum(a[1:] + a[:-1])) * 0.01 / 2 * 9.81 for a in (first, second)]
            speeds = np.abs(np.cos(angles) * velocities[0] + np.sin(angles) * velocities[1]).max(axis=1)
            for measure, values in (("pga", peaks), ("pgv", speeds)):
                for percentile in (50, 100):
                    found = two[f"{measure}_rotd{percentile}"]
                    self.assertEqual(found.dims, ("motion",))
                    # Sums of thousands of terms.
                    self.assertAlmostEqual(float(found[number]), np.percentile(values, percentile), delta=1e-12)

    def test_of_the_rows_of_a_table_have_measures_of_their_own(self):
        (self.folder / "table.csv").write_text("name,direction\nfirst,0\nsecond,90\nagain,0\n")
        (self.folder / "job.toml").write_text("""
            blocks.table = "table.csv"
            [scene]
            record = "one.AT2"
            second_component = "up.AT2"
            [plane]
            slenderness = 0.2
            size = 1
            restitution = 0.9
            scale = { values = [1, 2] }
            """)
        self.run_job()
        data = self.opened("out.h5")
        self.assertEqual(data.pgv.dims, ("block",))
        self.assertEqual(data.pgv_rotd50.dims, ())
        self.assertEqual(float(data.pgv[0]), float(data.pgv[2]))
        np.testing.assert_allclose(data.record_pga, [0.4, 0.2, 0.4])

    def test_have_a_history_of_one_of_the_pairs(self):
        for number in (1, 2):
            shutil.copy(self.folder / "one.AT2", self.folder / f"{number}.H1")
            shutil.copy(self.folder / "up.AT2", self.folder / f"{number}.H2")
        result = self.overturn("history", "job.toml", "--set", 'scene.record="*.H1"', "--set",
                               'scene.second_component="*.H2"', "--set", "plane.direction=0", "-o", "h.h5")
        self.assert_exit(result, 2, "with --set scene.record=1.H1 --set scene.second_component=1.H2.")

    def rock(self, name, plus, minus, directions):
        (self.folder / "rock.toml").write_text(self.ROCK.format(plus=plus, minus=minus, directions=directions))
        self.assert_exit(self.overturn("run", "rock.toml", "-o", name), 0)
        return self.opened(name)

    def test_of_a_rock_are_those_of_the_mirrored_rock_after_half_a_turn(self):
        # Sizes are interchanged by hand: the sides are plus and minus.
        one = self.rock("one.h5", 0.3, 0.2, [0, 30, 90, 200])
        self.ROCK = self.ROCK.replace("size_plus = 1\nsize_minus = 0.9", "size_plus = 0.9\nsize_minus = 1")
        other = self.rock("other.h5", 0.2, 0.3, [20, 180, 210, 270])
        by_value = {int(value): at for at, value in enumerate(other.direction.values)}
        order = [by_value[(int(value) + 180) % 360] for value in one.direction.values]
        np.testing.assert_array_equal(one.margin.values, other.margin.values[order])
        # Converted from one alpha to the other: rounded twice.
        np.testing.assert_allclose(one.peak.values, other.peak.values[order], rtol=2 * np.finfo(float).eps)
        np.testing.assert_array_equal(one.angle.values, -other.angle.values[order])
        self.assertGreater(len(np.unique(one.region.values)), 2)

    def test_have_boundaries_and_answers(self):
        self.rock("one.h5", 0.3, 0.2, [30])
        self.assert_exit(self.overturn("boundary", "rock.toml", "-o", "flips.h5"), 0)
        flips = self.opened("flips.h5")
        region = self.opened("one.h5").region.values.squeeze()
        scales = np.linspace(0.5, 4, 12)
        flip = flips.flip_amplitude.values.squeeze()
        changes = [np.sum(flip < scale) % 2 for scale in scales]
        unsafe = ~np.isin(region, [0, 1, 2])
        np.testing.assert_array_equal(np.array(changes) ^ bool(unsafe[0]), unsafe)
        answer = self.overturn("topple", "--slenderness-plus", "0.3", "--slenderness-minus", "0.2", "--size-plus", "1",
                               "--size-minus", "0.9", "--radius-of-gyration", "0.6", "--restitution-of-maximum", "0.9",
                               "--record", "one.AT2", "--set", "scene.second_component=up.AT2", "--direction", "30",
                               "--scale", "4", "--json")
        answer = json.loads(answer.stdout)
        self.assertAlmostEqual(answer["pga"], self.opened("one.h5").pga.values.ravel()[-1], places=12)
        self.assertEqual(answer["topples"], bool(unsafe[-1]))
        self.assertEqual(answer["motion"]["second_component"], "up.AT2")

    def test_are_refused_without_what_they_need(self):
        for arguments, words in ((("scene.second_component=up.AT2",), "direction is missing"),
                                 (("plane.direction=30",), "needs two horizontal components"),
                                 (("scene.second_component=up.AT2", "plane.direction=30", "plane.pga=1"),
                                  "depends on the direction")):
            overrides = [word for argument in arguments for word in ("--set", argument)]
            self.assert_exit(self.overturn("check", "job.toml", *overrides), 65, words)


class VerticalMotion(ScratchWithRecords):
    def test_changes_the_result_and_marks_points_without_gravity(self):
        self.run_job()
        self.run_job("--set", "scene.vertical=up.AT2", "--set", "plane.scale.last=8", out="up.h5")
        up = self.opened("up.h5")
        limit = 1 / -min(float(word) for word in
                         (self.folder / "up.AT2").read_text().split(" SEC\n")[1].split())
        self.assertTrue(4 < limit < 8)
        free = up.status.values == 16
        self.assertTrue(np.array_equal(free[0, :, 0], up.scale.values >= limit))
        self.assertTrue((up.region.values[free] == 254).all())
        self.assertTrue(np.isnan(up.angle.values[free]).all())
        self.assertTrue((up.region.values[~free] <= 8).all())
        self.assertFalse(np.array_equal(up.region.values[..., 0:20, :],
                                        self.opened("out.h5").region.values[..., 0:20, :]))

    def test_is_reported_where_it_cancels_gravity(self):
        up = ("--set", "scene.vertical=up.AT2")
        self.assert_exit(self.overturn("check", "job.toml", *up, "--set", "plane.scale.last=8"), 0,
                         "one.AT2: from the scale 5", "cancels gravity")
        self.assert_exit(self.overturn("run", "job.toml", *up, "--set", "plane.scale=9"), 65,
                         "plane.scale = 9: from here on, the vertical motion cancels gravity", "below the scale 5.3")

    def test_that_cancels_gravity_in_every_row_of_a_table_is_refused(self):
        (self.folder / "table.csv").write_text("slenderness,size,restitution,motion,scale\n"
                                               "0.2,1,0.9,two.AT2,9\n0.2,1,0.9,two.AT2,8\n")
        (self.folder / "table.toml").write_text(
            'blocks.table = "table.csv"\n'
            '[scene]\nrecord = ["one.AT2", "two.AT2"]\nvertical = "up.AT2"\n')
        shutil.copy(self.folder / "one.AT2", self.folder / "two.AT2")
        self.assert_exit(self.overturn("check", "table.toml"), 65,
                         "table.csv:1:5: scale = 8: from here on, the vertical motion cancels gravity under "
                         "every record", "below the scale 5.3")


class ABadRecord(ScratchWithRecords):
    def refused(self, *phrases, code=65, **changes):
        arguments = [f"--set={key.replace('__', '.')}={value}" for key, value in changes.items()]
        self.assert_exit(self.overturn("run", "job.toml", *arguments), code, *phrases)
        self.assertNotIn("job.h5", self.files())

    def test_is_refused_with_its_name(self):
        self.refused("scene.record", "none.AT2", "No such file", scene__record="none.AT2")
        self.refused('"*.V2A" matches no file', scene__record='"*.V2A"')
        (self.folder / "nan.txt").write_text("0.1\nnan\n")
        self.refused("nan.txt:2", scene__record="nan.txt", scene__units="g",
                     scene__time_step="0.01")
        (self.folder / "zero.txt").write_text("0\n0\n")
        self.refused("zero at all times", scene__record="zero.txt", scene__units="g",
                     scene__time_step="0.01")

    def test_is_warned_of_if_its_header_differs_by_little(self):
        (self.folder / "one.AT2").write_text("PEER\nA, 1\nIN UNITS OF G, PEAK = 0.306 G\nNPTS= 2, DT= .01\n.1 .3\n")
        remark = "one.AT2:3: the peak is 0.306 g, but that of the samples is 0.3 g"
        self.assert_exit(self.overturn("check", "job.toml"), 0, f"warning: {remark}.")
        result = self.overturn("topple", "--width=0.5", "--height=2", "--record=one.AT2", "--json")
        self.assertIn(remark, json.loads(result.stdout)["warnings"])

    def test_needs_an_existing_component_and_an_equal_vertical(self):
        self.refused("scene.component = 2 is not a component", "1", scene__component="2")
        self.scale_record("slow.AT2", 1, "0.02")
        self.refused("2001 samples at 0.02 s, but the horizontal component has 2001 at 0.01 s",
                     scene__vertical="slow.AT2")
        self.refused("scene.vertical = 3 is not a component", scene__vertical="3")

    def test_refuses_components_that_begin_at_other_times(self):
        def write(name, first, component):
            acceleration = np.sin(np.arange(100) / (10 + component))
            np.savetxt(self.folder / name, np.c_[first + 0.01 * np.arange(100), acceleration], fmt="%.5f")

        write("one.txt", 0, 0)
        for first in (0.01, 3, -3):
            write("other.txt", first, 1)
            for component in ("vertical", "second_component"):
                self.refused(f"begins at {first} s, but the horizontal component begins at 0 s", scene__record="one.txt",
                             scene__units="g", **{f"scene__{component}": "other.txt"})

    def test_excludes_a_pulse_and_its_axes(self):
        self.refused("scene.window cannot be combined with scene.record", scene__window="1")
        self.refused("plane.amplitude", plane__amplitude="1")
        self.refused('numerics.method = "rk45" is for pulses only', numerics__method="rk45")

    def test_takes_one_strength_and_one_size(self):
        for one, other in (("scale", "pga"), ("size", "frequency_parameter")):
            text = JOB.replace("slenderness =", f"{other} = 1\nslenderness =")
            (self.folder / "job.toml").write_text(text)
            self.refused(f"plane.{other} cannot be combined with plane.{one}")
            (self.folder / "job.toml").write_text(JOB)
            self.assert_exit(self.overturn("check", "job.toml", f"--set=plane.{other}=1"), 0, other)

    def test_may_be_replaced_by_a_pulse_and_back(self):
        pulse = ("--set=scene.pulse=one_sine", "--set=plane.frequency=2", "--set=plane.amplitude=3")
        self.assert_exit(self.overturn("check", "job.toml", *pulse), 0, "one_sine", "frequency")
        record = ("--set=scene.record=one.AT2", "--set=plane.scale=1", "--set=plane.size=1")
        self.assert_exit(self.overturn("check", "small.toml", *record,
                                       "--set=numerics.method=taylor"), 0, "one.AT2", "size")


class AStationOfThreeFiles(Scratch):
    """K-NET gives each component a file of its own, in counts."""

    def setUp(self):
        super().setUp()
        for number, direction in enumerate(("E-W", "N-S", "U-D")):
            counts = np.round(1e4 + 1e5 * np.sin(np.arange(400) / (10 + number))).astype(int)
            header = ("Origin Time       2020/01/01 00:00:00", "Sampling Freq(Hz) 100Hz", "Duration Time(s)  4",
                      f"Dir.              {direction}", "Scale Factor      3920(gal)/600000", "Memo.             ")
            name = f"NONE01.{direction.replace('-', '')}"
            (self.folder / name).write_text("\n".join(header) + "\n" + "\n".join(map(str, counts)) + "\n")
        (self.folder / "job.toml").write_text('''
[scene]
record = "NONE01.EW"
second_component = "NONE01.NS"
vertical = "NONE01.UD"
[plane]
direction = { values = [0, 90] }
scale = 1
size = 1
slenderness = 0.3
restitution_of_maximum = 1
''')

    def test_is_one_motion_that_is_not_corrected(self):
        self.assert_exit(self.overturn("check", "job.toml"), 0,
                         "NONE01.EW, component E-W, second NONE01.NS up to", ", vertical NONE01.UD up to",
                         " g, not corrected: 400 samples, 3.99 s, ")
        self.assert_exit(self.overturn("run", "job.toml", "-o", "out.h5"), 0)
        data = self.opened("out.h5")
        self.assertEqual(data.attrs["record_processing"], "not corrected")
        counts = np.loadtxt(self.folder / "NONE01.EW", skiprows=6)
        pga = np.abs(counts - counts.mean()).max() * 3920 / 600000 / 981
        self.assertAlmostEqual(float(data.record_pga.sel(direction=0)), pga, places=12)
        with h5py.File(self.folder / "out.h5") as file:
            self.assertIn("vertical NONE01.UD, not corrected\n    Origin Time", file["run/records"][()].tobytes().decode())

    def test_is_not_corrected_in_the_answers_of_topple(self):
        arguments = ("--width", "0.6", "--height", "1.8", "--record", "NONE01.EW", "--scale", "1")
        self.assert_exit(self.overturn("topple", *arguments), 0, "NONE01.EW, component E-W, not corrected: ")
        result = self.overturn("topple", *arguments, "--json")
        self.assertIs(json.loads(result.stdout)["motion"]["uncorrected"], True)


class AHistoryUnderARecord(ScratchWithRecords):
    def test_shows_the_ground_motion_and_the_peak_of_the_spectrum(self):
        at = "--at=scale=1,size=2,slenderness=0.2"
        self.assert_exit(self.overturn("history", "job.toml", at, "-o", "history.h5",
                                       "--samples", "20001"), 0, "region", "impact")
        self.run_job("--set=plane.scale=1", "--set=plane.size=2", "--set=plane.slenderness=0.2")
        peak = float(self.opened("out.h5").peak.values.ravel()[0])
        with h5py.File(self.folder / "history.h5") as file:
            self.assertEqual(file.attrs["scale"], 1)
            ground, angle = file["ground"][:], file["angle"][:]
        self.assertAlmostEqual(np.abs(ground).max(), 0.4, places=3)
        self.assertLessEqual(np.abs(angle).max() / 0.2, peak * (1 + 1e-12))
        self.assertGreater(np.abs(angle).max() / 0.2, peak * (1 - 1e-4))

    def test_needs_one_record_and_one_point(self):
        self.assert_exit(self.overturn("history", "job.toml", "-o", "h.h5"), 2,
                         "40 values of plane.size")
        self.scale_record("two.AT2", 2)
        both = 'scene.record=["one.AT2", "two.AT2"]'
        self.assert_exit(self.overturn("history", "job.toml", "-o", "h.h5", "--set", both), 2,
                         "has 2 records")


if __name__ == "__main__":
    unittest.main(verbosity=2)
