"""overturn boundary with recorded ground motions."""

import unittest

import h5py
import numpy as np

from records_test import ScratchWithRecords


class ABoundaryUnderARecord(ScratchWithRecords):
    SIZES = "plane.size.values=[0.4, 0.6, 0.9]"
    STRIPS = "strips narrower than the steps of the scan are missed"

    def boundary(self, *arguments, out="boundary.h5", ranks=None):
        result = self.overturn("boundary", "job.toml", "-o", out, "--set", self.SIZES, "--set",
                               "plane.slenderness=0.2", *arguments, ranks=ranks)
        self.assert_exit(result, 0, self.STRIPS)
        return self.opened(out)

    def test_has_the_verdicts_of_the_spectrum_at_all_steps_of_the_scan(self):
        scale = "plane.scale={ first = 1.0, last = 1.5, count = 501 }"  # the finest step
        found = self.boundary("--set", scale)
        self.run_job("--set", self.SIZES, "--set", "plane.slenderness=0.2", "--set", scale,
                     "--set", "numerics.resolve=true")
        spectrum = self.opened("out.h5")
        self.assertEqual(found.unsafe_share.dims, ("size",))
        self.assertTrue((found.undecided_share == 0).all())
        flips = found.flip_amplitude.values
        self.assertGreater(np.isfinite(flips).sum(), 6)
        for column in range(3):
            here = flips[:, column][np.isfinite(flips[:, column])]
            number = np.searchsorted(here, spectrum.scale.values)
            regions = np.append(found.region_below.values[0, column],
                                found.region_above.values[:, column])
            unsafe = spectrum.region.values[:, column] > 2
            self.assertTrue(np.array_equal(regions[number] > 2, unsafe))
            share = (unsafe[1:].mean() + unsafe[:-1].mean()) / 2
            # A flip is in the middle of its step for this sum, and anywhere in it for the boundary.
            self.assertLessEqual(abs(share - float(found.unsafe_share[column])),
                                 len(here) * 0.5 / 500)

    def test_divides_the_steps_of_the_job(self):
        whole = self.boundary("--set", "plane.scale={ first = 1.0, last = 1.5, count = 501 }")
        divided = self.boundary("--set", "plane.scale={ first = 1.0, last = 1.5, count = 2 }",
                                out="divided.h5")
        with h5py.File(self.folder / "divided.h5") as file:
            self.assertEqual(len(file["run/scan_scale"]), 2)
        step = whole.flip_amplitude.finest_step * 1.5
        compared = 0
        for column in range(3):
            flips = whole.flip_amplitude.values[:, column]
            wide = np.diff(np.concatenate([[1.0], flips])) > 2 * step
            # Every scan finds the flip between two wide strips in the step that contains it, or, if
            # one end of this step is in a narrower strip, in the next one.
            for flip in flips[:-1][wide[:-1] & wide[1:]]:
                found = divided.flip_amplitude.values[:, column]
                self.assertLess(np.nanmin(np.abs(found - flip)), 2 * step)
                compared += 1
        self.assertGreater(compared, 3)

    def test_is_the_same_in_peak_accelerations(self):
        scale = self.boundary("--set", "plane.scale={ first = 1.0, last = 1.5, count = 11 }")
        peak = float(scale.record_pga)
        pga = self.boundary("--set", f"plane.pga={{ first = {peak}, last = {1.5 * peak}, "
                            "count = 11 }", out="pga.h5", ranks=2)
        self.assertTrue(np.array_equal(scale.region_above, pga.region_above))
        for field in ("flip_amplitude", "flip_pga"):
            self.assertTrue(np.allclose(scale[field], pga[field], rtol=2e-4, equal_nan=True))
        self.assertTrue(np.allclose(scale.flip_amplitude * peak, scale.flip_pga, rtol=1e-12,
                                    equal_nan=True))
        self.assertTrue(np.allclose(scale.unsafe_share, pga.unsafe_share, atol=1e-3))

    def test_is_undecided_where_gravity_is_cancelled(self):
        up = self.boundary("--set", "scene.vertical=up.AT2", "--set",
                           "plane.scale={ values = [1.0, 1.1, 8.0, 9.0] }")
        limit = 1 / -min(float(word) for word in
                         (self.folder / "up.AT2").read_text().split(" SEC\n")[1].split())
        last = np.isfinite(up.flip_amplitude.values).sum(axis=0) - 1
        for column in range(3):
            self.assertEqual(up.region_above.values[last[column], column], 254)
            self.assertLess(float(up.flip_amplitude[last[column], column]), limit)
            self.assertGreater(float(up.undecided_share[column]), (9 - limit) / 8)

    def test_is_finished_by_another_number_of_ranks(self):
        self.boundary()
        whole = (self.folder / "boundary.h5").read_bytes()
        with h5py.File(self.folder / "boundary.h5") as file:
            place = file["run/checksum"].id.get_offset()
        (self.folder / "boundary.h5").write_bytes(whole[:place] + bytes(16) + whole[place + 16:])
        self.assert_exit(self.overturn("verify", "boundary.h5"), 0, "1 of 3 tiles are done")
        self.boundary(ranks=2)
        self.assertEqual((self.folder / "boundary.h5").read_bytes(), whole)
        self.assert_exit(self.overturn("info", "boundary.h5"), 0, self.STRIPS, "unsafe_share")

    def test_is_drawn_with_a_note_on_narrower_strips(self):
        self.boundary("--set", "plane.scale={ first = 1.0, last = 1.5, count = 11 }")
        self.assertEqual(self.tool("plot_boundary", "boundary.h5", "-o", "boundary.svg").returncode, 0)
        picture = (self.folder / "boundary.svg").read_text()
        for words in ("Scanned in steps of 0.1 %", "narrower strips", "lowest flip found",
                      "scale of the record"):
            self.assertIn(words, picture)


if __name__ == "__main__":
    unittest.main(verbosity=2)
