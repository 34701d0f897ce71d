"""All fields of a motion compared with one that SciPy integrates, with forces from the acceleration of the centre of
mass. Requires OVERTURN (the binary) in the environment. SUDDEN_ONSETS, 3 by default, is the number of
points of each kind of block under each motion that begins with a jump."""

import os
import unittest

import h5py
import numpy as np

from program import Scratch

try:
    from scipy.integrate import solve_ivp
    from scipy.optimize import brentq, minimize_scalar
except ImportError:
    solve_ivp = None

G = 9.81
FIELDS = ("region", "angle", "velocity", "peak", "fall_time", "friction_demand", "normal", "impacts", "status")


class Rocker:
    """A rigid block on an inclined base. Its corners are `plus` and `minus` from the foot of its centre of mass, which
    is `height` above the base; k: radius of gyration."""

    def __init__(self, plus, minus, height, k, incline, restitution):
        self.incline, self.restitution = incline, restitution
        self.alpha = {1: np.arctan(plus / height) - incline, -1: np.arctan(minus / height) + incline}
        self.radius = {1: np.hypot(plus, height), -1: np.hypot(minus, height)}
        self.moment = {side: k * k + r * r for side, r in self.radius.items()}  # about the corner, over m

    def turning(self, side, tilt, ground):
        arm = self.alpha[side] - tilt
        return -self.radius[side] / self.moment[side] * G * (np.sin(arm) + side * ground * np.cos(arm))

    def demand(self, side, tilt, rate, ground):
        """The friction coefficient and the normal force over that at rest, of a block that rocks."""
        arm, turning = self.alpha[side] - tilt, self.turning(side, tilt, ground)
        outward = side * ground * G + self.radius[side] * (turning * np.cos(arm) + rate**2 * np.sin(arm))
        upward = G + self.radius[side] * (turning * np.sin(arm) - rate**2 * np.cos(arm))
        return self.on_base(side, outward / G, upward / G)

    def at_rest(self, ground):
        return self.on_base(1, ground, 1)

    def on_base(self, side, outward, upward):
        c, s = np.cos(self.incline), side * np.sin(self.incline)
        along, normal = outward * c - upward * s, upward * c + outward * s
        return abs(along) / normal if normal > 0 else np.inf, normal / c

    def after_impact(self, side, rate):
        return np.sqrt(self.restitution * self.moment[side] / self.moment[-side]) * -rate


