"""overturn.risk.updated_weights: weights of the branches of a logic tree after the survival of blocks."""

import itertools
import unittest

import numpy as np
from tool import new_folder  # first: adds the package to the path
import overturn
from overturn import risk
from overturn.risk import Age
from risk_test import (AT_MEDIAN, BETA, CURVE, EXACT, K, MEDIAN, OPENQUAKE, PGA, UNDECIDED, S, bent, population,
                       power_law, result)
from scipy.special import ndtr

FACTORS = np.array([0.3, 1.0, 2.5])  # on the rates of the branches
PRIOR = np.array([0.2, 0.5, 0.3])
SAMPLES = np.exp(np.log([MEDIAN, BETA]) + np.random.default_rng(3).standard_normal((100, 2)) * 0.1)
SAMPLED = risk.lognormal(MEDIAN, BETA, samples=SAMPLES, **PGA)
SEVEN = 5e-7 / 3.343672  # of EXACT


def branches(factors=FACTORS):
    return [power_law().scaled(rate=factor) for factor in factors]


def uncertain(low=0.15, high=0.25):
    """A curve with bins in which nothing is known, and shares from low to high between."""
    return risk.binned([0.1, 0.4, 1.0, 4.0], [0.0, low, 0.7], [0.0, high, 0.75], **PGA)


