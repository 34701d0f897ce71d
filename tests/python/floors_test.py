"""overturn.floor_motion() compared with closed forms, identities and SciPy's integration. Requires the package on
PYTHONPATH."""

import dataclasses
import math
import pathlib
import tempfile
import types
import unittest
import warnings

import numpy as np
import overturn

try:
    from scipy.integrate import solve_ivp
except ImportError:
    solve_ivp = None

STEP = 0.02
THREE = {"periods": [0.5, 0.17, 0.1], "damping": [0.03, 0.05, 0.08], "shape": [1.3, -0.45, 0.1]}


def ground(seed=1, count=101, peak=0.4):
    """Noise of two seconds that begins and ends at 0, smoothed over five samples."""
    noise = np.random.default_rng(seed).standard_normal(count - 6)
    record = np.pad(np.convolve(noise, np.ones(5) / 5), 1)
    return peak * record / abs(record).max()


def floor(record=None, step=STEP, **changes):
    return overturn.floor_motion(ground() if record is None else record, step, **{**THREE, **changes})


def at_ground_samples(motion, count, step=STEP):
    return motion.acceleration[::round(step / motion.time_step)][:count]


def modes_of(building):
    w, damping, shape = np.broadcast_arrays(2 * np.pi / np.array(building["periods"]), building["damping"],
                                            building["shape"])
    return w, damping, shape


def slope_of(building, t, y):
    """x_i' and x_i'' of the oscillators, whose displacements and velocities begin y; g = 1."""
    w, damping, _ = modes_of(building)
    x, v = y[:w.size], y[w.size:2 * w.size]
    return v, lambda a: -a - 2 * damping * w * v - w * w * x


def integrated(building, record, step, end):
    """Returns the acceleration of the floor at the samples of the record and the states at the end, by SciPy. No
    integration crosses a sample."""
    w, _, shape = modes_of(building)
    y, floor_at = np.zeros(2 * w.size), []
    for k in range(len(record)):
        last = k == len(record) - 1
        level, rise = record[k], 0 if last else record[k + 1] - record[k]

        def slope(t, y):
            v, acceleration = slope_of(building, t, y)
            return [*v, *acceleration(level + rise * t / step)]
        floor_at.append(level + shape @ slope(0, y)[w.size:])
        length = end - k * step if last else step
        y = solve_ivp(slope, (0, length), y, method="DOP853", rtol=1e-13, atol=1e-16).y[:, -1] if length > 0 else y
    return np.array(floor_at), y


class TheSamples(unittest.TestCase):
    @unittest.skipIf(solve_ivp is None, "SciPy is not installed")
    def test_are_those_of_an_integration(self):
        for building in ({"periods": [0.4], "damping": [0.05], "shape": [1.0]},  # one storey
                         {"periods": [0.03], "damping": [0.9], "shape": [0.7]}, THREE):
            motion = floor(**building)
            end = (motion.acceleration.size - 1) * motion.time_step
            expected, y = integrated(building, ground(), STEP, end)
            # Errors of 1e-13 of each of 100 integrations. A wrong rise of the ground would change 1e-2.
            np.testing.assert_allclose(at_ground_samples(motion, 101), expected, rtol=0, atol=1e-11)
            w, damping, shape = modes_of(building)
            v, acceleration = slope_of(building, 0, y)
            a = acceleration(0)
            energy = a**2 + (2 * damping * a + w * v)**2  # x''^2 + (x'''/w)^2
            self.assertAlmostEqual(motion.remaining, abs(shape) @ np.sqrt(energy), delta=1e-11)
            self.assertAlmostEqual(motion.acceleration[-1], shape @ a, delta=1e-11)

    def test_after_a_sudden_acceleration_are_the_closed_form(self):
        w, damping = 2 * np.pi / 0.3, 0.1
        motion = floor(np.full(200, 0.25), periods=0.3, damping=damping, shape=0.8)
        t = np.arange(200) * STEP
        turn = w * math.sqrt(1 - damping**2)
        free = np.exp(-damping * w * t) * (np.cos(turn * t) - damping * w / turn * np.sin(turn * t))  # -x''/a
        # A few roundings per sample.
        np.testing.assert_allclose(at_ground_samples(motion, 200), 0.25 * (1 - 0.8 * free), rtol=0, atol=1e-13)

    def test_under_a_sine_converge_to_the_closed_form(self):
        w, z, load = 2 * np.pi / 0.5, 0.07, 2 * np.pi / 0.8
        turn = w * math.sqrt(1 - z * z)
        amplitude = -1 / complex(w * w - load * load, 2 * z * w * load)  # x = Im(amplitude exp(i load t)) + free
        c = -amplitude.imag
        d = (-(amplitude * load).real + z * w * c) / turn
        errors, steps = [], STEP / np.array([1, 2, 4, 8])
        for step in steps:
            t = np.arange(round(2 / step) + 1) * step
            # x'' of exp(-z w t) (c cos(turn t) + d sin(turn t)), with which x begins at rest
            decay = complex(-z * w, turn)
            free = ((c - 1j * d) * decay**2 * np.exp(decay * t)).real
            exact = np.sin(load * t) - load**2 * (amplitude * np.exp(1j * load * t)).imag + free
            motion = floor(np.sin(load * t), step, periods=0.5, damping=z, shape=1)
            errors.append(abs(at_ground_samples(motion, t.size, step) - exact).max())
            # The ground differs from the sine by (load step)^2 / 8; the response to an impulse is at most
            # w exp(-z w t) / sqrt(1 - z^2).
            self.assertLess(errors[-1], (load * step)**2 / 8 / (z * math.sqrt(1 - z * z)))
        order = np.polyfit(np.log(steps), np.log(errors), 1)[0]
        self.assertAlmostEqual(order, 2, delta=0.05)  # a response to constant accelerations in each step has order 1


