"""overturn.fragility(). Requires the package on PYTHONPATH."""

import csv
import itertools
import pathlib
import tempfile
import unittest

import numpy as np
import overturn
import xarray
from overturn.block_groups import groups_of
from overturn.fragility_points import share_interval
from overturn.lognormal_fit import Counts, fit
from overturn.motion_bootstrap import LOGISTIC
from overturn.motion_bootstrap import fit as fit_by_motion
from scipy.optimize import minimize
from scipy.special import expit, log_expit, logit
from scipy.stats import beta as beta_law
from scipy.stats import norm
from scipy.stats import t as student_t

MEDIAN, BETA = 0.4, 0.5
AT = np.log([0.2, 0.4, 0.8])
S, S_PLUS, U0, F, UNDECIDED, NOT_COMPUTED = 0, 1, 3, 8, 254, 255


def simulated(seed, motions=50, values=10, blocks=20, shared=0.5):
    """Counts of blocks of lognormal capacity, whose logarithms have the correlation shared^2 under one
    motion; all blocks meet all values."""
    random = np.random.default_rng(seed)
    log_measure = np.log(MEDIAN) + np.linspace(-1.2, 1.2, values)
    of_motion, own = random.standard_normal((motions, 1)), random.standard_normal((motions, blocks))
    capacity = np.log(MEDIAN) + BETA * (shared * of_motion + np.sqrt(1 - shared**2) * own)
    exceeding = (capacity[:, :, None] <= log_measure).sum(axis=1)
    return Counts(log_measure, np.full((motions, values), float(blocks)), exceeding.astype(float))


def joined_suites(count):
    """Two results of different suites that number their motions alike, joined."""
    random = np.random.default_rng(7)
    parts = []
    for name in ("a", "b"):
        part = result(random.choice([S, U0], (count, 3, 4)), [1, 2, 3])
        names = np.array([f"{name}{number}.AT2" for number in range(count)])
        parts.append(part.assign_coords(motion_name=("motion", names)))
    return xarray.concat(parts, "motion")


class TheFriction(unittest.TestCase):
    def test_that_is_not_there_leaves_no_verdict(self):
        random = np.random.default_rng(8)
        region = random.choice([S, U0, UNDECIDED, NOT_COMPUTED], (12, 5, 6))
        needed = random.uniform(0.2, 0.8, region.shape)
        needed[random.random(region.shape) < 0.1] = np.nan
        needed[random.random(region.shape) < 0.1] = np.inf
        data = result(region, [1, 2, 3, 4, 5], friction_demand=needed)
        for friction in (0.3, 0.5, 2):
            known = np.isin(region, [S, U0]) & (needed <= friction)
            found = overturn.fragility(data, friction_demand=friction)
            self.assertEqual(found.points.sum(), known.sum())
            self.assertEqual(found.exceeding.sum(), (known & (region == U0)).sum())
            self.assertEqual(found.undecided, (~known & (region != NOT_COMPUTED)).sum())
            lost = (np.isin(region, [S, U0]) & ~known).sum()
            self.assertIn(f"points, which are undecided, {lost} of them because they need a friction coefficient above "
                          f"{friction:g}, or an unknown one", found.summary())
            self.assertEqual(found.summary().count("need a friction"), 1)
            if np.isfinite(found.median):
                self.assertIn(f"median and beta are those of the {known.sum()} points with a verdict", found.summary())
            share = overturn.supported_share(data, friction)
            self.assertEqual(share, known.sum() / np.isin(region, [S, U0]).sum())
            of_blocks = overturn.supported_share(data.isel(motion=[0]), friction, "block")
            self.assertEqual(of_blocks.dims, ("motion", "scale"))
        data["region"][:] = np.where(region >= UNDECIDED, S, region)
        found = overturn.fragility(data, friction_demand=0.5)
        self.assertIn(f"left out: {found.undecided} of 360 points, which need a friction", found.summary())
        data["region"][:] = region
        with self.assertRaisesRegex(ValueError, "no field friction_demand"):
            overturn.fragility(data.drop_vars("friction_demand"), friction_demand=0.5)
        for wrong in (0, -1, float("nan"), float("inf"), 35, True, "0.5"):
            with self.assertRaisesRegex(ValueError, "is not a number above 0 and up to 2"):
                overturn.fragility(data, friction_demand=wrong)


class ASlidingBlock(unittest.TestCase):
    def test_that_leaves_its_support_is_no_survivor_without_a_note(self):
        slide = np.full((12, 5, 6), 0.5)
        data = result(np.random.default_rng(9).choice([S, U0], slide.shape), [1, 2, 3, 4, 5], slide_peak=slide)
        self.assertNotIn("slide", overturn.fragility(data).summary())
        slips = data.assign_coords(friction=0.4)
        self.assertIn("a block that slides off its support counts as standing", overturn.fragility(slips).summary())
        beyond = overturn.fragility(slips, of="slide_peak", above=0.6).summary()
        self.assertIn("a block that overturns counts only if its slide_peak is above the level", beyond)
        self.assertNotIn("counts as standing", beyond)


class TheMotions(unittest.TestCase):
    def test_of_joined_suites_are_counted_by_name(self):
        self.assertEqual(overturn.fragility(joined_suites(6)).motions, 12)


