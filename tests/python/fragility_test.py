"""overturn.fragility(). Requires the package on PYTHONPATH."""

import csv
import pathlib
import tempfile
import unittest

import numpy as np
import overturn
import xarray
from overturn.block_groups import groups_of
from results import NOT_COMPUTED, UNDECIDED, U0, F, S, S_PLUS, graded, result


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
        median, beta, kinds = 0.4, 0.5, set()
        for _ in range(20):
            shift = random.uniform(-1.5, 1.5)
            log_measure = np.log(median) + shift + np.linspace(-0.7, 0.7, 6)
            capacity = np.log(median) + beta * random.standard_normal((10, 1, 20))
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
