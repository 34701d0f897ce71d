"""overturn.risk: hazard curves, annual rates of overturning, survival and what follows from them."""

import dataclasses
import pathlib
import unittest

import numpy as np
from tool import new_folder  # first: adds the package to the path
import overturn
import xarray
from overturn import risk
from scipy.special import ndtr

PGA = {"im": "pga", "units": "g"}
MEDIAN, BETA, K, AT_MEDIAN = 0.7018, 0.6215, 2.5, 1e-4
EXACT = 3.343672e-4  # per year: lambda(median) exp(k^2 beta^2 / 2)
CURVE = risk.lognormal(MEDIAN, BETA, **PGA)
# Written by OpenQuake 3.26.2 for a point source, two sites and an investigation time of 50 years; PGV in cm/s.
OPENQUAKE = pathlib.Path(__file__).parent / "hazards/hazard_curve-mean-PGV.csv"
S, F, UNDECIDED = 0, 8, 254


def power_law(first=1e-4, last=1e4, levels=5):
    level = np.geomspace(first, last, levels)
    return risk.Hazard(level, AT_MEDIAN * (level / MEDIAN) ** -K, **PGA)


def bent():
    """Slopes from 0 to 30, as the plateaus and the ends of hazard curves have."""
    return risk.Hazard([0.05, 0.1, 0.2, 0.5, 1.0, 1.1, 3.0], [0.2, 0.2, 0.06, 4e-3, 2e-4, 1.15e-5, 1e-7], **PGA)


def steep():
    return risk.Hazard([0.1, 0.5], [1.0, 1e-40], **PGA)  # a slope of 57


def between_levels(hazard, median, beta):
    """The integral between the first and the last level, in closed form: by parts in each interval."""
    z, k = np.log(hazard.level / median) / beta, hazard.slope
    at_median = hazard.rate[:-1] * (median / hazard.level[:-1]) ** -k
    sign = np.where(z[:-1] + k * beta > 0, -1, 1)  # of the tail of Phi that is not near 1
    phi = sign * (ndtr(sign * (z[1:] + k * beta)) - ndtr(sign * (z[:-1] + k * beta)))
    whole = at_median * np.exp((k * beta) ** 2 / 2) * phi
    return (whole - np.diff(ndtr(z) * hazard.rate)).sum()


def result(region, scale, ratio=1.0):
    """A result as overturn.open returns it: region (motion, scale, block), records of 1 g."""
    region = np.asarray(region, np.uint8)
    flags = {"flag_values": np.uint8([0, 8, 254, 255]), "flag_meanings": "S F_minus undecided not_computed"}
    motions = np.ones(len(region))
    return xarray.Dataset({"region": (("motion", "scale", "block"), region, flags)}, {
        "motion": np.arange(1.0, len(region) + 1), "scale": np.asarray(scale, float),
        "block": np.arange(1.0, region.shape[2] + 1), "pgv": ("motion", motions * ratio, {"units": "m s-1"}),
        "record_pga": ("motion", motions, {"units": "1"})})


def population(seed=1):
    """30 motions, 8 scales, 40 blocks of lognormal capacity."""
    random = np.random.default_rng(seed)
    scale = np.geomspace(0.2, 4, 8)
    capacity = 0.9 * np.exp(0.3 * random.standard_normal((30, 1, 1)) + 0.3 * random.standard_normal((30, 1, 40)))
    return np.where(capacity <= scale[:, None], F, S), scale


