"""overturn.evaluate() compared with `overturn run`, and its arrays. Requires OVERTURN (the binary) in the
environment and the package on PYTHONPATH."""

import concurrent.futures
import pathlib
import signal
import time
import unittest
import warnings

import numpy as np
import overturn
from overturn import core

JOBS = pathlib.Path(__file__).resolve().parents[2] / "jobs"
FIELDS = ["region", "status", "peak", "margin"]
BLOCK = {"width": 0.6, "height": 2.4, "restitution": 0.87}
PULSE = {"pulse_period": 0.9, "pga": 0.4}


def random_blocks(count, seed=1):
    random = np.random.default_rng(seed)
    return {"width": random.uniform(0.2, 1, count), "height": random.uniform(1, 4, count),
            "restitution_of_maximum": random.uniform(0.7, 1, count),
            "pulse_period": random.uniform(0.2, 2, count), "pga": random.uniform(0.05, 1.2, count)}


class WithTheSameBits(unittest.TestCase):
    def assert_same(self, outcome, spectrum, kinds=2, fields=FIELDS):
        """Compares all fields bit by bit; a comparison of one region only would show little."""
        for field in fields:
            stored = spectrum[field].values
            self.assertEqual(outcome[field].reshape(stored.shape).tobytes(), stored.tobytes(), field)
        self.assertGreaterEqual(len(np.unique(outcome["region"])), kinds)


class BlocksWithTwoSides(WithTheSameBits):
    LEANING = {"width": 0.5, "height": 2.0, "incline": 4 * np.pi / 180}

    def test_have_the_bits_of_a_plane(self):
        for direction in (0, 180):
            spectrum = overturn.run({
                "scene": {"pulse": "one_sine"}, "block": self.LEANING, "numerics": {"method": "taylor"},
                "output": {"fields": FIELDS},
                "plane": {"pulse_period": {"first": 0.3, "last": 2, "count": 12}, "direction": direction,
                          "pga": {"first": 0.1, "last": 2, "count": 11}, "restitution_of_maximum": 1}})
            outcome = overturn.evaluate(
                **self.LEANING, direction=direction, restitution_of_maximum=1, pulse="one_sine",
                pga=spectrum.pga.values[:, None], pulse_period=spectrum.pulse_period.values)
            self.assert_same(outcome, spectrum, kinds=4)

    def test_flip_where_an_independent_program_says(self):
        for direction, flips in ((0, [0.407515258023]), (180, [0.620924782649, 0.891748873204, 1.173623183158])):
            pga = np.sort([flip + step for flip in flips for step in (-1e-11, 1e-11)])
            outcome = overturn.evaluate(**self.LEANING, direction=direction, restitution_of_maximum=1,
                                        pulse_period=0.5, pga=pga, resolve=True)
            np.testing.assert_array_equal(outcome["verdict"], [i % 4 in (1, 2) for i in range(len(pga))])

    def test_are_refused_if_they_do_not_stand(self):
        with self.assertRaisesRegex(ValueError, "does not stand"):
            overturn.evaluate(width=0.5, height=2, incline=[0.1, 0.3], restitution=0.8, pulse_period=0.5, pga=0.3)
        with self.assertRaisesRegex(ValueError, "4.0 degrees are 0.06981 rad|4 degrees are 0.06981 rad"):
            overturn.evaluate(width=0.5, height=2, incline=4, restitution=0.8, pulse_period=0.5, pga=0.3)


class TheBitsOfAPlane(WithTheSameBits):
    def test_without_units(self):
        for scene, numerics in (({"pulse": "one_sine"}, {"tolerance": 1e-9}),
                                ({"pulse": "symmetric_ricker", "window": 1.5}, {"resolve": True}),
                                ({"pulse": "sine", "cycles": 1.5, "theory": "linear"}, {"method": "rk45"})):
            numerics = {"method": "taylor", **numerics}
            spectrum = overturn.run({
                "scene": scene, "numerics": numerics, "output": {"fields": FIELDS},
                "plane": {"frequency": {"first": 0.7, "last": 8, "count": 15},
                          "amplitude": {"first": 0.5, "last": 12, "count": 13},
                          "restitution": {"values": [0.7, 0.8]}, "slenderness": 0.2}})
            outcome = overturn.evaluate(
                slenderness=spectrum.slenderness.item(),
                restitution=spectrum.restitution.values[:, None, None],
                amplitude=spectrum.amplitude.values[:, None], frequency=spectrum.frequency.values, **scene,
                **numerics)
            self.assertEqual(outcome["region"].shape, spectrum.region.shape)
            self.assert_same(outcome, spectrum, kinds=4)

    def test_in_metres_seconds_and_g(self):
        spectrum = overturn.run({
            "scene": {"pulse": "one_cosine"}, "block": {"width": BLOCK["width"], "height": BLOCK["height"]},
            "numerics": {"method": "taylor"}, "output": {"fields": FIELDS},
            "plane": {"pulse_period": {"first": 0.3, "last": 2, "count": 12},
                      "pga": {"first": 0.1, "last": 1, "count": 11},
                      "restitution_of_maximum": 0.9}})
        outcome = overturn.evaluate(width=BLOCK["width"], height=BLOCK["height"], restitution_of_maximum=0.9,
                                    pulse_period=spectrum.pulse_period.values, pga=spectrum.pga.values[:, None],
                                    pulse="one_cosine")
        self.assert_same(outcome, spectrum, kinds=4)


