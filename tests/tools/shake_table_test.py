"""tools/examples/shake_table.py, with simulated tests of known blocks.

Requires OVERTURN (the binary) in the environment. `shake_table_test.py TestTheCalibrationHalf` fits real tests in
$OVERTURN_RECORDS/shake_table, in two minutes.
"""

import json
import os
import pathlib
import sys
import unittest
import unittest.mock

import h5py
import numpy as np
from tool import InOneFolder, module_of  # first: adds the package to the path
import overturn

example = module_of("examples/shake_table.py")

DATA = pathlib.Path(os.environ.get("OVERTURN_RECORDS", ""), "shake_table/calibration_half.h5")
TIME_STEP = 0.01  # [s]
ROCKS = {"a": {"slenderness": 0.12, "restitution": 0.8, "scatter": 0.2},
         "b": {"slenderness": 0.2, "restitution": 0.7, "scatter": 0.15}}


def simulated(count, seed):
    """Returns records and the flags of two rocks, which are rocking blocks of lognormal slenderness."""
    random, records, flags = np.random.default_rng(seed), [], {name: [] for name in ROCKS}
    time = np.arange(0, 4, TIME_STEP)
    for _ in range(count):
        noise = np.convolve(random.standard_normal(len(time)), np.hanning(random.integers(5, 30)), "same")
        record = noise * np.sin(np.pi * time / time[-1])
        records.append(record / abs(record).max() * random.lognormal(np.log(0.7), 0.7))
        for name, rock in ROCKS.items():
            verdict = overturn.evaluate(
                slenderness=rock["slenderness"] * np.exp(rock["scatter"] * random.standard_normal()), scale=1.0,
                frequency_parameter=4.5, restitution=rock["restitution"], record=records[-1], time_step=TIME_STEP)
            flags[name].append(int(verdict["verdict"] == overturn.Verdict.OVERTURNS))
    return records, flags


def write(path, records, flags, names=True):
    """Writes the layout; without the names of the records if these are not given."""
    lengths = [len(record) for record in records]
    with h5py.File(path, "w") as file:
        file["acceleration"] = np.concatenate(records).astype(np.float32)
        file["acceleration"].attrs.update({"dt": TIME_STEP, "units": "g"})
        file["tests/start"], file["tests/length"] = np.cumsum([0, *lengths[:-1]]), lengths
        for name, values in flags.items():
            file[f"tests/toppled_{name}"] = np.array(values, np.int8)
        if names:
            file["tests/record"] = [f"record {i // 3}" for i in range(len(records))]


class Simulated(InOneFolder):
    TOOL = "examples/shake_table.py"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.tests = simulated(40, seed=1)
        write(cls.folder / "tests.h5", *cls.tests)

    def result(self, *arguments):
        return json.loads(self.output_of(*arguments))

    def raises(self, sentence, function, *arguments):
        with self.assertRaisesRegex(example.TestsError, sentence):
            function(*arguments)


class TestAFit(Simulated):
    def test_finds_the_block_that_was_simulated(self):
        records, flags = self.tests
        write(self.folder / "one.h5", records, {"a": flags["a"]})
        found = self.result("fit", "one.h5", "--folds", "2", "--plot", "reliability.png")
        self.assertTrue((self.folder / "reliability.png").exists())
        # A flag tells on which side of the slenderness it lies, with a scatter of 0.2: 40 flags, of which a
        # third lie within the scatter, give ln(slenderness) within 0.2 sqrt(2 pi / 4 / 13) = 0.07. A wrong
        # restitution moves it by a few percent more; three times this.
        self.assertAlmostEqual(np.log(found["a"]["slenderness"] / ROCKS["a"]["slenderness"]), 0, delta=0.25)
        self.assertGreater(found["a"]["accuracy"], 0.8)
        self.assertEqual(found["a"]["tests"], 40)
        with open(self.folder / "model.json") as file:
            self.assertEqual(json.load(file)["rocks"], found)

    def test_refuses_what_it_cannot_use(self):
        write(self.folder / "nameless.h5", *self.tests, names=False)
        self.raises("a fit needs tests/record", example.fit, self.folder / "nameless.h5", 5, 1)
        write(self.folder / "few.h5", [record[:50] for record in self.tests[0][:6]], {"a": [1] * 6})
        self.raises("2 records cannot be divided into 5 folds", example.fit, self.folder / "few.h5", 5, 1)
        self.raises("others must not, in each fold", example.fit, self.folder / "few.h5", 2, 1)