class TheWeights(unittest.TestCase):
    def test_are_those_of_the_closed_form(self):
        rate = EXACT * FACTORS
        for age, survival in ((8000, np.exp(-8000 * rate)), (Age.samples([2000, 9000]), (
                np.exp(-2000 * rate) + np.exp(-9000 * rate)) / 2), (Age.uniform(2000, 9000), (
                    np.exp(-2000 * rate) - np.exp(-9000 * rate)) / (7000 * rate)),
                (Age(lambda rate: -np.log1p(rate * 5000), 3466, "exponential"), 1 / (1 + 5000 * rate))):
            found = risk.updated_weights(branches(), PRIOR, CURVE, age)
            exact = PRIOR * survival / (PRIOR @ survival)
            # Of rate T below 8, in the exponential, the error is 8 times that of the rate, and twice that of a ratio.
            np.testing.assert_allclose(found.posterior, [exact, exact], rtol=16 * SEVEN)
            np.testing.assert_allclose(found.survival, [survival, survival], rtol=8 * SEVEN)
            np.testing.assert_allclose(found.rate, [rate, rate], rtol=SEVEN)
            self.assertTrue(np.isnan(found.interval).all())
            self.assertIsNone(found.after_interval)

    def test_are_those_of_simulated_histories(self):
        # Branches are drawn by their prior weights and ages from their distribution; of the histories in which no
        # earthquake overturns the block, the shares of the branches are the posterior weights.
        random, count, hazard = np.random.default_rng(5), 60_000, bent()
        factors = np.array([0.01, 0.05, 0.2])
        drawn = random.choice(3, count, p=PRIOR)
        years = random.uniform(20, 2000, count)
        shakings = random.poisson(hazard.rate[0] * factors[drawn] * years)
        of_history = np.repeat(np.arange(count), shakings)
        exceeded = random.uniform(0, hazard.rate[0], len(of_history))
        within = exceeded > hazard.rate[-1]
        x = np.exp(np.interp(np.log(exceeded[within]), np.log(hazard.rate[:0:-1]), np.log(hazard.level[:0:-1])))
        fallen = np.unique(of_history[within][random.random(len(x)) < ndtr(np.log(x / 0.6) / 0.4)])
        left = np.bincount(np.delete(drawn, fallen), minlength=3)
        found = risk.updated_weights([hazard.scaled(rate=factor) for factor in factors], PRIOR,
                                     risk.lognormal(0.6, 0.4, **PGA), Age.uniform(20, 2000))
        # Four standard deviations of a share of n histories. The weights change by more than ten of them, and are those
        # of the mean age only within as many. Shaking outside the levels overturns less than 1e-3 of the blocks.
        share, n = left / left.sum(), left.sum()
        self.assertTrue((abs(share - found.posterior) < 4 * np.sqrt(share * (1 - share) / n) + 1e-3).all())
        self.assertTrue((abs(share - PRIOR) > 0.02).all())

    def test_do_not_depend_on_the_scale_of_the_prior_weights(self):
        found = risk.updated_weights(branches(), PRIOR, uncertain(), 8000)
        for scale in (1e-9, 7):
            scaled = risk.updated_weights(branches(), scale * PRIOR, uncertain(), 8000)
            np.testing.assert_allclose(scaled.posterior, found.posterior, rtol=1e-13)
            np.testing.assert_allclose(scaled.prior, PRIOR, rtol=1e-15)
            self.assertIn(f"the sum of the weights is {scale:.4g}; they are divided by it", scaled.notes)
        self.assertNotIn("the sum of the weights", found.summary())

    def test_of_equal_branches_remain_and_one_branch_keeps_all(self):
        found = risk.updated_weights(branches([2, 2, 2]), PRIOR, CURVE, 8000)
        np.testing.assert_allclose(found.posterior, [PRIOR, PRIOR], rtol=1e-12)
        one = risk.updated_weights(branches([1]), 0.4, uncertain(), 8000)
        np.testing.assert_array_equal(one.posterior, [[1], [1]])
        # A branch in two parts has the weight of one.
        parts = risk.updated_weights(branches([0.3, 1, 1, 2.5]), [0.2, 0.1, 0.4, 0.3], CURVE, 8000).posterior
        whole = risk.updated_weights(branches(), PRIOR, CURVE, 8000).posterior
        np.testing.assert_allclose(parts[:, 1:3].sum(axis=1), whole[:, 1], rtol=1e-12)

    def test_move_to_the_lower_rates_the_longer_the_blocks_have_stood(self):
        found = [risk.updated_weights(branches(), PRIOR, CURVE, years).posterior[0]
                 for years in (1, 1e3, 1e4, 1e5, 1e7)]
        np.testing.assert_allclose(found[0], PRIOR, atol=1e-3)  # rate T is below 1e-3
        for before, after in itertools.pairwise(found):
            self.assertTrue(after[0] >= before[0] and after[2] <= before[2])
        # Survival with all branches underflows: exp(-1e3). The ratio is exp(-0.7 1e7 rate) = 0.
        np.testing.assert_array_equal(found[-1], [1, 0, 0])
        # A spread of the age weakens the evidence of the same mean.
        spread = risk.updated_weights(branches(), PRIOR, CURVE, Age.samples([1e3, 19e3])).posterior[0]
        self.assertTrue(PRIOR[0] < spread[0] < found[2][0])

    def test_of_a_branch_that_overturns_nothing_grow_by_the_survival_of_the_others(self):
        weak = risk.Hazard([1e-3, 2e-3, 4e-3], [1e-9, 1e-12, 1e-20], **PGA)
        other = risk.Hazard([1e-3, 5.0], [1e-1, 1e-9], **PGA)
        found = risk.updated_weights([weak, other], [0.1, 0.9], CURVE, 3000)
        survival = np.exp(-3000 * risk.annual_rate(other, CURVE).rate[::-1])
        self.assertLess(found.rate[1, 0], 1e-12)  # below and above its levels
        np.testing.assert_allclose(found.posterior[:, 0], (0.1 / (0.1 + 0.9 * survival))[::-1], rtol=1e-8)

    def test_of_branches_without_weight_are_zero(self):
        found = risk.updated_weights(branches(), [0.5, 0, 0.5], SAMPLED, 8000)
        np.testing.assert_array_equal(found.posterior[:, 1], [0, 0])
        np.testing.assert_array_equal(found.interval[:, 1], [0, 0])

    def test_that_are_none_are_refused(self):
        for hazards, weights, words in (
                ([], [], "Give one or more branches"), (branches(), [0.5, 0.5], "a weight for each"),
                (branches(), [0.5, 0.6, -0.1], "must be 0 or more"), (branches(), [0, 0, 0], "with a positive sum"),
                (branches(), [1, np.nan, 1], "must be 0 or more"),
                ([power_law(), risk.Hazard([1, 2], [0.1, 0.01], "pgv", "m/s")], [1, 1], "the hazard is of pgv"),
                ([power_law(1e-4, 1), power_law(2, 1e4)], [1, 1], "one begins at 2 g, another one ends at 1 g")):
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, words):
                risk.updated_weights(hazards, weights, CURVE, 100)
        with self.assertRaisesRegex(ValueError, "years = 0"):
            risk.updated_weights(branches(), PRIOR, CURVE, 0)