class APulseOfOnesOwn(WithTheSameBits):
    ROWS = np.array([[3, 0], [3.1, 2], [3.4, -5], [3.5, -1], [4.25, 0]])
    SHAPES = ({"shape": ROWS}, {"shape": ROWS.tolist(), "pulse": "table"})

    def test_has_the_bits_of_a_plane(self):
        spectrum = overturn.run({
            "scene": {"pulse": "table", "shape": self.ROWS}, "block": {"width": 0.6, "height": 2.4},
            "output": {"fields": FIELDS},
            "plane": {"pulse_period": {"first": 0.3, "last": 2, "count": 12}, "restitution": 0.8,
                      "pga": {"first": 0.1, "last": 1.5, "count": 11}}})
        for shape in self.SHAPES:
            outcome = overturn.evaluate(**{**BLOCK, "restitution": 0.8}, **shape, pga=spectrum.pga.values[:, None],
                                        pulse_period=spectrum.pulse_period.values)
            self.assert_same(outcome, spectrum, kinds=3)

    def test_is_refused_unless_it_is_one(self):
        for phrase, arguments in (
                ("shape has the shape (4,). Give rows (time over the period, value): (n, 2).", {"shape": [0, 1, 2, 3]}),
                ("shape[2, 0] = 1.0 is not after the time before it, 1", {"shape": [[0, 0], [1, 1], [1, 2]]}),
                ("shape[1, 1] = nan is not a finite number", {"shape": [[0, 0], [1, np.nan]]}),
                ("shape is zero at all times", {"shape": [[0, 0], [1, 0]]}),
                ("shape has 1 row", {"shape": [[0, 1]]}),
                ("shape is not a number or an array of numbers", {"shape": "shape.csv"}),
                ('the pulse "table" needs shape', {"pulse": "table"}),
                ('shape is for the pulse "table"', {"pulse": "one_sine", "shape": self.ROWS}),
                ("window has no meaning for a shape", {"window": 2, "shape": self.ROWS}),
                ("is for pulses only, and not for a table", {"method": "rk45", "shape": self.ROWS})):
            with self.subTest(phrase), self.assertRaises(ValueError) as raised:
                overturn.evaluate(**BLOCK, **PULSE, **arguments)
            self.assertIn(phrase.replace("1.0", "1"), str(raised.exception).replace("1.0", "1"))
        with self.assertRaisesRegex(ValueError, "shape cannot be combined with record"):
            overturn.evaluate(**BLOCK, record=[0, 1], time_step=0.1, scale=1, shape=self.ROWS)


class EveryField(WithTheSameBits):
    PLANE = {"slenderness": 0.2, "restitution": 0.8, "friction": 0.35}

    def test_has_the_bits_of_a_plane(self):
        fields = [*core.fields]
        spectrum = overturn.run({
            "scene": {"pulse": "one_sine"}, "numerics": {"method": "taylor"}, "output": {"fields": fields},
            "plane": {"frequency": {"first": 0.7, "last": 8, "count": 12},
                      "amplitude": {"first": 0.5, "last": 12, "count": 11}, **self.PLANE}})
        outcome = overturn.evaluate(**self.PLANE, amplitude=spectrum.amplitude.values[:, None],
                                    frequency=spectrum.frequency.values, fields=fields)
        self.assertEqual([*outcome], ["verdict", *fields])
        self.assert_same(outcome, spectrum, kinds=4, fields=fields)

    def test_is_refused_if_it_is_unknown_or_impossible(self):
        motion = {"amplitude": 2, "frequency": 1}
        for arguments, text in (({"fields": ["peaks"]}, 'fields contains "peaks", which is not one of region, angle'),
                                ({"fields": "peak"}, "fields = 'peak' is a word"),
                                ({"fields": ["normal"], "theory": "linear", "friction": 1}, "linear theory has no forces"),
                                                                ({"fields": ["error"], "method": "rk45", "tolerance": 1e-3}, "is too loose")):
            with self.assertRaisesRegex(ValueError, text):
                overturn.evaluate(**{**self.PLANE, **motion, **arguments})


