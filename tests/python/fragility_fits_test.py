"""The fits of overturn.fragility() and overturn.fragility_plane(). Requires the package on PYTHONPATH."""

import csv
import pathlib
import tempfile
import unittest

import numpy as np
import overturn
from overturn.fragility_points import share_interval
from overturn.lognormal_fit import Counts, fit
from overturn.motion_bootstrap import LOGISTIC
from overturn.motion_bootstrap import fit as fit_by_motion
from results import NOT_COMPUTED, UNDECIDED, F, S, result
from scipy.optimize import minimize
from scipy.special import expit, log_expit, logit
from scipy.stats import beta as beta_law
from scipy.stats import norm
from scipy.stats import t as student_t

MEDIAN, BETA = 0.4, 0.5
AT = np.log([0.2, 0.4, 0.8])
LOGISTIC_SITE = -0.3, 5.0, 2.5  # ln(P / (1 - P)) = a + b ln PGA + c ln(PGV/PGA)


def simulated(seed, motions=50, values=10, blocks=20, shared=0.5):
    """Counts of blocks of lognormal capacity, whose logarithms have the correlation shared^2 under one
    motion; all blocks meet all values."""
    random = np.random.default_rng(seed)
    log_measure = np.log(MEDIAN) + np.linspace(-1.2, 1.2, values)
    of_motion, own = random.standard_normal((motions, 1)), random.standard_normal((motions, blocks))
    capacity = np.log(MEDIAN) + BETA * (shared * of_motion + np.sqrt(1 - shared**2) * own)
    exceeding = (capacity[:, :, None] <= log_measure).sum(axis=1)
    return Counts(log_measure, np.full((motions, values), float(blocks)), exceeding.astype(float))


def logistic_points(seed, motions=30, scales=8, blocks=10, shared=0.5):
    """ln PGA of the scales, ln(PGV/PGA) of the motions, and which blocks overturn (motion, scale, block), with the
    probability of LOGISTIC_SITE; those under one motion are correlated."""
    random = np.random.default_rng(seed)
    log_pga, log_ratio = np.linspace(-2.3, 1.4, scales), np.log(2) + 0.5 * random.standard_normal(motions)
    of_motion, own = random.standard_normal((motions, 1, 1)), random.standard_normal((motions, 1, blocks))
    a, b, c = LOGISTIC_SITE
    p = expit(a + b * log_pga[:, None] + c * log_ratio[:, None, None])
    return log_pga, log_ratio, norm.cdf(shared * of_motion + np.sqrt(1 - shared**2) * own) < p


def logistic_site(seed, **numbers):
    log_pga, log_ratio, fallen = logistic_points(seed, **numbers)
    return result(np.where(fallen, F, S), 2 * np.exp(log_pga), pgv=0.5 * np.exp(log_ratio))  # of records of 0.5 g


