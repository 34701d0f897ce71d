"""Blocks with two different sides in every command: the flips of two blocks of the documentation, which
an independent program computed."""

import json
import math
import unittest

import h5py
import numpy as np

from program import Scratch

INCLINE = 4 * math.pi / 180
LEANING = {"width": 0.5, "height": 2, "incline": INCLINE}
ECCENTRIC = {"width": 0.5, "height": 2, "center_offset": -0.05, "center_height": 1,
             "radius_of_gyration": math.sqrt(0.3541667)}
SURVEYED = {"slenderness_plus": math.atan(0.3), "slenderness_minus": math.atan(0.2),
            "size_plus": math.hypot(0.3, 1), "size_minus": math.hypot(0.2, 1),
            "radius_of_gyration": math.sqrt(0.3541667)}
# Peak ground accelerations over g of a one-sine pulse of 0.5 s at which the verdict flips, twelve digits each.
FLIPS = {("leaning", 0): [0.407515258023],
         ("leaning", 180): [0.620924782649, 0.891748873204, 1.173623183158],
         ("eccentric", 0): [0.686360312579, 1.022079907029, 1.324864005712],
         ("eccentric", 180): [0.418905920675]}
BLOCKS = {"leaning": [LEANING], "eccentric": [ECCENTRIC, SURVEYED]}
ABOVE = {("leaning", 0): ["U0+"], ("leaning", 180): ["U2+", "S-", "U0+"],
         ("eccentric", 0): ["U2-", "S+", "U0-"], ("eccentric", 180): ["U0-"]}


def block_of(block):
    return "".join(f"{name} = {value}\n" for name, value in block.items())


def cases():
    for (name, direction), flips in FLIPS.items():
        for block in BLOCKS[name]:
            yield block, direction, flips, ABOVE[name, direction]