class TheBitsUnderARecord(WithTheSameBits):
    def test_of_a_plane(self):
        for numerics in ({"tolerance": 1e-6}, {"resolve": True}):
            spectrum = overturn.run(JOBS / "synthetic.toml", overrides={
                "numerics": numerics, "output.fields": FIELDS,
                "plane.scale": {"first": 0.5, "last": 2.5, "count": 9},
                "plane.size": {"first": 0.2, "last": 3, "count": 11}})
            record = overturn.read_record(JOBS / "synthetic.AT2")
            outcome = overturn.evaluate(
                record=record.acceleration, time_step=record.time_step,
                slenderness=spectrum.slenderness.values, restitution_of_maximum=1,
                scale=spectrum["scale"].values[:, None], size=spectrum["size"].values, **numerics)
            self.assert_same(outcome, spectrum)

    def test_pga_scales_the_record(self):
        record = overturn.read_record(JOBS / "synthetic.AT2")
        motion = {**BLOCK, "record": record.acceleration, "time_step": record.time_step}
        peak = abs(record.acceleration).max()
        by_pga = overturn.evaluate(**motion, pga=np.array([1, 2]) * peak)
        by_scale = overturn.evaluate(**motion, scale=[1, 2])
        np.testing.assert_array_equal(by_pga["peak"], by_scale["peak"])

    def test_of_two_components_has_directions(self):
        one, other = (overturn.read_record(JOBS / name) for name in ("synthetic.AT2", "synthetic_vertical.AT2"))
        motion = {**BLOCK, "record": one.acceleration, "time_step": one.time_step}
        scale = np.linspace(0.5, 4, 12)[:, None]
        turned = overturn.evaluate(**motion, second_component=other.acceleration, scale=scale,
                                   direction=[0, 90, 180, 30])
        for column, record in enumerate((one, other, one)):
            alone = overturn.evaluate(**{**motion, "record": record.acceleration}, scale=scale[:, 0])
            np.testing.assert_array_equal(turned["margin"][:, column], alone["margin"])
        sum_of_both = one.acceleration * np.cos(np.pi / 6) + other.acceleration * np.sin(np.pi / 6)
        alone = overturn.evaluate(**{**motion, "record": sum_of_both}, scale=scale[:, 0])
        np.testing.assert_array_equal(turned["verdict"][:, 3], alone["verdict"])
        self.assertEqual(len(np.unique(turned["verdict"])), 2)
        for arguments, words in (({"scale": 1}, "direction is missing"), ({"pga": 1, "direction": 30}, "pga is not"),
                                 ({"scale": 1, "direction": 30, "second_component": [0, 1]}, "has 2 samples")):
            with self.assertRaisesRegex(ValueError, words):
                overturn.evaluate(**{**motion, "second_component": other.acceleration, **arguments})

    def test_where_gravity_vanishes_points_are_undecided(self):
        motion = {"record": [0, 0.5, 0], "vertical": [0, -0.5, 0], "time_step": 0.1}
        outcome = overturn.evaluate(**BLOCK, **motion, scale=[1, 2])
        self.assertEqual(outcome["verdict"].tolist(), [overturn.Verdict.SAFE, overturn.Verdict.UNDECIDED])
        self.assertEqual(outcome["region"][1], 254)
        self.assertTrue(np.isnan(outcome["peak"][1]))


