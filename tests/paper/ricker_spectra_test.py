"""Statements of section 4.3 of the paper about the spectra of Ricker wavelets.

Regions I to VII are numbered as in the paper. Signs are equal: Eqs. 47, 48, 51, 53 and 54 push like
our pulses, so theta0 > 0 in the paper is theta0 > 0 here. Names with "but" describe where a
statement does not hold as printed. Counts in comments are for 150 x 150 points."""

import unittest

import numpy as np

from spectra import (COUNT, MOST, PRACTICALLY_ALL, history, largest_part, moved, share, spectrum,
                     touching)


class SymmetricRicker(unittest.TestCase):
    """Figures 14 and 15, with window = 1: one period to each side of the middle."""

    FIRST_SWING = np.exp(1.5) / 2  # least amplitude at which the first, smaller push lifts: 2.24
    TURN = np.sqrt(2)  # phase from the middle of the second change of sign

    def setUp(self):
        self.largest, self.smaller = spectrum("14a"), spectrum("14b")
        self.both = (self.largest, self.smaller)

    @staticmethod
    def region_i(one):
        return largest_part(one.of("U0-"))

    def test_region_I_is_adjacent_to_the_safe_regions_but_so_is_U0_plus_along_F_plus(self):
        for one in self.both:
            strip = largest_part(one.of("U0+"))  # mostly without any impact; not in the paper
            self.assertGreater(touching(one.safe, strip), COUNT / 3)
            self.assertGreater(touching(one.of("F+"), strip), COUNT / 3)
            self.assertGreater(share(one.impacts == 0, strip), MOST)
            self.assertGreater(touching(one.safe, self.region_i(one)), COUNT / 3)
            self.assertGreater(np.count_nonzero(self.region_i(one)), 0.05 * one.region.size)

    def test_region_I_ends_with_negative_angle_and_velocity_but_for_a_few_almost_at_rest(self):
        for one in self.both:
            i = self.region_i(one)
            self.assertLess(one.angle[i].max(), 0)
            self.assertGreater(share(one.velocity < 0, i), 0.98)  # 0.999 and 0.986
            # The others, just beyond alpha, move back too slowly to return over it.
            slow = i & (one.velocity >= 0)
            self.assertLess(one.angle[slow].max(), -one.slenderness)
            self.assertLess(one.velocity[slow].max(), 0.2 * one.slenderness)

    def test_region_I_has_a_single_impact_in_the_forced_stage_except_for_a_few_of_the_weakest_pulses(self):
        for one in self.both:
            i = self.region_i(one)
            self.assertGreater(share(one.impacts == 1, i), PRACTICALLY_ALL)  # 0.998 and 0.993
            # The first push does not lift the others, or so little that they bounce to rest.
            self.assertLess(one.amplitude[i & (one.impacts != 1)].max(), 1.1 * self.FIRST_SWING)

    def test_region_I_overturns_without_impact_in_the_free_stage(self):
        for figure, one in zip(("14a", "14b"), self.both):
            for place in one.sample(self.region_i(one), 9):
                with self.subTest(figure=figure, place=place):
                    self.assertEqual([kind for kind, _ in history(figure, *place).events[-2:]],
                                     ["end_of_pulse", "fall"])

    def phases_of_the_impact(self, region, count):
        """Returns phases from the middle of the wavelet, its peak; they do not depend on r."""
        found = []
        for frequency, amplitude in self.largest.sample(region, count):
            block = history("14a", frequency, amplitude)
            impact = block.times("impact")[0]
            found.append(frequency * (impact - block.end_of_pulse / 2))
        return np.array(found)

    def test_the_impact_is_between_the_peak_and_the_change_of_sign_but_later_if_strong(self):
        i = self.region_i(self.largest) & (self.largest.impacts == 1)
        weaker = self.phases_of_the_impact(i & (self.largest.amplitude < 13), 30)
        self.assertGreater(np.mean((0 < weaker) & (weaker < self.TURN)), 0.7)  # 0.83
        # At 0.7 r_max region I ends at 12.8; at r_max half of it is above. There the impact occurs
        # after the change of sign, before the trough at sqrt(6).
        stronger = self.phases_of_the_impact(i & (self.largest.amplitude > 17), 15)
        self.assertGreater(stronger.min(), self.TURN)
        self.assertLess(stronger.max(), np.sqrt(6))

    def test_the_output_of_region_I_depends_on_the_restitution(self):
        i = self.region_i(self.largest) & (self.largest.impacts == 1) & self.smaller.landed
        by = moved(*self.both)
        self.assertGreater(by[i].min(), 0)
        self.assertGreater(np.median(by[i]), 0.5 * self.largest.slenderness)

    def test_at_0_7_r_max_region_II_is_S_plus_and_considerably_wider(self):
        before, after = (np.count_nonzero(one.of("S+")) for one in self.both)  # 110 and 1131
        self.assertGreater(after, 5 * before)
        ii = largest_part(self.smaller.of("S+"))
        self.assertGreater(share(ii, self.smaller.of("S+")), 0.95)  # 0.988
        self.assertLess(self.smaller.angle[ii].max(), 0)
        self.assertGreater(self.smaller.velocity[ii].min(), 0)
        # The blade itself, in phase space: 0.31 and 0.75 of theta'_max at -alpha.
        height = [np.sqrt(-one.q_min / one.q_max) for one in self.both]
        self.assertGreater(height[1], 2 * height[0])

    def test_at_0_7_r_max_both_the_output_and_the_blade_change_the_spectrum(self):
        def in_the_blade(landing, of):
            """S+ with the forced stage of one spectrum and the blade of another."""
            return (landing.landed & (landing.angle < 0) & (landing.velocity > 0)
                    & (landing.q0 < 0) & (landing.q0 >= of.q_min))

        for one in self.both:
            np.testing.assert_array_equal(in_the_blade(one, one), one.of("S+"))
        largest, smaller = self.both
        neither = np.count_nonzero(in_the_blade(largest, largest))  # 110
        blade = np.count_nonzero(in_the_blade(largest, smaller))  # 158
        landing = np.count_nonzero(in_the_blade(smaller, largest))  # 659
        together = np.count_nonzero(in_the_blade(smaller, smaller))  # 1131
        self.assertGreater(blade, 1.2 * neither)
        self.assertGreater(landing, 1.2 * neither)
        self.assertGreater(together, 1.5 * max(blade, landing))