class TheArguments(unittest.TestCase):
    def test_in_another_unit_or_not_normalised_are_warned_of(self):
        for changes, message in (({"periods": [0.5, 0.17, 500]}, r"^periods\[2\] = 500 .* in seconds"),
                                 ({"periods": [0.009, 0.17, 0.1]}, r"^periods\[0\] = 0.009 .* in seconds"),
                                 ({"shape": [30, 12, 1]}, "^the values of shape add up to 43: .* add up to 1"),
                                 ({"shape": [-1.5, -0.4, -0.2]}, "add up to -2.1")):
            with self.assertWarnsRegex(UserWarning, message) as caught:
                overturn.floor_motion(ground(), STEP, **{**THREE, **changes})
            self.assertEqual((len(caught.warnings), caught.filename), (1, __file__))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            floor(periods=[20, 0.17, 0.01], shape=[1.6, 0.4, -0.1])


class TheError(unittest.TestCase):
    def test_of_interpolation_is_below_its_bound_and_falls_by_four_as_the_step_is_halved(self):
        exact = floor(tolerance=1e-7)
        t = np.arange(exact.acceleration.size) * exact.time_step
        steps, errors = [], []
        for tolerance in (4e-3, 1e-3, 2.5e-4, 6.25e-5):
            motion = floor(tolerance=tolerance)
            between = np.interp(t, np.arange(motion.acceleration.size) * motion.time_step, motion.acceleration, right=0)
            shaking = t <= 2
            errors.append(abs(between - exact.acceleration)[shaking].max())
            steps.append(motion.time_step)
            self.assertLessEqual(motion.error, tolerance * abs(motion.acceleration).max())
            self.assertLess(errors[-1], motion.error)
            # Three modes that do not peak together, and bounds of each by its energy.
            self.assertGreater(errors[-1], motion.error / 6)
            self.assertEqual(round(STEP / motion.time_step, 9) % 1, 0)
        self.assertGreater(steps[0] / steps[-1], 6)
        self.assertAlmostEqual(np.polyfit(np.log(steps), np.log(errors), 1)[0], 2, delta=0.1)

    def test_of_a_vibration_that_vanishes_at_every_sample_of_the_ground_is_seen(self):
        motion = floor([0, 0.5, 0], periods=STEP, damping=1e-3, shape=1)
        quarter = np.interp(STEP / 4, np.arange(motion.acceleration.size) * motion.time_step, motion.acceleration)
        # x'' = -0.5 / (2 pi) sin(2 pi t / step), which the damping reduces by less than pi / 2 * 1e-3.
        self.assertAlmostEqual(quarter, 0.5 / 4 - 0.5 / (2 * math.pi), delta=motion.error + 1.3e-4)

    def test_after_the_last_sample_is_below_what_remains(self):
        self.assertEqual(floor(tolerance=0.2).time_step, STEP)
        for tolerance in (0.2, 1e-2, 1e-3):
            short, long = floor(tolerance=tolerance), floor(tolerance=1e-6)
            after = np.arange(long.acceleration.size) * long.time_step > (short.acceleration.size - 1) * short.time_step
            self.assertLess(abs(long.acceleration[after]).max(), short.remaining)
            self.assertGreater(abs(long.acceleration[after]).max(), short.remaining / 3)  # of three modes, one is left
            self.assertLessEqual(short.remaining, tolerance * abs(short.acceleration).max())


