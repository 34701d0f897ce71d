"""Statements of section 4 of the paper about its block, its pulses and all of its spectra.

Regions I to VII are numbered as in the paper. Signs are equal: Eqs. 47, 48, 51, 53 and 54 push like
our pulses, so theta0 > 0 in the paper is theta0 > 0 here. Names with "but" describe where a
statement does not hold as printed. Counts in comments are for 150 x 150 points."""

import unittest

import numpy as np

from spectra import history, largest_part, moved, spectrum

FIGURES = ("07a", "09a", "09b", "11a", "11b", "14a", "14b", "16a", "16b")
PULSES = ("07a", "11a", "14a", "16a")  # one of each, at r = r_max


class TheBlock(unittest.TestCase):
    """Printed numbers are correct to half a unit of their last digit."""

    def setUp(self):
        self.block = spectrum("07a")

    def test_has_half_a_diagonal_of_5_758_m_and_p_of_1_13_per_second(self):
        self.assertEqual((self.block.half_width, self.block.half_height), (1, 5.67))
        radius = np.hypot(self.block.half_width, self.block.half_height)
        self.assertAlmostEqual(radius, 5.758, delta=0.0005)
        self.assertAlmostEqual(np.sqrt(3 * 9.81 / (4 * radius)), 1.13, delta=0.005)

    def test_has_a_slenderness_of_0_175_or_10_degrees(self):
        self.assertAlmostEqual(self.block.slenderness, 0.175, delta=0.0005)
        self.assertAlmostEqual(np.degrees(self.block.slenderness), 10, delta=0.5)

    def test_has_a_largest_restitution_of_0_912(self):
        self.assertAlmostEqual(self.block.restitution, 0.912, delta=0.0005)
        largest = (1 - 1.5 * np.sin(self.block.slenderness) ** 2) ** 2
        self.assertAlmostEqual(self.block.restitution, largest, delta=1e-15)


class ThePulses(unittest.TestCase):
    """At frequency 3 and amplitude 8."""

    def block(self, figure):
        return history(figure, 3.0, 8.0, samples=2000)

    def assert_ground(self, block, shape):
        """Compares the ground acceleration over g with 8 tan(alpha) shape; the last sample before
        the end of the pulse and those after it are excluded."""
        shaking = block.time < 0.999 * block.end_of_pulse
        expected = 8 * np.tan(block.slenderness) * shape
        np.testing.assert_allclose(block.ground[shaking], expected[shaking], rtol=0, atol=1e-12)

    def test_one_sine_is_equation_48_and_rocking_starts_at_the_phase_psi(self):
        block = self.block("07a")
        self.assert_ground(block, np.sin(block.phase))
        self.assertAlmostEqual(3 * block.times("uplift")[0], np.arcsin(1 / 8), delta=1e-12)

    def test_one_sine_forces_the_block_for_two_pi_less_psi(self):
        block = self.block("07a")
        duration = block.end_of_pulse - block.times("uplift")[0]
        self.assertAlmostEqual(duration, (2 * np.pi - np.arcsin(1 / 8)) / 3, delta=1e-12)

    def test_one_cosine_is_equation_51_and_forces_the_block_for_its_whole_period(self):
        block = self.block("11a")
        self.assert_ground(block, np.cos(block.phase))
        self.assertEqual(block.times("uplift")[0], 0)
        self.assertAlmostEqual(block.end_of_pulse, 2 * np.pi / 3, delta=1e-12)

    def test_symmetric_ricker_is_equation_53(self):
        block = self.block("14a")
        square = block.phase_from_the_middle**2 / 2  # 2 pi^2 t^2 / T_p^2
        self.assert_ground(block, (1 - square) * np.exp(-square / 2))

    def test_antisymmetric_ricker_is_equation_54_and_1_38_makes_its_maximum_a_p(self):
        block = self.block("16a")
        z = block.phase_from_the_middle / np.sqrt(3)
        self.assert_ground(block, (z**2 - 3) * z * np.exp(-z**2 / 2) / 1.38)
        highest = max(abs(block.ground)) / (8 * np.tan(block.slenderness))
        self.assertAlmostEqual(highest, 1, delta=0.005 / 1.38)  # the digits of 1.38

    def test_wavelets_start_rocking_at_the_first_instant_above_g_tan_alpha(self):
        for figure in ("14a", "16a"):
            with self.subTest(figure):
                block = self.block(figure)
                uplift = block.times("uplift")[0]
                threshold = np.tan(block.slenderness)
                self.assertLessEqual(max(abs(block.ground[block.time < uplift])), threshold)
                after = abs(block.ground[block.time > uplift][:10])
                self.assertGreater(max(after), threshold)