class Follower:
    """Follows a block from rest under a ground acceleration over g that is smooth between the times `pieces` and ends
    with the last of them. `demand` is the largest friction and the smallest normal force; None if the block bounces
    too often to be followed. `peak` is the largest tilt over alpha, infinite if the block falls; `end` its angle and
    velocity at the end of the motion, or of its fall before; `lifted` and `fallen` are times."""

    def __init__(self, block, ground, pieces):
        self.block, self.ground, self.pieces = block, ground, pieces
        self.kept, self.beyond = [block.at_rest(0)], []
        self.demand, self.peak, self.end, self.impacts = None, 0.0, (0.0, 0.0), 0
        self.lifted, self.fallen = None, np.inf
        if self.follow():
            friction, normal = np.array(self.kept).T
            self.demand = friction.max(), normal.min()

    def extremes(self, demand_at, begin, end):
        """The demands between two times: the extremes of samples, refined between their neighbours."""
        times = np.linspace(begin, end, 60)
        values = np.array([demand_at(time) for time in times])
        found = [tuple(values[0]), tuple(values[-1])]
        for which, sign in ((0, -1), (1, 1)):
            best = int(np.argmin(sign * values[:, which]))
            near = times[max(best - 1, 0)], times[min(best + 1, 59)]
            top = minimize_scalar(lambda time: sign * demand_at(time)[which], bounds=near, method="bounded",
                                  options={"xatol": 1e-9 * (near[1] - near[0])})
            found += [tuple(values[best]), demand_at(top.x)]
        return found

    def uplift(self, begin, end):
        """The first time at which the ground lifts the block, and the side; `end` and 0 if it does not."""
        def excess(time, side):
            return -side * self.ground(time) - np.tan(self.block.alpha[side])
        times = np.linspace(begin, end, 200)
        for first, last in zip(times, times[1:]):
            for side in (1, -1):
                if excess(last, side) > 0:
                    return (first if excess(first, side) > 0 else
                            brentq(excess, first, last, args=(side,), xtol=1e-15)), side
        return end, 0

    def follow(self):
        side, tilt, rate, impacts, after = 0, 0.0, 0.0, 0, 0
        pieces = [*zip(self.pieces, self.pieces[1:]), (self.pieces[-1], self.pieces[-1] + 1000)]
        for piece, (time, end) in enumerate(pieces):
            is_free = piece == len(pieces) - 1
            ground = (lambda time: 0.0) if is_free else self.ground
            while time < end:
                if side == 0:
                    if is_free:
                        return True
                    begin = time
                    time, side = self.uplift(time, end)
                    if time > begin:
                        self.kept += self.extremes(lambda t: self.block.at_rest(ground(t)), begin, time)
                    tilt, rate = 0.0, 0.0
                    self.lifted = time if self.lifted is None and side else self.lifted
                    continue
                time, tilt, rate, event = self.arc(side, (time, end), (tilt, rate), ground)
                if not is_free:
                    self.end = side * tilt, side * rate
                if event == "fall":
                    self.fallen = time
                    return True
                if event == "impact":
                    tilt, rate, side = 0.0, self.block.after_impact(side, rate), -side
                    impacts, after = impacts + 1, after + is_free
                    self.impacts += not is_free
                    if impacts > 40 or (rate < 1e-3 and not is_free):
                        return False
                    if after == 24:  # the later arcs approach the standing block
                        self.kept += [self.block.demand(s, 0, 0, 0) for s in (1, -1)]
                        return True
        return True

    def arc(self, side, times, start, ground):
        block = self.block

        def slope(time, state):
            return [state[1], block.turning(side, state[0], ground(time))]

        def impact(time, state):
            return state[0]

        def pass_top(time, state):
            return state[0] - block.alpha[side]

        def fall(time, state):
            return state[0] - np.pi / 2

        def turn(time, state):
            return state[1]
        impact.terminal, impact.direction, fall.terminal, fall.direction = True, -1, True, 1
        # SciPy sees an event only if the sign has changed at the end of a step: short steps for two impacts.
        longest = 0.004 if times[1] <= self.pieces[-1] else np.inf
        motion = solve_ivp(slope, times, start, method="DOP853", rtol=1e-12, atol=1e-15, dense_output=True,
                           events=(impact, pass_top, fall, turn), first_step=min(1e-5, times[1] - times[0]),
                           max_step=longest)

        def demand_at(time):
            return block.demand(side, *motion.sol(time), ground(time))
        end = motion.t[-1]
        marks = [times[0], *motion.t_events[1], end]
        for begin, last in zip(marks, marks[1:]):
            if last > begin:
                found = self.extremes(demand_at, begin, last)
                if motion.sol((begin + last) / 2)[0] > block.alpha[side]:
                    self.beyond += found
                else:
                    self.kept += self.beyond + found
                    self.beyond = []
        turned = [state[0] for state in motion.y_events[3]]
        self.peak = max([self.peak, *np.array([*turned, motion.y[0, -1]]) / block.alpha[side]])
        if motion.t_events[2].size:
            self.peak = np.inf
            return end, np.pi / 2, motion.y[1, -1], "fall"
        if motion.t_events[0].size:
            self.kept, self.beyond = self.kept + self.beyond, []
            return end, 0.0, motion.y[1, -1], "impact"
        return end, *motion.y[:, -1], ""


def random_blocks(random, count, two_sided, steepest=0.05):
    rows = []
    for _ in range(count):
        height = random.uniform(0.5, 2)
        width = 2 * height * random.uniform(0.15, 0.4)
        row = {"width": width, "height": 2 * height, "restitution": random.uniform(0.2, 0.5)}
        if two_sided:
            row |= {"center_offset": width * random.uniform(-0.15, 0.15), "center_height": height,
                    "radius_of_gyration": height * random.uniform(0.4, 0.8),
                    "incline": random.uniform(-1, 1) * min(steepest, 0.25 * width / height)}
        rows.append(row)
    return rows