class TheRate(unittest.TestCase):
    def test_of_a_power_law_and_a_lognormal_curve_is_the_closed_form(self):
        for levels in (2, 5, 200):
            found = risk.annual_rate(power_law(levels=levels), CURVE)
            # Six digits of the reference. The bounds differ by what is above 10,000 g, 4e-15.
            np.testing.assert_allclose(found.rate, EXACT, rtol=5e-7 / 3.343672)
            np.testing.assert_allclose(found.survival(10_000), 0.0353071, rtol=0, atol=5e-8)

    def test_is_exact_for_every_slope_of_the_hazard(self):
        for hazard, median, beta in ((bent(), 0.4, 0.02), (bent(), 1.0, 0.12), (bent(), 0.3, 0.25),
                                     (steep(), 0.12, 0.3)):
            found = risk.annual_rate(hazard, risk.lognormal(median, beta, **PGA))
            exact = between_levels(hazard, median, beta)
            # The error of the integral is below 2e-15 of the first rate, at most 1; sums of about 1,000 terms round by
            # 1e-13 at most. The closed form subtracts P lambda, of at most 0.3 per year.
            np.testing.assert_allclose(found.contribution[:, 1:-1].sum(axis=1), exact, rtol=2e-13, atol=2e-15)
            self.assertLess(found.error, 2e-15 + 2e-13 * exact)

    def test_of_binned_shares_is_the_sum_over_the_bins(self):
        edges, share = np.array([0.08, 0.3, 0.7, 2.0]), np.array([0.1, 0.4, 0.9])
        found = risk.annual_rate(bent(), risk.binned(edges, share, **PGA))
        rate = bent().at(edges)
        low, high = (share * -np.diff(rate)).sum(), 0.1 * (0.2 - rate[0])
        np.testing.assert_allclose(found.rate, [low + 0.9 * rate[-1], low + high + rate[-1]], rtol=1e-12)
        # The bound of the error is 2e-15 of the first rate, 1; sums round by less than 1e-13.
        found = risk.annual_rate(steep(), risk.binned([0.05, 0.6], [0.3], **PGA))
        np.testing.assert_allclose(found.contribution[:, 1], 0.3, rtol=1e-13)

    def test_is_that_of_a_million_simulated_years(self):
        random, hazard, years = np.random.default_rng(1), bent(), 10**6
        exceeded = random.uniform(0, hazard.rate[0], random.poisson(years * hazard.rate[0]))
        within = exceeded[exceeded > hazard.rate[-1]]
        # Where lambda(x) is the drawn rate. The plateau from 0.05 to 0.1 g has no earthquakes.
        x = np.exp(np.interp(np.log(within), np.log(hazard.rate[:0:-1]), np.log(hazard.level[:0:-1])))
        fallen = (random.random(len(x)) < ndtr(np.log(x / 0.4) / 0.4)).sum()
        found = risk.annual_rate(hazard, risk.lognormal(0.4, 0.4, **PGA)).contribution[0, 1:-1].sum()
        # Four standard deviations of a Poisson number of about 10,000: 4 %. Straight lines between the levels, not in
        # logarithms, would give 80 % more.
        self.assertGreater(fallen, 5000)
        self.assertAlmostEqual(fallen / years, found, delta=4 * np.sqrt(found / years))

    def test_has_the_interval_of_the_samples(self):
        curve = overturn.fragility(result(*population()), "pga", samples=200)
        found = risk.annual_rate(power_law(), curve)
        median, beta = curve.samples.T
        rates = AT_MEDIAN * (median / MEDIAN) ** -K * np.exp((K * beta) ** 2 / 2)
        # What is above the last level, 4e-15 per year of about 1e-4, differs between the bounds.
        np.testing.assert_allclose(found.interval, np.quantile(rates, [0.025, 0.975]), rtol=1e-9)
        self.assertTrue(found.interval[0] < found.rate[0] < found.interval[1])
        np.testing.assert_allclose(found.survival_interval(100), np.exp(-100 * found.interval[::-1]))
        of_bins = risk.annual_rate(power_law(), risk.shares_of(curve)).rate  # without an upper bound
        self.assertIn(f"without the fit, from the shares in the 10 bins of the fragility: {of_bins[0]:.4g} or more "
                      "a year", found.summary())
        self.assertTrue(np.isnan(risk.annual_rate(power_law(), CURVE).interval).all())

    def test_without_an_interval_warns_if_it_depends_on_the_fit(self):
        curve = overturn.fragility(result(*population()), "pga", bins=40, samples=50)
        other = dataclasses.replace(curve, median=1.5 * curve.median)
        for fragility, is_certain, warns in ((curve, False, False), (other, False, True), (other, True, False)):
            samples = curve.samples if is_certain else np.empty((0, 2))
            text = risk.annual_rate(bent(), dataclasses.replace(fragility, samples=samples)).summary()
            self.assertEqual("warning: the rates with and without the fit differ by a factor of" in text, warns, text)

    def test_with_an_interval_warns_if_the_shares_are_outside_of_it(self):
        curve = overturn.fragility(result(*population()), "pga", bins=40, samples=50)
        for factor in (1, 3):
            other = dataclasses.replace(curve, median=factor * curve.median, samples=curve.samples * [factor, 1])
            self.assertEqual("without the fit is outside the confidence interval" in risk.annual_rate(bent(), other).summary(),
                             factor > 1)

    def test_is_refused_for_another_measure_or_another_unit(self):
        for im, units in (("pgv", "m/s"), ("pga", "m/s2")):
            hazard = risk.Hazard([0.1, 1], [0.1, 1e-3], im, units)
            for compute, arguments in ((risk.annual_rate, ()), (risk.largest_factor, (50, 0.5))):
                with self.assertRaisesRegex(ValueError, rf"the hazard is of {im} \[.*\], the fragility of pga \[g\]"):
                    compute(hazard, CURVE, *arguments)
        with self.assertRaisesRegex(TypeError, "float is not a fragility"):
            risk.annual_rate(power_law(), 0.5)