class TheFit(unittest.TestCase):
    def test_is_that_of_a_general_minimizer(self):
        counts = simulated(1)

        def cost(x):
            z = (counts.log_measure - x[0]) / np.exp(x[1])
            others = counts.points - counts.exceeding
            return -(counts.exceeding * norm.logcdf(z) + others * norm.logsf(z)).sum()
        log_median, log_beta = minimize(cost, [0.0, 0.0], method="BFGS").x
        found = fit(counts, AT, 10, 1)
        # A gradient of 1e-5 in BFGS over a curvature above 1e3, of 10,000 points, leaves 1e-8; differences of
        # the cost, about 3e3, leave 1e-6.
        self.assertAlmostEqual(np.log(found.median), log_median, delta=1e-5)
        self.assertAlmostEqual(np.log(found.beta), log_beta, delta=1e-5)

    def test_has_intervals_that_contain_the_parameters_as_often_as_they_claim(self):
        repetitions = 250
        truth = norm.cdf((AT - np.log(MEDIAN)) / BETA)
        hits = np.zeros(6)

        def log_rate(median, beta):  # of overturning under a hazard of slope 2.5; see overturn.risk
            return -2.5 * np.log(median) + (2.5 * beta) ** 2 / 2
        for seed in range(repetitions):
            found = fit(simulated(seed), AT, 400, seed)
            of_rate = np.quantile(log_rate(*found.samples.T), [0.025, 0.975])
            low, high = np.column_stack([found.median_interval, found.beta_interval, found.band, of_rate])
            true = [MEDIAN, BETA, *truth, log_rate(MEDIAN, BETA)]
            hits += (low <= true) & (true <= high)
        # Three standard deviations of a binomial count around 237.5 of 250. Intervals of 90 % would contain the
        # parameters 225 times, which is 3.6 deviations below.
        deviation = np.sqrt(repetitions * 0.95 * 0.05)
        np.testing.assert_array_less(abs(hits - 0.95 * repetitions), 3 * deviation, err_msg=f"{hits}")

    def test_has_a_band_that_rises_also_with_few_motions(self):
        # Of 40 suites of 11 motions whose blocks hardly differ, intervals of a + b s, point by point, fall in 16.
        at = np.log(MEDIAN) + BETA * np.linspace(-6, 6, 49)
        bands = [found.band for found in (fit(simulated(seed, motions=11, shared=0.9), at, 200, seed)
                                          for seed in range(40)) if found and np.isfinite(found.band).all()]
        self.assertGreater(len(bands), 30)
        self.assertGreaterEqual(min(np.diff(band).min() for band in bands), 0)

    def test_has_samples_whose_quantiles_are_the_intervals(self):
        found = fit(simulated(1), AT, 200, 1)
        self.assertEqual(found.samples.shape, (200, 2))
        low, high = np.quantile(found.samples, [0.025, 0.975], axis=0)
        # Neighbours among 200 samples differ by up to 2 % there. A quantile is interpolated between them in the numbers
        # here and in the logarithms there, which differs by at most an eighth of the square, 5e-5. Unstudentized
        # samples would differ by several per cent.
        np.testing.assert_allclose(np.stack([low, high], axis=1), [found.median_interval, found.beta_interval],
                                   rtol=1e-4)
        self.assertEqual(len(fit(simulated(1, motions=9), AT, 200, 1).samples), 0)

    def test_depends_on_the_seed_only_in_its_intervals(self):
        first, same, other = (fit(simulated(1), AT, 100, seed) for seed in (1, 1, 2))
        np.testing.assert_array_equal(first.band, same.band)
        self.assertFalse(np.array_equal(first.band, other.band))
        self.assertEqual(first.median, other.median)


