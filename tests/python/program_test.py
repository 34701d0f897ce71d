"""overturn.run(), check() and open(). Requires OVERTURN (the binary) and MPIEXEC in the environment and the
package on PYTHONPATH."""

import os
import pathlib
import shutil
import tempfile
import unittest

import h5py
import numpy as np
import overturn

JOBS = pathlib.Path(__file__).resolve().parents[2] / "jobs"
JOB = {"title": 'Both "quotes" and \\ and ä', "scene": {"pulse": "one_sine"},
       "plane": {"frequency": {"first": 0.5, "last": 8, "count": 70}, "amplitude": {"values": np.linspace(1, 9, 80)},
                 "restitution": 0.9, "slenderness": {"values": (0.1, 0.2)}},
       "numerics": {"resolve": False}, "output": {"fields": ["region", "margin"]}}
TEXT = """[scene]
pulse = "half_sine"
[plane]
frequency = 3
amplitude = { first = 1, last = 9, count = 5 }
restitution = 0.9
slenderness = 0.2
"""


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="overturn-test-")
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def assert_fails(self, exit_code, phrase, call, *arguments, **options):
        with self.assertRaises(overturn.ProgramError) as raised:
            call(*arguments, **options)
        self.assertIn(phrase, str(raised.exception))
        self.assertEqual(raised.exception.exit_code, exit_code)


class AJob(InAFolder):
    def test_as_a_dictionary_is_the_same_as_its_file(self):
        spectrum = overturn.run(JOB)
        self.assertEqual(spectrum.title, JOB["title"])
        self.assertEqual(spectrum.region.shape, (2, 80, 70))
        np.testing.assert_array_equal(spectrum.amplitude, np.linspace(1, 9, 80))
        self.assertEqual(os.listdir(), [])  # neither a job nor a result remains

    def test_as_a_text_or_a_path(self):
        by_text = overturn.run(TEXT)
        pathlib.Path("job.toml").write_text(TEXT)
        by_path = overturn.run("job.toml")
        self.assertEqual(by_text.region.values.tobytes(), by_path.region.values.tobytes())
        self.assertIn("points       5 in 1 tile", overturn.check(TEXT))
        self.assertEqual(overturn.check(TEXT).split("space ")[0],  # what follows, free space and time, varies
                         overturn.check(pathlib.Path("job.toml")).split("space ")[0])

    def test_on_two_ranks_into_a_file(self):
        one = overturn.run(JOB, output="one.h5")
        two = overturn.run(JOB, ranks=2, output="two.h5")
        np.testing.assert_array_equal(one.margin, two.margin)
        self.assertEqual(sorted(os.listdir()), ["one.h5", "one.h5.json", "two.h5", "two.h5.json"])

    def test_with_overrides(self):
        spectrum = overturn.run(JOB, overrides={"scene.pulse": "triangular", "plane.slenderness": 0.3,
                                                "plane.amplitude": {"values": [2.0, 3.0]}})
        self.assertEqual((spectrum.pulse, spectrum.sizes["amplitude"]), ("triangular", 2))

    def test_in_other_units_is_warned_of(self):
        with self.assertWarnsRegex(UserWarning, "^the period of the pulse = 231.6 s") as caught:
            overturn.run(JOB, overrides={"plane.size": 1, "plane.frequency": 0.01})
        self.assertEqual((len(caught.warnings), caught.filename), (1, __file__))

    def test_finds_records_in_the_working_folder(self):
        shutil.copy(JOBS / "synthetic.AT2", "here.AT2")
        text = overturn.check({"scene": {"record": "here.AT2"},
                               "plane": {"scale": 1, "size": 1, "slenderness": 0.2, "restitution": 0.9}})
        self.assertIn("here.AT2", text)


class AnAnswer(InAFolder):
    LEANING = {"width": 0.5, "height": np.float64(2), "incline": 0.0698, "period": 0.5, "pga_max": 1.2}

    def test_has_both_directions_of_a_leaning_block_and_the_worse_verdict(self):
        answer = overturn.topple(**self.LEANING, pga=0.5, history="worse.h5")
        self.assertEqual(answer["verdict"], "topples at 0.5 g in direction 0, worse than 180")
        self.assertEqual([each["topples"] for each in answer["by_direction"]], [True, False])
        one = overturn.topple(**self.LEANING, pga=0.5, direction=180)
        self.assertEqual(one["toppling_pga"], answer["by_direction"][1]["toppling_pga"])
        with overturn.open("worse.h5") as history:
            self.assertGreater(float(abs(history.angle).max()), 1.5)

    def test_without_a_search_is_the_verdict(self):
        answer = overturn.topple(width=0.6, height=1.8, period=0.5, pga=0.9, search=False)
        self.assertEqual((answer["verdict"], answer["toppling_pga"]), ("does not topple at 0.9 g", None))

    def test_has_the_values_of_a_quantity_at_which_the_block_topples(self):
        answer = overturn.topple(height=1.8, period=0.5, pga=0.95, vary=("width", np.float64(0.3), 1.2))
        self.assertAlmostEqual(answer["safe_from"], 0.61404, places=4)
        self.assertEqual(answer["topples"], [[0.3, answer["safe_from"]]])
        self.assert_fails(2, 'Did you mean "width"?', overturn.topple, height=1.8, period=0.5, pga=0.9, vary=("widht", 0.3, 1))

    def test_under_a_record_and_other_gravity(self):
        answer = overturn.topple(width=0.6, height=1.8, record=JOBS / "synthetic.AT2", scale=1, pga_max=0.5,
                                 overrides={"scene.gravity": 1.62})
        self.assertEqual((answer["gravity"], answer["motion"]["record"]), (1.62, str(JOBS / "synthetic.AT2")))

    def test_that_cannot_be_given_raises_the_message_of_the_program(self):
        self.assert_fails(65, "0.42 m x 1.55 m?", overturn.topple, width=42, height=155, period=0.5)
        self.assert_fails(2, "--depth", overturn.topple, width=1, height=2, depth=3, period=0.5)
        with self.assertRaisesRegex(TypeError, "overturn.evaluate"):
            overturn.topple(width=1, height=2, record=np.zeros(9), scale=1)

    def test_warns_of_other_units(self):
        with self.assertWarnsRegex(UserWarning, "the period of the pulse = 600 s") as caught:
            overturn.topple(width=0.6, height=1.8, period=600, pga_max=0.3)
        self.assertEqual(caught.filename, __file__)