class TheBounds(unittest.TestCase):
    def test_contain_the_weights_whatever_the_unknown_points_are(self):
        bounds = risk.updated_weights(branches(), PRIOR, uncertain(), Age.uniform(100, 3000))
        self.assertTrue((bounds.posterior[0] < bounds.posterior[1]).all())
        for share in (0.15, 0.19, 0.25):
            for last in (0.7, 0.75):
                truth = risk.updated_weights(branches(), PRIOR, risk.binned(
                    [0.1, 0.4, 1.0, 4.0], [0, share, last], **PGA), Age.uniform(100, 3000)).posterior
                self.assertTrue((bounds.posterior[0] <= truth[0]).all() and (truth[1] <= bounds.posterior[1]).all())
        self.assertIn("two numbers are bounds", bounds.summary())

    def test_are_those_of_all_ends_of_the_rates(self):
        found = risk.updated_weights(branches(), PRIOR, uncertain(), 3000)
        likelihoods = PRIOR * np.exp(-3000 * np.array(list(itertools.product(*found.rate.T))))
        each = likelihoods / likelihoods.sum(axis=1, keepdims=True)
        np.testing.assert_allclose(found.posterior, [each.min(axis=0), each.max(axis=0)], rtol=1e-12)
        for i in (1, 2, 3):  # of the levels of power_law()
            means = each @ [hazard.rate[i] for hazard in branches()]
            np.testing.assert_allclose([end.rate[i] for end in found.after], [means.min(), means.max()], rtol=1e-12)

    def test_of_a_branch_without_an_upper_end_of_the_rate_begin_at_0(self):
        # Below 0.3 g nothing is known; this curve is so steep that it may overturn at any rate.
        steep = risk.Hazard([0.3, 0.5, 4.0], [0.1, 1e-4, 1e-6], **PGA)
        flat = risk.Hazard([0.3, 0.31, 4.0], [1e-3, 1e-3, 1e-6], **PGA)
        fragility = risk.binned([0.3, 1, 4], [0.2, 0.9], **PGA)
        found = risk.updated_weights([steep, flat], [0.5, 0.5], fragility, 3000)
        self.assertEqual(found.rate[1, 0], np.inf)
        self.assertEqual(found.posterior[0, 0], 0)
        self.assertEqual(found.posterior[1, 1], 1)
        self.assertIn("1 of 2 rates have no upper end", found.summary())

    def test_of_points_without_a_verdict_are_never_those_of_safe_points(self):
        region, scale = population()
        safe = overturn.fragility(result(region, scale), "pga", bins=8, samples=1)
        region = np.where(np.random.default_rng(2).random(region.shape) < 0.1, UNDECIDED, region)
        curve = overturn.fragility(result(region, scale), "pga", bins=8, samples=1)
        found, known = (risk.updated_weights(branches(), PRIOR, each, 3000) for each in (curve, safe))
        self.assertTrue((found.posterior[0] < known.posterior[0]).all())
        self.assertTrue((found.posterior[1] > known.posterior[1]).all())


class TheConfidence(unittest.TestCase):
    def test_is_that_of_the_samples_under_all_branches_at_once(self):
        found = risk.updated_weights(branches(), PRIOR, SAMPLED, 8000)
        each = []
        for median, beta in SAMPLES:
            rate = AT_MEDIAN * (median / MEDIAN) ** -K * np.exp((K * beta) ** 2 / 2) * FACTORS
            likelihood = PRIOR * np.exp(-8000 * rate)
            each.append(likelihood / likelihood.sum())
        # Rates above 10,000 g, 4e-15 per year, are unknown.
        np.testing.assert_allclose(found.interval, np.quantile(each, [0.025, 0.975], axis=0), rtol=1e-8)
        means = np.array(each) @ [hazard.rate[2] for hazard in branches()]
        np.testing.assert_allclose([end.rate[2] for end in found.after_interval], np.quantile(means, [0.025, 0.975]),
                                   rtol=1e-8)


    def test_includes_the_bounds_of_the_samples(self):
        alike = risk.lognormal(MEDIAN, BETA, samples=[(MEDIAN, BETA)] * 20, edges=[0.3, 1.0], unknown=[0, 0.2], **PGA)
        found = risk.updated_weights(branches(), PRIOR, alike, 3000)
        self.assertTrue((found.posterior[0] < found.posterior[1]).all())
        np.testing.assert_allclose(found.interval, found.posterior, rtol=1e-14)