class TheBounds(unittest.TestCase):
    def test_contain_what_a_short_hazard_curve_leaves_out(self):
        for first, last in ((0.3, 1e4), (1e-4, 1.5), (0.3, 1.5)):
            found = risk.annual_rate(power_law(first, last), CURVE)
            low, high = found.rate
            self.assertLess(low, EXACT)
            self.assertGreaterEqual(high, EXACT * (1 - 1e-6))
            # The hazard continues below the first level as in its first interval: the bound is exact.
            below = between_levels(power_law(1e-8, first), MEDIAN, BETA)
            np.testing.assert_allclose(found.contribution[:, 0], [0, below], rtol=1e-10, atol=1e-20)
            at_last = AT_MEDIAN * (last / MEDIAN) ** -K
            p_last = ndtr(np.log(last / MEDIAN) / BETA)
            np.testing.assert_allclose(found.contribution[:, -1], [p_last * at_last, at_last])
            most = f"{found.contribution[1, 0]:.3g}"
            self.assertIn(f"below the first level of the hazard, pga = {first:.4g} g: at most {most} a year",
                          found.summary())
            self.assertIn(f"above the last level, pga = {last:.4g} g: ", found.summary())

    def test_have_no_upper_end_if_even_the_weakest_bin_overturns(self):
        found = risk.annual_rate(power_law(0.3, 10), risk.binned([0.3, 1, 10], [0.2, 0.9], **PGA))
        self.assertEqual(found.rate[1], np.inf)
        self.assertEqual(found.survival(50)[0], 0)
        self.assertIn("pga = 0.3 g: unbounded", found.summary())
        self.assertIn("the rate has no upper end: if the hazard continued", found.summary())
        flat = risk.Hazard([0.3, 0.5, 10], [0.1, 0.1, 1e-4], **PGA)  # nothing is weaker than its first level
        self.assertEqual(risk.annual_rate(flat, risk.binned([0.3, 1, 10], [0.2, 0.9], **PGA)).contribution[1, 0], 0)

    def test_have_no_upper_end_if_weak_shaking_would_overturn_more_often_than_the_first_level_is_exceeded(self):
        steep = risk.Hazard([0.02, 0.05, 4], [47, 0.03, 1e-8], **PGA)  # below 0.02 g, x^-8
        samples = [(1.5, 0.5)] * 90 + [(3.0, 2.0)] * 10  # the latter would overturn 1e40 times a year
        found = risk.annual_rate(steep, risk.lognormal(1.5, 0.5, samples=samples, **PGA))
        self.assertLess(found.rate[1], 1e-3)
        self.assertEqual(found.interval[1], np.inf)
        self.assertIn("or more)", found.summary())
        self.assertIn("the confidence has no upper end", found.summary())
        self.assertIn("than this level is exceeded, 47 a year, in some samples", found.summary())
        self.assertNotIn("upper end", risk.annual_rate(power_law(), CURVE).summary())

    def test_of_bins_without_points_are_those_of_their_neighbours(self):
        shares = risk.binned([0.1, 0.2, 0.4, 0.8, 1.6, 3], [np.nan, 0.3, np.nan, 0.2, np.nan], **PGA)
        np.testing.assert_array_equal(shares.at(np.array([0.15, 0.3, 0.6, 1, 2]))[0],
                                      [[0, 0.3, 0.2, 0.2, 0.3], [0.2, 0.3, 0.3, 0.2, 1]])

    def test_of_samples_have_no_upper_end_if_too_many_have_none(self):
        def at(x, lost):
            high = np.where(np.arange(101)[:, None] > 100 - lost, 1.0, ndtr(np.log(x / MEDIAN) / BETA))
            return np.stack([0 * high, high], axis=1)
        for lost, is_finite in ((1, True), (4, False)):  # of 100; 2.5 may be above the interval
            found = risk.annual_rate(power_law(), risk.Probability(lambda x: at(x, lost), **PGA, breaks=np.empty(0)))
            self.assertEqual(np.isfinite(found.interval[1]), is_finite)
            self.assertEqual(found.interval[0], 0)

    def test_contain_the_rate_if_points_had_a_verdict(self):
        region, scale = population()
        edges = np.geomspace(0.15, 5, 9)
        hidden = {"any": np.ones(region.shape, bool), "overturning": region == F, "safe": region == S}
        for which, points in hidden.items():
            few = np.where(points & (np.random.default_rng(2).random(region.shape) < 0.1), UNDECIDED, region)
            curve = overturn.fragility(result(few, scale), "pga", bins=8, samples=1)
            total = curve.points + curve.without_verdict
            shares = [exceeding / total for exceeding in (curve.exceeding, curve.exceeding + curve.without_verdict)]
            low, high = risk.annual_rate(bent(), risk.binned(edges, *shares, **PGA)).rate
            whole = (region == F).reshape(30, 8, 40).mean(axis=(0, 2))
            truth = risk.annual_rate(bent(), risk.binned(edges, whole, **PGA)).rate
            self.assertTrue(low <= truth[0] * (1 + 1e-12) and truth[1] <= high * (1 + 1e-12), which)
            self.assertLess(low, high, which)
            fitted = risk.annual_rate(bent(), curve)
            self.assertIn("points without a verdict", fitted.summary())
            if which == "any":
                low, high = fitted.rate
                truth = risk.annual_rate(bent(), overturn.fragility(result(region, scale), "pga", samples=1)).rate
                self.assertTrue(low < truth[0] and truth[1] < high)

    def test_of_a_fit_are_as_wide_as_the_share_without_a_verdict(self):
        region, scale = population()
        region[:, 3, :8] = UNDECIDED  # a fifth of the points at 0.72 g
        curve = overturn.fragility(result(region, scale), "pga", bins=8, samples=1)
        low, high = risk.probability_of(curve).at(np.array([0.1, 0.72, 1.8, 9.0]))[0]
        fitted = ndtr(np.log(np.array([0.1, 0.72, 1.8, 9.0]) / curve.median) / curve.beta)
        np.testing.assert_allclose(high - low, [0, 0.2, 0, 0], atol=1e-15)
        np.testing.assert_allclose(low, fitted * [1, 0.8, 1, 1], rtol=1e-14)
        region[:, -1] = UNDECIDED  # all points above 2.6 g: outside the data, nothing is known
        curve = overturn.fragility(result(region, scale), "pga", bins=8, samples=1)
        low, high = risk.probability_of(curve).at(np.array([1.8, 3.0]))[0]
        np.testing.assert_allclose(high - low, [0, 1], atol=1e-15)

    def test_are_not_those_of_shaking_outside_the_data_which_is_mentioned(self):
        inside = np.diff([between_levels(power_law(1e-4, end), MEDIAN, BETA) for end in (0.6, 0.8)])[0]
        outside = risk.annual_rate(power_law(), risk.lognormal(MEDIAN, BETA, edges=[0.6, 0.8], unknown=[0, 0], **PGA))
        self.assertIn(f"{100 * (1 - inside / EXACT):.3g} % of the rate is from shaking outside the data of the "
                      "fragility, pga = 0.6 to 0.8 g", outside.summary())
        np.testing.assert_allclose(outside.rate, EXACT, rtol=2e-7)
        self.assertNotIn("outside the data", risk.annual_rate(power_law(), CURVE).summary())

    def test_of_a_curve_without_a_fit_are_those_of_its_bins(self):
        region = np.full((12, 4, 5), S)
        region[:, 2:], region[:, 1, :2] = F, UNDECIDED
        curve = overturn.fragility(result(region, [0.25, 0.5, 1, 2]), "pga", bins=3, samples=1)
        self.assertTrue(np.isnan(curve.median))  # bins of 0.25 to 0.5, 0.5 to 1 and 1 to 2 g
        at = bent().at([0.5, 1, 2])
        found = risk.annual_rate(bent(), curve).contribution[:, 1:-1].sum(axis=1) - bent().rate[-1]
        np.testing.assert_allclose(found[0], at[1] - 2 * bent().rate[-1], rtol=1e-12)
        self.assertGreater(found[1], at[0] * 0.4)
        with self.assertRaisesRegex(ValueError, "no point of this fragility curve has a verdict"):
            risk.annual_rate(bent(), overturn.fragility(result(np.full((3, 2, 2), UNDECIDED), [1, 2]), "pga"))