class ARunThatFails(InAFolder):
    def test_raises_the_message_and_the_exit_code(self):
        wrong = {**JOB, "plane": {**JOB["plane"], "restitution": 1.2}}
        for call in (overturn.check, overturn.run):
            self.assert_fails(65, "plane.restitution = 1.2 is outside (0, 1]", call, wrong)
        self.assert_fails(65, "plane.restitution = 1.2 is outside (0, 1]", overturn.run, wrong, ranks=2)
        self.assert_fails(65, 'job:1:1: unknown key "a"', overturn.check, "a = 1\nb = 2\n")
        self.assert_fails(65, "missing.toml: cannot be read", overturn.check, "missing.toml")
        pathlib.Path("other.h5").write_text("not a result")
        self.assert_fails(74, "other.h5", overturn.run, JOB, output="other.h5")

    def test_refuses_values_that_no_job_has(self):
        with self.assertRaisesRegex(TypeError, "scene.pulse = None cannot be part of a job"):
            overturn.check({"scene": {"pulse": None}})


    def test_refuses_arrays_where_a_job_names_files(self):
        draw = np.random.default_rng(1)
        plane = {"scale": 1, "size": 1, "slenderness": 0.2, "restitution": 0.9}
        record = overturn.read_record(JOBS / "synthetic.AT2")
        samples = draw.uniform(-1, 1, draw.integers(2, 2000))
        for key in ("record", "vertical"):
            for value in (samples, list(samples), tuple(samples[:2]), samples.astype("f4"), record, samples[:, None]):
                job = {"scene": {"record": "here.AT2", key: value}, "plane": plane}
                with self.assertRaisesRegex(TypeError, rf"scene.{key} is .*, but a job names files: give .*"
                                            rf"overturn.evaluate\({key}=\.\.\..* takes accelerations"):
                    overturn.run(job)
                with self.assertRaisesRegex(TypeError, f"scene.{key} is .*, but a job names files"):
                    overturn.check(JOBS / "synthetic.toml", overrides={f"scene.{key}": value})
        with self.assertRaisesRegex(TypeError, "blocks.table is ndarray of the shape .*, but a job names files"):
            overturn.check({"scene": {"pulse": "one_sine"}, "blocks": {"table": samples}, "plane": {}})