class TestAPrediction(Simulated):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rocks = {name: {**rock, "logistic": [0.0, 1.0, 1.0]} for name, rock in ROCKS.items()}
        (cls.folder / "model.json").write_text(json.dumps(
            {"frequency_parameter": 4.5, "restitution_range": 0.12, "rocks": rocks}))

    def test_of_the_blocks_that_were_simulated_is_right_and_calibrated(self):
        scores = self.result("predict", "model.json", "tests.h5", "--csv", "probability.csv")
        table = np.genfromtxt(self.folder / "probability.csv", delimiter=",", names=True)
        for name in ROCKS:
            toppled, probability = np.array(self.tests[1][name]), table[name]
            self.assertAlmostEqual(scores[name]["accuracy"], np.mean((probability > 0.5) == toppled), delta=0.02)
            self.assertAlmostEqual(scores[name]["brier"], np.mean((probability - toppled) ** 2), delta=1e-4)
            # Flags are drawn with these probabilities: three standard deviations of the mean difference.
            deviation = np.sqrt(np.mean(probability * (1 - probability)) / len(toppled))
            self.assertLess(abs(np.mean(probability - toppled)), 3 * deviation + 0.02)  # 0.02: the range of r

    def test_depends_neither_on_the_order_of_tests_and_rocks_nor_on_optional_data(self):
        whole = self.result("predict", "model.json", "tests.h5")
        records, flags = self.tests
        write(self.folder / "turned.h5", records[::-1], {name: flags[name][::-1] for name in ("b", "a")}, names=False)
        turned = self.result("predict", "model.json", "turned.h5")
        for name in ROCKS:
            self.assertEqual(turned[name]["confusion"], whole[name]["confusion"])
            self.assertAlmostEqual(turned[name]["brier"], whole[name]["brier"], delta=1e-12)

    def test_leaves_out_unknown_flags_and_rocks(self):
        records, flags = self.tests
        write(self.folder / "part.h5", records[:9], {"a": [-1, *flags["a"][1:9]]})
        scores = self.result("predict", "model.json", "part.h5", "--plot", "reliability.png")
        self.assertEqual((scores["a"]["tests"], scores["a"]["left_out"]), (8, 1))
        self.assertEqual((scores["b"]["accuracy"], scores["b"]["tests"]), (None, 0))

    def test_refuses_another_layout(self):
        with h5py.File(self.folder / "empty.h5", "w") as file:
            file["motion"] = [0.0]
        self.refuses(1, "shake_table: \"empty.h5\": there is no dataset acceleration. --help describes the layout.\n",
                     "predict", "model.json", "empty.h5")
        self.raises("cannot read \".*missing.h5\"", example.Tests, self.folder / "missing.h5")
        (self.folder / "other.json").write_text("{}")
        self.raises("is not a model", example.read_model, self.folder / "other.json")
        for place, change in (("tests/start", lambda file: file["tests/start"].__setitem__(0, 10**6)),
                              ("dt", lambda file: file["acceleration"].attrs.__delitem__("dt")),
                              ("is in m/s2", lambda file: file["acceleration"].attrs.__setitem__("units", "m/s2")),
                              ("are not finite", lambda file: file["acceleration"].__setitem__(5, np.nan)),
                              ("not one flag", lambda file: file.__setitem__("tests/toppled_c", [1]))):
            write(self.folder / "wrong.h5", *self.tests)
            with h5py.File(self.folder / "wrong.h5", "a") as file:
                change(file)
            self.raises(place, example.Tests, self.folder / "wrong.h5")