class TheSite(unittest.TestCase):
    def test_of_equal_blocks_has_the_rate_of_one_and_of_opposite_ones_their_sum(self):
        region = np.full((12, 3, 3), S)
        region[:6, 1:, :2] = F  # blocks 1 and 2 under the same motions, block 3 under the others
        region[6:, 1:, 2] = F
        data = result(region, [0.25, 0.5, 1])

        def rate(*blocks):
            curve = overturn.fragility(data.isel(block=list(blocks)), "pga", together="block", bins=2, samples=1)
            return risk.annual_rate(bent(), risk.binned(curve.edges, curve.fraction, **PGA)).contribution[0, 1:-1].sum()
        self.assertEqual(rate(0, 1), rate(0))
        # Independent fates would give 3/4 of the motions, not all.
        last = bent().at(1.0) - bent().rate[-1]  # above the bins, the last share
        self.assertAlmostEqual(rate(0, 2), rate(0) + rate(2), delta=1e-12 * last)


class TheDisaggregation(unittest.TestCase):
    def test_sums_to_one(self):
        for hazard in (power_law(), power_law(0.3, 1.5), bent()):
            for edges in (None, [0.2, 0.9], []):
                found = risk.annual_rate(hazard, CURVE, edges=edges)
                np.testing.assert_allclose(found.disaggregation.sum(axis=1), 1, rtol=1e-14)
                self.assertEqual(found.disaggregation.shape, (2, len(found.edges) - 1))

    def test_is_the_closed_form_below_each_intensity(self):
        edges = np.array([0.1, 0.4, 1.3])
        found = risk.annual_rate(power_law(), CURVE, edges=edges)
        exact = [between_levels(power_law(1e-4, edge), MEDIAN, BETA) for edge in edges]
        np.testing.assert_allclose(np.cumsum(found.contribution[0])[1:4], exact, rtol=1e-10)
        np.testing.assert_array_equal(found.edges, [0, 1e-4, *edges, 1e4, np.inf])


