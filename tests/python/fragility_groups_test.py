"""The blocks of one site and the rows of one object in overturn.fragility(). Requires the package on PYTHONPATH."""

import itertools
import unittest

import numpy as np
import overturn
import xarray
from overturn.block_groups import groups_of
from results import NOT_COMPUTED, UNDECIDED, F, S, graded, result


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


if __name__ == "__main__":
    unittest.main()