class AntisymmetricRicker(unittest.TestCase):
    """Figures 16 and 17, with window = 1: one period to each side of the middle."""

    # The least amplitude at which the first, smaller push lifts: 3.68.
    CREST = np.sqrt(3 + np.sqrt(6))
    FIRST_SWING = 1.38 / (CREST * np.sqrt(6) * np.exp(-CREST**2 / 2))

    def setUp(self):
        self.both = (spectrum("16a"), spectrum("16b"))

    def strong(self, one):
        return one.amplitude > self.FIRST_SWING

    @staticmethod
    def region_i(one):
        return largest_part(one.of("U0-"))

    def region_ii(self, one):
        return largest_part(one.of("U0+") & self.strong(one))

    def test_has_two_unsafe_regions_but_for_a_lobe_of_pulses_whose_first_push_does_not_lift(self):
        for one in self.both:
            regions = self.region_i(one) | self.region_ii(one)
            unsafe = one.of("U0+", "U0-", "U1+", "U1-")
            self.assertGreater(share(regions, unsafe & self.strong(one)), 0.98)
            self.assertGreater(np.count_nonzero(self.region_ii(one)), 0.003 * one.region.size)
            # The lobe starts to the other side, so it is U0+ after one impact.
            lobe = largest_part(one.of("U0+") & ~self.strong(one))
            self.assertGreater(np.count_nonzero(lobe), 0.003 * one.region.size)
            self.assertGreater(share(one.impacts == 1, lobe), PRACTICALLY_ALL)

    def test_region_I_is_U0_minus_after_a_single_impact_but_for_one_point_in_fifty(self):
        for one in self.both:
            i = self.region_i(one)
            self.assertGreater(share(one.impacts == 1, i), 0.98)  # 0.992 and 0.982
            self.assertLess(one.angle[i].max(), 0)
            # The first push does not lift the others, or so little that they bounce to rest; or
            # they have two more impacts, the last one just before the end, next to region II.
            weakest = one.amplitude < 1.1 * self.FIRST_SWING
            others = i & (one.impacts != 1)
            self.assertGreater(share(weakest, others), 0.8)
            self.assertLessEqual(set(one.impacts[others & ~weakest]), {3})

    def test_region_II_has_two_impacts_in_the_forced_stage_and_is_U0_plus(self):
        for one in self.both:
            self.assertGreater(share(one.impacts == 2, self.region_ii(one)), PRACTICALLY_ALL)
            self.assertGreater(one.angle[self.region_ii(one)].min(), 0)

    def test_regions_I_and_II_overturn_without_impact_in_the_free_stage(self):
        for figure, one in zip(("16a", "16b"), self.both):
            for region in (self.region_i(one), self.region_ii(one)):
                for place in one.sample(region, 9):
                    with self.subTest(figure=figure, place=place):
                        self.assertEqual([kind for kind, _ in history(figure, *place).events[-2:]],
                                         ["end_of_pulse", "fall"])

    def test_region_II_needs_a_window_longer_than_one_period_in_total(self):
        # Half a period to each side, as allowed by T_f <= T_p: no strong pulse is U0+.
        for figure in ("16a", "16b"):
            short = spectrum(figure, "scene.window=0.5")
            self.assertFalse(short.of("U0+")[self.strong(short)].any())


if __name__ == "__main__":
    unittest.main()