class TheFactor(unittest.TestCase):
    def test_on_the_rates_and_on_the_levels_is_the_closed_form(self):
        years, survival = 10_000, 0.2
        on_rates = -np.log(survival) / (EXACT * years)
        for on, exact in (("rate", on_rates), ("level", on_rates ** (1 / K))):
            found = risk.largest_factor(power_law(), CURVE, years, survival, on)
            np.testing.assert_allclose(found.bounds, exact, rtol=2e-7)  # of EXACT, which has seven digits
            scaled = power_law().scaled(**{on: found.bounds[0]})
            # The root is known to 1e-12 in its logarithm, the survival to k ln(survival) times this.
            np.testing.assert_allclose(risk.annual_rate(scaled, CURVE).survival(years), survival, rtol=1e-9)

    def test_has_the_interval_of_the_rate(self):
        curve = overturn.fragility(result(*population()), "pga", samples=100)
        rate, level = (risk.largest_factor(power_law(), curve, 1000, 0.5, on) for on in ("rate", "level"))
        np.testing.assert_allclose(level.interval, rate.interval ** (1 / K), rtol=1e-9)
        self.assertTrue(rate.interval[0] < rate.bounds[0] <= rate.bounds[1] < rate.interval[1])

    def test_is_infinite_if_all_earthquakes_together_are_too_rare(self):
        flat = risk.Hazard([0.1, 0.2, 1], [1e-6, 1e-6, 1e-8], **PGA)
        self.assertEqual(risk.largest_factor(flat, CURVE, 1000, 0.05, "level").bounds.tolist(), [np.inf] * 2)
        self.assertTrue(np.isfinite(risk.largest_factor(flat, CURVE, 1000, 0.05).bounds).all())

    def test_is_refused_without_a_probability_or_a_time(self):
        for arguments, words in (((50, 1.0), "survival = 1.0 is not between 0 and 1"), ((0, 0.5), "years = 0"),
                                 ((50, 0.5, "pga"), "on = 'pga' is neither")):
            with self.assertRaisesRegex(ValueError, words):
                risk.largest_factor(power_law(), CURVE, *arguments)