def rocker_of(row):
    half, height = row["width"] / 2, row["height"] / 2
    offset = row.get("center_offset", 0.0)
    return Rocker(half - offset, half + offset, height, row.get("radius_of_gyration", np.hypot(half, height) / 3**0.5),
                  row.get("incline", 0.0), row["restitution"])


def sudden_pulse(name, length, shape, keys=""):
    """A pulse that begins at its peak: its keys, its strength over tan alpha, its ground acceleration and its pieces.
    length: of the pulse, in periods."""
    def strength(random, least):
        return {"pga": least * random.uniform(0.8, 6), "pulse_period": random.uniform(0.2, 1.2)}

    def ground(row):
        return lambda time: row["pga"] * shape(2 * np.pi * time / row["pulse_period"])
    return f'pulse = "{name}"\n{keys}', strength, ground, lambda row: [0, length * row["pulse_period"]]


def sudden_record(folder):
    """A record whose first sample is the largest one, as above."""
    times = np.arange(9) * 0.15
    samples = np.array([1, 0.9, -0.7, -0.8, 0.2, 0.6, -0.3, -0.5, 0])
    np.savetxt(folder / "sudden.txt", np.column_stack([times, samples]), header="time [s], acceleration [g]")

    def ground(row):
        return lambda time: row["scale"] * np.interp(time, times, samples)
    return ('record = "sudden.txt"\nunits = "g"', lambda random, least: {"scale": least * random.uniform(0.8, 6)},
            ground, lambda row: list(times))