class TheSite(unittest.TestCase):
    """Blocks that stand at one site: a point exceeds if one of them does."""

    def test_of_two_equal_blocks_has_the_curve_of_one(self):
        one = result(*graded()).isel(block=[3])
        two = one.isel(block=[0, 0]).assign_coords(block=[1, 2])
        alone, together = overturn.fragility(one, samples=20), overturn.fragility(two, samples=20, together="block")
        np.testing.assert_array_equal(together.samples, alone.samples)
        self.assertEqual((together.median, together.beta, together.points.sum()),
                         (alone.median, alone.beta, alone.points.sum()))
        self.assertIn("2 blocks together", together.summary())

    def test_counts_the_combinations_of_their_variants(self):
        random = np.random.default_rng(9)
        region = random.choice([S, F, UNDECIDED, NOT_COMPUTED], (11, 3, 6), p=[0.6, 0.2, 0.1, 0.1])
        needed = random.uniform(0.2, 0.7, region.shape)
        name = np.array(["b", "a", "c", "a", "b", "a"])  # 3 x 2 x 1 combinations
        data = result(region, [1, 2, 4], friction_demand=needed).assign_coords(name=("block", name.astype(object)))
        found = overturn.fragility(data, friction_demand=0.6, together="name", bins=3, samples=20)
        region = np.where((region < UNDECIDED) & (needed > 0.6), UNDECIDED, region)
        counts = dict.fromkeys(("exceeding", "not_computed", "undecided", "safe"), 0)
        for motion, scale in np.ndindex(region.shape[:2]):
            for combination in itertools.product(*(region[motion, scale, name == each] for each in "abc")):
                counts["exceeding" if F in combination else "not_computed" if NOT_COMPUTED in combination else
                       "undecided" if UNDECIDED in combination else "safe"] += 1
        self.assertEqual(found.exceeding.sum(), counts["exceeding"])
        self.assertEqual(found.points.sum(), counts["exceeding"] + counts["safe"])
        self.assertEqual((found.undecided, found.not_computed), (counts["undecided"], counts["not_computed"]))
        self.assertEqual((found.blocks, found.motions), (3, 11))

    def test_shares_the_direction_of_the_motion(self):
        # Per motion, scale and direction of the axis: all combinations of one row of each name.
        random = np.random.default_rng(10)
        for directions, names in itertools.product((1, 2, 3, 5), ("ab", "aab", "abc", "aabb", "abcc")):
            with self.subTest(directions=directions, names=names):
                region = random.choice([S, F], (4, 3, len(names), directions), p=[0.8, 0.2])
                pga = random.uniform(0.1, 1, (4, 3, directions))
                data = result(region[..., 0], [1, 2, 4]).drop_vars("region").assign(
                    region=(("motion", "scale", "block", "direction"), region.astype(np.uint8),
                            result(region[..., 0], [1, 2, 4])["region"].attrs))
                data = data.assign_coords(name=("block", np.array([*names], object)),
                                          direction=np.arange(directions) * 10.0)
                of_names = [np.flatnonzero(np.array([*names]) == name) for name in sorted(set(names))]
                combinations = [*itertools.product(*of_names)]
                fallen = np.array([(region[:, :, list(rows)] == F).any(axis=2) for rows in combinations]).sum()
                for measure in (None, pga):  # the same in all directions, or that of each one
                    if measure is not None:
                        data = data.assign_coords(pga=(("motion", "scale", "direction"), measure))
                    found = overturn.fragility(data, "pga", together="name", bins=2, samples=1)
                    self.assertEqual(found.points.sum(), 12 * directions * len(combinations))
                    self.assertEqual(found.exceeding.sum(), fallen)

    def test_of_rows_in_several_directions_stands_if_all_stand_under_the_same_motion(self):
        random = np.random.default_rng(11)
        for azimuths, columns in itertools.product((2, 3, 5, 12), ("direction", "azimuth", "block", "name", "both")):
            with self.subTest(azimuths=azimuths, column=columns):
                region = random.choice([S, F], (4, 3, azimuths), p=[0.9, 0.1])
                pga = random.uniform(0.1, 1, region.shape)  # of each direction
                angles = np.arange(azimuths) * 10.0
                data = result(region, [1, 2, 4]).assign_coords(
                    pga=(("motion", "scale", "block"), pga), direction=("block", angles), azimuth=("block", angles),
                    block=np.arange(1.0, azimuths + 1), name=("block", np.array(["rock"] * azimuths, object)),
                    both=("block", angles // 20))
                found = overturn.fragility(data, "pga", together=columns, bins=3, samples=1)
                self.assertEqual(found.points.sum(), 12)
                self.assertEqual(found.exceeding.sum(), (region == F).any(axis=2).sum())
                self.assertEqual((found.edges[0], found.edges[-1]), (pga.max(axis=2).min(), pga.max()))
                self.assertIn("pga is the largest of those in the directions of the blocks", found.notes)

    def test_may_be_the_values_of_an_axis(self):
        # Per motion and scale: all combinations of one point of each value of the axis.
        random = np.random.default_rng(13)
        for axis, other, third in itertools.product(("azimuth", "block", "size"), (1, 2, 3), (1, 2)):
            with self.subTest(axis=axis, other=other, third=third):
                region = random.choice([S, F], (4, 3, 3, other, third), p=[0.8, 0.2])
                flat = result(region[..., 0, 0], [1, 2, 4])
                data = flat.drop_vars("region").assign(region=(("motion", "scale", axis, "slenderness", "restitution"),
                                                               region.astype(np.uint8), flat["region"].attrs))
                data = data.assign_coords({axis: [1.0, 2.0, 3.0]})
                variants = [*np.ndindex(other, third)]
                fallen = sum(any(region[place][row][variant] == F for row, variant in enumerate(each))
                             for place in np.ndindex(4, 3) for each in itertools.product(variants, repeat=3))
                found = overturn.fragility(data, "pga", together=axis, bins=2, samples=1)
                self.assertEqual(found.points.sum(), 12 * len(variants) ** 3)
                self.assertEqual(found.exceeding.sum(), fallen)

    def test_is_not_told_apart_by_the_unknown_direction_of_the_motion(self):
        data = result(*graded()).expand_dims(direction=[0.0, 90.0])
        with self.assertRaisesRegex(ValueError, "direction is an axis of this result: the unknown direction"):
            overturn.fragility(data, together="direction")

    def test_has_one_motion_for_all_blocks_and_a_column_that_tells_them_apart(self):
        data = result(*graded()).assign_coords(block=np.arange(8.0))
        with self.assertRaisesRegex(ValueError, "'pgv' is not a property of the blocks"):
            overturn.fragility(data, together="pgv")
        with self.assertRaisesRegex(ValueError, "mass has empty values"):
            overturn.fragility(data.assign_coords(mass=("block", [np.nan] * 8)), together="mass")
        own = data.isel(motion=0).assign_coords(motion=("block", np.arange(8.0)), pgv=("block", np.ones(8)))
        with self.assertRaisesRegex(ValueError, "each block has a motion of its own"):
            overturn.fragility(own, together="block")
        many = xarray.concat([data.assign_coords(variant=number) for number in range(150)], "variant")
        with self.assertRaisesRegex(ValueError, "combinations of the points of 8 blocks, more than 2.53"):
            overturn.fragility(many, together="block")


class AnObject(unittest.TestCase):
    """Rows of one value of the column azimuth_of are one thing."""

    ORDER = F, NOT_COMPUTED, UNDECIDED, S  # the first that one of its rows has is its verdict

    def table(self, seed, samples=True, others=(), p=(0.6, 0.2, 0.1, 0.1)):
        """Returns a random result of two or three objects, in random order, and the names of their things."""
        random = np.random.default_rng(seed)
        things = [(name, sample) for name in "abc"[:random.integers(2, 4)] for sample in range(random.integers(1, 4))]
        things = things if samples else [(name, 0) for name, sample in things if not sample]
        rows = np.concatenate([np.full(random.integers(1, 4), i) for i in range(len(things))])
        random.shuffle(rows)
        region = random.choice([S, F, UNDECIDED, NOT_COMPUTED], (11, 3, len(rows), *others), p=p)
        flat = result(region.reshape(11, 3, len(rows), -1)[..., 0], [1, 2, 4])
        dims = ("motion", "scale", "block", "restitution")[:region.ndim]
        data = flat.drop_vars("region").assign(region=(dims, region.astype(np.uint8), flat["region"].attrs))
        data = data.assign_coords(azimuth_of=("block", np.array([things[i][0] for i in rows], object)),
                                  azimuth=("block", np.arange(len(rows)) * 10.0))
        if samples:
            data = data.assign_coords(sample=("block", np.array([float(things[i][1]) for i in rows])))
        return data, region, rows, things

    def worst(self, regions):
        return next(code for code in self.ORDER if code in regions)

    def expect(self, found, verdicts, kind):
        count = [sum(verdict == code for verdict in verdicts) for code in self.ORDER]
        self.assertEqual([found.exceeding.sum(), found.not_computed, found.undecided, found.points.sum()],
                         [*count[:3], count[0] + count[3]])
        self.assertIn(f" motions, {kind}", found.summary())

    def test_falls_if_it_falls_in_one_of_its_rows(self):
        for seed, samples, others in itertools.product(range(6), (False, True), ((), (2,))):
            data, region, rows, things = self.table(seed, samples, others)
            objects = len({name for name, _ in things})
            kind = f"{objects} objects in {len(rows)} rows" + f" of {len(things)} samples" * (len(things) > objects) + \
                ", 2 variants each" * bool(others)
            verdicts = [self.worst(region[motion, scale][(rows == i, *variant)])
                        for motion, scale in np.ndindex(11, 3) for i in range(len(things))
                        for variant in np.ndindex(others)]
            found = overturn.fragility(data, "pga", bins=3, samples=1)
            self.expect(found, verdicts, f"{kind} pooled")
            self.assertEqual(found.blocks, objects)

    def test_stands_with_the_others_at_its_site_if_each_in_one_of_its_samples_stands(self):
        for seed, samples in itertools.product(range(6), (False, True)):
            data, region, rows, things = self.table(seed, samples)
            names = sorted({name for name, _ in things})
            of_names = [[i for i, (name, _) in enumerate(things) if name == each] for each in names]
            verdicts = [self.worst([code for i in each for code in region[motion, scale, rows == i]])
                        for motion, scale in np.ndindex(11, 3) for each in itertools.product(*of_names)]
            found = overturn.fragility(data, "pga", together="azimuth_of", bins=3, samples=1)
            self.expect(found, verdicts, f"{len(names)} objects in {len(rows)} rows")
            self.assertIn(" together;", found.summary())

    def test_shares_the_unknown_direction_of_the_motion(self):
        data, region, rows, things = self.table(3, samples=False, others=(5,))
        data = data.rename(restitution="direction").assign_coords(direction=np.arange(5) * 72.0)
        for together in (None, "azimuth_of"):
            groups = [[i] for i in range(len(things))] if together is None else [range(len(things))]
            verdicts = [self.worst(region[motion, scale, :, direction][np.isin(rows, group)])
                        for motion, scale in np.ndindex(11, 3) for group in groups for direction in range(5)]
            found = overturn.fragility(data, "pga", together=together, bins=3, samples=1)
            self.expect(found, verdicts, f"{len(things)} objects in {len(rows)} rows in 5 directions "
                                         f"{'together' if together else 'pooled'}")

    def test_meets_the_largest_of_the_measures_in_its_directions(self):
        data, region, rows, things = self.table(4, samples=False, p=(0.8, 0.2, 0, 0))
        pga = np.random.default_rng(1).uniform(0.1, 1, region.shape)
        data = data.assign_coords(pga=(("motion", "scale", "block"), pga), direction=data["azimuth"])
        found = overturn.fragility(data, "pga", bins=4, samples=1)
        largest = np.stack([pga[..., rows == i].max(axis=-1) for i in range(len(things))])
        fallen = np.stack([(region[..., rows == i] == F).any(axis=-1) for i in range(len(things))])
        self.assertEqual((found.edges[0], found.edges[-1]), (largest.min(), largest.max()))
        np.testing.assert_array_equal(found.points, np.histogram(largest, found.edges)[0])
        np.testing.assert_array_equal(found.exceeding, np.histogram(largest[fallen], found.edges)[0])
        self.assertIn("pga is the largest of those in the directions of the rows of an object", found.notes)

    def test_of_rows_with_motions_of_their_own_falls_under_each_of_them(self):
        data, region, rows, things = self.table(5, samples=False)
        stacked = data.stack(row=("motion", "scale", "block"))
        own = xarray.Dataset({"region": ("block", stacked.region.values, data.region.attrs)}, coords={
            **{name: ("block", stacked[name].values) for name in ("motion", "record_pga", "scale", "azimuth_of")}})
        first, second = (overturn.fragility(each, "pga", samples=20) for each in (data, own))
        np.testing.assert_array_equal(first.exceeding, second.exceeding)
        self.assertEqual((first.median, first.motions, first.blocks), (second.median, second.motions, second.blocks))
        self.assertEqual((first.undecided, first.not_computed), (second.undecided, second.not_computed))

    def test_with_equal_rows_has_the_curve_of_one_row(self):
        one = result(*graded()).isel(block=[3])
        several = one.isel(block=[0, 0, 0]).assign_coords(azimuth_of=("block", np.array(["rock"] * 3, object)))
        for together in (None, "azimuth_of"):
            alone, found = (overturn.fragility(each, samples=20, together=how)
                            for each, how in ((one, None), (several, together)))
            np.testing.assert_array_equal(found.samples, alone.samples)
            self.assertEqual((found.median, found.points.sum(), found.blocks), (alone.median, alone.points.sum(), 1))
            self.assertIn("1 object in 3 rows;", found.summary())

    def test_is_told_apart_by_a_column_that_is_the_same_in_its_rows(self):
        data, _, rows, things = self.table(6, samples=False)
        with self.assertRaisesRegex(ValueError, 'azimuth differs within an object, .* Choose "azimuth_of"'):
            overturn.fragility(data, together="azimuth")
        data = data.assign_coords(kind=("block", np.where(data["azimuth_of"] == "a", "bust", "urn").astype(object)))
        found = overturn.fragility(data, together="kind", samples=1)
        self.assertIn("2 blocks together", found.summary())
        empty = data.assign_coords(azimuth_of=("block", np.where(rows == 0, " ", data["azimuth_of"].values).astype(object)))
        with self.assertRaisesRegex(ValueError, "row [0-9]+ of the table has an empty azimuth_of"):
            overturn.fragility(empty)
        with self.assertRaisesRegex(ValueError, "row 1 of the table has an empty sample"):
            overturn.fragility(data.assign_coords(sample=("block", np.full(len(rows), np.nan))))

    def test_counts_once_in_the_quarters_of_a_column(self):
        # Object i has i rows and the value i: the quarters of the 8 objects have two each.
        rows = np.repeat(np.arange(1, 9), np.arange(1, 9))
        region, scale = graded(blocks=len(rows))
        data = result(region, scale).assign_coords(azimuth_of=("block", rows), mass=("block", 1.0 * rows))
        groups = groups_of(data, "mass")
        self.assertEqual([len(np.unique(part["azimuth_of"])) for part in groups.values()], [2, 2, 2, 2])
        self.assertEqual(overturn.fragility(groups["mass = 7 to 8"], samples=1).kind, "objects in 15 rows")


LOGISTIC_SITE = -0.3, 5.0, 2.5  # ln(P / (1 - P)) = a + b ln PGA + c ln(PGV/PGA)


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


def result(region, scale, motions=None, pgv=1.0, **fields):
    """A result as overturn.open returns it: region (motion, scale, block)."""
    region = np.asarray(region, np.uint8)
    motions = region.shape[0]
    dims = ("motion", "scale", "block")
    names = ["S", "S_plus", "S_minus", "U0_plus", "U0_minus", "U1_plus", "U1_minus", "F_plus", "F_minus", "undecided",
             "not_computed"]
    flags = {"flag_values": np.uint8([*range(9), 254, 255]), "flag_meanings": " ".join(names)}
    data = {"region": (dims, region, flags), **{name: (dims, values) for name, values in fields.items()}}
    measures = {"record_pga": 0.5, "pgv": pgv, "arias_intensity": 3.0, "significant_duration": 8.0}
    return xarray.Dataset(data, coords={
        "motion": np.arange(1.0, motions + 1), "scale": np.asarray(scale, float),
        **{name: ("motion", np.full(motions, value), {"units": "1" if name == "record_pga" else "m s-1"})
           for name, value in measures.items()}})


def graded(motions=10, blocks=8):
    """More blocks overturn at larger scales; motions differ by one block."""
    scale = np.array([0.5, 1.0, 2.0, 4.0])
    counts = np.minimum(np.array([0, 2, 5, 7]) + np.arange(motions)[:, None] % 2, blocks)
    region = np.where(np.arange(blocks) < counts[..., None], F, S_PLUS)
    return region, scale


class TheCurve(unittest.TestCase):
    def test_counts_the_blocks_that_overturn_in_each_bin(self):
        curve = overturn.fragility(result(*graded()), "pgv", bins=4, samples=50)
        self.assertEqual(curve.points.tolist(), [80] * 4)
        self.assertEqual(curve.exceeding.tolist(), [5, 25, 55, 75])
        np.testing.assert_allclose(curve.fraction, np.array([5, 25, 55, 75]) / 80)
        self.assertEqual((curve.motions, curve.undecided, curve.not_computed, curve.notes), (10, 0, 0, ()))
        self.assertTrue(curve.median_interval[0] < curve.median < curve.median_interval[1])
        self.assertTrue((curve.band[0] <= curve.probability).all() and (curve.probability <= curve.band[1]).all())

    def test_scales_the_measures_like_the_motion(self):
        by_pgv = overturn.fragility(result(*graded(), pgv=0.8), "pgv", samples=1)
        by_pga = overturn.fragility(result(*graded()), "pga", samples=1)
        by_arias = overturn.fragility(result(*graded()), "arias_intensity", samples=1)
        self.assertAlmostEqual(by_pga.median / 0.5, by_pgv.median / 0.8, delta=1e-6)
        self.assertAlmostEqual(by_arias.median / 3.0, (by_pgv.median / 0.8) ** 2, delta=1e-6)
        self.assertAlmostEqual(by_arias.beta, 2 * by_pgv.beta, delta=1e-6)
        duration = overturn.fragility(result(*graded()), "significant_duration", samples=1)
        np.testing.assert_allclose(duration.edges, [8 / 1.05, 8 * 1.05])
        self.assertIn("no fit: all points have the same significant_duration = 8", duration.notes)

    def test_is_the_same_whether_scale_or_pga_is_the_axis(self):
        data = result(*graded())
        by_pga = data.assign_coords(pga=("scale", 0.5 * data.scale.values))
        scale = np.tile(data.scale.values, (10, 1))
        by_pga = by_pga.swap_dims(scale="pga").assign_coords(scale=(("motion", "pga"), scale))
        first, second = (overturn.fragility(each, "pga", samples=20) for each in (data, by_pga))
        self.assertEqual((first.median, first.units), (second.median, "g"))
        np.testing.assert_array_equal(first.band, second.band)

    def test_of_blocks_with_motions_of_their_own_is_the_same(self):
        data = result(*graded())
        rows = data.stack(row=("motion", "scale", "block"))
        own = xarray.Dataset({"region": ("block", rows.region.values, data.region.attrs)}, coords={
            **{name: ("block", rows[name].values) for name in ("motion", "pgv", "scale")}})
        first, second = (overturn.fragility(each, samples=20) for each in (data, own))
        self.assertEqual((first.median, first.motions), (second.median, second.motions))
        np.testing.assert_array_equal(first.band, second.band)

    def test_counts_peaks_above_a_limit(self):
        region, scale = graded()
        peak = np.where(region == F, np.inf, 0.3)
        peak[:, 0, 0] = 0.7
        curve = overturn.fragility(result(region, scale, peak=peak), of="peak", above=0.5, bins=4, samples=1)
        self.assertEqual(curve.exceeding.tolist(), [10, 25, 55, 75])
        self.assertIn("peak above 0.5 against pgv", curve.summary())
        with self.assertRaisesRegex(ValueError, "no field peak"):
            overturn.fragility(result(region, scale), of="peak", above=0.5)

    def test_counts_values_of_any_field_above_a_level_and_none_that_is_unknown(self):
        random = np.random.default_rng(12)
        region = random.choice([S, S_PLUS, U0, F, UNDECIDED, NOT_COMPUTED], (11, 4, 8))
        slide = np.where(random.random(region.shape) < 0.2, np.nan, random.uniform(0, 1, region.shape))
        impacts = random.integers(0, 6, region.shape).astype(np.uint16)
        data = result(region, [0.5, 1, 2, 4], slide_peak=slide, impacts=impacts,
                      peak=np.where(region == F, np.nan, slide))
        decided, overturns = region < UNDECIDED, (region == U0) | (region == F)
        for field, above, known, exceeding in (
                ("slide_peak", 0.3, ~np.isnan(slide), slide > 0.3), ("slide_peak", 0, ~np.isnan(slide), slide > 0),
                ("impacts", 3, True, impacts > 3), ("slide_peak", -1, ~np.isnan(slide), ~np.isnan(slide)),
                ("peak", 0.6, overturns | ~np.isnan(slide), overturns | (slide > 0.6))):
            curve = overturn.fragility(data, of=field, above=above, samples=1)
            self.assertEqual(curve.points.sum(), (decided & known).sum())
            self.assertEqual(curve.exceeding.sum(), (decided & exceeding).sum())
            self.assertEqual(curve.not_computed, (region == NOT_COMPUTED).sum())
            self.assertEqual(curve.undecided, ((region != NOT_COMPUTED) & ~(decided & known)).sum())
            self.assertIn(f"{field} above {above:g} against pgv", curve.summary())

    def test_has_the_mean_of_the_values_in_each_bin(self):
        region, scale = graded()  # at 0.5, 1, 2 and 4 m/s
        region[:, 3] = UNDECIDED
        region[0, 3, 0] = F
        curve = overturn.fragility(result(region, scale), bins=2, samples=1)
        np.testing.assert_allclose(curve.edges, [0.5, 2**0.5, 4])
        self.assertAlmostEqual(curve.mean[0], 0.5**0.5)
        self.assertAlmostEqual(curve.mean[1], (2**80 * 4) ** (1 / 81))
        curve = overturn.fragility(result(region, scale), bins=12, samples=1)
        self.assertEqual(np.isnan(curve.mean).tolist(), (curve.points == 0).tolist())

    def test_leaves_out_points_without_a_verdict_and_reports_them(self):
        region, scale = graded()
        region[0, :, 7] = UNDECIDED  # safe otherwise
        region[9, 2:] = NOT_COMPUTED
        peak = np.where(region >= UNDECIDED, np.nan, np.where(region == F, np.inf, 0.3))
        for what in ({}, {"of": "peak", "above": 0.5}):
            curve = overturn.fragility(result(region, scale, peak=peak), bins=4, samples=20, **what)
            self.assertEqual(curve.points.tolist(), [79, 79, 71, 71])
            self.assertEqual(curve.exceeding.tolist(), [5, 25, 49, 67])
            self.assertEqual(curve.without_verdict.tolist(), [1, 1, 9, 9])
            self.assertEqual((curve.undecided, curve.not_computed), (4, 16))
            self.assertIn("left out: 4 of 320 points, which are undecided", curve.notes)
            self.assertIn("the result is unfinished: 16 of 320 points are not computed and left out", curve.notes)
            self.assertIn("4 undecided, 16 not computed", curve.summary())

    def test_of_an_unfinished_result_says_how_many_motions_are_missing(self):
        random = np.random.default_rng(1)
        for _ in range(5):
            region, scale = graded()
            missing = random.choice(10, random.integers(1, 9), replace=False)
            region[missing] = NOT_COMPUTED
            notes = overturn.fragility(result(region, scale), samples=1).notes
            self.assertIn(f"the result is unfinished: {32 * len(missing)} of 320 points are not computed and left out",
                          notes)
            self.assertIn(f"{len(missing)} of 10 motions have no point with a verdict", notes)

    def test_says_if_its_median_is_outside_the_data(self):
        random = np.random.default_rng(2)
        kinds = set()
        for _ in range(20):
            shift = random.uniform(-1.5, 1.5)
            log_measure = np.log(MEDIAN) + shift + np.linspace(-0.7, 0.7, 6)
            capacity = np.log(MEDIAN) + BETA * random.standard_normal((10, 1, 20))
            data = result(np.where(capacity <= log_measure[:, None], F, S), np.exp(log_measure))
            curve = overturn.fragility(data, samples=1)
            notes = [note for note in curve.notes if note.startswith("extrapolated: the median is outside the data")]
            if np.isfinite(curve.median):
                is_outside = not np.exp(log_measure[0]) <= curve.median <= np.exp(log_measure[-1])
                self.assertEqual(len(notes), is_outside)
                kinds.add(is_outside)
        self.assertEqual(kinds, {True, False})

    def test_has_bins_of_equal_counts_if_asked(self):
        random = np.random.default_rng(14)
        for motions, bins in ((100, 7), (11, 10), (30, 4)):
            data = result(random.choice([S, F], (motions, 1, 3)), [1.0], pgv=random.uniform(0.1, 5, motions))
            found = overturn.fragility(data, bins=bins, equal_counts=True, samples=1)
            self.assertEqual(len(found.points), bins)
            self.assertLessEqual(np.ptp(found.points), 3)  # a motion more or less
            self.assertEqual((found.points.sum(), found.edges[0], found.edges[-1]),
                             (3 * motions, data.pgv.min(), data.pgv.max()))
        # Values that are equal are in one bin.
        found = overturn.fragility(result(*graded()), bins=7, equal_counts=True, samples=1)
        self.assertEqual(found.points.tolist(), [80] * 4)

    def test_says_how_many_blocks_are_pooled(self):
        data = result(*graded())
        for count in (8, 3, 1):
            curve = overturn.fragility(data.isel(block=slice(0, count)), samples=1)
            self.assertEqual(curve.blocks, count)
            self.assertIn(f"{count} rows of the table pooled" if count > 1 else "1 row of the table;", curve.summary())
        self.assertEqual(overturn.fragility(data.isel(block=0), samples=1).blocks, 1)

    def test_counts_a_block_in_several_directions_once(self):
        data = result(*graded()).rename(block="direction")
        curve = overturn.fragility(data, samples=1)
        self.assertEqual(curve.blocks, 1)
        self.assertIn("1 block in 8 directions pooled", curve.summary())
        data = xarray.concat([data, data], "size").assign_coords(
            size=("size", [0.5, 0.625], {"units": "m"}), mass_of_the_block=("size", [1.0, np.nan], {"units": "kg"}))
        self.assertIn("2 blocks in 8 directions pooled", overturn.fragility(data, samples=1).summary())
        self.assertEqual(list(groups_of(data, "size")), ["size = 0.5 m", "size = 0.625 m"])
        self.assertEqual(list(groups_of(data, "mass_of_the_block")),
                         ["mass of the block = 1 kg", "mass of the block = not given"])

    def test_of_a_group_of_blocks_is_that_of_these_blocks(self):
        random = np.random.default_rng(3)
        texts, few = random.choice(["urn", "bust", ""], 8), random.choice([1.5, 2.0], 8)
        many = random.permutation(np.arange(8.0))
        many[0] = np.nan
        data = result(*graded()).assign_coords(kind=("block", texts.astype(object)), few=("block", few),
                                               many=("block", many))
        for column, sizes in (("kind", {f"kind = {text or '(empty)'}": (texts == text).sum() for text in texts}),
                              ("few", {f"few = {number:g}": (few == number).sum() for number in few})):
            self.assertEqual({name: part.sizes["block"] for name, part in groups_of(data, column).items()}, sizes)
        quarters = groups_of(data, "many")
        self.assertEqual(list(quarters)[-1], "many = not given")
        self.assertEqual(sum(part.sizes["block"] for part in quarters.values()), 8)
        self.assertEqual(len(quarters), 5)
        # Numbers that differ in late digits only.
        close = result(*graded(blocks=8)).assign_coords(date=("block", 20190101 + np.arange(8) // 2),
                                                        number=("block", 2019001 + np.arange(8)))
        self.assertEqual({name: part.sizes["block"] for name, part in groups_of(close, "date").items()},
                         {f"date = {20190101 + i}": 2 for i in range(4)})
        self.assertEqual([part.sizes["block"] for part in groups_of(close, "number").values()], [2, 2, 2, 2])
        for column in ("motion", "pgv", "scale", "mass"):
            with self.assertRaisesRegex(ValueError, "is not a property of the blocks. This result has"):
                groups_of(data, column)
        with self.assertRaisesRegex(ValueError, "13 different texts"):
            groups_of(result(*graded(blocks=13)).assign_coords(
                name=("block", [f"block {i}" for i in range(13)])), "name")

    def test_leaves_out_points_whose_measure_has_no_logarithm(self):
        region, scale = graded()
        curve = overturn.fragility(result(region, [0.0, 1.0, 2.0, 4.0]), samples=20)
        self.assertIn("left out: 80 points whose pgv is not positive", curve.notes)
        self.assertEqual(curve.points.sum(), 240)

    def test_of_two_rocks_whose_fates_are_one_is_as_uncertain_as_that_of_one(self):
        one = result(*graded()).isel(block=[3])
        alone, pooled = (overturn.fragility(data, samples=50) for data in (one, one.isel(block=[0, 0])))
        # Of each motion, points and scores are doubled: a factor of the sums in a different order.
        np.testing.assert_allclose(pooled.samples, alone.samples, rtol=1e-6)
        np.testing.assert_allclose(pooled.fraction_interval, alone.fraction_interval, rtol=1e-12)

    def test_of_one_motion_has_no_band(self):
        for data in (result(*graded()).isel(motion=1), result(*graded()).isel(motion=[1])):
            curve = overturn.fragility(data)
            self.assertTrue(np.isfinite(curve.median) and np.isnan(curve.band).all())
            self.assertIn("no confidence band: it needs 10 motions or more, not 1", curve.notes)

    def test_refuses_what_has_no_motions_or_no_such_measure(self):
        with self.assertRaisesRegex(ValueError, "no scale"):
            overturn.fragility(result(*graded()).drop_vars("scale"))
        with self.assertRaisesRegex(ValueError, "'mass' is not an intensity measure of the motions. This result has"):
            overturn.fragility(result(*graded()), "mass")
        data = result(*graded()).assign_coords(names=("motion", [f"{i}.AT2" for i in range(10)]), width=0.5)
        for name in ("motion", "names", "width", "scale", "block", "region"):  # numbers of motions, texts, blocks
            with self.assertRaisesRegex(ValueError, f"'{name}' is not an intensity measure of the motions"):
                overturn.fragility(data, name)
        with self.assertRaisesRegex(ValueError, "bins = 0"):
            overturn.fragility(result(*graded()), bins=0)

    def test_is_written_as_a_table(self):
        region, scale = graded()
        region[:, 1] = NOT_COMPUTED
        curve = overturn.fragility(result(region, scale), bins=4, samples=20)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "curve.csv"
            curve.to_csv(path)
            lines = path.read_text().splitlines()
        comments = [line for line in lines if line.startswith("#")]
        self.assertEqual([f"# {line}" for line in curve.summary().splitlines()], comments)
        rows = list(csv.DictReader(lines[len(comments):]))
        self.assertEqual([row["points"] for row in rows], ["80", "0", "80", "80"])
        self.assertEqual([row["fraction"] for row in rows], ["0.0625", "", "0.6875", "0.9375"])
        self.assertEqual([row["fraction_low"] for row in rows],
                         ["" if np.isnan(low) else f"{low:.6g}" for low in curve.fraction_interval[0]])


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


class AnEdgeCase(unittest.TestCase):
    """There is no fit, and the curve says why."""

    def assert_no_fit(self, region, scale, note):
        curve = overturn.fragility(result(region, scale), samples=20)
        self.assertTrue(np.isnan([curve.median, curve.beta, *curve.probability, *curve.band.ravel()]).all())
        self.assertTrue(any(note in each for each in curve.notes), curve.notes)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "curve.csv"
            curve.to_csv(path)
            rows = list(csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("#")))
        self.assertEqual([row["probability"] for row in rows], [""] * len(curve.points))
        return curve

    def test_no_point_overturns(self):
        curve = self.assert_no_fit(np.full((10, 4, 8), S), [0.5, 1, 2, 4], "no fit: no point overturns, up to pgv = 4")
        self.assertEqual(curve.fraction[[0, -1]].tolist(), [0, 0])

    def test_every_point_overturns(self):
        self.assert_no_fit(np.full((10, 4, 8), U0), [0.5, 1, 2, 4], "no fit: every point overturns, down to pgv = 0.5")

    def test_all_points_have_one_value(self):
        region, scale = graded()
        curve = self.assert_no_fit(region[:, 1:2], scale[1:2], "no fit: all points have the same pgv = 1")
        self.assertEqual(curve.fraction.tolist(), [25 / 80])

    def test_no_point_has_a_verdict(self):
        curve = self.assert_no_fit(np.full((10, 4, 8), NOT_COMPUTED), [0.5, 1, 2, 4], "no fit: no point has a verdict")
        self.assertEqual((len(curve.points), curve.not_computed), (0, 320))

    def test_no_value_has_points_of_both_kinds(self):
        region = np.full((10, 4, 8), S)
        region[:, 2:] = F
        self.assert_no_fit(region, [0.5, 1, 2, 4],
                           "no point overturns up to pgv = 1, and every point does so from 2 on")

    def test_a_single_point_overturns_at_the_largest_value(self):
        region = np.full((10, 4, 8), S)
        region[:, 3] = UNDECIDED
        region[0, 3, 0] = F
        self.assert_no_fit(region, [0.5, 1, 2, 4],
                           "no point overturns up to pgv = 2, and the only point above, at 4, does so")

    def test_points_that_were_masked_or_have_unknown_codes_have_no_verdict(self):
        region, scale = graded()
        whole = result(region, scale)
        random = np.random.default_rng(5)
        kept = xarray.DataArray(random.random(whole.region.shape) < 0.5, dims=whole.region.dims)
        masked = overturn.fragility(whole.where(kept), samples=20)
        marked = whole.assign(region=whole.region.where(kept, UNDECIDED).assign_attrs(whole.region.attrs))
        expected = overturn.fragility(marked, samples=20)
        self.assertEqual((masked.points.sum(), masked.undecided), (kept.sum(), (~kept).sum()))
        self.assertEqual((masked.median, masked.beta), (expected.median, expected.beta))
        unknown = whole.assign(region=xarray.full_like(whole.region, 77))
        self.assertEqual(overturn.fragility(unknown, samples=20).points.sum(), 0)

    def test_what_is_no_field_or_no_limit_is_refused(self):
        whole = result(*graded())
        plain = xarray.DataArray(whole.region.values, dims=whole.region.dims)
        data = result(*graded())
        with self.assertRaisesRegex(ValueError, "values between the region codes"):
            overturn.fragility(data.interp(scale=data.scale.values[:-1] * 1.03))
        with self.assertRaisesRegex(ValueError, "region has no flag_meanings"):
            overturn.fragility(whole.assign(region=plain))
        for above in (float("nan"), -1, 0, 1.01, 5, 18.4, 50):
            with self.assertRaisesRegex(ValueError, f"above = {above} must be in"):
                overturn.fragility(whole, of="peak", above=above)
        with self.assertRaisesRegex(TypeError, 'no argument limit: write of="peak", above=0.4'):
            overturn.fragility(whole, limit=0.5)
        for words, what in (("above = 0.4 is the level of a field", {"above": 0.4}), ("needs above", {"of": "peak"}),
                            ("above = inf is not a finite number", {"of": "slide_peak", "above": np.inf}),
                            ("no field region of numbers .* Add it", {"of": "region", "above": 3}),
                            ("no field pgv", {"of": "pgv", "above": 3}), ("of = None is not the name", {"of": None})):
            with self.assertRaisesRegex(ValueError, words):
                overturn.fragility(whole, **what)

    def test_units_are_those_of_the_variable(self):
        whole = result(*graded())
        pga = xarray.DataArray(np.full(whole.sizes["motion"], 9.81), dims="motion", attrs={"units": "m/s2"})
        self.assertEqual(overturn.fragility(whole.assign_coords(record_pga=pga), "pga", samples=20).units, "m/s2")

    def test_fewer_points_overturn_at_larger_values(self):
        region, scale = graded()
        self.assert_no_fit(
            region[:, ::-1], scale, "no fit: the probability that a point overturns does not rise with pgv"
        )

    def test_too_many_samples_have_no_fit(self):
        region = np.full((10, 4, 8), S)
        region[:, 3] = F
        region[0, 2, :3] = F  # only this motion has scatter
        region[0, 3, 0] = S
        curve = overturn.fragility(result(region, [0.5, 1, 2, 4]), samples=200)
        self.assertTrue(np.isfinite(curve.median))
        self.assertTrue(np.isnan([*curve.band.ravel(), *curve.beta_interval]).all())
        # A sample of 10 motions lacks the first one with the probability 0.9^10 = 0.35.
        self.assertRegex("".join(curve.notes), r"no confidence band: [5-9]\d of 200 samples of the motions have no fit")


if __name__ == "__main__":
    unittest.main()
