"""overturn.risk.Age: survival over an age that is a distribution."""

import unittest

import numpy as np
from tool import new_folder  # first: adds the package to the path
from overturn import risk
from overturn.risk import Age
from risk_test import CURVE, EXACT, K, power_law
from scipy.special import ndtr

RATES = np.array([1e-12, 1e-7, 1e-5, 1e-4, 3e-4, 1e-3, 1e-2, 0.3])  # survival from 1 to 1e-300 for ages of 2,000 years


def exponential(mean):
    return Age(lambda rate: -np.log1p(rate * mean), mean * np.log(2), f"{mean:g} years (exponential)")


def integrated(density, low, high, rates):
    """The mean of exp(-rate T) by 400 panels of 20 nodes."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    ends = np.linspace(low, high, 401)
    t = (ends[:-1, None] + np.diff(ends)[:, None] * (1 + nodes) / 2).ravel()
    mass = density(t) * np.tile(weights, 400) * (ends[1] - ends[0]) / 2
    return np.exp(-np.multiply.outer(rates, t)) @ mass


class AnAge(unittest.TestCase):
    ALL = {"fixed": Age.samples(10_000), "samples": Age.samples([500, 2000, 9000], [0.2, 0.5, 0.3]),
           "uniform": Age.uniform(0, 4000), "quantiles": Age.quantiles([0, 0.025, 0.5, 0.975, 1], [1, 2, 3, 5, 9]),
           "normal": Age.normal(2000, 500), "lognormal": Age.lognormal(2000, 0.4), "interval": Age.interval(1e3, 1e5),
           "exponential": exponential(5000)}

    def test_survives_without_shaking_and_not_forever(self):
        for name, age in self.ALL.items():
            with self.subTest(age=name):
                np.testing.assert_array_equal(np.exp(age.log_survival([0, np.inf])), [1, 0])
                self.assertTrue(np.isnan(age.log_survival(np.nan)))
                self.assertEqual(age.log_survival(np.full((3, 1, 2), 1e-4)).shape, (3, 1, 2))

    def test_survives_less_probably_the_higher_the_rate_and_more_than_its_mean(self):
        for name, age in self.ALL.items():
            with self.subTest(age=name):
                log = age.log_survival(RATES)
                self.assertTrue((np.diff(log) < 0).all())
                # S is convex, and so is ln S: it lies above its tangent at 0, -mean rate. The mean is known to
                # 1e-6 from a rate of 1e-12, whose ln S, above 1e-12, rounds to 1e-16 of 1.
                mean = -log[0] / RATES[0]
                self.assertTrue((log >= -mean * RATES * (1 + 1e-3)).all())

    def test_has_a_rate_at_which_it_survives_with_a_probability(self):
        for name, age in self.ALL.items():
            for probability in (0.999, 0.5, 0.05, 1e-6):
                with self.subTest(age=name, probability=probability):
                    # The root is known to 1e-14 in its logarithm; d ln S / d ln rate is at most ln S of the fixed age.
                    np.testing.assert_allclose(np.exp(age.log_survival(age.rate(probability))), probability, rtol=1e-12)

    def test_that_is_known_exactly_gives_an_exponential(self):
        np.testing.assert_array_equal(Age.samples(2000).log_survival(RATES), -2000 * RATES)

    def test_of_samples_is_their_weighted_mean_whatever_the_scale_of_the_weights(self):
        exact = 0.25 * np.exp(-1000 * RATES) + 0.75 * np.exp(-300 * RATES)
        for weights in ([0.25, 0.75], [1, 3], [1e6, 3e6]):
            np.testing.assert_allclose(np.exp(Age.samples([1000, 300], weights).log_survival(RATES)), exact, rtol=1e-13)
        np.testing.assert_allclose(Age.samples([1000, 300, 300, 300]).log_survival(RATES), np.log(exact), rtol=1e-13,
                                   atol=1e-15)

    def test_between_two_ends_is_the_closed_form(self):
        low, high, rates = 1000, 5000, RATES[2:]
        exact = (np.exp(-rates * low) - np.exp(-rates * high)) / (rates * (high - low))
        # The closed form loses 1 / (rate width) = 25 of 1e-16, exp(ln S) loses -ln S < 310.
        np.testing.assert_allclose(np.exp(Age.uniform(low, high).log_survival(rates)), exact, rtol=1e-13)
        # It is the mean of those of its halves; and of ages near each other.
        halves = Age.quantiles([0, 0.5, 1], [1000, 3000, 5000])
        np.testing.assert_allclose(halves.log_survival(RATES), Age.uniform(low, high).log_survival(RATES), rtol=1e-13,
                                   atol=1e-15)
        np.testing.assert_allclose(Age.uniform(1000, 1000 * (1 + 1e-12)).log_survival(RATES), -1000 * RATES, rtol=1e-11)

    def test_of_a_normal_distribution_has_no_ages_below_0(self):
        for mean, deviation in ((2000, 500), (2000, 2000), (100, 1000)):
            def density(t, mean=mean, deviation=deviation):
                z = (t - mean) / deviation
                return np.exp(-z * z / 2) / (deviation * np.sqrt(2 * np.pi) * ndtr(mean / deviation))
            high = mean + 9 * deviation  # beyond are 1e-19
            exact = integrated(density, 0, high, RATES[:-2])
            np.testing.assert_allclose(np.exp(Age.normal(mean, deviation).log_survival(RATES[:-2])), exact, rtol=1e-13)
        # Far below all ages, S falls as density(0) / rate, with a relative error of mean / (rate deviation^2) = 1e-6.
        self.assertAlmostEqual(np.exp(Age.normal(100, 1000).log_survival(100.0)) / (density(0.0) / 100), 1, delta=2e-6)

    def test_of_a_lognormal_distribution_is_known_to_rounding(self):
        z, step = np.linspace(-25, 9, 30001, retstep=True)  # earlier ages count for less than 1e-130, later for 1e-19
        mass = step * np.exp(-z * z / 2) / np.sqrt(2 * np.pi)
        for sigma, rates in ((0.1, RATES[:-1]), (0.5, RATES), (1.0, RATES), (2.0, RATES)):
            exact = np.exp(-np.multiply.outer(rates, 2000 * np.exp(sigma * z))) @ mass
            # For improbable survival, exponents of 100 round by 1e-14.
            np.testing.assert_allclose(np.exp(Age.lognormal(2000, sigma).log_survival(rates)), exact, rtol=1e-13)
            # Only the product of the rate and the median counts.
            np.testing.assert_allclose(Age.lognormal(2000, sigma).log_survival(RATES),
                                       Age.lognormal(20, sigma).log_survival(100 * RATES), rtol=1e-13, atol=1e-15)
        # Without scatter, it is known exactly: exp(-x exp(s z)) has the mean exp(-x) (1 + s^2 (x^2 - x) / 2 + ...).
        np.testing.assert_allclose(Age.lognormal(2000, 1e-8).log_survival(RATES), -2000 * RATES, rtol=1e-11, atol=4e-15)

    def test_of_an_interval_has_the_rest_on_both_sides(self):
        age = Age.interval(1000, 9000)
        self.assertAlmostEqual(age.median, 3000, delta=1e-9)
        sigma = np.log(3) / 1.959963984540054
        np.testing.assert_allclose(age.log_survival(RATES), Age.lognormal(3000, sigma).log_survival(RATES), rtol=1e-13,
                                   atol=1e-15)

    def test_says_what_it_is(self):
        for name, text in (("fixed", "10000 years"), ("samples", "2000 years (3 samples, 95 % from 500 to 9000)"),
                           ("uniform", "2000 years (uniform from 0 to 4000)"),
                           ("quantiles", "3 years (95 % from 2 to 5)"),
                           ("normal", "2000 years (normal, standard deviation 500)"),
                           ("lognormal", "2000 years (lognormal, sigma 0.4)"),
                           ("interval", "10000 years (lognormal, 95 % from 1000 to 100000)")):
            self.assertEqual(self.ALL[name].text, text)

    def test_is_refused_if_it_is_none(self):
        for words, make, *arguments in (
                ("years = 0 is not a positive number", Age.samples, 0), ("years = .* is not", Age.samples, [1, np.nan]),
                ("2 ages have 3 weights", Age.samples, [1, 2], [1, 1, 1]),
                ("one or more of them positive", Age.samples, [1, 2], [0, 0]),
                ("each 0 or more", Age.samples, [1, 2], [-1, 2]), ("each 0 or", Age.samples, [1, 2], [np.nan, 2]),
                ("must be 0 or more, and ascend", Age.uniform, 2, 1), ("must be 0 or more", Age.uniform, -1, 1),
                ("must ascend from 0 to 1", Age.quantiles, [0.1, 1], [1, 2]),
                ("must ascend from 0 to 1", Age.quantiles, [0, 1], [1, 2, 3]),
                ("deviation = 0", Age.normal, 5, 0), ("mean = -1", Age.normal, -1, 1),
                ("median = inf", Age.lognormal, np.inf, 1), ("sigma = 0", Age.lognormal, 1, 0),
                ("low = 3 is not below high = 2", Age.interval, 3, 2), ("low = 0", Age.interval, 0, 2)):
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, words):
                make(*arguments)


class ReadAges(unittest.TestCase):
    def read(self, text):
        path = new_folder(self.addCleanup) / "ages.txt"
        path.write_text(text)
        return risk.read_age(path)

    def test_have_one_or_two_columns(self):
        for text, age in (("# cal BP\n900\n\n1100\n", Age.samples([900, 1100])),
                          ("900, 0.2\n1100\t0.8\n", Age.samples([900, 1100], [1, 4]))):
            found = self.read(text)
            np.testing.assert_array_equal(found.log_survival(RATES), age.log_survival(RATES))
            self.assertEqual(found.text, age.text)

    def test_are_refused_with_the_place(self):
        for text, words in (("900\nold\n", r"ages.txt:2: \"old\" is not an age in years"),
                            ("900 1\n1000\n", r"ages.txt:2: \"1000\" is not"), ("1 2 3\n", "ages.txt:1: "),
                            ("# nothing\n", "ages.txt has no ages"), ("-50\n", "ages.txt: years = .* is not a posi")):
            with self.subTest(text=text), self.assertRaisesRegex(ValueError, words):
                self.read(text)


class TheSurvival(unittest.TestCase):
    def test_of_a_power_law_is_that_of_the_closed_form_of_the_rate(self):
        found = risk.annual_rate(power_law(), CURVE)
        for age, exact in ((Age.uniform(2000, 8000), (np.exp(-2000 * EXACT) - np.exp(-8000 * EXACT)) / (6000 * EXACT)),
                           (exponential(5000), 1 / (1 + 5000 * EXACT)),
                           (Age.samples([1000, 9000]), (np.exp(-1000 * EXACT) + np.exp(-9000 * EXACT)) / 2)):
            np.testing.assert_allclose(found.survival(age), exact, rtol=4 * 2e-7)  # EXACT has seven digits; rate T < 4
            self.assertIn(f"survival of {age.text} {exact:.4g}", found.summary(age))

    def test_interval_is_that_of_the_ends_of_the_rate(self):
        curve = risk.lognormal(0.7, 0.6, im="pga", units="g", samples=[(0.7 + 0.001 * i, 0.6) for i in range(100)])
        found, age = risk.annual_rate(power_law(), curve), Age.uniform(100, 900)
        np.testing.assert_array_equal(found.survival_interval(age), np.exp(age.log_survival(found.interval[::-1])))

    def test_has_a_largest_factor(self):
        age = exponential(5000)
        on_rates = (1 / 0.05 - 1) / 5000 / EXACT
        for on, exact in (("rate", on_rates), ("level", on_rates ** (1 / K))):
            found = risk.largest_factor(power_law(), CURVE, age, 0.05, on)
            np.testing.assert_allclose(found.bounds, exact, rtol=2e-7)


if __name__ == "__main__":
    unittest.main()
