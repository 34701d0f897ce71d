"""The pictures and numbers of tools/plot_fragility.

Requires OVERTURN (the binary) in the environment.
"""

import csv
import dataclasses
import re
import shutil
import signal
import subprocess
import unittest
import warnings

import h5py
import numpy as np
from tool import TOOLS, InOneFolder, run_overturn, run_tool, words_of  # first: adds the package to the path
import overturn
from matplotlib import pyplot
from overturn.plot import fragility_curves

JOB = """
    scene.record = "*.AT2"
    output.fields = ["region", "peak"]
    [plane]
    size = { first = 0.5, last = 2.0, count = 4 }
    scale = { first = 0.5, last = 4.0, count = 5, spacing = "log" }
    restitution_of_maximum = 0.9
    slenderness = { first = 0.15, last = 0.3, count = 3 }
    """


class Curve(InOneFolder):
    TOOL, JOB = "plot_fragility", JOB

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        done = run_tool("synthetic_record", "--suite", "10", "-o", ".", cwd=cls.folder)
        assert done.returncode == 0, done.stderr
        run_overturn(cls.folder, "run", JOB, "result.h5")

    def words(self, *arguments):
        text, words = self.drawing(words_of, *arguments)
        return text, " ".join(words)

    def unfinished(self, name):
        shutil.copy(self.folder / "result.h5", self.folder / name)
        with h5py.File(self.folder / name, "a") as file:
            file["run/checksum"][-1] = 0  # of the tile of the last motion