class TheMean(unittest.TestCase):
    def test_of_branches_of_other_levels_is_that_between_them(self):
        one, other = power_law(1e-2, 1e2, 5), power_law(1e-3, 10, 3).scaled(rate=3)
        found = risk.updated_weights([one, other], [0.25, 0.75], CURVE, 8000)
        self.assertEqual(found.before.level[[0, -1]].tolist(), [1e-2, 10])
        np.testing.assert_allclose(found.before.rate, AT_MEDIAN * (found.before.level / MEDIAN) ** -K * 2.5, rtol=1e-12)
        least = found.posterior[[1, 0], [0, 1]]  # much of the branch of the lower rates, little of the other one
        np.testing.assert_allclose(found.after[0].rate, AT_MEDIAN * (found.before.level / MEDIAN) ** -K
                                   * (least @ [1, 3]), rtol=1e-12)

    def test_of_plateaus_is_one(self):
        hazards = [bent().scaled(rate=factor) for factor in np.geomspace(0.01, 1, 19)]  # equal rates at two levels
        found = risk.updated_weights(hazards, np.ones(19), SAMPLED, 100)
        for mean in (found.before, *found.after, *found.after_interval):
            self.assertEqual(mean.rate[0], mean.rate[1])

    def test_is_told_at_return_periods(self):
        found = risk.updated_weights(branches(), PRIOR, CURVE, 8000)
        text = found.summary()
        for years in (475, 2475, 10_000):
            before, after = (MEDIAN * (AT_MEDIAN * years * factor) ** (1 / K)
                             for factor in (PRIOR @ FACTORS, found.posterior[0] @ FACTORS))
            self.assertIn(f"pga that is exceeded once in {years} years (mean hazard): {before:.4g} g before, "
                          f"{after:.4g} g after", text)


class TheSummary(unittest.TestCase):
    def test_has_a_row_for_each_branch(self):
        found = risk.updated_weights(branches(), PRIOR, SAMPLED, Age.uniform(1000, 3000))
        lines = found.summary().splitlines()
        self.assertRegex(lines[0], r"^branch +prior  posterior \(95 % confidence\) +rate \[1/year\]  survival$")
        self.assertRegex(lines[1], rf"^branch 1  0\.2 +{found.posterior[0, 0]:.4g} \(0\.\d+ to 0\.\d+\) +\d")
        self.assertIn(f"survival of 2000 years (uniform from 1000 to 3000) with the prior weights "
                      f"{found.survival[0] @ PRIOR:.4g}", lines)

    def test_says_that_no_branch_fits(self):
        self.assertIn("no branch gives the survival a probability above 4.4e-05: ",
                      risk.updated_weights(branches(), PRIOR, CURVE, 1e5).summary())
        self.assertNotIn("no branch", risk.updated_weights(branches(), PRIOR, CURVE, 1e4).summary())

    def test_is_written_as_a_table(self):
        found, path = risk.updated_weights(branches(), PRIOR, CURVE, 8000), new_folder(self.addCleanup) / "weights.csv"
        for _ in range(2):
            found.to_csv(path)
        header, *rows = [line.split(",") for line in path.read_text().splitlines()]
        self.assertEqual(header[:4], ["branch", "prior", "posterior_low", "posterior_high"])
        self.assertEqual([row[0] for row in rows], ["branch 1", "branch 2", "branch 3"])
        np.testing.assert_allclose([float(row[2]) for row in rows], found.posterior[0], rtol=5e-6)  # six digits
        self.assertEqual(rows[0][4:6], ["", ""])
        path.write_text("notes")
        with self.assertRaisesRegex(OSError, "is not a table of weights of branches"):
            found.to_csv(path)