class ThePlane(unittest.TestCase):
    def test_counts_the_points_of_each_bin(self):
        data = logistic_site(1)
        random = np.random.default_rng(2)
        unknown = random.choice([UNDECIDED, NOT_COMPUTED], data.region.shape)
        region = np.where(random.random(data.region.shape) < 0.1, unknown, data.region.values)
        region[:, :, 2] = np.where(region[:, :, 1] == F, F, region[:, :, 2])
        data = data.assign(region=(data.region.dims, region, data.region.attrs))
        plane = overturn.fragility_plane(data, bins=(4, 3), samples=5)
        x, y = np.broadcast_arrays((0.5 * data.scale.values)[:, None], (data.pgv / 0.5).values[:, None, None])
        for found, points in ((plane.points, region < UNDECIDED), (plane.exceeding, region == F),
                              (plane.without_verdict, region >= UNDECIDED)):
            expected = np.histogram2d(*(np.broadcast_to(each, region.shape).ravel() for each in (x, y)),
                                      [plane.x_edges, plane.y_edges], weights=points.ravel())[0]
            np.testing.assert_array_equal(found, expected)
        self.assertEqual(plane.undecided, (region == UNDECIDED).sum())
        self.assertEqual(plane.not_computed, (region == NOT_COMPUTED).sum())
        self.assertIn("against pga [g] and pgv/pga [m s-1/g]:", plane.summary())
        self.assertIn(f"left out: {plane.undecided} of 2400 points, which are undecided", plane.notes)
        self.assertEqual((np.isnan(plane.fraction) == (plane.points == 0)).all(), True)
        middles = (np.sqrt(edges[:-1] * edges[1:]) for edges in (plane.x_edges[:4], plane.y_edges))
        inside = plane.without_verdict_at(*middles)
        np.testing.assert_allclose(inside, np.diag(plane.without_verdict / (plane.points + plane.without_verdict)))

    def test_counts_an_object_once(self):
        data = logistic_site(3, blocks=6)
        of_objects = data.assign_coords(azimuth_of=("block", [1, 1, 1, 2, 2, 2]))
        region = data.region.values.reshape(30, 8, 2, 3).max(axis=-1)
        united = data.isel(block=[0, 1]).assign(region=(data.region.dims, region, data.region.attrs))
        united = united.assign_coords(block=[1, 2])
        for together in (None, "block"):
            found, expected = (overturn.fragility_plane(each, samples=5, together=how) for each, how in (
                (of_objects, together and "azimuth_of"), (united, together)))
            np.testing.assert_array_equal(found.exceeding, expected.exceeding)
            np.testing.assert_array_equal(found.samples, expected.samples)
            self.assertIn("2 objects in 6 rows", found.summary())

    def test_has_the_fit_of_a_general_minimizer(self):
        data = logistic_site(4)
        plane = overturn.fragility_plane(data, samples=5)
        x, y = np.log(0.5 * data.scale.values)[:, None], np.log(data.pgv / 0.5).values[:, None, None]
        fallen = data.region.values == F

        def cost(abc):
            z = abc[0] + abc[1] * x + abc[2] * y
            return -np.where(fallen, log_expit(z), log_expit(-z)).sum()
        # As for the curve: a gradient of 1e-5 over a curvature above 10, and differences of a cost of 400.
        np.testing.assert_allclose(plane.coefficients, minimize(cost, [0.0, 1.0, 0.0], method="BFGS").x, atol=1e-4)

    def test_has_lines_where_the_probability_is_their_share(self):
        plane = overturn.fragility_plane(logistic_site(5), samples=50)
        y = np.array([0.3, 1, 2])
        for share in (0.16, 0.5, 0.84):
            np.testing.assert_allclose(plane.probability(plane.line(y, share), y), share, rtol=1e-12)
            low, high = plane.line_interval(y, share)
            self.assertTrue((low < plane.line(y, share)).all() and (plane.line(y, share) < high).all())
        x = np.array([1e-300, 0.5, 1e300])
        for row, (a, b, c) in zip(plane.of_samples(x, y), [plane.coefficients, *plane.samples]):
            z = a + b * np.log(x[:, None]) + c * np.log(y)
            np.testing.assert_allclose(row, expit(z), rtol=1e-12, atol=1e-150)

    def test_has_intervals_that_contain_the_parameters_as_often_as_they_claim(self):
        # The line of 50 % at three ratios, ln(1/b), its slope -c/b, and ln PGA at 84 %. Measured: 92 to 95 %; with
        # fragility_plane() and 400 samples, 90 to 95 % under 30 motions, 93 to 96 % under 50.
        repetitions, (a, b, c), at = 200, LOGISTIC_SITE, np.log([1.2, 2.0, 3.3])
        truth = np.array([*(-(a + c * at) / b), -np.log(b), -c / b, (logit(0.84) - a - c * at[1]) / b])
        hits = np.zeros(6)
        for seed in range(repetitions):
            log_pga, log_ratio, fallen = logistic_points(seed, scales=6)
            exceeding = np.zeros((30, 30, 6))  # a value of both measures for each motion and scale
            exceeding[range(30), range(30)] = fallen.sum(axis=2)
            points = np.where(np.eye(30, dtype=bool)[:, :, None], 10.0, 0) + np.zeros(6)
            v, w = (each.ravel() for each in np.broadcast_arrays(log_pga, log_ratio[:, None]))
            found = fit_by_motion(points.reshape(30, -1), exceeding.reshape(30, -1),
                                  np.stack([0 * v + 1, v, w], axis=1), LOGISTIC, 200, seed)
            middle, scatter, slope = found.samples.T
            of_samples = [*(middle + slope * each for each in at), scatter, slope,
                          middle + slope * at[1] + logit(0.84) * np.exp(scatter)]
            low, high = np.quantile(of_samples, [0.025, 0.975], axis=1)
            hits += (low <= truth) & (truth <= high)
        self.assertTrue(((0.9 <= hits / repetitions) & (hits / repetitions <= 0.98)).all(), hits)

    def test_without_a_fit_says_why(self):
        data = logistic_site(6)
        for change, words in ((lambda region: np.full_like(region, S), "no fit: no point overturns"),
                              (lambda region: np.full_like(region, F), "no fit: every point overturns"),
                              (lambda region: region[:, ::-1], "does not rise with pga, or a line separates"),
                              (lambda region: np.where(data.scale.values[:, None] > 1, F, S) | 0 * region,
                               "does not rise with pga, or a line separates")):
            changed = data.assign(region=(data.region.dims, change(data.region.values), data.region.attrs))
            plane = overturn.fragility_plane(changed, samples=20)
            self.assertIn(words, plane.summary())
            self.assertTrue(np.isnan(plane.coefficients).all() and np.isnan(plane.coefficients_interval).all())
        plane = overturn.fragility_plane(data.assign_coords(pgv=0 * data.pgv + 1.0), samples=20)
        self.assertIn("no fit: all points have the same pgv/pga = 2", plane.notes)
        plane = overturn.fragility_plane(data.isel(motion=slice(0, 8)), samples=20)
        self.assertIn("no confidence band: it needs 10 motions or more, not 8", plane.notes)
        self.assertTrue(np.isnan(plane.line_interval([1.0])).all() and np.isfinite(plane.coefficients).all())
        for wrong in (5, (5,), (0, 5)):
            with self.assertRaisesRegex(ValueError, "bins = "):
                overturn.fragility_plane(data, bins=wrong)
        with self.assertRaisesRegex(ValueError, "no point of this result has a verdict"):
            overturn.fragility_plane(data.assign(region=data.region * 0 + 255).assign(
                region=lambda each: each.region.astype(np.uint8).assign_attrs(data.region.attrs)))

    def test_is_written_as_a_table(self):
        plane = overturn.fragility_plane(logistic_site(7), bins=(3, 2), samples=20)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "plane.csv"
            plane.to_csv(path)
            plane.to_csv(path)  # replaces its own
            lines = path.read_text().splitlines()
        comments = [line for line in lines if line.startswith("#")]
        self.assertEqual([f"# {line}" for line in plane.summary().splitlines()], comments)
        rows = list(csv.DictReader(lines[len(comments):]))
        self.assertEqual([int(row["points"]) for row in rows], plane.points.ravel().tolist())
        edges = [f"{end:.6g}" for end in plane.y_edges]
        self.assertEqual([(row["pgv/pga_from"], row["pgv/pga_to"]) for row in rows], [*zip(edges[:-1], edges[1:])] * 3)
        middle = [[np.sqrt(float(row[f"{name}_from"]) * float(row[f"{name}_to"])) for row in rows]
                  for name in ("pga", "pgv/pga")]
        np.testing.assert_allclose([float(row["probability"]) for row in rows], plane.probability(*middle),
                                   rtol=1e-4)  # of edges of six digits