class TestAPicture(Curve):
    def test_has_a_panel_for_each_measure(self):
        text, words = self.words("result.h5", "--im", "pga", "pgv", "--csv", "curve.csv")
        self.assertIn("overturning against pga [g]", text)
        self.assertIn("overturning against pgv [m s-1]", text)
        for label in ("PGA [g]", "PGV [m/s]", "95 % confidence of the curve"):
            self.assertIn(label, words)
        for measure in ("pga", "pgv"):
            with open(self.folder / f"curve_{measure}.csv", encoding="utf-8") as file:
                rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
            self.assertEqual(sum(int(row["points"]) for row in rows), 10 * 60)
        for line in ("Fragility: result.h5", "10 motions,  12 blocks pooled"):
            self.assertIn(line, words)

    def test_has_a_curve_for_each_value_of_a_column(self):
        text, words = self.words("result.h5", "--by", "slenderness", "--csv", "by.csv", "--samples", "20")
        self.assertIn("10 motions,  12 blocks,  3 groups", words)
        for number, slenderness in enumerate(("0.15", "0.225", "0.3"), 1):
            self.assertIn(f"slenderness = {slenderness} rad (4 blocks)", words)
            self.assertIn(f"\nslenderness = {slenderness} rad\n", text)
            self.assertIn(f"# slenderness = {slenderness} rad\n", (self.folder / f"by_{number}.csv").read_text())
        self.assertIn("by slenderness", words)

    def test_of_many_groups_has_all_its_words_within_the_picture(self):
        with overturn.open(self.folder / "result.h5") as dataset:
            curve = overturn.fragility(dataset, samples=2)
        for count in (2, 12):
            for long in (0, 3):  # repetitions of some words in a name
                curves = [dataclasses.replace(curve, group=f"kind = {'grey granite of the valley ' * (long * (i % 2))}{i}",
                                              notes=("a note",) * (i % 3)) for i in range(count)]
                figure, panel = pyplot.subplots(layout="constrained", figsize=(5.5, 5))
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    fragility_curves.make_room([fragility_curves.draw_panel(panel, curves)])
                    figure.draw_without_rendering()
                pyplot.close(figure)
                self.assertGreater(min(panel.get_window_extent().size), 3.5 * figure.dpi)
                for words in (panel.get_legend(), panel.xaxis.label, panel.title):
                    box = words.get_window_extent()
                    self.assertTrue(0 <= box.x0 < box.x1 <= figure.bbox.x1, (count, long, words))
                    self.assertTrue(0 <= box.y0 < box.y1 <= figure.bbox.y1, (count, long, words))

    def test_may_be_the_plane_of_two_measures(self):
        text, words = self.words("result.h5", "--plane", "--csv", "plane.csv", "--samples", "20", "--bins", "4")
        self.assertIn("overturning against pga [g] and pgv/pga [m s-1/g]", text)
        self.assertIn("ln(P / (1 - P)) = a + b ln(pga) + c ln(pgv/pga)", text)
        for label in ("PGA [g]", "PGV/PGA [m/s/g]", "fit: 50 %", "95 % confidence of 50 %", "fraction that overturns"):
            self.assertIn(label, words)
        self.assertNotIn("without a verdict", words)
        with open(self.folder / "plane.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.assertEqual((len(rows), sum(int(row["points"]) for row in rows)), (16, 600))
        self.unfinished("part.h5")
        text, words = self.words("part.h5", "--plane", "--im", "pgv", "arias_intensity", "--by", "slenderness",
                                 "--samples", "20")
        self.assertIn("\nslenderness = 0.225 rad\n", text)
        for label in ("PGV [m/s]", "Arias intensity [m/s]", "with points without a verdict", "slenderness = 0.3 rad"):
            self.assertIn(label, words)

    def test_marks_the_weakest_azimuth(self):
        (self.folder / "rock.csv").write_text("azimuth_of,azimuth_from_x,slenderness,size,restitution_of_maximum\n"
                                              "rock,0,0.2,1,0.9\nrock,90,0.15,1,0.9\nrock,180,0.5,1,0.9\n"
                                              "rock,270,0.2,1,0.9\n")
        run_overturn(self.folder, "run", 'scene.record = "*.AT2"\nblocks.table = "rock.csv"\n[plane]\n'
                     'scale = { first = 0.5, last = 6.0, count = 8, spacing = "log" }\n', "rock.h5")
        text, words = self.words("rock.h5", "--polar", "azimuth_from_x", "--im", "pga", "--samples", "20")
        medians = re.findall(r"azimuth_from_x = ([0-9]+) degree\nmedian ([0-9.]+)", text)
        self.assertEqual(min(medians, key=lambda each: float(each[1]))[0], "90")
        self.assertRegex(words, r"median PGA \[g\],  least [0-9.]+ in the plane 90°-270° from x")
        self.assertIn("weakest plane", words)
        # Together they are one object, weaker than each of its rows.
        text, words = self.words("rock.h5", "--im", "pga", "--samples", "20")
        self.assertIn("1 object in 4 rows;", text)
        self.assertIn("10 motions,  1 object in 4 rows", words)
        least = min(float(each[1]) for each in medians)
        self.assertLessEqual(float(re.search(r"median ([0-9.]+)", text)[1]), 1.05 * least)

    def test_of_several_objects_counts_the_rows_of_all(self):
        (self.folder / "both.csv").write_text("azimuth_of,azimuth_from_x,slenderness,size\nrock,0,0.2,1\nrock,90,0.15,1\n"
                                              "boulder,0,0.3,1\n")
        run_overturn(self.folder, "run", 'scene.record = "*.AT2"\nblocks.table = "both.csv"\n'
                     "plane.restitution_of_maximum = 0.9\nplane.scale.values = [1, 2, 4]\n", "both.h5")
        text, words = self.words("both.h5", "--by", "azimuth_of", "--im", "pga", "--samples", "1")
        self.assertIn("10 motions,  2 objects in 3 rows,  2 groups", words)
        self.assertNotIn("azimuth of =", text + words)
        text, words = self.words("both.h5", "--together", "azimuth_of", "--im", "pga", "--samples", "1")
        self.assertIn("10 motions,  2 objects in 3 rows together", words)
        self.assertIn("2 objects in 3 rows together;", text)
        self.refuses(2, "--polar draws the azimuths of one object, but this result has 2 objects in 3 rows", "both.h5",
                     "--polar", "azimuth_from_x")

    def test_replaces_its_own_table_and_no_other(self):
        self.output_of("result.h5", "--im", "pga", "--csv", "own.csv", "-o", "picture.png")
        own = (self.folder / "own.csv").read_text()
        header = next(line for line in own.splitlines() if not line.startswith("#"))
        self.output_of("result.h5", "--im", "pga", "--csv", "own.csv", "-o", "picture.png")
        others = [own.replace("\n", ",note\n"), "# notes of the visit\n" + own, f"# notes: {header}\nx,y\n1,2\n",
                  header + "\n1,2,3,4,5,6,7,8,9\n", own.rstrip("\n").rpartition("\n")[0] + "\nsee p. 7\n",
                  own.replace("pga_from", "pgv_from")]
        for other in others:
            (self.folder / "other.csv").write_text(other)
            run = self.run_tool("result.h5", "--im", "pga", "--csv", "other.csv", "-o", "picture.png")
            self.assertEqual(run.returncode, 74, other)
            self.assertIn("it exists and is not a table of a fragility curve", run.stderr)
            self.assertEqual((self.folder / "other.csv").read_text(), other)

    def test_ends_without_a_message_if_its_reader_stops_early(self):
        command = [TOOLS / "plot_fragility", "result.h5", "-o", "early.png"]
        with subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as tool:
            tool.stdout.close()
            self.assertEqual(tool.stderr.read(), b"")
        self.assertEqual(tool.returncode, 128 + signal.SIGPIPE)

    def test_has_a_name_of_its_own(self):
        self.assertEqual(fragility_curves.read_arguments(["result.h5"]).output, "result_fragility.png")

    def test_of_peaks_above_a_level_counts_more_points(self):
        overturning, _ = self.words("result.h5")
        rocking, words = self.words("result.h5", "--of", "peak", "--above", "0.3")
        self.assertIn("fraction with a peak", words)
        counts = [int(re.search(r": (\d+) of 600 points", text)[1]) for text in (overturning, rocking)]
        self.assertLess(*counts)

    def test_of_a_friction_coefficient_leaves_out_what_may_slip(self):
        self.overturn("run", "friction.h5", 'output.fields=["region", "friction_demand"]')
        with h5py.File(self.folder / "friction.h5") as file:
            supported = np.count_nonzero(file["friction_demand"][:] <= 0.3)
        self.assertTrue(0 < supported < 600)
        text, words = self.words("friction.h5", "--friction-demand", "0.3")
        self.assertIn(f"of {supported} points with a verdict", text)
        self.assertIn("need a friction coefficient above 0.3", words)
        text, words = self.words("friction.h5", "--friction-demand", "1e-6")
        self.assertIn("left out: 600 of 600 points", text)
        self.assertIn("no fit: no point has a verdict", words)

    def test_without_a_fit_says_why_and_draws_no_curve(self):
        self.overturn("run", "safe.h5", "plane.scale={first=0.001, last=0.002, count=2}")
        text, words = self.words("safe.h5")
        self.assertIn("no fit: no point overturns", text)
        self.assertIn("no fit: no point overturns", words)
        self.assertNotIn("lognormal", words)
        self.assertNotIn("confidence of the curve", words)

    def test_of_an_unfinished_file_reports_what_is_not_computed(self):
        self.unfinished("part.h5")
        text, words = self.words("part.h5")
        self.assertIn("of 540 points with a verdict, 9 motions, 12 blocks pooled; 0 undecided, 60 not computed", text)
        self.assertIn("the result is unfinished: 60 of 600 points are not computed", text)
        self.assertIn("the result is unfinished: 60 of 600 points are not computed", words)
        self.assertIn("with points without a verdict", words)


class TestACurveRefused(Curve):
    def refuses(self, code, sentence, *arguments):
        super().refuses(code, sentence, *arguments, "-o", "refused.png")
        self.assertFalse((self.folder / "refused.png").exists())

    def test_of_what_is_not_a_result_under_records(self):
        self.refuses(74, "cannot read", "missing.h5")
        pulse = 'scene.pulse="one_sine"\n[plane]\nfrequency.values=[1, 2]\namplitude.values=[1, 2]\n' \
            "slenderness=0.2\nrestitution.values=[0.8]\n"
        self.overturn("run", "pulse.h5", job=pulse)
        self.refuses(2, "a result under records", "pulse.h5")

    def test_of_a_measure_or_a_field_that_is_not_there(self):
        self.refuses(2, "'mass' is not an intensity measure", "result.h5", "--im", "mass")
        self.refuses(2, "'motion' is not an intensity measure", "result.h5", "--im", "motion")
        self.refuses(2, "'pgv' is not a property of the blocks", "result.h5", "--by", "pgv")
        self.refuses(2, "'mass' is not a property of the blocks", "result.h5", "--polar", "mass")
        self.refuses(2, "--plane needs two measures", "result.h5", "--plane", "--im", "pga")
        self.refuses(2, "draw it without --plane and --by", "result.h5", "--plane", "--polar")
        self.refuses(2, "--polar needs one measure", "result.h5", "--polar", "--im", "pga", "pgv")
        self.overturn("run", "region.h5", 'output.fields=["region"]')
        self.refuses(2, "has no field peak", "region.h5", "--of", "peak", "--above", "1")
        self.refuses(2, "no field slide_peak of numbers to be above 0.1. Add it to output.fields. Those that it has: "
                     "peak.", "result.h5", "--of", "slide_peak", "--above", "0.1")
        self.refuses(2, "--limit is called --of peak --above now", "result.h5", "--limit", "0.3")
        self.refuses(2, "has no field friction_demand", "region.h5", "--friction-demand", "0.5")
        self.refuses(2, "friction_demand = 35.0 is not a number above 0", "region.h5", "--friction-demand", "35")


class TestATableOfToCsv(Curve):
    OPTIONS = ("--of", "peak", "--above", "0.4", "--bins", "7", "--samples", "30", "--seed", "4")

    def tables(self, *command, tool):
        """Returns the names and the contents of the tables that a command writes."""
        before = {*self.folder.iterdir()}
        self.output_of("result.h5", *command, *self.OPTIONS, tool=tool)
        new = {path.name: path.read_text() for path in {*self.folder.iterdir()} - before if path.suffix == ".csv"}
        for name in new:
            (self.folder / name).unlink()
        return new

    def test_is_that_of_plot_fragility_with_the_same_options(self):
        for measures, by, count in ((["pga"], (), 1), (["pga", "pgv"], (), 2), (["pgv"], ("--by", "slenderness"), 3)):
            tables = self.tables("--fragility", *measures, *by, "-o", "t.csv", tool="to_csv")
            self.assertEqual(len(tables), count)
            self.assertEqual(tables, self.tables("--im", *measures, *by, "--csv", "t.csv", tool="plot_fragility"))
            for table in tables.values():
                self.assertRegex(table, r"# peak above 0.4 against pg[av] \[(g|m s-1)\]")
                self.assertEqual(sum(not line.startswith("#") for line in table.splitlines()), 1 + 7)

    def test_has_the_name_of_the_result_and_no_undecided_point_among_the_safe(self):
        undecided, samples = 254, ("--samples", "2")
        shutil.copy(self.folder / "result.h5", self.folder / "holes.h5")
        with h5py.File(self.folder / "holes.h5", "r+") as file:
            file["region"][0] = undecided
            points = file["region"].size
            left = points - file["region"][0].size
        self.output_of("holes.h5", "--fragility", "pga", *samples, tool="to_csv")
        table = (self.folder / "holes.csv").read_text()
        self.assertRegex(table, f" of {left} points with a verdict.*; {points - left} undecided")
        rows = list(csv.DictReader(line for line in table.splitlines() if not line.startswith("#")))
        self.assertEqual(sum(int(row["points"]) for row in rows), left)
        self.assertGreater(sum(int(row["without_verdict"]) for row in rows), 0)

    def test_is_refused_for_a_choice_of_points_and_for_results_without_records(self):
        for words, name in ((("--slenderness", "0"), "slenderness"), (("--index", "size=0"), "index"),
                            (("--units", "job"), "units"), (("--events",), "events")):
            self.refuses(2, f"--{name} is not for fragility curves", "result.h5", *words, "--fragility", "pga", tool="to_csv")
        for words in (("--together", "size"), ("--bins", "3"), ("--by", "size"), ("--friction-demand", "0.4"),
                      ("--above", "0.4")):
            self.refuses(2, f"{words[0]} is for --fragility MEASURE only", "result.h5", *words, tool="to_csv")
        self.overturn("run", "pulse.h5", job='scene.pulse="one_sine"\n[plane]\nfrequency=3\namplitude=2\nslenderness=0.2\n'
                                             "restitution=0.8\n")
        self.refuses(2, "this result has no scale of a record", "pulse.h5", "--fragility", "pga", tool="to_csv")


if __name__ == "__main__":
    unittest.main()
