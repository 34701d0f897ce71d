"""Filled spectra: the same bytes from any ranks and kernels and after an interruption, and an audit
that the file and the terminal report."""

import re
import shlex
import unittest

import h5py
import numpy as np

from program import Scratch, checksum

FILL = ("--set", "numerics.fill=true", "--set", 'output.fields=["region","impacts"]',
        "--set", "numerics.audit=0.01")


class FilledSpectra(Scratch):
    def fill(self, output, *arguments, ranks=None):
        result = self.overturn("run", "small.toml", "-o", output, *FILL, *arguments, ranks=ranks)
        self.assert_exit(result, 0)
        return result.stdout + result.stderr

    def test_have_the_same_bytes_with_any_number_of_ranks_and_kernel(self):
        self.fill("one.h5")
        for ranks in (2, 3, 5):
            self.fill(f"{ranks}.h5", ranks=ranks)
            self.assertEqual(checksum(self.folder / "one.h5"), checksum(self.folder / f"{ranks}.h5"))
        kernels = [kernel for kernel in ("double", "avx2", "avx512") if self.runs(kernel)]
        self.assertTrue(kernels)
        for kernel in kernels:
            self.fill(f"{kernel}.h5", "--kernel", kernel)
            self.assertEqual(checksum(self.folder / "one.h5"),
                             checksum(self.folder / f"{kernel}.h5"), kernel)

    def runs(self, kernel):
        return self.overturn("run", "small.toml", "-o", "any.h5", "--kernel", kernel, *FILL,
                             "--set", "plane.frequency.count=2").returncode == 0

    def test_are_the_integrated_spectra_with_a_record_of_what_was_integrated(self):
        text = self.fill("filled.h5")
        self.assert_exit(self.overturn("run", "small.toml", "-o", "whole.h5", *FILL[2:4]), 0)
        with h5py.File(self.folder / "filled.h5") as filled, \
                h5py.File(self.folder / "whole.h5") as whole:
            np.testing.assert_array_equal(filled["region"][:], whole["region"][:])
            np.testing.assert_array_equal(filled["impacts"][:], whole["impacts"][:])
            evaluated = filled["evaluated"][:]
            self.assertEqual(sorted(np.unique(evaluated)), [0, 1])
            checked, wrong = (int(filled[f"run/audit_{name}"][:].sum()) for name in ("checked", "wrong"))
        self.assertGreater(checked, 0)
        self.assertIn(f"{checked} filled points checked, {wrong} wrong", text)
        self.assertIn(f"{checked} filled points checked, {wrong} wrong",
                      self.overturn("info", "filled.h5").stdout)

    def test_report_the_bound_of_clopper_and_pearson(self):
        text = self.fill("filled.h5")
        with h5py.File(self.folder / "filled.h5") as file:
            checked = int(file["run/audit_checked"][:].sum())
        # None wrong of n: (1 - p)^n = 0.05.
        self.assertIn(f"at most {1 - 0.05 ** (1 / checked):.2g} of", text)

    def test_are_damaged_if_the_counts_of_an_audit_change(self):
        self.fill("filled.h5")
        self.assert_exit(self.overturn("verify", "filled.h5"), 0)
        with h5py.File(self.folder / "filled.h5", "r+") as file:
            file["run/audit_checked"][1] += np.uint64(1)
        self.assertNotEqual(self.overturn("verify", "filled.h5").returncode, 0)

    def test_are_resumed(self):
        self.fill("filled.h5")
        whole = checksum(self.folder / "filled.h5")
        with h5py.File(self.folder / "filled.h5", "r+") as file:
            file["run/checksum"][1] = 0
            file["run/audit_checked"][1] = 0
            file["evaluated"][0, 0, :128, 128:] = 255
            file["region"][0, 0, :128, 128:] = 255
            file["impacts"][0, 0, :128, 128:] = 65534
        self.fill("filled.h5")
        self.assertEqual(checksum(self.folder / "filled.h5"), whole)

    def test_are_predicted_by_check(self):
        text = self.overturn("check", "small.toml", *FILL).stdout
        self.assertRegex(text, r"% of the points are integrated; all of them would take")
        self.assertIn("field        evaluated, 60.0 kB", text)

    def test_are_refused_with_arguments_that_work(self):
        for wrong, count in (({'output.fields=["impacts", "angle", "region"]'}, 2), ({'output.fields=["margin"]'}, 2),
                             ({"plane.frequency.values=[1, 2]"}, 1),
                             ({"plane.frequency.values=[1, 2]", 'output.fields=["angle"]'}, 1)):
            given = [word for each in ("numerics.fill=true", "numerics.audit=0.1", *wrong) for word in ("--set", each)]
            refused = self.overturn("check", "small.toml", *given)
            self.assert_exit(refused, 65, "numerics.fill = true is not possible")
            advice = re.findall(r"--set (?:'[^']*'|\S+)", refused.stderr.split("not possible")[1])
            self.assertEqual(len(advice), count, refused.stderr)
            for words in map(shlex.split, advice):
                checked = self.overturn("check", "small.toml", *given, *words)
                self.assert_exit(checked, 0)
                self.assertEqual("of the points are integrated" in checked.stdout, "fill" not in words[1])
        refused = self.overturn("boundary", "small.toml", *FILL)
        self.assert_exit(refused, 65, "Use --set numerics.fill=false.")
        self.assert_exit(self.overturn("check", "small.toml", *FILL, "--set", "numerics.fill=false"), 0)

    def test_are_refused_as_boundaries(self):
        result = self.overturn("boundary", "small.toml", *FILL, "-o", "boundary.h5")
        self.assert_exit(result, 65)
        self.assertIn("numerics.fill = true is for spectra", result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