class AnIdentity(unittest.TestCase):
    def assert_equal(self, one, other, rounding=1e-13):
        # About 100 operations with numbers of order 1.
        np.testing.assert_allclose(at_ground_samples(one, 101), other if isinstance(other, np.ndarray) else
                                   at_ground_samples(other, 101), rtol=0, atol=rounding)

    def test_grounds_can_be_added(self):
        one, other = ground(1), ground(2)
        both = at_ground_samples(floor(one), 101) + at_ground_samples(floor(other), 101)
        self.assert_equal(floor(one + other), both)

    def test_twice_the_ground_is_twice_the_floor(self):
        one, twice = floor(), floor(2 * ground())
        np.testing.assert_array_equal(twice.acceleration, 2 * one.acceleration)
        self.assertEqual((twice.time_step, twice.error, twice.remaining), (one.time_step, 2 * one.error,
                                                                           2 * one.remaining))

    def test_of_slower_time(self):
        slow = floor(step=4 * STEP, periods=4 * np.array(THREE["periods"]))
        np.testing.assert_array_equal(slow.acceleration, floor().acceleration)
        self.assertEqual(slow.time_step, 4 * floor().time_step)

    def test_modes_can_be_added(self):
        each = [at_ground_samples(floor(periods=T, damping=z, shape=f), 101) - ground()
                for T, z, f in zip(*THREE.values())]
        self.assert_equal(floor(), ground() + sum(each))
        halves = floor(periods=[0.4, 0.4], damping=0.05, shape=[0.3, 0.7])
        self.assert_equal(halves, floor(periods=0.4, damping=0.05, shape=1))

    def test_what_the_modes_leave_moves_with_the_ground(self):
        np.testing.assert_array_equal(floor(shape=[0, 0, 0]).acceleration, [*ground(), 0])
        oscillator = at_ground_samples(floor(periods=0.4, damping=0.05, shape=1), 101)
        self.assert_equal(floor(periods=0.4, damping=0.05, shape=0.3), 0.7 * ground() + 0.3 * oscillator)

    def test_stiff_modes_move_with_the_ground(self):
        period = 1e-5 * STEP
        motion = floor(periods=[period, 2 * period, 3 * period], damping=0.05, shape=[0.5, 0.3, 0.2])
        # Each kink excites x'' = rise / (w step), and fewer than 100 add up; without a mode this would be 0.4 * shape.
        limit = 100 * abs(np.diff(ground())).max() * 3e-5 / (2 * np.pi)
        self.assertLess(limit, 1e-3)
        np.testing.assert_allclose(motion.acceleration[:101], ground(), rtol=0, atol=limit)
        self.assertEqual(motion.time_step, STEP)

    def test_a_trace_is_its_samples(self):
        trace = types.SimpleNamespace(id="XX.STA..HNE", data=981 * ground(),
                                      stats=types.SimpleNamespace(delta=STEP, starttime=0.0))
        motion = overturn.floor_motion(trace, units="gal", **THREE)
        np.testing.assert_allclose(motion.acceleration, floor().acceleration, rtol=0, atol=1e-14)


class AFile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="overturn-test-")
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "floor.txt"

    def test_has_the_samples_and_states_that_they_are_those_of_a_floor(self):
        motion = floor()
        motion.to_text(self.path)
        record = overturn.read_record(self.path, units="g")
        np.testing.assert_array_equal(record.acceleration, motion.acceleration)
        # The reader chooses the decimal number with the fewest digits.
        self.assertAlmostEqual(record.time_step, motion.time_step, delta=4 * np.spacing(motion.time_step))
        self.assertEqual((motion.motion_of, record.motion_of), ("floor", "floor"))
        self.assertEqual((motion.ground_pga, record.ground_pga), (abs(ground()).max(),) * 2)

    def test_replaces_its_own_kind_only(self):
        floor().to_text(self.path)
        floor(shape=[1, 0, 0]).to_text(self.path)
        self.path.write_text("0 1\n")
        with self.assertRaisesRegex(OSError, "it exists and is not a motion of a floor"):
            floor().to_text(self.path)

    def test_of_a_structure_on_a_floor_has_the_ground_below_both(self):
        self.assertEqual(floor(floor(), step=None).ground_pga, abs(ground()).max())

    def test_of_another_motion_is_one_of_the_ground(self):
        self.path.write_text("0 0\n1 1\n")
        record = overturn.read_record(self.path, units="g")
        self.assertEqual((record.motion_of, record.ground_pga), ("ground", None))


