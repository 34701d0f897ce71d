"""overturn topple: the statue of the documentation, records, and refusals."""

import json
import math
import os
import re
import shutil
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import JOBS, OVERTURN, Scratch

STATUE = ("--width", "0.6", "--height", "1.8")
PULSE = (*STATUE, "--period", "0.5")
RECORD = (*STATUE, "--record", str(JOBS / "synthetic.AT2"))


def use_one_core():
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})


class Toppling(Scratch):
    def topple(self, *arguments):
        result = self.overturn("topple", *arguments)
        self.assert_exit(result, 0)
        return result.stdout

    def answer(self, *arguments):
        return json.loads(self.topple(*arguments, "--json"))

    def test_of_a_statue_is_answered_in_a_few_lines(self):
        text = self.topple(*PULSE, "--pga", "0.4")
        for words in ("does not topple at 0.4 g; topples at 0.9034 g (126 % more)\n", "0.8868 degrees, 4.81 % of alpha",
                      "lifts from   0.3333 g",
                      "1.1113 to 1.6445 g, above 2.1296 g, searched up to 5 g"):
            self.assertIn(words, text)
        self.assertLess(len(text.splitlines()), 17)
        self.assertIn("verdict      topples at 1.2 g",
                      self.topple(*PULSE, "--pga", "1.2", "--restitution-of-maximum", "0.9"))

    def test_of_a_near_miss_says_how_near_it_is(self):
        for wanted, *words in (("does not topple at 1.975 times the record, 0.7900 g; topples at 1.979 times the record "
                                "(0.2 % more) and at 1.924 times the record (2.6 % less)\n", *RECORD, "--scale", "1.975"),
                               ("does not topple at 0.9016 g; topples at 0.9034 g (0.2 % more)\n", *PULSE, "--pga", "0.9016")):
            self.assertIn(f"verdict      {wanted}", self.topple(*words, "--pga-max", "1.2"))
        answer = self.answer(*PULSE, "--pga", "0.9016", "--restitution-of-maximum", "0.9", "--pga-max", "1.2")
        self.assertEqual(answer["verdict"], "does not topple at 0.9016 g; topples at 1.1113 g (23 % more); with r = r_max, "
                                            "it topples at 0.9034 g (0.2 % more)")
        self.assertIsNone(answer["toppling_pga_below"])
        self.assertEqual(answer["toppling_pga_above"], answer["toppling_pga"][0][0])
        self.assertEqual([each["toppling_pga_above"] for each in answer["by_restitution"]],
                         [None if not each["toppling_pga"] else each["toppling_pga"][0][0]
                          for each in answer["by_restitution"]])

    def test_states_the_friction_that_it_needs(self):
        self.assertIn("friction     the verdict holds if the coefficient is at least 0.46", self.topple(*PULSE, "--pga", "0.9"))
        alpha = math.atan(1 / 3)
        at_rest = self.answer(*PULSE, "--pga", "0.25")
        self.assertAlmostEqual(at_rest["friction_demand"], 0.25, places=12)
        self.assertGreaterEqual(self.answer(*PULSE, "--pga", "0.34")["friction_demand"], math.tan(alpha) * (1 - 1e-12))
        linear = self.answer(*PULSE, "--pga", "0.9", "--set", "scene.theory=linear")
        self.assertEqual((linear["friction_demand"], linear["friction_to_topple"]), (None, []))
        self.assertNotIn("friction", self.topple(*PULSE, "--pga", "0.9", "--set", "scene.theory=linear"))

    def test_states_the_friction_of_its_ranges(self):
        for motion, scene in ((("--period", "0.5"), 'pulse = "one_sine"'),
                              (("--record", str(JOBS / "synthetic.AT2")), f'record = "{JOBS / "synthetic.AT2"}"')):
            answer = self.answer(*STATUE, *motion)
            lower_ends = [first for first, _ in answer["toppling_pga"]]
            self.assertEqual(len(answer["friction_to_topple"]), len(lower_ends))
            period = "pulse_period = 0.5" if "pulse" in scene else ""
            for lower, needed in zip(lower_ends[:2], answer["friction_to_topple"]):
                (self.folder / "up.toml").write_text(
                    f"[scene]\n{scene}\n[block]\nwidth = 0.6\nheight = 1.8\n[plane]\nrestitution_of_maximum = 1\n{period}\n"
                    f"pga = {{ first = {answer['lifting_pga']}, last = {lower}, count = 400 }}\n"
                    '[numerics]\nresolve = true\n[output]\nfields = ["region", "friction_demand"]\n')
                self.assert_exit(self.overturn("run", "up.toml", "-o", "up.h5"), 0)
                with h5py.File(self.folder / "up.h5") as file:
                    # Two scans, with steps of half a per cent or less, of a friction that is at most in proportion.
                    self.assertAlmostEqual(np.max(file["friction_demand"][:]) / needed, 1, delta=0.005)
                (self.folder / "up.h5").unlink()

    def test_knows_the_friction_at_the_lower_ends_of_ranges(self):
        # At an end itself, the margin may be too close to zero to be settled.
        for words in (("--width", "0.8", "--height", "2", "--center-offset", "0.1", "--center-height", "0.9", "--period",
                       "0.6"), ("--width", "6", "--height", "18", "--period", "15.8114")):
            needed = self.answer(*words)["friction_to_topple"]
            self.assertTrue(needed and all(0.3 < friction < 1 for friction in needed), needed)

    def test_of_a_weak_motion_leaves_the_block_at_rest(self):
        text = self.topple(*PULSE, "--pga", "0.3")
        for words in ("does not topple at 0.3 g", "0: the block is not lifted and stays at rest"):
            self.assertIn(words, text)

    def test_agrees_with_the_job_in_dimensionless_numbers(self):
        answer = self.answer(*PULSE, "--pga", "1.2", "--restitution", "0.65")
        alpha, p = math.atan(1 / 3), math.sqrt(3 * 9.81 / (4 * math.hypot(0.3, 0.9)))
        self.assertAlmostEqual(answer["slenderness"], alpha, places=15)
        self.assertAlmostEqual(answer["frequency_parameter"], p, places=14)
        one = ("--set", f"plane.frequency={2 * math.pi / (0.5 * p)}", "--set",
               f"plane.slenderness={alpha}", "--set", "plane.restitution=0.65")
        self.assert_exit(self.overturn(
            "boundary", "small.toml", "-o", "b.h5", *one,
            "--set", "plane.amplitude={ first = 1, last = 15, count = 141 }"), 0)
        with h5py.File(self.folder / "b.h5") as file:
            flips = file["flip_amplitude"][:3] * math.tan(alpha)
        (first, last), (above, end) = answer["toppling_pga"]
        for mine, theirs in zip((first, last, above), flips):
            self.assertLess(abs(mine - theirs), 1e-10)
        self.assertIsNone(end)
        self.assertTrue(first < 1.2 < last and answer["topples"])

    def test_beside_a_flip_is_told_with_enough_decimals(self):
        for side in (-2e-7, 2e-7):
            pga = self.answer(*PULSE)["toppling_pga"][0][1] + side
            text = self.topple(*PULSE, "--pga", repr(pga))
            row = next(row for row in text.splitlines() if row.startswith("topples"))
            last = float(row.split(" to ")[1].split()[0])
            self.assertEqual(f"verdict      topples at {pga} g" in text, pga < last)
            self.assertIn("0.9034 to 1.8397 g", self.topple(*PULSE, "--pga", "1.8"))

    def test_takes_the_ratio_of_the_velocities_or_of_the_energies(self):
        for block in (STATUE, (*STATUE, "--center-offset", "0.05")):
            words = (*block, "--period", "0.5", "--pga", "0.9", "--pga-max", "1.5")
            self.assertEqual(self.topple(*words, "--velocity-restitution", "0.8"),
                             self.topple(*words, "--restitution", repr(0.8 * 0.8)))

    def test_without_a_search_gives_the_verdict_only(self):
        searched = {"friction_to_topple", "toppling_pga_below", "toppling_pga_above", "toppling_pga", "safe_pga",
                    "undecided_pga", "toppling_intervals", "undecided_share", "end_of_search", "coarse_search",
                    "by_restitution"}
        sentence = re.compile("(?:topples|does not topple) at [^;]*")
        for words in ((*PULSE, "--pga", "0.9"), (*PULSE, "--pga", "6"), (*RECORD, "--scale", "1.5"),
                      (*STATUE, "--center-offset", "0.05", "--period", "0.5", "--pga", "0.7"),
                      (*PULSE, "--pga", "0.9", "--friction", "0.3")):
            whole, verdict = self.answer(*words), self.answer(*words, "--no-search")
            self.assertEqual(whole.keys(), verdict.keys())
            for answer, other in ((whole, verdict), *zip(sorted(whole["by_direction"], key=lambda each: each["direction"]),
                                                         sorted(verdict["by_direction"], key=lambda each: each["direction"]))):
                for name in other.keys() - {"by_direction", "pga_max", "narrower_ranges_exist"}:
                    if name == "verdict":
                        self.assertEqual(sentence.match(answer[name])[0], other[name])
                    else:
                        self.assertEqual(other[name], None if name in searched else answer[name], name)
            self.assertIsNone(verdict["pga_max"])
            text = self.topple(*words, "--no-search")
            self.assertIn(f"verdict      {verdict['verdict']}\n", text)
            self.assertNotIn("r/r_max", text)
            self.assertNotIn("ranges", text)
        self.assert_refused(2, ["Give --pga or --scale"], "topple", *PULSE, "--no-search")
        self.assert_refused(2, ["--pga-max excludes --no-search"], "topple", *PULSE, "--pga", "1", "--no-search", "--pga-max", "2")

    def test_without_an_acceleration_gives_the_ranges_only(self):
        answer = self.answer(*PULSE)
        self.assertIsNone(answer["topples"])
        self.assertEqual(len(answer["toppling_pga"]), 2)
        shares = [each["restitution_of_maximum"] for each in answer["by_restitution"]]
        self.assertEqual([round(share, 12) for share in shares], [0.8, 0.85, 0.9, 0.95, 1])
        self.assertEqual(self.answer(*PULSE, "--pga-max", "0.3")["toppling_pga"], [])

    def test_under_a_record_says_that_narrower_ranges_may_be_missed(self):
        began = time.monotonic()
        text = self.topple(*RECORD, "--scale", "1.5")
        self.assertLess(time.monotonic() - began, 60)
        self.assertIn("does not topple at 1.5 times the record, 0.6000 g", text)
        self.assertIn("synthetic.AT2: 2001 samples, 20 s, 0.4 g", text)
        self.assertIn("ranges narrower than the steps of 0.5 % may be missed", text)
        answer = self.answer(*RECORD, "--pga", "0.9")
        self.assertTrue(answer["narrower_ranges_exist"])
        intervals, ranges = answer["toppling_intervals"], answer["toppling_pga"]
        self.assertTrue(len(ranges) > 6 == len(intervals))
        self.assertEqual(intervals[-1], {"first": ranges[-1][0], "last": None, "share": 1})
        for interval in intervals[:-1]:
            inside = [last - first for first, last in ranges[:-1] if interval["first"] <= first and last <= interval["last"]]
            self.assertAlmostEqual(interval["share"], sum(inside) / (interval["last"] - interval["first"]), places=12)

    def test_under_a_record_ends_its_safe_ranges_at_safe_accelerations(self):
        generator = np.random.default_rng(5)
        for _ in range(3):
            size = {"width": generator.uniform(0.4, 0.7), "height": generator.uniform(1.6, 2.2)}
            answer = self.answer("--record", str(JOBS / "synthetic.AT2"),
                                 *(f"--{name}={value!r}" for name, value in size.items()))
            ends = [end for safe in answer["safe_pga"] for end in safe
                    if answer["lifting_pga"] < end < answer["end_of_search"]]
            self.assertGreater(len(ends), 3)
            (self.folder / "job.toml").write_text(f"""
                [scene]
                record = "{JOBS}/synthetic.AT2"
                [plane]
                pga = {{ values = {ends!r} }}
                restitution_of_maximum = 1.0
                {"".join(f"{name} = {value!r}{chr(10)}" for name, value in size.items())}
                [numerics]
                resolve = true
                """)
            self.assert_exit(self.overturn("run", "job.toml", "-o", "s.h5"), 0)
            with h5py.File(self.folder / "s.h5") as file:
                self.assertLessEqual(file["region"][:].max(), 2)
            for file in ("s.h5", "s.h5.json"):
                (self.folder / file).unlink()

    def test_of_a_slow_pulse_finds_narrow_strips_just_above_the_uplift(self):
        # Both strips topple the block in an integration by Runge-Kutta steps of fixed size.
        for size, period, share, pga in ((("0.63", "2.74"), "6.197", 0.8, 0.2437),
                                         (("0.41", "2.07"), "4.263", 0.9, 0.2101)):
            answer = self.answer("--width", size[0], "--height", size[1], "--period", period, "--pulse",
                                 "antisymmetric_ricker", "--restitution-of-maximum", str(share))
            self.assertTrue(any(first < pga < (last or math.inf) for first, last in answer["toppling_pga"]))

    def test_under_a_record_has_the_verdict_of_the_spectrum_in_its_ranges(self):
        (self.folder / "job.toml").write_text(f"""
            [scene]
            record = "{JOBS}/synthetic.AT2"
            [plane]
            pga = {{ values = [0.7, 0.9, 1.0, 2.0] }}
            restitution_of_maximum = 1.0
            [block]
            width = 0.6
            height = 1.8
            [numerics]
            resolve = true
            """)
        self.assert_exit(self.overturn("run", "job.toml", "-o", "s.h5"), 0)
        with h5py.File(self.folder / "s.h5") as file:
            for pga, code in zip(file["pga"][:], file["region"][:].ravel()):
                answer = self.answer(*RECORD, "--pga", str(pga))
                for each in answer["by_restitution"]:  # ranges do not touch
                    ends = [end or math.inf for ends in each["toppling_pga"] for end in ends]
                    self.assertEqual(ends, sorted(set(ends)))
                self.assertEqual(answer["topples"], bool(code > 2))
                self.assertEqual(answer["topples"],
                                 any(first <= pga <= (last or math.inf)
                                     for first, last in answer["toppling_pga"]), pga)

    def test_takes_keys_of_the_scene(self):
        moon = self.answer(*PULSE, "--set", "scene.gravity=1.62")
        self.assertEqual(moon["gravity"], 1.62)
        self.assertEqual(moon["lifting_pga"], self.answer(*PULSE)["lifting_pga"])
        # With t -> t sqrt(9.81 / 1.62), accelerations over g are the same.
        period = str(0.5 * math.sqrt(1.62 / 9.81))
        earth = self.answer(*STATUE, "--period", period)
        for one, other in zip(moon["toppling_pga"], earth["toppling_pga"], strict=True):
            self.assertLess(abs(one[0] / other[0] - 1), 1e-11)

    def test_writes_the_motion_at_the_requested_acceleration(self):
        text = self.topple(*PULSE, "--pga", "0.9", "--history", "tilt.h5")
        self.assertTrue(text.endswith("\n\ntilt.h5: written; draw it with tools/plot_history tilt.h5 "
                                      "--units physical\n"))
        (self.folder / "job.toml").write_text("""
            scene.pulse = "one_sine"
            plane = { pulse_period = 0.5, pga = 0.9, restitution_of_maximum = 1.0 }
            block = { width = 0.6, height = 1.8 }
            """)
        self.assert_exit(self.overturn("history", "job.toml", "-o", "same.h5"), 0)
        with h5py.File(self.folder / "tilt.h5") as one, h5py.File(self.folder / "same.h5") as other:
            for name in ("time", "angle", "velocity"):
                self.assertEqual(one[name][:].tolist(), other[name][:].tolist())
        before = (self.folder / "tilt.h5").read_bytes()
        self.answer(*PULSE, "--pga", "0.9", "--history", "tilt.h5")  # prints nothing but JSON
        self.assertEqual((self.folder / "tilt.h5").read_bytes(), before)

    def test_that_cannot_be_written_is_refused_before_the_answer(self):
        (self.folder / "notes.h5").write_text("not to be lost")
        for path, reason in (("none/tilt.h5", "there is no folder"), ("notes.h5", "its kind is not")):
            result = self.overturn("topple", *PULSE, "--pga", "0.9", "--history", path)
            self.assert_exit(result, 74, reason)
            self.assertEqual(result.stdout, "")
        self.assertEqual((self.folder / "notes.h5").read_text(), "not to be lost")

    def assert_partition(self, answer):
        """Checks that the ranges of the three kinds cover the search without gaps."""
        end = answer["end_of_search"]
        kinds = ("toppling_pga", "safe_pga", "undecided_pga")
        ranges = sorted([first, end if last is None else last] for kind in kinds
                        for first, last in answer[kind])
        self.assertEqual((ranges[0][0], ranges[-1][1]), (0, end))
        for one, next_one in zip(ranges, ranges[1:]):
            self.assertEqual(one[1], next_one[0])

    def verdict_in(self, answer, pga):
        return [kind for kind in ("toppling_pga", "safe_pga", "undecided_pga")
                for first, last in answer[kind] if first <= pga <= (last or math.inf)]

    def test_is_searched_as_far_as_the_vertical_motion_leaves_gravity(self):
        random = np.random.default_rng(1)
        for _ in range(3):
            ground, upwards = random.uniform(-0.5, 0.5, (2, 400))
            upwards[random.integers(400)] = -random.uniform(0.6, 1.5)
            for name, values in (("h.txt", ground), ("v.txt", upwards)):
                np.savetxt(self.folder / name, np.cumsum(values) / 20 if name == "h.txt" else values)
            ground = np.loadtxt(self.folder / "h.txt")
            upwards = np.loadtxt(self.folder / "v.txt")
            motion = (*STATUE, "--record", "h.txt", "--set", "scene.vertical=v.txt", "--set",
                      "scene.time_step=0.02", "--set", "scene.units=g")
            answer = self.answer(*motion)
            peak = np.abs(ground).max()
            limit = peak / -upwards.min()
            self.assertAlmostEqual(answer["end_of_search"] / min(limit, 5), 1, delta=1e-14)
            lifting = peak / 3 / (np.abs(ground) - upwards / 3).max()
            self.assertAlmostEqual(answer["lifting_pga"] / lifting, 1, delta=1e-14)
            for each in (answer, *answer["by_restitution"]):
                self.assert_partition(each)
            for pga in limit * random.uniform(0.9, 0.9999, 2):
                asked = self.answer(*motion, "--pga", repr(float(pga)))
                kinds = self.verdict_in(asked, pga)
                self.assertTrue({True: "toppling_pga", False: "safe_pga",
                                 None: "undecided_pga"}[asked["topples"]] in kinds or
                                "undecided_pga" in kinds, (pga, asked))
            text = self.topple(*motion)
            self.assertIn("vertical v.txt", text)
            if limit < 5:
                self.assertIn(f"{limit:.6g} g the vertical motion cancels gravity", text)
            searched = [float(end) for end in re.findall("searched up to ([0-9.]+) g", text)]
            self.assertEqual(len(searched), 6)
            for end in searched:
                self.assertTrue(answer["end_of_search"] - 1e-6 < end <= answer["end_of_search"])

    def test_that_is_undecided_is_neither_safe_nor_toppling(self):
        # Without loss, a block bounces too often to be followed just above the acceleration that
        # lifts it.
        arguments = ("--width", "0.3", "--height", "1.8", "--period", "0.3", "--pulse", "sine",
                     "--set", "scene.cycles=3", "--restitution", "1", "--pga", "0.16668",
                     "--pga-max", "0.1667")
        answer = self.answer(*arguments)
        self.assertIsNone(answer["topples"])
        self.assertEqual(self.verdict_in(answer, 0.16668), ["undecided_pga"])
        self.assertGreater(answer["undecided_share"], 0.5)
        self.assert_partition(answer)
        self.assertEqual(answer["by_restitution"][0]["undecided_share"], 0)

    def test_is_searched_up_to_the_requested_acceleration(self):
        for pga, period in ((20, 0.15), (7, 0.3), (5.5, 0.5)):
            answer = self.answer(*STATUE, "--period", str(period), "--pga", str(pga))
            self.assertEqual(answer["end_of_search"], pga)
            self.assertEqual("toppling_pga" in self.verdict_in(answer, pga), answer["topples"])

    def test_of_slow_pulses_reports_progress(self):
        slow = ("--width", "1", "--height", "6.6", "--period", "2", "--pulse", "cosine", "--set",
                "scene.cycles=10")
        with subprocess.Popen([OVERTURN, "topple", *slow], text=True, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL,
                              preexec_fn=use_one_core) as process:  # it waits for the time of a report
            self.addCleanup(process.kill)
            self.assertRegex(process.stderr.readline(), "[0-5] of 6 restitutions, ")
            process.kill()

    def test_of_a_wide_block_has_no_rows_of_r_max(self):
        # r_max is defined below 54.7 degrees.
        wide = ("--width", "3", "--height", "1", "--period", "1", "--restitution", "0.5")
        self.assertIn("r = 0.5; r_max is not defined for so wide a block", self.topple(*wide))
        answer = self.answer(*wide)
        self.assertEqual((answer["restitution_of_maximum"], answer["by_restitution"]), (None, []))
        self.assertEqual(len(answer["toppling_pga"]), 1)

    def test_needs_one_record_and_a_place_for_its_answer(self):
        for name in ("1.AT2", "2.AT2"):
            shutil.copy(JOBS / "synthetic.AT2", self.folder / name)
        self.assert_exit(self.overturn("topple", *STATUE, "--record", "*.AT2", "--scale", "1"), 2,
                         "--record matches 2 files")
        self.assert_exit(self.overturn("topple", *PULSE, "--pga", "0.4",
                                       shell_setup="exec > /dev/full"), 74, "cannot write to stdout")

    def test_of_a_pattern_that_matches_one_file_is_that_of_the_file(self):
        (self.folder / "d [1]").mkdir()
        (self.folder / "d [1]" / "a.AT2").write_text("PEER\nA, 1\nIN UNITS OF G\nNPTS= 4, DT= .1\n0 1 1 0\n")
        texts = [self.topple(*STATUE, "--record", f"d [1]/{name}") for name in ("a.AT2", "*.AT2")]
        self.assertIn("topples", texts[0])
        self.assertEqual(texts[0], texts[1])

    def test_writes_a_history_with_the_settled_verdict_of_a_motion_too_sensitive_for_doubles(self):
        for size, scale, verdict in (("1.28607", "1.268662", "topples"),  # although the curve stays upright
                                     ("2", "1.0939597315436242", "undecided")):
            text = self.topple("--record", str(JOBS / "synthetic.AT2"), "--slenderness", "0.24497866312686414",
                               "--restitution", "1", "--size", size, "--scale", scale, "--no-search",
                               "--history", "h.h5")
            self.assertIn(f"verdict      {verdict}", text)
            with h5py.File(self.folder / "h.h5") as file:
                region = int(file.attrs["region"])
                self.assertEqual(verdict, "undecided" if region == 254 else "topples" if region >= 3 else None)
                self.assertLess(np.abs(file["angle"][:]).max(), 0.5)
                self.assertFalse(file.attrs["curve_is_certain"])
                self.assertTrue(math.isnan(file.attrs["margin"]))
                self.assertTrue(math.isnan(file.attrs["time_of_fall"]) and math.isnan(file.attrs["time_of_rest"]))

    def test_with_a_component_without_motion_is_refused(self):
        for name, direction in (("zero.AT2", 90), ("zero.AT2", 270)):
            head, *_ = (JOBS / "synthetic.AT2").read_text().split(" SEC\n")
            (self.folder / name).write_text(head + " SEC\n" + "0\n" * 2001)
            shutil.copy(JOBS / "synthetic.AT2", self.folder / "one.AT2")
            self.assert_exit(self.overturn("topple", *STATUE, "--record", "one.AT2", "--direction", str(direction),
                                           "--set", "scene.second_component='zero.AT2'", "--scale", "1"),
                             65, "second_component", "is zero at all times")

    def test_warns_of_other_units(self):
        for wrong, words in ((("--width", "20", "--height", "60", "--period", "0.5"), "R = 31.62"),
                             ((*STATUE, "--period", "600"), "the period of the pulse = 600 s"),
                             ((*PULSE, "--pga", "40"), "the peak ground acceleration = 40 g"),
                             ((*PULSE, "--restitution", "0.9"), "r = 0.9 is above r_max = 0.7225")):
            result = self.overturn("topple", *wrong)
            self.assert_exit(result, 0)
            self.assertEqual(result.stderr.count("warning"), 1)
            self.assertIn(words, result.stderr)
            self.assertIn(words, self.answer(*wrong)["warnings"][0])
        self.assertEqual(self.answer(*PULSE)["warnings"], [])

    def test_refuses_what_contradicts_itself(self):
        for arguments, words in (
                ((*RECORD, "--period", "0.5"), "--period excludes --record"),
                ((*RECORD, "--pulse", "one_sine"), "--pulse excludes --record"),
                ((*STATUE, "--pga", "0.4"), "Give --period"),
                ((*PULSE, "--scale", "2"), "--scale requires --record"),
                ((*PULSE, "--component", "2"), "--component requires --record"),
                ((*RECORD, "--scale", "2", "--pga", "1"), "--pga excludes --scale"),
                ((*PULSE, "--restitution", "0.6", "--restitution-of-maximum", "1"), "--restitution excludes --restitution-of-maximum"),
                ((*PULSE, "--restitution", "0.6", "--velocity-restitution", "1"), "--restitution excludes --velocity-restitution"),
                ((*PULSE, "--velocity-restitution", "0.6", "--restitution-of-maximum", "1"),
                 "--velocity-restitution excludes --restitution-of-maximum"),
                ((*PULSE, "--history", "a.h5"), "Give --pga or --scale"),
                ((*PULSE, "--set", "plane.pga=1"), "--set takes keys of [scene] here"),
                (("--width", "0", "--height", "1.8", "--period", "0.5"), "width = 0 is outside (0, inf)"),
                ((*PULSE, "--width", "1"), "--width: At Most 1 required but received 2"),
                ((*STATUE, "--incline", "4", "--period", "0.5"), "4 degrees are 0.06981 rad"),
                ((*STATUE, "--incline", "x", "--period", "0.5"), "x is not a number"),
                ((*PULSE, "--pga-max", "nan"), "nan is not a positive, finite number"),
                ((*PULSE, "--pga-max", "inf"), "inf is not a positive, finite number"),
                ((*PULSE, "--pga-max", "1e4"), "1e4 is above 1000 g.")):
            self.assert_exit(self.overturn("topple", *arguments), 2, words)
        self.assert_exit(self.overturn("topple", *PULSE, "--restitution", "1.2"), 65,
                         "outside (0, 1]")
        self.assert_exit(self.overturn("topple", *PULSE, "--pulse", "sinus"), 65, "is unknown")
        self.assert_exit(self.overturn("topple", "--width", "42", "--height", "155", "--period", "0.5"), 65,
                         "Lengths are in metres: 0.42 m x 1.55 m?")
        self.assert_exit(self.overturn("topple", *STATUE, "--record", "none\n\"\\.AT2"), 65,
                         "none \"\\.AT2: cannot be read")


if __name__ == "__main__":
    unittest.main(verbosity=2)