class TwoMeasures(unittest.TestCase):
    MEAN, POWER = -0.3, 0.8  # of ln y; of y in P(x, y)
    beta, spread = BETA, 0.5  # of ln x in P(x, y), of ln y

    def density(self, y, x):
        z = (np.log(y) - self.MEAN) / self.spread
        return np.exp(-z * z / 2) / (y * self.spread * np.sqrt(2 * np.pi))  # whatever x

    def probability(self, x, y):
        return ndtr(np.log(x * y**self.POWER / MEDIAN) / self.beta)

    def marginal(self, *ends):
        y = np.exp(self.MEAN + self.spread * np.linspace(*ends, 33))
        return risk.marginal(self.probability, self.density, y, **PGA)

    def test_of_lognormal_laws_give_a_lognormal_curve(self):
        for self.beta, self.spread in ((BETA, 0.5), (0.1, 0.1)):
            found = risk.annual_rate(power_law(1e-2, 1e2), self.marginal(-8, 8))
            median, beta = MEDIAN * np.exp(-self.POWER * self.MEAN), np.hypot(self.beta, self.POWER * self.spread)
            exact = risk.annual_rate(power_law(1e-2, 1e2), risk.lognormal(median, beta, **PGA))
            # The density has 1.2e-15 outside; of the rate of all shaking, 4.1 per year, this is 1.6e-11 of the result.
            # Panels of 0.25 are twice the smaller beta, 0.13: 6e-31 (0.25 (2.7 / 0.13 + 2.5))^20 = 1e-15 of the rate.
            np.testing.assert_allclose(found.rate, exact.rate, rtol=2e-11)
            self.assertLess(found.error, 2e-11 * found.rate[0])

    def test_bound_the_rate_if_the_density_is_known_in_part(self):
        hazard = power_law(1e-2, 1e2)
        found, whole = (risk.annual_rate(hazard, self.marginal(-8, end)).contribution[:, 1:-1].sum(axis=1)
                        for end in (0, 8))
        self.assertTrue(found[0] < whole[0] < found[1])
        self.assertAlmostEqual(found[1] - found[0], 0.5 * (hazard.rate[0] - hazard.rate[-1]), delta=1e-10)

    def test_refuse_what_is_no_density(self):
        for density in (lambda y, x: 2 * self.density(y, x), lambda y, x: -self.density(y, x)):
            with self.assertRaisesRegex(ValueError, "is negative, or its integral over y, .*, is above 1"):
                risk.annual_rate(power_law(), risk.marginal(self.probability, density, [0.01, 0.1, 1, 10], **PGA))

    def test_of_a_result_are_binned(self):
        ratio = np.repeat([1.0, 4.0], 10)  # PGV/PGA; only motions of 4 overturn, from 0.5 g on
        region = np.full((20, 3, 2), S)
        region[10:, 1:] = F
        data = result(region, [0.25, 0.5, 1], ratio)
        hazard, rate = bent(), bent().at([0.5, 1.0])

        def uniform(y, x):
            return np.ones_like(y * x) / 3

        def shares(bins, data=data, density=uniform):
            found = risk.binned_marginal(data, "pga", "pgv/pga", density, bins=bins, samples=50)
            return found.at(np.array([0.3, 0.7]))
        # The bins of y are from 1 to 2, with 1/3 of the density, and from 2 to 4.
        for row in shares((2, 2)):
            np.testing.assert_allclose(row, [[0, 2 / 3], [0, 2 / 3]], atol=1e-14)
        self.assertEqual(len(shares((2, 2))), 51)
        # Half of the density is outside the bins of y.
        half = shares((2, 2), density=lambda y, x: uniform(y, x) / 2)[0]
        np.testing.assert_allclose(half, [[0, 1 / 3], [1 / 2, 5 / 6]], atol=1e-14)
        # In a bin without points nothing is known: 1.26 to 2.52 and 2.52 to 4 of four bins of 3.
        edges = 4 ** (np.arange(4) / 3)
        low, empty = np.array([0, (4 - edges[2]) / 3]), (edges[2] - edges[1]) / 3
        np.testing.assert_allclose(shares((2, 3))[0], [low, low + empty], atol=1e-14)
        region[0, 2, 0] = UNDECIDED
        low, high = shares((2, 2), result(region, [0.25, 0.5, 1], ratio))[0]
        np.testing.assert_allclose(high - low, [0, 1 / 40 / 3], atol=1e-14)
        curve = risk.binned_marginal(data, "pga", "pgv/pga", uniform, bins=(2, 2))
        found = risk.annual_rate(hazard, curve, edges=[0.5, 1])
        np.testing.assert_allclose(found.contribution[0, 2], 2 / 3 * (rate[0] - rate[1]), rtol=1e-12)


    def test_of_a_plane_are_those_of_its_fit(self):
        region, scale = population()
        ratio = np.exp(0.3 * np.random.default_rng(3).standard_normal(30))
        y = np.geomspace(ratio.min(), ratio.max(), 41)
        plane = overturn.fragility_plane(result(region, scale, ratio), samples=20)
        x = np.geomspace(0.1, 9, 7)
        found = risk.marginal(plane, self.uniform(ratio))
        of_function = risk.marginal(plane.probability, self.uniform(ratio), y, **PGA)
        np.testing.assert_allclose(found.at(x)[0], of_function.at(x)[0], rtol=1e-9)
        self.assertEqual((found.im, found.units, found.at(x).shape, found.data), ("pga", "g", (21, 2, 7), (0.2, 4.0)))
        region[:, 3, :8] = UNDECIDED  # a fifth of the points at one scale
        few = overturn.fragility_plane(result(region, scale, ratio), bins=(8, 1), samples=20)
        low, high = risk.marginal(few, self.uniform(ratio)).at(np.array([0.1, 1.01 * scale[3], 3.0, 9.0]))[0]
        np.testing.assert_allclose(high - low, [0, 0.2, 0, 0], atol=1e-12)
        with self.assertRaisesRegex(ValueError, "this plane has no fit"):
            risk.marginal(overturn.fragility_plane(result(region, scale)), self.uniform(ratio))

    def uniform(self, ratio):
        """The density of a ratio that is uniform in the logarithm between the extremes."""
        first, last = ratio.min(), ratio.max()
        return lambda y, x: np.where((first <= y) & (y <= last), 1 / (y * np.log(last / first)), 0) + 0 * x

    def test_of_a_result_count_an_object_once(self):
        region, scale = population()
        several = result(region[..., [0, 1, 2, 0, 1, 2]], scale).assign_coords(azimuth_of=("block", [1, 2, 2, 3, 4, 4]))
        either = np.where((region[..., [1]] == F) | (region[..., [2]] == F), F, S)
        blocks = result(np.concatenate([region[..., [0]], either] * 2, axis=2), scale)

        def at(data):
            found = risk.binned_marginal(data, "pga", "pgv", self.density, bins=(5, 5), samples=20)
            return found.at(np.geomspace(0.2, 4, 9))
        np.testing.assert_array_equal(at(several), at(blocks))

    def test_of_pooled_samples_of_an_object_is_refused(self):
        region, scale = population()
        samples = result(region[..., [0, 1, 2]], scale).assign_coords(
            azimuth_of=("block", [1, 1, 2]), sample=("block", [0, 1, 0]))
        curve, plane = overturn.fragility(samples, "pga", samples=1), overturn.fragility_plane(samples, samples=1)
        hazard = risk.Hazard([0.01, 10], [1, 1e-6], **PGA)
        for compute in (lambda: risk.annual_rate(hazard, curve), lambda: risk.shares_of(curve),
                        lambda: risk.largest_factor(hazard, curve, 100, 0.5),
                        lambda: risk.updated_weights([hazard], [1], curve, 100),
                        lambda: risk.marginal(plane, self.density),
                        lambda: risk.binned_marginal(samples, "pga", "pgv", self.density, samples=1),
                        lambda: risk.annual_rate(hazard, overturn.fragility(samples, "pga", together="azimuth_of",
                                                                            samples=1))):
            with self.assertRaisesRegex(ValueError, "pools the samples .* the mean of the survival of each sample"):
                compute()
        one = samples.isel(block=samples["sample"].values == 0)  # of both objects
        self.assertTrue(np.isfinite(risk.annual_rate(hazard, overturn.fragility(one, "pga", samples=1)).rate).all())