class TheForcedStage(unittest.TestCase):
    def test_follows_equation_47_from_zero_initial_conditions(self):
        for figure in PULSES:
            with self.subTest(figure):
                block = history(figure, 3.0, 4.0, samples=4000)
                before = block.time <= block.times("uplift")[0]
                self.assertFalse(block.angle[before].any() or block.velocity[before].any())
                tilt = np.sign(block.angle) * block.slenderness - block.angle
                acceleration = -(np.sin(tilt) + block.ground * np.cos(tilt))
                # From sample to sample; at events, where theta = 0, the acceleration is
                # discontinuous.
                step = np.diff(block.time)
                gained = np.diff(block.velocity)
                expected = step * (acceleration[1:] + acceleration[:-1]) / 2
                rocking = (block.angle[1:] != 0) & (block.angle[:-1] != 0)
                compared = rocking & (step > 0) & (block.time[1:] < block.end_of_pulse)
                self.assertGreater(np.count_nonzero(compared), 100)
                # The error of the trapezoidal rule is step^2 / 12 times the curvature of the
                # acceleration: 3e-6 at steps of 2e-3. A wrong sign of any term changes 0.1.
                wrong = abs(gained - expected)[compared] / step[compared]
                self.assertLess(wrong.max(), 1e-5)

    def test_lasts_at_most_a_period_but_two_for_wavelets(self):
        # The paper states T_f <= T_p for all pulses, and no end of wavelets. Within one period (a
        # window of 0.5) the symmetric one would be cut off at a third of its peak, and the
        # antisymmetric one would lose its first and last push.
        for figure, periods in zip(PULSES, (1, 1, 2, 2)):
            with self.subTest(figure):
                block = history(figure, 3.0, 8.0)
                length = block.end_of_pulse - block.times("uplift")[0]
                self.assertLessEqual(length, periods * 2 * np.pi / 3)
                self.assertGreater(length, (periods - 1) * 2 * np.pi / 3)

    def test_agrees_with_another_solver(self):
        for figure in PULSES:
            with self.subTest(figure):
                one, other = spectrum(figure), spectrum(figure, "numerics.method=taylor")
                np.testing.assert_array_equal(one.region, other.region)
                self.assertLess(moved(one, other).max(), 1e-4 * one.slenderness)
                self.assertGreater(moved(one, other).max(), 0)


class AllSpectra(unittest.TestCase):
    def test_have_the_same_block_except_for_restitution(self):
        # The caption of figure 10 has 1 degree, unlike the text and figure 9: a misprint.
        for figure, part in zip(FIGURES, (1, 0.85, 0.7, 1, 0.7, 1, 0.7, 1, 0.7)):
            with self.subTest(figure):
                found, block = spectrum(figure), spectrum("07a")
                self.assertEqual(found.slenderness, block.slenderness)
                self.assertAlmostEqual(found.restitution, part * block.restitution, delta=1e-15)

    def test_rock_nowhere_below_g_tan_alpha_and_everywhere_above(self):
        for figure in FIGURES:
            with self.subTest(figure):
                found = spectrum(figure)
                weak = found.amplitude < 0.999  # 1.38 in Eq. 54 makes the peak 1.0001
                self.assertGreater(weak.mean(), 0.02)
                self.assertTrue(found.of("S")[weak].all())
                for still in (found.angle, found.velocity, found.impacts, found.peak):
                    self.assertFalse(still[weak].any())
                self.assertTrue(found.rocked[found.amplitude > 1].all())

    def test_overturn_during_the_pulse_exactly_where_the_angle_is_a_quarter_turn(self):
        for figure in FIGURES:
            with self.subTest(figure):
                found = spectrum(figure)
                lying = abs(found.angle) >= np.pi / 2
                np.testing.assert_array_equal(lying, found.of("F+", "F-"))

    def test_are_safe_where_equation_20_holds_at_the_end_of_the_pulse(self):
        for figure in FIGURES:
            with self.subTest(figure):
                found = spectrum(figure)
                angle, q0 = found.angle, found.q0
                blade = (abs(angle) <= np.pi / 2) & (angle * found.velocity < 0) & \
                        (found.q_min <= q0) & (q0 <= 0)
                rhomboid = (abs(angle) <= found.slenderness) & (0 <= q0) & (q0 <= found.q_max)
                ended = ~found.of("F+", "F-")
                np.testing.assert_array_equal((blade | rhomboid)[ended], found.safe[ended])
                np.testing.assert_array_equal(rhomboid[ended], found.of("S")[ended])
                np.testing.assert_array_equal((blade & ~rhomboid)[ended],
                                              found.of("S+", "S-")[ended])

    def fate(self, figure, place):
        """Returns the events after the pulse, and whether the block overturns during it."""
        block = history(figure, *place)
        after = [kind for kind, time in block.events if time > block.end_of_pulse]
        during = [kind for kind, time in block.events if time <= block.end_of_pulse]
        return after, "fall" in during

    def assert_fate(self, names, fits):
        """Checks five points of each region, in the spectrum with the most of it."""
        for name in names:
            figure = max(FIGURES, key=lambda one: np.count_nonzero(spectrum(one).of(name)))
            found = spectrum(figure)
            for place in found.sample(largest_part(found.of(name)), 5):
                with self.subTest(name, figure=figure, place=place):
                    self.assertTrue(fits(*self.fate(figure, place)))

    def test_overturn_without_impact_in_the_free_stage_where_light_yellow(self):
        self.assert_fate(("U0+", "U0-"), lambda after, fell: after == ["fall"])

    def test_overturn_after_a_single_impact_in_the_free_stage_where_dark_yellow(self):
        self.assert_fate(("U1+", "U1-"), lambda after, fell: after == ["impact", "fall"])

    def test_overturn_during_the_forced_stage_where_grey(self):
        self.assert_fate(("F+", "F-"), lambda after, fell: fell)

    def test_never_overturn_where_green_or_dark_green(self):
        self.assert_fate(("S", "S+", "S-"),
                         lambda after, fell: not fell and "fall" not in after)


if __name__ == "__main__":
    unittest.main()