class AResultFile(InAFolder):
    def test_has_only_coordinates_and_fields(self):
        overturn.run(JOB, output="spectrum.h5").close()
        with overturn.open("spectrum.h5") as spectrum:
            self.assertEqual(set(spectrum.data_vars), {"region", "margin"})
            self.assertEqual(set(spectrum.coords), {"slenderness", "restitution", "amplitude", "frequency", "pga"})
            self.assertEqual(spectrum.region.dtype, np.uint8)
            self.assertFalse(spectrum.margin.variable._in_memory)

    def test_of_a_record_names_its_motions(self):
        suite = overturn.run(JOBS / "synthetic.toml", overrides={"plane.scale": 1, "plane.size": 1})
        self.assertEqual(suite.motion_name.item(), "synthetic.AT2")
        self.assertIn("motion_name", suite.coords)

    def test_of_two_components_has_a_fragility_over_the_measures_of_each_direction(self):
        one = {"plane.size": 1, "plane.slenderness": 0.25}
        alone = overturn.run(JOBS / "synthetic.toml", overrides=one)
        turned = overturn.run(JOBS / "synthetic.toml", overrides={
            **one, "scene.second_component": "synthetic_vertical.AT2", "plane.direction": {"values": [0, 30, 90]}})
        for measure, power in (("pga", 1), ("pgv", 1), ("arias_intensity", 2), ("pga_rotd50", 1), ("pgv_rotd100", 1)):
            values = (turned["record_pga" if measure == "pga" else measure] * turned.scale**power).values
            curve = overturn.fragility(turned, measure, bins=1, samples=1)
            np.testing.assert_allclose(curve.edges, [values.min(), values.max()])
            self.assertEqual((curve.im, curve.units), (measure, "g" if measure.startswith("pga") else "m s-1"))
        for measure in ("pga", "pgv", "arias_intensity"):
            self.assertEqual(overturn.fragility(turned.isel(direction=0), measure, samples=1).median,
                             overturn.fragility(alone, measure, samples=1).median)
        ratio = overturn.risk.binned_marginal(turned, "pgv/pga", "pga", lambda y, x: np.zeros_like(y * x), samples=0)
        self.assertAlmostEqual(ratio.data[1], float((turned.pgv / turned.record_pga).max()))

    def test_of_two_components_by_an_earlier_version_has_no_fragility_over_those_of_the_first_one(self):
        alone = overturn.run(JOBS / "synthetic.toml", overrides={"plane.size": 1, "plane.slenderness": 0.25})
        alone["pgv"].attrs["comment"] = "of the first horizontal component"
        with self.assertRaisesRegex(ValueError, "first of two horizontal components, .* compute the result again"):
            overturn.fragility(alone, "pgv")

    def test_that_is_unfinished_has_no_values_of_unmarked_tiles(self):
        with overturn.run(JOB, output="spectrum.h5") as spectrum:
            whole = spectrum.load()
        with h5py.File("spectrum.h5", "r+") as file:
            self.assertEqual(len(file["run/checksum"]), 2 * 4)  # tiles of 64 x 64 points
            file["run/checksum"][6] = 0  # the second slenderness, rows from 64 on, columns up to 64
        with self.assertWarnsRegex(UserWarning, "unfinished: 7 of 8 tiles computed. The other points have the region 255"):
            part = overturn.open("spectrum.h5")
        self.assertTrue((part.region[1, 64:, :64] == 255).all())
        self.assertTrue(np.isnan(part.margin[1, 64:, :64]).all())
        part.region[1, 64:, :64] = whole.region[1, 64:, :64]
        np.testing.assert_array_equal(part.region, whole.region)
        self.assertEqual(part.region.dtype, np.uint8)

    def test_that_is_an_unfinished_list_has_no_values_of_unmarked_tiles(self):
        overturn.run(JOBS / "statues.toml", output="list.h5").close()  # with a column named kind
        with h5py.File("list.h5", "r+") as file:
            shape, tile = file["region"].shape, file["run/checksum"].attrs["tile_shape"]
            file["run/checksum"][7] = 0
        place = [along // side for along, side in zip(np.indices(shape), tile)]
        number = np.ravel_multi_index(place, [-(-extent // side) for extent, side in zip(shape, tile)])
        with self.assertWarnsRegex(UserWarning, "unfinished"), overturn.open("list.h5") as part:
            self.assertEqual(part.coords["kind"].dims, ("block",))
            np.testing.assert_array_equal(part.region == 255, number == 7)
            np.testing.assert_array_equal(np.isnan(part.peak), number == 7)

    def test_of_another_program_is_refused(self):
        with h5py.File("other.h5", "w") as file:
            file["x"] = [1.0]
        with self.assertRaisesRegex(ValueError, "is not a result of overturn"):
            overturn.open("other.h5")
        with self.assertRaises(OSError):
            overturn.open("missing.h5")


class AList(InAFolder):
    def test_of_objects_as_a_path_or_as_columns(self):
        columns = {"name": ["vase", "cabinet, low"], "width": np.array([0.18, 0.9]), "height": (0.45, 1.0)}
        pathlib.Path("objects.csv").write_text('name,width,height\nvase,0.18,0.45\n"cabinet, low",0.9,1.0\n')
        expected = overturn.assess("objects.csv", period=[0.3, 0.5], pga=0.5, fine=True)
        answer = overturn.assess(columns, period=(0.3, 0.5), pga=np.float64(0.5), fine=True)
        self.assertEqual([row["name"] for row in answer["objects"]], ["vase", "cabinet, low"])
        self.assertEqual({**answer, "table": ""}, {**expected, "table": ""})
        self.assertEqual([row["cases"] for row in answer["objects"]], [2, 2])
        self.assertEqual(sorted(os.listdir()), ["objects.csv"])

    def test_under_records(self):
        records = [JOBS / "synthetic.AT2"]
        row = overturn.assess({"width": [0.5], "height": [1.6]}, record=records, scale=1)["objects"][0]
        self.assertEqual(row["topples_from"],
                         overturn.assess({"width": [0.5], "height": [1.6]}, record=str(JOBS / "synthetic.*2"))[
                             "objects"][0]["topples_from"])

    def test_that_is_refused(self):
        self.assert_fails(65, "width", overturn.assess, {"width": [-1], "height": [1]}, period=0.5)
        self.assert_fails(2, "the ground motion is missing", overturn.assess, {"width": [1], "height": [1]})
        with self.assertRaises(ValueError):
            overturn.assess({"width": [1, 2], "height": [1]}, period=0.5)


if __name__ == "__main__":
    unittest.main()
