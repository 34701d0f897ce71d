"""`overturn assess`: its rows are those of `run` and own arithmetic."""

import csv
import json
import math
import unittest

import h5py
import numpy as np

from program import JOBS, Scratch

TABLE = """name,width,height
vase,0.18,0.45
statue,0.6,1.8
slim,0.2,1.6
"cabinet, low",0.9,1
"""


class Assess(Scratch):
    def write_table(self, text, name="objects.csv"):
        (self.folder / name).write_text(text)

    def rows(self, *options):
        found = self.overturn("assess", "objects.csv", "--json", *options)
        self.assert_exit(found, 0)
        return {row["name"]: row for row in json.loads(found.stdout)["objects"]}

    def regions(self, strengths, motion, direction=None):
        """The regions of the objects at these strengths, as `run` computes them."""
        lines = [f"blocks.table = \"objects.csv\"\nnumerics.resolve = true\nscene.{motion[0]}\n[plane]", *motion[1:],
                 "restitution_of_maximum = 1", f"pga.values = {json.dumps(list(strengths))}"]
        lines += [f"direction = {direction}"] * (direction is not None)
        (self.folder / "job.toml").write_text("\n".join(lines))
        (self.folder / "r.h5").unlink(missing_ok=True)
        self.assert_exit(self.overturn("run", "job.toml", "-o", "r.h5"), 0)
        with h5py.File(self.folder / "r.h5") as file:
            region = file["region"]
            names = [b"".join(letters).decode().strip("\0 ") for letters in file["name"][()]]
            place = [d[0].name.rsplit("/", 1)[-1] for d in region.dims].index("block")
            values = np.moveaxis(region[()], place, 0).reshape(len(names), -1)
        return dict(zip(names, values))

    def test_takes_the_ratio_of_the_velocities_as_a_column(self):
        rows = []
        for name, value in (("velocity_restitution", 0.8), ("restitution", 0.8 * 0.8)):
            self.write_table(f"name,width,height,{name}\nstatue,0.6,1.8,{value!r}\n")
            rows.append(self.rows("--period", "0.5")["statue"])
        self.assertEqual(*({name: row[name] for name in ("lifts_from", "topples_from")} for row in rows))

    def test_has_the_lowest_strength_and_the_verdict_of_run(self):
        generator = np.random.default_rng(5)
        for motion, options in ((['pulse = "one_sine"', "pulse_period = 0.5"], ["--period", "0.5"]),
                                ([f'record = "{JOBS}/synthetic.AT2"'], ["--record", f"{JOBS}/synthetic.AT2"])):
            heights = generator.uniform(0.4, 2.5, 12)
            widths = heights * generator.uniform(0.15, 0.5, 12)
            self.write_table("name,width,height\n" + "".join(f"o{i},{w},{h}\n"
                                                             for i, (w, h) in enumerate(zip(widths, heights))))
            rows = self.rows("--pga", "0.6", "--pga-max", "2", *options)
            self.assertEqual(len(rows), 12)
            asked = self.regions([0.6], motion)
            strengths = np.geomspace(0.1, 2, 3000)  # steps of 0.1 %
            scanned = self.regions(strengths, motion)
            edges = [row["topples_from"] for row in rows.values() if row["topples_from"]]
            at_edges = self.regions(sorted(edges), motion)
            below = self.regions(sorted(edge * (1 - 1.01e-4) for edge in edges), motion)
            for name, row in rows.items():
                topples = asked[name][0] > 2
                self.assertEqual(row["verdict"] == "topples", topples)
                self.assertEqual(row["share_toppling"], float(topples))
                width, height = widths[int(name[1:])], heights[int(name[1:])]
                self.assertAlmostEqual(row["lifts_from"], width / height, places=12)
                is_regular = "pulse" in motion[0]  # under a record, ranges have narrow gaps, and gaps narrow ranges
                # Ranges that are wider than the steps of the search, 0.5 %: with seven neighbours that topple.
                toppling = strengths[:-6][np.lib.stride_tricks.sliding_window_view(scanned[name] > 2, 7).all(axis=1)]
                if len(toppling) and is_regular:
                    self.assertLessEqual(row["topples_from"], toppling[0] * (1 + 1e-4))
                if row["topples_from"]:
                    place = sorted(edges).index(row["topples_from"])
                    self.assertGreater(at_edges[name][place], 2)
                    self.assertTrue(below[name][place] <= 2 or not is_regular)
                else:
                    self.assertEqual(len(toppling), 0)
                    self.assertFalse(topples)
                    self.assertIn("searched up to 2 g", row["note"])

    def test_combines_motions_and_directions(self):
        self.write_table("name,width,height,center_offset\nleaning,0.4,1.2,0.05\nstraight,0.5,1.6,0\n")
        periods, directions = (0.3, 0.5, 0.8), (0, 180)
        together = self.rows("--period", ",".join(map(str, periods)), "--pga", "0.5")
        alone = {(period, direction): self.rows("--period", str(period), "--pga", "0.5", "--direction", str(direction))
                 for period in periods for direction in directions}
        for name, row in together.items():
            cases = [each[name] for key, each in alone.items() if name == "leaning" or key[1] == 0]
            self.assertEqual(row["cases"], len(cases))
            lowest = sorted(case["topples_from"] or math.inf for case in cases)
            self.assertEqual(row["topples_from"], lowest[0])
            self.assertEqual(row["median"], lowest[len(cases) // 2 - 1] if len(cases) % 2 == 0 else lowest[1])
            self.assertEqual(row["percentile_16"], lowest[0])
            self.assertEqual(row["lifts_from"], min(case["lifts_from"] for case in cases))
            self.assertAlmostEqual(row["share_toppling"], np.mean([case["share_toppling"] for case in cases]), places=12)

    def test_lists_the_most_vulnerable_first_as_text_and_csv(self):
        self.write_table(TABLE)
        found = self.overturn("assess", "objects.csv", "--period", "0.5", "--pga", "0.53", "--csv", "a.csv")
        self.assert_exit(found, 0)
        self.assertIn("steps of at most 0.5 % and refined to 0.01 %", found.stdout)
        names = [line.split()[0] for line in found.stdout.split("\n\n")[1].splitlines()[1:]]
        self.assertEqual(names, ["slim", "vase", "statue", "cabinet,"])
        with open(self.folder / "a.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["name"] for row in rows], ["slim", "vase", "statue", "cabinet, low"])
        self.assertEqual([row["verdict"] for row in rows], ["topples", "topples", "rocks", "stands"])
        self.assertAlmostEqual(float(rows[2]["topples_from"]), 0.903473050, delta=1e-4)
        self.assertEqual(rows[0]["peak_of_alpha"], "")  # infinite

    def test_notes_how_near_a_flip_the_strength_is(self):
        self.write_table(TABLE)
        for pga, note in (("0.86", "topples at 5.1 % more"), ("0.5", ""),
                          ("1.9", "topples at 3.2 % less and 12 % more")):  # safe from 1.84 to 2.13 g
            for fine in ((), ("--fine",)):
                self.assertEqual(self.rows("--period", "0.5", "--pga", pga, *fine)["statue"]["note"], note)
        # Of each record at its own strength.
        for name, peak in (("weak", 0.05), ("strong", 0.5)):
            samples = [0, *[peak] * 5, *[-peak] * 5, 0]
            (self.folder / f"{name}.txt").write_text("".join(f"{i / 10},{a}\n" for i, a in enumerate(samples)))
        records = ("--record", "weak.txt", "--record", "strong.txt", "--set", "scene.units=g")
        lowest = self.rows(*records)["statue"]["topples_from"]
        self.assertLess(lowest, 0.5)
        scale = 0.97 * lowest / 0.5
        self.assertEqual(self.rows(*records, "--scale", str(scale))["statue"]["note"],
                         "topples at 3.1 % more")

    def test_topples_an_object_if_one_of_its_azimuths_topples(self):
        """Against the answers for the single rows. Two samples of rock A, of which one row has equal sides."""
        rows = [("A", 0, "north", 0.30, 0.4, 0.02), ("A", 0, "east", 0.36, 0.4, 0.0), ("A", 1, "s1: north", 0.27, 0.4, 0.03),
                ("A", 1, "s1: east", 0.40, 0.4, 0.01), ("B", 0, "north", 0.5, 0.6, 0.0), ("B", 0, "east", 0.45, 0.6, 0.05)]
        head = "azimuth_of,sample,name,width,height,center_offset\n"
        motion = ("--period", "0.4,0.7", "--pga", "1.1", "--pga-max", "3")
        alone = {}
        for row in rows:
            for direction in ("0", "180"):
                for period in ("0.4", "0.7"):
                    self.write_table(head.replace("azimuth_of,", "") + ",".join(map(str, row[1:])) + "\n")
                    alone[row, direction, period], = self.rows("--period", period, *motion[2:], "--direction", direction).values()
        self.write_table(head + "".join(",".join(map(str, row)) + "\n" for row in rows))
        found = self.overturn("assess", "objects.csv", "--json", *motion)
        self.assert_exit(found, 0)
        answers = {row["azimuth_of"]: row for row in json.loads(found.stdout)["objects"]}
        self.assertEqual(set(answers), {"A", "B"})
        for name, answer in answers.items():
            keys = [key for key in alone if key[0][0] == name]
            lowest = {case: min(alone[key]["topples_from"] or math.inf for key in keys if (key[0][1], *key[1:]) == case)
                      for case in {(key[0][1], *key[1:]) for key in keys}}
            self.assertEqual(answer["cases"], len(lowest))
            self.assertEqual(answer["topples_from"], min(lowest.values()))
            ordered = sorted(lowest.values())
            self.assertEqual(answer["median"] or math.inf, ordered[len(ordered) // 2 - 1])
            topples = {case: any(alone[key]["verdict"] == "topples" for key in keys if (key[0][1], *key[1:]) == case)
                       for case in lowest}
            self.assertEqual(answer["share_toppling"], sum(topples.values()) / len(topples))
            self.assertEqual(answer["lifts_from"], min(alone[key]["lifts_from"] for key in keys))
            weakest = min(keys, key=lambda key: alone[key]["topples_from"] or math.inf)
            self.assertEqual(answer["name"], weakest[0][2])
            self.assertIn(f"weakest: {weakest[0][2]}", answer["note"])
        self.assertIsNone(json.loads(found.stdout)["least_widths"])

    def test_refuses_a_row_without_the_object_of_which_it_is_an_azimuth(self):
        for object_ in ("A", "1"):
            self.write_table(f"azimuth_of,name,width,height\n{object_},north,0.3,1\n,east,0.4,1\n")
            self.assert_refused(65, ["objects.csv:3", "azimuth_of is empty"], "assess", "objects.csv", "--period", "0.5")

    def test_fine_has_the_ranges_of_topple(self):
        self.write_table(TABLE)
        for motion in (["--period", "0.5"], ["--record", f"{JOBS}/synthetic.AT2"]):
            row = self.rows(*motion, "--pga", "0.4", "--pga-max", "1.5", "--fine")["vase"]
            answer = json.loads(self.overturn("topple", "--width", "0.18", "--height", "0.45", *motion, "--pga", "0.4",
                                              "--pga-max", "1.5", "--json").stdout)
            self.assertEqual(row["topples_from"], answer["toppling_pga"][0][0])
            self.assertEqual(row["end_of_search"], answer["end_of_search"])
            if answer["toppling_pga_above"]:
                self.assertAlmostEqual(row["factor_above"], answer["toppling_pga_above"] / 0.4, places=12)

    def test_says_how_wide_the_worst_object_must_be(self):
        self.write_table("name,width,height,center_offset\nleaning,0.4,1.2,0.05\nlow,1,1,0\n")
        motion = ("--period", "0.5,0.8", "--pga", "0.6")
        found = self.overturn("assess", "objects.csv", "--json", *motion)
        widths = json.loads(found.stdout)["least_widths"]
        self.assertEqual((widths["object"], widths["width"]), ("leaning", 0.4))
        self.assertAlmostEqual(widths["end_of_search"], 1.2, places=12)
        answers = [json.loads(self.overturn("topple", "--height", "1.2", "--center-offset", "0.05", "--period", period, "--pga",
                                            "0.6", "--direction", direction, "--vary", "width", "0.4", "1.2",
                                            "--json").stdout) for period in ("0.5", "0.8") for direction in ("0", "180")]
        self.assertEqual(widths["safe_from"], sorted(answer["safe_from"] for answer in answers))
        self.assertGreater(widths["safe_from"][-1], 0.4)
        self.assertIn(f"With more width, it stands from {math.ceil(widths['safe_from'][-1] * 1e4) / 1e4:.4f} m in all cases",
                      self.overturn("assess", "objects.csv", *motion).stdout)
        wide = self.rows(*motion)["low"]
        self.assertNotEqual(wide["verdict"], "topples")
        # Without a width in the table, and if nothing topples, there is no answer.
        for table, pga in (("name,size,slenderness\nslim,1,0.1\n", "0.9"), (TABLE, "0.05")):
            self.write_table(table)
            found = self.overturn("assess", "objects.csv", "--period", "0.5", "--pga", pga, "--json")
            self.assertIsNone(json.loads(found.stdout)["least_widths"])

    def test_without_a_strength_gives_no_verdict(self):
        self.write_table(TABLE)
        rows = self.rows("--period", "0.5")
        for row in rows.values():
            self.assertIsNone(row["verdict"])
            self.assertIsNone(row["share_toppling"])

    def test_says_what_slides(self):
        self.write_table("name,width,height,friction\nvase,0.18,0.45,0.2\nstatue,0.6,1.8,0.45\n")
        rows = self.rows("--period", "0.5", "--pga", "1.9", "--pga-max", "2")
        self.assertEqual(rows["vase"]["verdict"], "slides")
        self.assertAlmostEqual(rows["vase"]["slides_from"], 0.2, places=12)
        self.assertGreater(rows["vase"]["slide"], 0.1)
        self.assertIsNone(rows["vase"]["lifts_from"])
        self.assertEqual(rows["statue"]["verdict"], "topples")  # which would stand if it could not slip
        self.assertAlmostEqual(rows["statue"]["topples_from"], 0.903568714, delta=1e-4)
        far = self.overturn("assess", "objects.csv", "--period", "4", "--pga", "1.9", "--pga-max", "2").stdout
        self.assertRegex(far, r"vase .* \d{4,} mm")

    def test_reads_tables_with_semicolons_decimal_commas_and_units(self):
        self.write_table("name,width,height,incline\nvase,0.18,0.45,0\nleaning,0.41,1.2,0.05\n")
        expected = self.rows("--period", "0.5", "--pga", "0.4")
        self.write_table("name;width_cm;height_mm;incline_deg\n"
                         f"vase;18;450;0\nleaning;41,0;1200;{math.degrees(0.05)!r}\n".replace(".", ","))
        found = self.rows("--period", "0.5", "--pga", "0.4")
        for name, row in expected.items():
            for key, value in row.items():
                if isinstance(value, float):
                    self.assertAlmostEqual(found[name][key], value, places=12)
                else:
                    self.assertEqual(found[name][key], value)

    def test_warns_of_a_base_that_is_wider_than_deep_and_of_a_component_without_effect(self):
        def warnings(depth, *options):
            self.write_table(f"name,width_mm,depth_cm,height\nstele,520,{depth},2.1\nbust,300,40,1\n")
            found = self.overturn("assess", "objects.csv", *(options or ("--period", "0.5")))
            self.assert_exit(found, 0)
            return found.stderr
        self.assertIn('the column "depth_cm" of objects.csv has no effect, but the depth of an object is smaller than its '
                      "width", warnings(51))
        self.assertNotIn("warning", warnings(52))
        two = ("--record", str(JOBS / "synthetic.AT2"), "--set",
               f"scene.second_component={json.dumps(str(JOBS / 'synthetic_vertical.AT2'))}", "--direction")
        self.assertIn("the second horizontal component has no effect", warnings(52, *two, "0,180"))
        self.assertNotIn("has no effect", warnings(52, *two, "0,30"))

    def test_warns_of_a_column_that_seems_to_be_a_restitution(self):
        for column, meant in (("coefficient_of_restitution", "velocity_restitution"), ("restituton", "restitution"),
                              ("restitution_r", "restitution"), ("e", None)):
            warning = f'the column "{column}" of objects.csv has no effect (did you mean {meant}?)'
            for given, value in (("", ""), (",restitution", ",0.8")):
                self.write_table(f"name,width,height,{column}{given}\nbust,0.4,1,0.8{value}\n")
                found = self.overturn("assess", "objects.csv", "--period", "0.5")
                self.assert_exit(found, 0)
                self.assertEqual(warning in found.stderr, bool(meant) and not given, found.stderr)

    def test_takes_an_empty_cell_of_an_offset_or_incline_as_zero(self):
        self.write_table("name,width,height,incline,center_offset\na,0.2,0.5,0.03,0.01\nb,0.4,1.2,0,0\n")
        expected = self.rows("--period", "0.5", "--pga", "0.4")
        self.write_table("name,width,height,incline,center_offset\na,0.2,0.5,0.03,0.01\nb,0.4,1.2,,\n")
        found = self.rows("--period", "0.5", "--pga", "0.4")
        self.assertEqual(found, expected)
        self.assertEqual((found["b"]["incline"], found["b"]["cases"]), (0, 1))

    def test_of_a_floor_says_that_pga_is_not_that_of_the_ground(self):
        self.write_table(TABLE)
        samples = "".join(f"{i / 100} {0.5 * math.sin(0.3 * i)}\n" for i in range(100))
        (self.folder / "floor.txt").write_text(f"# units = g\n# motion_of = floor\n# ground_pga = 0.2\n{samples}")
        for strength, is_said in (("--pga", True), ("--scale", False)):
            found = self.overturn("assess", "objects.csv", "--record", "floor.txt", strength, "1")
            self.assert_exit(found, 0)
            self.assertEqual("where ground_pga = 0.2 g (for this earthquake, give scale = 1)" in found.stderr, is_said)

    def test_refuses_ambiguous_tables(self):
        for table, words in (
                ("name,width,width_cm,height\na,0.1,10,1\n", "width_cm is another column of width. Remove one"),
                ("name,width_cm,width_mm,height\na,10,100,1\n", "width_mm is another column of width. Remove one"),
                ("name;width;height\na;1.234,5;2\n", "is not a number. Write it without separators of thousands"),
                ("name,breite,height\na,0.1,1\n", "width"),
                ("name,width,height\na,0.1,1\na,0.2,1\n", "the name \"a\" is that of line 2, too"),
                ("name,width,height,friction\na,0.1,1,0.3\nb,0.2,1,\n", "friction"),
                ("name,width,height\na,0.1,1\n,,\n", "width")):
            with self.subTest(table=table):
                self.write_table(table)
                self.assert_exit(self.overturn("assess", "objects.csv", "--period", "0.5"), 65, words)

    def test_names_the_object_that_it_refuses(self):
        self.write_table("name,width,height\nA,0.6,1.8\nB,1.8,0.6\n")
        self.assert_refused(65, ["objects.csv:3:2: width = 1.8: slenderness = 1.249", "r_max is defined only"],
                            "assess", "objects.csv", "--period", "0.5")

    def test_refuses_what_it_cannot_use(self):
        self.write_table(TABLE)
        for options, code, words in (
                (["nothing.csv", "--period", "0.5"], 65, ["nothing.csv", "No such file"]),
                (["objects.csv"], 2, ["the ground motion is missing", "--period"]),
                (["objects.csv", "--period", "-1"], 2, ["--period"]),
                (["objects.csv", "--period", "0.5", "--set", "plane.pga=1"], 2, ["keys of [scene]"]),
                (["objects.csv", "--period", "0.5", "--pga", "0.4", "--csv", "no/a.csv"], 74, ["no"]),
                (["objects.csv", "--period", "0.5", "--csv", "objects.csv"], 74, ["is not a table of answers"])):
            with self.subTest(options=options):
                self.assert_exit(self.overturn("assess", *options), code, *words)
        self.assertEqual((self.folder / "objects.csv").read_text(), TABLE)
        self.write_table("name,width,height\nvase,0.18,-0.45\n")
        self.assert_exit(self.overturn("assess", "objects.csv", "--period", "0.5"), 65, "objects.csv", "height")


if __name__ == "__main__":
    unittest.main()