class TheHazard(unittest.TestCase):
    def setUp(self):
        self.folder = new_folder(self.addCleanup)

    def read(self, text, **how):
        path = self.folder / "hazard.txt"
        path.write_text(text)
        return risk.read_hazard(path, **how)

    def refuses(self, words, compute, *arguments, **how):
        with self.assertRaisesRegex(ValueError, words):
            compute(*arguments, **how)

    def test_is_read_from_two_columns(self):
        for text, how in (("# pga [g], site A\n0.1 0.02\n\n1, 1e-4\n", {}), ("0.1\t0.02\n1 1e-4", PGA),
                          ("% notes\n10,0.02\n100,1e-4\n", {"im": "pga", "units": "%g"})):
            found = self.read(text, **how)
            np.testing.assert_allclose(found.level, [0.1, 1])
            self.assertEqual((found.im, found.units, found.rate.tolist()), ("pga", "g", [0.02, 1e-4]))
        self.assertAlmostEqual(found.at(np.sqrt(0.1)) / np.sqrt(0.02 * 1e-4), 1, delta=1e-14)  # rounding
        self.assertTrue(np.isnan(found.at([0.09, 1.1])).all())

    def test_is_read_from_openquake(self):
        lines = OPENQUAKE.read_text().splitlines()
        for site, levels in ((0, 20), (1, 15)):
            found = risk.read_hazard(OPENQUAKE, site=site)
            probability = np.array(lines[2 + site].split(",")[3:], float)
            # The probabilities return. Those of the second site are zero from the 16th level on.
            np.testing.assert_allclose(1 - np.exp(-50 * found.rate), probability[:levels], rtol=1e-7)
            self.assertFalse(probability[levels:].any())
            np.testing.assert_allclose(found.level[[0, 14]], [0.01, 0.668724509], rtol=1e-7)  # cm/s in the file
            self.assertEqual((found.im, found.units), ("pgv", "m s-1"))
        self.assertEqual(risk.read_hazard(OPENQUAKE, site=0, im="pgv_rotd50").im, "pgv_rotd50")
        older = '# kind="mean", investigation_time=1.0,imt="SA(0.3)"\nlon,lat,depth,poe-0.1,poe-0.4\n'
        found = self.read(older + "0,0,0,4.5E-01,5.5E-02\n", im="sa03")
        self.assertEqual((found.im, found.units, found.rate[0]), ("sa03", "g", -np.log1p(-0.45)))

    def test_of_openquake_is_refused_if_it_is_not_one_curve_of_rates(self):
        text = OPENQUAKE.read_text()
        for site in (None, 2, -1):
            self.refuses(r"has 2 sites \(lon, lat, depth\): 0 \(15.0+, 40.10+, 0.0+\), 1 .* Choose one with site = 0 "
                         "to 1", risk.read_hazard, OPENQUAKE, site=site)
        self.refuses("txt:3: the probability of exceeding 1 in 50 years is 1. .*fewer years", self.read,
                     text.replace("3.909152E-01", "1.000000E+00"), site=0)
        for im in ("pga", "pga_rotd50"):
            self.refuses(f"states the measure pgv, not {im}", self.read, text, site=0, im=im)
        self.refuses("states the unit cm/s, not m/s", self.read, text, site=0, units="m/s")
        self.refuses("does not state the unit", self.read, text.replace("PGV", "CAV"), site=0)
        self.refuses("is not an output of hazard curves", self.read, text.replace("poe-", "PGV-"), site=0)
        self.refuses("txt:3: could not convert", self.read, text.replace("3.909152E-01", "-"), site=0)

    def test_of_text_that_is_not_one_of_annual_rates_is_refused_with_the_conversion(self):
        rows = "0.1 1e-2\n0.5 1e-3\n"
        of_years = "rate = -ln(1 - probability) / {}"
        comments = {
            **{f"probability of exceedance {word} {years} {unit}": of_years.format(years)
               for word, years, unit in (("in", 50, "years"), ("in", 475, "yr"), ("within", 10, "yrs"),
                                         ("during", 100, "years"), ("over", 2.5, "years"), ("in", 1, "year"))},
            "PoE in 50 years": of_years.format(50), "PE_in_50_years": of_years.format(50),
            "exceedance in 50 years": of_years.format(50), "10 % in 50 y": of_years.format(50),
            "50-year exceedance": of_years.format(50), "POE": of_years.format("years"),
            "probability of exceedance": of_years.format("years"), "exceedance probabilities": of_years.format("years"),
            "AEP": of_years.format("years"), "annual probability of exceedance": of_years.format("years"),
            **{name: "rate = 1 / return period" for name in (
                "return period [years]", "Return Periods", "return_period", "RP", "mean recurrence interval",
                "recurrence interval (yr)", "MRI [years]", "return-time", "MRP")}}
        self.assertGreaterEqual(len(comments), 20)
        for words, conversion in comments.items():
            for comment in (f"# pga [g], {words}\n", f"# pga [g]\n% {words.upper()}\n"):
                with self.subTest(comment=comment), self.assertRaises(ValueError) as raised:
                    self.read(comment + rows)
                self.assertIn(conversion, str(raised.exception))
                self.assertIn(f":{comment.count(chr(10))}: the comment", str(raised.exception))

    def test_of_text_may_say_that_it_is_one_of_annual_rates(self):
        for comment in ("annual rate of exceedance", "annual frequency of exceedance", "rate [1/year]", "AFE",
                        "exceedances per year", "per 1 year", "catalogue of 1900 to 2000, updated every 5 years",
                        "events per annum", "site RP1, approved", "logic tree: 12 branches", "Vs30 = 800 m/s"):
            with self.subTest(comment=comment):
                self.assertEqual(list(self.read(f"# pga [g], {comment}\n0.1 1e-2\n0.5 1e-3\n").rate), [1e-2, 1e-3])

    def test_of_text_is_refused_if_it_is_not_understood(self):
        self.refuses('txt:2: "0.1" is not two numbers', self.read, "# pga [g]\n0.1\n")
        self.refuses('txt:1: "level rate" is not two numbers', self.read, "level rate\n0.1 1\n")
        self.refuses("does not state the measure of its levels", self.read, "0.1 0.1\n1 0.01\n")
        self.refuses("states the unit g, not m/s2", self.read, "# pga [g]\n0.1 0.1\n1 0.01\n", im="pga", units="m/s2")
        self.refuses("Omit the site", self.read, "# pga [g]\n0.1 0.1\n1 0.01\n", site=0)
        self.refuses("two or more levels", self.read, "# pga [g]\n")

    def test_that_is_no_curve_is_refused(self):
        for level, rate, words in (
                ([0.1], [0.1], "two or more levels"), ([0.1, 0.2], [0.1], "two or more levels"),
                ([0.1, 0.2, 0.2], [3, 2, 1], r"level\[2\] = 0.2 is not above level\[1\] = 0.2"),
                ([0.1, 0.2, 0.3], [0.1, 0.2, 0.01], r"rate\[1\] = 0.2 is above rate\[0\] = 0.1"),
                ([0.1, 0.2], [0.1, 0.0], r"rate\[1\] = 0 is not a positive number"),
                ([0.0, 0.2], [0.1, 0.01], r"level\[0\] = 0 is not a positive number"),
                ([0.1, 0.2], [0.1, np.nan], r"rate\[1\] = nan is not a positive number")):
            self.refuses(words, risk.Hazard, level, rate, **PGA)

    def test_is_met_by_a_curve_that_is_one(self):
        self.refuses("median = 0.5 and beta = 0", risk.lognormal, 0.5, 0, **PGA)
        self.refuses("2 edges and .* shares", risk.binned, [0.1, 0.2], [0.1, 0.2], **PGA)
        self.refuses("edges must be positive, ascend", risk.binned, [0.2, 0.1], [0.1], **PGA)
        self.refuses("0 <= low <= high <= 1", risk.binned, [0.1, 0.2], [0.3], [0.2], **PGA)


if __name__ == "__main__":
    unittest.main()