class TheWords(unittest.TestCase):
    """Of warnings, which name the peak acceleration of the motion."""

    def warning(self, **motion):
        with warnings.catch_warnings(record=True) as raised:
            warnings.simplefilter("always")
            overturn.evaluate(width=0.5, height=2, restitution_of_maximum=0.9, pga=6, **motion)
        return " ".join(str(each.message) for each in raised)

    def test_are_those_of_the_motion(self):
        arrays = {"record": ground(), "time_step": STEP}
        record = overturn.Record(ground(), STEP, "", "text", False, [])
        of_floor = dataclasses.replace(record, motion_of="floor")
        for word, motion in (("ground", arrays), ("floor", {**arrays, "motion_of": "floor"}),
                             ("ground", {"record": record}), ("floor", {"record": record, "motion_of": "floor"}),
                             ("floor", {"record": of_floor}), ("floor", {"record": floor()}),
                             ("floor", {"record": of_floor, "motion_of": "floor"}),
                             ("ground", {"pulse_period": 1}), ("floor", {"pulse_period": 1, "motion_of": "floor"})):
            with self.subTest(word, motion=[*motion]):
                self.assertIn(f"the peak {word} acceleration = 6 g is above 5 g", self.warning(**motion))

    def test_that_contradict_the_motion_are_refused(self):
        with self.assertRaisesRegex(TypeError, "motion_of = 'ground', but a component is the motion of a floor"):
            self.warning(record=floor(), motion_of="ground")
        with self.assertRaisesRegex(ValueError, 'motion_of = "roof" is not one of ground, floor'):
            self.warning(record=ground(), time_step=STEP, motion_of="roof")


class ARefusal(unittest.TestCase):
    def assert_refused(self, phrase, record=None, error=ValueError, **changes):
        with self.assertRaises(error) as raised:
            floor(record, **changes)
        self.assertIn(phrase, str(raised.exception))

    def test_of_modes(self):
        for name, value, phrase in (
                ("damping", 0, "damping[0] = 0 is outside (0, 1)"), ("damping", 5, "give 0.05 for 5 %"),
                ("damping", [0.1, 1, 0.1], "damping[1] = 1 is outside"), ("damping", math.nan, "damping[0] = nan is"),
                ("damping", [0.1, 0.1], "damping has the shape (2,), and periods has (3,). Give one number"),
                ("periods", [0.5, -1, 0.1], "periods[1] = -1 is outside [2e-08, inf)"),
                ("periods", [0.5, 0.1, 1e-9], "Leave out a mode that is stiffer"),
                ("periods", [0.5, math.inf, 1], "periods[1] = inf is outside"),
                ("periods", [], "periods has the shape (0,)"), ("periods", "slow", "periods is not a number"),
                ("shape", [1, 2], "shape has the shape (2,)"), ("shape", [1, math.nan, 0], "shape[1] = nan is outside"),
                ("shape", [[1, 1, 1]], "shape has the shape (1, 3)")):
            with self.subTest(f"{name} = {value}"):
                self.assert_refused(phrase, **{name: value})

    def test_of_the_ground(self):
        self.assert_refused("record[1] = nan is not finite", [0, math.nan, 0])
        self.assert_refused("record needs two or more samples", [0, 0])
        self.assert_refused("record has 2 dimensions", [[0, 1]])
        self.assert_refused("time_step = 0 is outside (0, inf)", step=0)
        self.assert_refused("time_step = nan is outside", step=math.nan)
        self.assert_refused("a record needs time_step", error=TypeError, step=None)
        self.assert_refused("units = 'ft' is not one of", units="ft")

    def test_of_a_tolerance(self):
        for tolerance in (0, 1, math.nan):
            self.assert_refused(f"tolerance = {tolerance} is outside (0, 1)", tolerance=tolerance)
        self.assert_refused("tolerance = 1e-12 needs steps so short that", tolerance=1e-12)
        self.assert_refused("needs so long until the floor is at rest that", damping=1e-7)