class TwoSides(Scratch):
    def write(self, block, plane):
        (self.folder / "job.toml").write_text(
            f'scene.pulse = "one_sine"\n[block]\n{block_of(block)}[plane]\nrestitution_of_maximum = 1\n{plane}\n')

    def assert_computes(self, command, output, *arguments):
        self.assert_exit(self.overturn(command, "job.toml", "-o", output, *arguments), 0)
        return self.folder / output

    def test_flip_where_they_should_in_boundaries(self):
        for number, (block, direction, flips, above) in enumerate(cases()):
            self.write(block, f"pulse_period = 0.5\ndirection = {direction}\n"
                              "pga = { first = 0.01, last = 3, count = 60 }")
            with h5py.File(self.assert_computes("boundary", f"{number}.h5")) as file:
                found = file["flip_pga"][:]
                np.testing.assert_allclose(found[np.isfinite(found)], flips, rtol=0, atol=2e-12)
                region = file["region_above"]
                names = dict(zip(region.attrs["flag_values"], region.attrs["flag_meanings"].decode().split()))
                self.assertEqual([names[code] for code in region[:len(flips)]], above)

    def test_flip_where_they_should_in_answers(self):
        for block, direction, flips, _ in cases():
            options = [f"--{name.replace('_', '-')}={value}" for name, value in block.items()]
            result = self.overturn("topple", *options, "--period", "0.5", "--direction", str(direction), "--json",
                                   "--pga-max", "3")
            self.assert_exit(result, 0)
            answer = json.loads(result.stdout)
            ends = [end for first_last in answer["toppling_pga"] for end in first_last if end is not None]
            np.testing.assert_allclose(ends, flips, rtol=0, atol=2e-8)
            self.assertEqual(answer["undecided_pga"], [])

    def test_are_computed_in_both_directions_unless_one_is_asked_for(self):
        for name, strengths in (("leaning", (0.45, 0.7)), ("eccentric", (0.4, 0.5))):
            options = [f"--{key.replace('_', '-')}={value}" for key, value in BLOCKS[name][0].items()]
            for pga in strengths:
                toppling = {direction for direction in (0, 180)
                            if sum(flip < pga for flip in FLIPS[name, direction]) % 2 == 1}
                result = self.overturn("topple", *options, "--period=0.5", f"--pga={pga}", "--pga-max=1.2", "--json")
                answer = json.loads(result.stdout)
                self.assertEqual(answer["warnings"], [])
                self.assertEqual({each["direction"] for each in answer["by_direction"] if each["topples"]}, toppling)
                self.assertEqual(sorted(each["direction"] for each in answer["by_direction"]), [0, 180])
                self.assertEqual(answer["topples"], bool(toppling))
                self.assertTrue(answer["direction"] in toppling or not toppling)
                self.assertEqual(answer | answer["by_direction"][0], answer)  # the worse one is first
                self.assertIn(f" at {pga} g in direction {answer['direction']:.0f}, worse than "
                              f"{180 - answer['direction']:.0f}", answer["verdict"])

    def test_say_which_direction_is_worse_and_write_its_history(self):
        options = [f"--{key.replace('_', '-')}={value}" for key, value in BLOCKS["eccentric"][0].items()]
        options += ["--period=0.5", "--pga=0.5", "--pga-max=1.2"]
        result = self.overturn("topple", *options, "--history", "both.h5")
        self.assert_exit(result, 0, "directions 0 and 180 degrees",
                         "verdict topples at 0.5 g in direction 180, worse than 0 "
                         "does not topple at 0.5 g in direction 0; topples at 0.6863 g (37 % more)",
                         "both.h5: written, the motion in direction 180; draw it with")
        self.assertEqual(result.stderr, "")
        self.assert_exit(self.overturn("topple", *options, "--direction=180", "--history", "one.h5"), 0)
        with h5py.File(self.folder / "both.h5") as both, h5py.File(self.folder / "one.h5") as one:
            np.testing.assert_array_equal(both["angle"][:], one["angle"][:])

    def test_are_resolved_beside_their_flips_in_spectra_and_tables(self):
        for number, (block, direction, flips, _) in enumerate(cases()):
            pga = sorted(flip + step for flip in flips for step in (-1e-11, 1e-11))
            unsafe = [i % 4 in (1, 2) for i in range(len(pga))]
            resolved = "numerics = { resolve = true }"
            self.write(block, f"pulse_period = 0.5\ndirection = {direction}\npga = {{ values = {pga} }}")
            (self.folder / "job.toml").write_text(f"{resolved}\n" + (self.folder / "job.toml").read_text())
            plane = self.assert_computes("run", f"plane_{number}.h5")
            names = [*block, "pulse_period", "direction", "restitution_of_maximum", "pga"]
            rows = [[*block.values(), 0.5, direction, 1, value] for value in pga]
            (self.folder / "blocks.csv").write_text(
                "\n".join(",".join(map(str, row)) for row in [names, *rows]) + "\n")
            (self.folder / "job.toml").write_text(f'scene.pulse = "one_sine"\nblocks.table = "blocks.csv"\n{resolved}\n')
            table = self.assert_computes("run", f"table_{number}.h5")
            for path in (plane, table):
                with h5py.File(path) as file:
                    self.assertEqual((file["region"][:] >= 3).tolist(), unsafe, path)

    def test_have_no_boundary_of_another_block_or_direction(self):
        plane = "pulse_period = {{ first = 0.3, last = 1, count = 5 }}\ndirection = {}\n" \
                "pga = {{ first = 0.1, last = 1, count = 5 }}"
        for name, block, direction in (("right", LEANING, 0), ("mirrored", LEANING, 180),
                                       ("other", {**LEANING, "incline": 0.05}, 0)):
            self.write(block, plane.format(direction))
            self.assert_computes("boundary", f"{name}_b.h5")
            self.assert_computes("run", f"{name}.h5")
        for name, words in (("right", ""), ("mirrored", "direction differs"), ("other", "slenderness_plus differs")):
            drawn = self.tool("plot_spectrum", f"{name}.h5", "--boundary", "right_b.h5")
            self.assertEqual(drawn.returncode == 0, not words, drawn.stderr)
            self.assertIn(words, drawn.stderr)

    def test_warn_of_what_may_be_a_mistake(self):
        self.write(LEANING, "pulse_period = 0.5\npga = 0.5")
        self.assert_exit(self.overturn("check", "job.toml"), 0, "the mirror image of the motion, direction 180")
        for direction in ("0", "180", "{ values = [0, 180] }"):
            result = self.overturn("check", "job.toml", "--set", f"plane.direction={direction}")
            self.assertNotIn("warning", result.stderr)
        result = self.overturn("check", "job.toml", "--set", "plane.direction=0", "--set",
                               "plane.radius_of_gyration=6")
        self.assertIn("the radius of gyration", result.stderr)
        (self.folder / "blocks.csv").write_text("width,height,centre_offset,lean,restitution\n0.5,2,0.1,4,0.8\n")
        (self.folder / "table.toml").write_text(
            'scene.pulse = "one_sine"\nblocks.table = "blocks.csv"\nplane = { pulse_period = 0.5, pga = 0.3 }\n')
        self.assert_exit(self.overturn("check", "table.toml"), 0, "centre_offset, lean: stored, not used in the computation")
        self.assert_exit(self.overturn("run", "table.toml", "-o", "table.h5"), 0,
                         "columns not used in the computation: centre_offset, lean")

    def test_warn_of_columns_that_are_keys_of_the_motion(self):
        for column in ("pulse", "cycles", "gravity", "theory", "scale", "motion", "damping_remark"):
            (self.folder / "blocks.csv").write_text(f"width,height,restitution,{column}\n0.5,2,0.8,3\n")
            (self.folder / "table.toml").write_text(
                'scene.pulse = "one_sine"\nblocks.table = "blocks.csv"\nplane = { pulse_period = 0.5, pga = 0.3 }\n')
            result = self.overturn("check", "table.toml")
            self.assertEqual("no effect: it is a key of the job" in result.stderr, column != "damping_remark", column)

    def test_warn_of_columns_that_are_misspelt(self):
        for column, meant in (("inclin", "incline"), ("incline_degrees", "incline"),
                              ("center_ofset", "center_offset"), ("centre_offset", "center_offset"),
                              ("directoin", "direction"),
                              ("inclination", "incline"), ("lean_angle", "incline"), ("base_tilt", "incline"),
                              ("offset", "center_offset"), ("eccentricity", "center_offset"),
                              ("center_of_mass_height", "center_height"), ("com_height", "center_height"),
                              ("gyration_radius", "radius_of_gyration"),
                              ("Inclination", "incline"), ("Lean", "incline"), ("Offset", "center_offset"),
                              ("name", None), ("weight", None), ("site", None), ("sizes", None),
                              ("restitution_from", None), ("age", None)):
            (self.folder / "blocks.csv").write_text(f"width,height,{column},restitution\n0.5,2,0.05,0.8\n")
            (self.folder / "table.toml").write_text(
                'scene.pulse = "one_sine"\nblocks.table = "blocks.csv"\nplane = { pulse_period = 0.5, pga = 0.3 }\n')
            for command in ("check", "run") if column == "inclin" else ("check",):
                result = self.overturn(command, "table.toml")
                self.assert_exit(result, 0, column)
                self.assertEqual(f'the column "{column}" of blocks.csv has no effect (did you mean {meant}?)'
                                 in result.stderr, meant is not None, column)
                self.assertEqual("warning" in result.stderr, meant is not None, column)

    def test_have_filled_spectra(self):
        self.write(LEANING, "pulse_period = { first = 0.2, last = 1.2, count = 300 }\n"
                            "pga = { first = 0.1, last = 1.5, count = 300 }\ndirection = { values = [0, 180] }")
        region = ("--set", 'output.fields=["region"]')
        whole = self.assert_computes("run", "whole.h5", *region)
        filled = self.assert_computes("run", "filled.h5", *region, "--set", "numerics.fill=true")
        with h5py.File(whole) as one, h5py.File(filled) as other:
            np.testing.assert_array_equal(one["region"][:], other["region"][:])
            self.assertLess(np.mean(other["evaluated"][:] == 1), 0.5)
            self.assertGreater(other["run/audit_checked"][:].sum(), 0)
            self.assertEqual(other["run/audit_wrong"][:].sum(), 0)

    def test_are_described_by_check_and_info(self):
        self.write(LEANING, "pulse_period = 0.5\npga = { first = 0.1, last = 1, count = 5 }")
        self.assert_exit(self.overturn("check", "job.toml"), 0, "alpha = 10.04 degrees (+), 18.04 degrees (-)",
                         "incline 4 degrees", "R = 1.031 m (+), 1.031 m (-)", "p = 2.672 1/s (+), 2.672 1/s (-)",
                         "r_max = 0.8313")
        self.assert_computes("run", "run.h5")
        self.assert_exit(self.overturn("info", "run.h5"), 0)
        self.assert_exit(self.overturn("verify", "run.h5"), 0)

    def test_need_more_friction_than_any_if_the_base_would_have_to_pull(self):
        block = "size_plus = 1, size_minus = 0.7, slenderness_plus = 0.3, slenderness_minus = 0.2, radius_of_gyration = 0.6"
        for share, impact in (("1.0", "an impact 0.202 to 0.626"),
                              ("0.1", "an impact from 0.628 to more than any, since the base would have to pull")):
            (self.folder / "rock.toml").write_text(f'scene.pulse = "one_sine"\nblock = {{ {block} }}\n[plane]\n'
                                                   f"pulse_period = 0.5\npga = 1\nrestitution_of_maximum = {share}\n")
            self.assert_exit(self.overturn("check", "rock.toml"), 0,
                             f"lifting needs a friction coefficient of 0.37 to 1.15 (b / h), {impact}")
    def test_that_imply_an_incline_are_described_with_it(self):
        self.write({"slenderness_plus": 0.3, "slenderness_minus": 0.2, "size_plus": 1, "size_minus": 0.7,
                    "radius_of_gyration": 0.6}, "pulse_period = 0.5\npga = 0.3\ndirection = 0")
        result = self.overturn("check", "job.toml")
        self.assert_exit(result, 0, "incline 31.78 degrees")
        self.assertIn("the incline that the angles and distances imply = 31.78 degrees is outside", result.stderr)

    def test_are_refused_with_what_to_do(self):
        self.write(LEANING, "pulse_period = 0.5\npga = 0.5")
        for override, words in (("plane.incline=4", "4 degrees are 0.06981 rad"),
                                ("plane.incline=0.3", "The block does not stand"),
                                ("plane.amplitude=2", "Give pga [g] instead"),
                                ("plane.direction=90", "needs two horizontal components"),
                                ("plane.slenderness=0.2", "describes the block in another way")):
            result = self.overturn("check", "job.toml", "--set", override)
            if override == "plane.slenderness=0.2":  # replaces the block
                self.assert_exit(result, 65, "needs the dimensions of the block")
            else:
                self.assert_exit(result, 65, words)

    def test_have_a_history_with_up_to_two_decisive_impacts(self):
        for block, direction, flips, above in cases():
            for pga, region in zip((flip + 1e-4 for flip in flips), above):
                self.write(block, f"pulse_period = 0.5\ndirection = {direction}\npga = {pga}")
                path = self.assert_computes("history", "history.h5")
                with h5py.File(path) as file:
                    kinds = dict(enumerate(file["events/kind"].attrs["flag_meanings"].decode().split()))
                    names = [kinds[code] for code in file["events/kind"][:]]
                    time, angle, velocity = (file[name][:] for name in ("time", "angle", "velocity"))
                    after = names[names.index("end_of_pulse"):]
                    if region.startswith("U"):
                        self.assertEqual(after.count("impact"), int(region[1]), region)
                        self.assertEqual(after[-1], "fall")
                        self.assertAlmostEqual(abs(angle[-1]), math.pi / 2, places=12)
                        self.assertEqual(angle[-1] > 0, region.endswith("+"))
                    # The velocity is the derivative of the angle in 1/p of the side plus.
                    step = np.diff(time)
                    inner = (step > 0) & (step < 0.05)
                    mean = (velocity[1:] + velocity[:-1]) / 2
                    error = np.abs(np.diff(angle)[inner] / step[inner] - mean[inner])
                    # Trapezoidal rule: h^2 / 12 times a third derivative of a few times alpha.
                    self.assertLess(error.max(), 0.05 ** 2)
                path.rename(self.folder / "last.h5")
        drawn = self.tool("plot_history", "last.h5")
        self.assertEqual(drawn.returncode, 0, drawn.stderr)


if __name__ == "__main__":
    unittest.main()