class TheShareOfABin(unittest.TestCase):
    def test_is_between_ends_that_contain_it_as_often_as_they_claim(self):
        repetitions = 2000
        for motions, blocks, share, shared in ((10, 20, 0.5, 0.5), (50, 20, 0.05, 0.5), (30, 50, 0.3, 0.0)):
            random = np.random.default_rng(15)
            of_motion = random.standard_normal((motions, repetitions, 1))
            own = random.standard_normal((motions, repetitions, blocks))
            fallen = shared * of_motion + np.sqrt(1 - shared**2) * own < norm.ppf(share)
            low, high = share_interval(np.full((motions, repetitions), float(blocks)), fallen.sum(axis=2).astype(float))
            found = ((low <= share) & (share <= high)).mean()
            # Measured: 0.94 to 0.96. A binomial interval contains the share in 0.66 of the first bins.
            self.assertTrue(0.925 < found < 0.975, found)

    def test_of_none_or_all_is_that_of_as_many_independent_points_as_motions(self):
        points = np.array([[5.0, 5, 0], [2, 2, 3], [7, 7, 0]])
        low, high = share_interval(points, points * [0, 1, 1])
        np.testing.assert_allclose(low, [0, beta_law.ppf(0.025, 3, 1), np.nan], rtol=1e-12)
        np.testing.assert_allclose(high, [beta_law.ppf(0.975, 1, 3), 1, np.nan], rtol=1e-12)

    def test_is_not_more_certain_because_the_motions_have_equal_shares(self):
        points = np.full((4, 1), 10.0)
        low, high = share_interval(points, points / 2)
        width = student_t.ppf(0.975, 3) / np.sqrt(40 * 0.25)  # of 40 independent points
        np.testing.assert_allclose(np.log([*low / (1 - low), *high / (1 - high)]), [-width, width], rtol=1e-12)


if __name__ == "__main__":
    unittest.main()