class TheShape(unittest.TestCase):
    def test_of_numbers_is_that_of_a_number(self):
        outcome = overturn.evaluate(**BLOCK, **PULSE)
        for values in outcome.values():
            self.assertEqual(values.shape, ())
        self.assertEqual({name: values.dtype.name for name, values in outcome.items()},
                         {"verdict": "uint8", "region": "uint8", "status": "uint8", "peak": "float64",
                          "margin": "float64"})

    def test_follows_the_rules_of_numpy(self):
        width, pga = np.array([0.4, 0.5, 0.6]), np.array([[0.1], [0.9]])
        outcome = overturn.evaluate(**{**BLOCK, **PULSE, "width": width, "pga": pga})
        self.assertEqual(outcome["peak"].shape, (2, 3))
        one = overturn.evaluate(**{**BLOCK, **PULSE, "width": 0.5, "pga": 0.9})
        self.assertEqual(outcome["margin"][1, 1], one["margin"])

    def test_an_aspect_ratio_is_a_slenderness(self):
        for ratio in (1.5, 3, 7.25):
            same = {"size": 1.1, "restitution": 0.8, **PULSE}
            by_ratio = overturn.evaluate(aspect_ratio=ratio, **same)
            by_angle = overturn.evaluate(slenderness=np.arctan(1 / ratio), **same)
            np.testing.assert_allclose(by_ratio["margin"], by_angle["margin"], rtol=1e-9)
            self.assertEqual(by_ratio["region"], by_angle["region"])

    def test_may_be_empty(self):
        outcome = overturn.evaluate(**{**BLOCK, **PULSE, "pga": np.empty((0, 3))})
        for values in outcome.values():
            self.assertEqual(values.shape, (0, 3))

    def test_integers_lists_and_slices_are_accepted(self):
        pga = np.arange(12, dtype=np.float32)[::3] / 10
        outcome = overturn.evaluate(**{**BLOCK, "height": 2, "pulse_period": [1, 2, 1, 2], "pga": pga})
        self.assertEqual(outcome["verdict"].shape, (4,))

    def test_verdicts_follow_from_the_regions(self):
        outcome = overturn.evaluate(**random_blocks(300))
        np.testing.assert_array_equal(outcome["verdict"] == overturn.Verdict.SAFE, outcome["region"] <= 2)
        np.testing.assert_array_equal(outcome["verdict"] == overturn.Verdict.OVERTURNS,
                                      np.isinf(outcome["peak"]))

    def test_alternative_descriptions_of_a_block_and_a_pulse_agree(self):
        p = np.sqrt(3 * 9.81 / (4 * np.hypot(0.3, 1.2)))
        slenderness = np.arctan(0.25)
        first = overturn.evaluate(**BLOCK, **PULSE)
        for other in ({"half_width": 0.3, "half_height": 1.2, "pulse_period": 0.9, "pga": 0.4},
                      {"slenderness": slenderness, "size": np.hypot(0.3, 1.2), "pulse_frequency": 1 / 0.9,
                       "pga": 0.4},
                      {"slenderness": slenderness, "frequency_parameter": p, "pulse_period": 0.9, "amplitude": 1.6},
                      {"slenderness": slenderness, "frequency": 2 * np.pi / (0.9 * p), "amplitude": 1.6}):
            outcome = overturn.evaluate(restitution=0.87, **other)
            # A few roundings of the arguments; they grow by less than a thousand.
            np.testing.assert_allclose(outcome["margin"], first["margin"], rtol=1e-12)

    def test_the_velocity_restitution_is_the_root_of_the_restitution(self):
        other = {"width": 0.6, "height": 2.4, **PULSE}
        np.testing.assert_array_equal(overturn.evaluate(velocity_restitution=[0.8, 0.9], **other)["margin"],
                                      overturn.evaluate(restitution=[0.8 * 0.8, 0.9 * 0.9], **other)["margin"])


class AWarning(unittest.TestCase):
    def test_is_given_once_a_call_if_units_look_mistaken(self):
        random = np.random.default_rng(3)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            overturn.evaluate(**random_blocks(100))
        for factors, words in (({"width": 0.01, "height": 0.01}, "R = "), ({"pga": 981}, "peak ground"),
                               ({"pulse_period": 1000}, "the period of the pulse")):
            blocks = random_blocks(100)
            rows = random.random(100) < 0.3
            for name, factor in factors.items():
                blocks[name][rows] *= factor
            with self.assertWarnsRegex(UserWarning, words) as caught:
                overturn.evaluate(**blocks)
            self.assertEqual(len(caught.warnings), 1)
            self.assertEqual(caught.filename, __file__)

    def test_of_a_record_in_other_units(self):
        block = {**BLOCK, "restitution": 0.8, "record": np.array([0, 300, -200.0])}
        with self.assertWarnsRegex(UserWarning, "the peak of a component of a record = 300 g"):
            overturn.evaluate(**block, time_step=0.02, pga=0.3)
        with self.assertWarnsRegex(UserWarning, "the time step of a record = 20 s"):
            overturn.evaluate(**{**block, "record": [0, 0.3, -0.2]}, time_step=20, scale=1)


class Threads(unittest.TestCase):
    def test_compute_the_same_values(self):
        blocks = random_blocks(20_000)
        whole = overturn.evaluate(**blocks)
        parts = [{name: values[part::2] for name, values in blocks.items()} for part in range(2)]
        with concurrent.futures.ThreadPoolExecutor(2) as threads:
            for part, outcome in enumerate(threads.map(lambda given: overturn.evaluate(**given), parts)):
                for name, values in outcome.items():
                    self.assertEqual(values.tobytes(), whole[name][part::2].tobytes(), name)


class AnInterruption(unittest.TestCase):
    def test_ends_a_long_evaluation(self):
        def interrupt(number, frame):
            raise KeyboardInterrupt

        before = signal.signal(signal.SIGALRM, interrupt)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            overturn.evaluate(**random_blocks(1_000_000), method="rk45", tolerance=1e-14)  # half a minute
        self.assertLess(time.monotonic() - began, 4)


if __name__ == "__main__":
    unittest.main()