@unittest.skipIf(solve_ivp is None, "SciPy is not installed")
class AContact(Scratch):
    def computed(self, scene, rows):
        """Writes a table of blocks and returns the fields of its points."""
        (self.folder / "t.csv").write_text("\n".join(
            [",".join(rows[0]), *(",".join(repr(float(value)) for value in row.values()) for row in rows)]))
        (self.folder / "job.toml").write_text(
            f'[scene]\n{scene}\ngravity = {G}\n[blocks]\ntable = "t.csv"\n[numerics]\nmethod = "taylor"\n'
            f'tolerance = 1e-11\n[output]\nfields = {list(FIELDS)}\n')
        (self.folder / "r.h5").unlink(missing_ok=True)
        self.assert_exit(self.overturn("run", "job.toml", "-o", "r.h5"), 0)
        with h5py.File(self.folder / "r.h5") as file:
            return {name: file[name][:].ravel() for name in FIELDS}

    def compare(self, scene, rows, ground_of, pieces_of):
        found = self.computed(scene, rows)
        compared = 0
        for number, row in enumerate(rows):
            follower = Follower(rocker_of(row), ground_of(row), pieces_of(row))
            if follower.demand is None or found["region"][number] >= 250:
                continue
            friction, normal = follower.demand
            compared += 1
            with self.subTest(row=row):
                self.assertEqual(found["status"][number] & 32, 32 * (normal <= 0))
                self.assertAlmostEqual(found["peak"][number], follower.peak, delta=1e-8)
                self.compare_state(follower, {name: values[number] for name, values in found.items()})
                self.assertAlmostEqual(found["normal"][number], normal, delta=1e-8)
                if np.isfinite(friction):
                    self.assertAlmostEqual(found["friction_demand"][number] / friction, 1, delta=1e-8 / min(normal, 1))
                else:
                    self.assertEqual(found["friction_demand"][number], np.inf)
        return compared

    def compare_state(self, follower, found):
        """Errors grow e-fold in each 1/p of a motion, and near the top without bound."""
        block = follower.block
        p = np.sqrt(G * block.radius[1] / block.moment[1])
        angle, velocity = follower.end
        self.assertAlmostEqual(found["angle"], angle, delta=1e-7)
        self.assertAlmostEqual(found["velocity"], velocity / p, delta=1e-7)
        self.assertEqual(found["impacts"], follower.impacts)
        if np.isfinite(follower.fallen):
            self.assertAlmostEqual(found["fall_time"], p * (follower.fallen - follower.lifted), delta=1e-6)
        else:
            self.assertEqual(found["fall_time"], np.inf)

    def compare_under_pulses(self, seed, count, two_sided):
        random = np.random.default_rng(seed)
        rows = random_blocks(random, count, two_sided)
        for row in rows:
            row |= {"pga": random.uniform(0.5, 3) * row["width"] / row["height"],
                    "pulse_period": random.uniform(0.4, 1.2)}

        def ground_of(row):
            return lambda time: row["pga"] * np.sin(2 * np.pi * time / row["pulse_period"])
        return self.compare('pulse = "one_sine"', rows, ground_of, lambda row: [0, row["pulse_period"]])

    def test_of_boxes_under_pulses_bears_what_scipy_finds(self):
        self.assertGreater(self.compare_under_pulses(1, 8, False), 6)

    def test_of_blocks_with_two_sides_under_pulses_bears_what_scipy_finds(self):
        self.assertGreater(self.compare_under_pulses(2, 16, True), 13)

    def compare_under_a_record(self, seed, count, two_sided):
        random = np.random.default_rng(seed)
        times = np.arange(16) * 0.15
        samples = np.concatenate([[0], random.normal(0, 1, 14), [0]])
        samples /= abs(samples).max()
        np.savetxt(self.folder / "r.txt", np.column_stack([times, samples]), header="time [s], acceleration [g]")
        rows = random_blocks(random, count, two_sided)
        for row in rows:
            row["scale"] = random.uniform(0.5, 3) * row["width"] / row["height"]

        def ground_of(row):
            return lambda time: row["scale"] * np.interp(time, times, samples)
        return self.compare('record = "r.txt"\nunits = "g"', rows, ground_of, lambda row: list(times))

    def test_of_boxes_under_a_record_bears_what_scipy_finds(self):
        self.assertGreater(self.compare_under_a_record(3, 10, False), 1)

    def test_of_blocks_with_two_sides_under_a_record_bears_what_scipy_finds(self):
        self.assertGreater(self.compare_under_a_record(4, 16, True), 2)

    def test_that_lifts_at_a_jump_bears_what_shenton_finds(self):
        k, accelerations = 4, np.array([1, 0.5, 0.26])  # k: height over width
        rows = [{"width": 0.5, "height": 2.0, "pulse_period": 0.4, "restitution": 0.8, "pga": a} for a in accelerations]
        found = self.computed('pulse = "rectangular"', rows)["friction_demand"]
        np.testing.assert_allclose(found, (accelerations * (4 + k**2) + 3 * k) / (4 * k**2 + 1 + 3 * k * accelerations),
                                   rtol=1e-14)

    def test_on_a_steep_base_that_lifts_at_a_jump_does_not_leave_it(self):
        rows = [{"width": 0.5, "height": 2.0, "incline": 0.2, "pulse_period": 0.02, "restitution": 0.5, "pga": 4.95,
                 "direction": direction} for direction in (180, 0)]
        found = self.computed('pulse = "rectangular"', rows)
        # Shenton's force on the inclined base, at the onset for direction 180.
        np.testing.assert_allclose(found["friction_demand"], [1.700, 0.636], atol=5e-4)
        self.assertAlmostEqual(found["normal"][0], 0.887, delta=5e-4)
        self.assertEqual(list(found["status"] & 32), [0, 0])

    def test_under_a_motion_that_begins_with_a_jump_bears_what_scipy_finds(self):
        count = int(os.environ.get("SUDDEN_ONSETS", 2))
        motions = [sudden_pulse("rectangular", 0.5, lambda phase: 1.0), sudden_pulse("one_cosine", 1, np.cos),
                   sudden_pulse("cosine", 2, np.cos, "cycles = 2"), sudden_record(self.folder)]
        compared = 0
        for number, (scene, strength, ground, pieces) in enumerate(motions):
            for two_sided in (False, True):
                random = np.random.default_rng((number, two_sided))
                rows = random_blocks(random, count, two_sided, steepest=0.2)
                for row in rows:
                    row |= strength(random, row["width"] / row["height"]) | {"direction": random.choice([0, 180])}

                def ground_of(row):
                    at, sign = ground(row), 1 if row["direction"] == 0 else -1
                    return lambda time: sign * at(time)
                compared += self.compare(scene, rows, ground_of, pieces)
        self.assertGreaterEqual(compared, 7 * count)


if __name__ == "__main__":
    unittest.main()