class TwoMeasures(unittest.TestCase):
    def test_give_the_weights_of_their_marginal_probability(self):
        y = np.exp(0.5 * np.linspace(-8, 8, 33))

        def density(y, x):
            return np.exp(-(np.log(y) / 0.5) ** 2 / 2) / (y * 0.5 * np.sqrt(2 * np.pi)) * np.ones_like(x)
        curve = risk.marginal(lambda x, y: ndtr(np.log(x * y / MEDIAN) / BETA), density, y, **PGA)
        hazards = [hazard.scaled(level=0.3) for hazard in (power_law(1e-2, 1e2), bent())]
        found = risk.updated_weights(hazards, [0.5, 0.5], curve, 5000)
        exact = risk.updated_weights(hazards, [0.5, 0.5], risk.lognormal(MEDIAN, np.hypot(BETA, 0.5), **PGA), 5000)
        np.testing.assert_allclose(found.posterior, exact.posterior, rtol=1e-6)

    def test_of_a_result_have_a_confidence(self):
        region, scale = population()
        region[:, 0] = S  # so that weaker shaking is known to overturn nothing
        data = result(region, scale, np.repeat([1.0, 4.0], 15))
        curve = risk.binned_marginal(data, "pga", "pgv/pga", lambda y, x: np.ones_like(y * x) / 3, bins=(8, 2),
                                     samples=50)
        found = risk.updated_weights(branches([0.05, 0.2]), [0.5, 0.5], curve, 5000)
        self.assertTrue((found.interval[0] <= found.posterior[0]).all()
                        and (found.posterior[1] <= found.interval[1]).all())
        self.assertGreater(found.posterior[0, 0], 0.5)
        factor = risk.largest_factor(power_law(), curve, Age.uniform(1000, 9000), 0.05)
        self.assertTrue(factor.interval[0] < factor.bounds[0] <= factor.bounds[1] < factor.interval[1])


class AListOfBranches(unittest.TestCase):
    def setUp(self):
        self.folder = new_folder(self.addCleanup)
        (self.folder / "low.txt").write_text("# pga [g]\n0.1 0.01\n1 1e-4\n")
        (self.folder / "curves").mkdir()
        (self.folder / "curves/high.txt").write_text("# pga [g]\n0.1 0.03\n1 1e-3\n")

    def read(self, text, name="branches.csv", **how):
        (self.folder / name).write_text(text)
        return risk.read_branches(self.folder / name, **how)

    def test_names_weights_and_files(self):
        for text in ("# a tree\nweight,file\n0.3,low.txt\n0.7,curves/high.txt\n",
                     "File; notes; Weight\nlow.txt; ; 0,3\ncurves/high.txt; old; 0,7\n"):
            hazards, weights = self.read(text)
            self.assertEqual(weights.tolist(), [0.3, 0.7])
            self.assertEqual([hazard.rate[0] for hazard in hazards], [0.01, 0.03])
            self.assertEqual([hazard.source for hazard in hazards], ["low", "high"])
        hazards, _ = self.read("name,weight,file\nA,1,low.txt\n")
        self.assertEqual(hazards[0].source, "A")

    def test_may_be_that_of_openquake(self):
        for number in ("000", "001"):
            for measure in ("PGV", "PGA"):
                (self.folder / f"hazard_curve-rlz-{number}-{measure}_7.csv").write_text(
                    OPENQUAKE.read_text().replace("PGV", measure))
        text = "#,,\"generated_by='OpenQuake engine 3.13.0'\"\nrlz_id,branch_path,weight\n0,A~A,0.25\n1,A~B,0.75\n"
        hazards, weights = self.read(text, "realizations_7.csv", im="pgv", site=1)
        self.assertEqual(weights.tolist(), [0.25, 0.75])
        self.assertEqual([(hazard.source, hazard.im) for hazard in hazards], [("A~A", "pgv"), ("A~B", "pgv")])
        with self.assertRaisesRegex(ValueError, "realization 0 has curves of PGA, PGV. Choose one of them with im"):
            self.read(text, "realizations_7.csv", site=1)
        with self.assertRaisesRegex(ValueError, r"no file \"hazard_curve-rlz-000-\*_8.csv\" beside this list"):
            self.read(text, "realizations_8.csv", im="pgv", site=1)

    def test_is_refused_with_the_place(self):
        for text, words in (("0.1 0.01\n", "is no list of branches: a CSV"), ("weight\n1\n", "is no list"),
                            ("weight,file\n", "is no list"), ("", "is no list"),
                            ("weight,file\n1,low.txt\nmuch,low.txt\n", "csv:3: weight = \"much\" is not a number"),
                            ("weight,file\n1\n", "csv:2: 1 values, but 2 columns")):
            with self.subTest(text=text), self.assertRaisesRegex(ValueError, words):
                self.read(text)
        with self.assertRaisesRegex(FileNotFoundError, r"named in .*csv:2.*missing.txt"):
            self.read("weight,file\n1,missing.txt\n")


if __name__ == "__main__":
    unittest.main()