def largest_tilt(building, record, step, width, height, restitution):
    """Returns the largest |theta| / alpha of a block on a floor, infinite if it overturns, from one integration of the
    block and the building. Impacts of 1e-4 of the velocity that topples bring the block to rest."""
    w, _, shape = modes_of(building)
    modes, alpha = w.size, math.atan(width / height)
    p = math.sqrt(3 * 9.81 / (4 * math.hypot(width / 2, height / 2)))
    y, t, side, largest = np.zeros(2 * modes + 2), 0.0, 0, 0.0
    end = (len(record) - 1) * step + 8
    times = np.arange(len(record)) * step

    while t < end - 1e-12:
        k = min(int((t + 1e-9) / step), len(record) - 1)
        until = times[k + 1] if k + 1 < len(record) else end
        level, rate = record[k], (record[k + 1] - record[k]) / step if k + 1 < len(record) else 0.0

        def floor_at(t, y):
            a = level + rate * (t - times[k])
            v, acceleration = slope_of(building, t, y)
            return v, acceleration(a), a + shape @ acceleration(a)

        def slope(t, y):
            v, acceleration, floor = floor_at(t, y)
            lean = side * alpha - y[-2]
            turning = -p * p * (math.sin(lean) + floor * math.cos(lean)) if side else 0.0
            return [*v, *acceleration, y[-1], turning]

        def lift(t, y):
            return abs(floor_at(t, y)[2]) - math.tan(alpha) if not side else -1.0

        def impact(t, y):
            return side * y[-2] if side else 1.0

        def fall(t, y):
            return abs(y[-2]) - math.pi / 2

        def turn(t, y):
            return y[-1]

        lift.terminal = impact.terminal = fall.terminal = True
        lift.direction, impact.direction = 1, -1
        motion = solve_ivp(slope, (t, until), y, method="DOP853", rtol=1e-10, atol=1e-13,
                           events=(lift, impact, fall, turn), first_step=min(1e-4, until - t), max_step=0.02)
        largest = max(largest, *abs(motion.y[-2]), *(abs(turned[-2]) for turned in motion.y_events[3]))
        t, y = motion.t[-1], motion.y[:, -1].copy()
        if motion.t_events[2].size:
            return math.inf
        if motion.t_events[0].size:
            side = -int(np.sign(floor_at(t, y)[2]))
        if motion.t_events[1].size:
            y[-2], y[-1] = 0.0, math.sqrt(restitution) * y[-1]
            side = int(np.sign(y[-1]))
            if abs(y[-1]) < 1e-4 * p * alpha:
                side, y[-1] = 0, 0.0
    return largest / alpha


@unittest.skipIf(solve_ivp is None, "SciPy is not installed")
class ABlockOnAFloor(unittest.TestCase):
    def test_has_the_verdict_of_an_integration_of_block_and_building(self):
        building = {"periods": [0.6, 0.2], "damping": [0.05, 0.05], "shape": [1.3, -0.3]}
        slender = {"width": 0.4, "height": 1.6, "restitution": 0.6}
        large = {"width": 0.8, "height": 2.4, "restitution": 0.6}
        overturning = []
        for seed, scales, block in ((3, [1.0, 1.2, 1.7], slender), (5, [1.0, 1.24, 1.6, 2.3], large)):
            motion = floor(ground(seed), tolerance=1e-6, **building)
            outcome = overturn.evaluate(**block, record=motion.acceleration, time_step=motion.time_step, scale=scales)
            expected = [largest_tilt(building, scale * ground(seed), STEP, **block) for scale in scales]
            np.testing.assert_array_equal(outcome["verdict"] == overturn.Verdict.OVERTURNS, np.isinf(expected))
            # The error of 1e-6 grows by less than exp(p t) = 100 in the 1.5 s from an uplift to the largest tilt.
            np.testing.assert_allclose(outcome["peak"], expected, rtol=1e-4)
            overturning += list(np.isinf(expected))
        self.assertEqual(sum(overturning), 2)
        self.assertEqual(len(overturning), 7)

    def test_slips_as_in_a_job_with_the_text_of_the_floor(self):
        motion = floor(ground(3), tolerance=1e-3, periods=[0.6], damping=0.05, shape=1.3)
        block = {"width": 0.4, "height": 1.6, "friction": [0.2, 0.3]}  # b/h = 0.25
        scale = np.array([1.0, 1.7])
        with tempfile.TemporaryDirectory() as folder:
            motion.to_text(pathlib.Path(folder, "floor.txt"))
            job = overturn.run({"scene": {"record": str(pathlib.Path(folder, "floor.txt")), "units": "g"},
                                "block": {**block, "friction": {"values": block["friction"]}},
                                "plane": {"restitution": 0.6, "scale": {"values": scale}},
                                "numerics": {"method": "taylor"}, "output": {"fields": ["region", "slide", "status"]}})
        found = overturn.evaluate(**block, restitution=0.6, record=motion, scale=scale[:, None],
                                  fields=["region", "slide", "status"])
        for name in ("region", "slide", "status"):
            np.testing.assert_array_equal(job[name].transpose("scale", "friction"), found[name])
        self.assertTrue((found["slide"][:, 0] != 0).all())
        self.assertTrue((found["verdict"][:, 0] == overturn.Verdict.SAFE).all())  # it never lifts
        self.assertEqual(found["verdict"][1, 1], overturn.Verdict.OVERTURNS)


if __name__ == "__main__":
    unittest.main()