class TestBlocksThatSlip(Simulated):
    NODES = {"SLENDERNESS": np.geomspace(0.06, 0.5, 12), "RESTITUTION": np.linspace(0.5, 0.98, 4), "FRICTION": (0.05, 0.15)}

    def setUp(self):
        for name, values in self.NODES.items():
            patch = unittest.mock.patch.object(example, name, values)
            patch.start()
            self.addCleanup(patch.stop)

    def test_have_the_verdicts_of_each_coefficient_alone(self):
        alpha, r = np.meshgrid(self.NODES["SLENDERNESS"], self.NODES["RESTITUTION"], indexing="ij")
        at_most = (1 - 1.5 * np.sin(alpha) ** 2) ** 2
        self.assertTrue((r > at_most).any())
        differ = 0
        for record in self.tests[0][:6]:
            known = example.verdicts_under(record, TIME_STEP, alpha, r, [None, 0.05, 0.15, 0.4])
            for friction, verdict in known.items():
                alone = overturn.evaluate(
                    slenderness=alpha, restitution=r if friction is None else np.minimum(r, at_most), friction=friction,
                    frequency_parameter=4.5, record=record, time_step=TIME_STEP, scale=1.0)["verdict"]
                np.testing.assert_array_equal(verdict, alone)
            differ += (known[0.05] != known[0.4]).sum() * (known[0.15] != known[0.4]).sum()
        self.assertGreater(differ, 0)

    def test_are_fitted_and_predicted_beside_those_that_do_not(self):
        records, flags = self.tests[0], self.tests[1]["a"]
        write(self.folder / "slip.h5", records, {"a": flags})
        with unittest.mock.patch.object(example, "fit_block", return_value=(ROCKS["a"], -0.3)):
            model, _ = example.fit(self.folder / "slip.h5", 2, 1, [0.05, example.FIT])
        rocks = model["rocks"]
        self.assertEqual({name: rock["friction"] for name, rock in rocks.items()},
                         {"a": None, "a_friction_0.05": 0.05, "a_friction_fit": 0.15})  # equally likely: the largest
        # With a coefficient of 0.05, below tan(0.06), no block lifts.
        never = np.mean(np.log(np.where(flags, 0.01, 0.99)))
        self.assertAlmostEqual(rocks["a_friction_0.05"]["log_score"], never, places=12)
        self.assertGreater(rocks["a"]["log_score"], never)
        scores, predictions = example.predict(model, self.folder / "slip.h5")
        for name, rock in rocks.items():
            # Predictions leave out slendernesses of a weight below 1e-5; other verdicts would change it by 0.1.
            self.assertAlmostEqual(scores[name]["log_score"], rock["log_score"], delta=1e-4)
        self.assertEqual(predictions["a_friction_0.05"][0].max(), 0)

    def test_have_the_most_likely_coefficient(self):
        verdicts = {each: unittest.mock.Mock(of=lambda _, each=each: each) for each in (None, *self.NODES["FRICTION"])}
        likelihood = {None: -0.1, 0.05: -0.3, 0.15: -0.32}
        with unittest.mock.patch.object(example, "fit_block", side_effect=lambda each, *_: ({}, likelihood[each])):
            found = example.fitted(verdicts, np.zeros((4, 2)), np.array([0, 1, 0, 1.0]), np.ones(4, bool),
                                   {example.FIT: self.NODES["FRICTION"]}, 1)
        self.assertEqual(found[example.FIT]["friction"], 0.05)

    def test_need_a_coefficient_of_friction(self):
        for word in ("0", "-1", "nan", "35", "much"):
            self.refuses(2, "argument --friction: ", "fit", "tests.h5", "--friction", word)


class TestTheScores(unittest.TestCase):
    def test_of_known_probabilities(self):
        scores = example.scores(np.array([0.9, 0.2, 0.6, 0.1, np.nan]), np.array([1, 0, 0, np.nan, 1]), bins=2)
        self.assertAlmostEqual(scores["brier"], (0.01 + 0.04 + 0.36) / 3)
        self.assertAlmostEqual(scores["accuracy"], 2 / 3)
        # Flags are wrong with a probability of 0.01.
        self.assertAlmostEqual(scores["log_score"], np.log([0.01 + 0.98 * p for p in (0.9, 0.8, 0.4)]).mean())
        self.assertEqual((scores["tests"], scores["left_out"]), (3, 2))
        self.assertEqual(scores["confusion"], {"toppled_and_predicted": 1, "toppled_not_predicted": 0,
                                               "predicted_not_toppled": 1, "neither": 1})
        self.assertEqual([each["tests"] for each in scores["reliability"]], [1, 2])
        self.assertAlmostEqual(scores["reliability"][1]["toppled"], 0.5)

    def test_in_cross_validation_never_use_a_record_of_the_fit(self):
        names = [f"record {i % 11}" for i in range(60)]
        fold = example.folds_of(names, 5, seed=1)
        self.assertEqual(set(fold), set(range(5)))
        self.assertEqual(len({(name, k) for name, k in zip(names, fold)}), 11)

    def test_of_the_baseline_are_those_of_a_logistic_curve(self):
        random = np.random.default_rng(1)
        measures = random.standard_normal((20000, 2))
        toppled = random.random(20000) < example.logistic([0.5, 2.0, -1.0], measures)
        # 20,000 flags give the coefficients within about 0.03.
        np.testing.assert_allclose(example.fit_logistic(measures, toppled), [0.5, 2.0, -1.0], atol=0.1)


@unittest.skipUnless("TestTheCalibrationHalf" in sys.argv, "takes two minutes")
class TestTheCalibrationHalf(Simulated):
    def test_is_predicted_in_cross_validation(self):
        if not DATA.exists():
            self.skipTest(f"no file {DATA}")
        done = self.run_tool("fit", DATA, timeout=600)
        for name, rock in json.loads(done.stdout).items():
            with self.subTest(name):
                self.assertGreaterEqual(rock["accuracy"], 0.87)
                self.assertLessEqual(rock["brier"], 0.09)
                self.assertGreater(rock["accuracy"], rock["logistic_regression"]["accuracy"])
                self.assertLess(rock["brier"], rock["logistic_regression"]["brier"])


if __name__ == "__main__":
    unittest.main()
